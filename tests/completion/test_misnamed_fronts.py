"""Drawers that are called doors, and doors that are called drawers, are corrected; all other names are kept."""

from dataclasses import replace
from math import log

import pytest

from grafu.asset.part import Asset, PartSource
from grafu.completion.features import FeatureConfig
from grafu.completion.misnamed_fronts import with_corrected_fronts
from grafu.completion.network import complete_by_network
from grafu.completion.static_guesses import with_static
from grafu.graph.edges import Hinge
from grafu.graph.edit import with_edges
from grafu.graph.parse import parse_graph
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_choices import MotionChoice, Moves, Side
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.refusal import Reason, Refusal
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel
from network_answers import Answers
from small_scenes import box

FEW = FeatureConfig(points=16, anchors=2, neighbours=2)
DOOR, DRAWER, SHELF, MISC = PartLabel.DOOR, PartLabel.DRAWER, PartLabel.SHELF, PartLabel.MISC
SIDES = tuple(
    replace(box(f"side_{k}", (x, 0.0, 0.0), (x + 0.02, 0.5, 0.8)), label=PartLabel.SIDE_PANEL)
    for k, x in enumerate((-0.32, 0.3))
)
FRONT = box("front", (-0.3, -0.02, 0.1), (0.3, 0.0, 0.3))


def asset_of(label):
    return Asset("made", "", "made", (*SIDES, replace(FRONT, label=label, labelled_by="name")))


def completed(stated, seen, probability, named=("front",), edges=()):
    """Returns the completion of a front that is called `stated` and taken for `seen`."""
    graph = with_edges(parse_graph(asset_of(stated)), edges)
    odds = log(probability / (1 - probability))
    said = Answers(labels={"front": {seen: odds + 8.0, stated: 8.0}})
    return complete_by_network(graph, said.about(graph), FEW, named=named)


@pytest.mark.parametrize(("stated", "seen"), [(DOOR, DRAWER), (DRAWER, DOOR)])
def test_a_front_is_what_the_network_is_sure_of_and_the_asset_follows(stated, seen):
    found = completed(stated, seen, 0.9)
    assert found.completed.node("front").label is seen
    decision = found.decision("front", "label")
    assert decision is not None
    assert (decision.choice, decision.runner_up) == (seen, stated)
    assert decision.score == pytest.approx(0.9, abs=0.01)
    asset = with_corrected_fronts(asset_of(stated), found)
    assert (asset.part("front").label, asset.part("front").labelled_by) == (seen, "prediction")
    how = "left" if stated is DOOR else "slides"
    note = f"front is called a {stated}, but is a {seen} by its shape (90%): --move front={how} moves it as a {stated}"
    assert asset.notes == (note,)


@pytest.mark.parametrize(
    ("stated", "seen", "probability", "named", "edges"),
    [
        (DOOR, DRAWER, 0.7, ("front",), ()),  # not sure enough
        (DOOR, DRAWER, 0.9, (), ()),  # the user or an annotation states it
        (DOOR, SHELF, 0.99, ("front",), ()),  # that it moves is kept
        (MISC, DRAWER, 0.99, ("front",), ()),  # and that it does not
        (DOOR, DRAWER, 0.9, ("front",), (Hinge("side_0", "front", 0, 0),)),  # its motion is stated
    ],
)
def test_all_other_names_are_kept(stated, seen, probability, named, edges):
    found = completed(stated, seen, probability, named, edges)
    assert found.completed.node("front").label is stated
    assert found.decision("front", "label") is None
    assert with_corrected_fronts(asset_of(stated), found) == asset_of(stated)


def board(name, low, high, label, by="name"):
    return replace(box(name, low, high), label=label, labelled_by=by)


CASE = (
    board("left", (0.0, 0.0, 0.0), (0.02, 0.5, 0.8), PartLabel.SIDE_PANEL),
    board("right", (0.58, 0.0, 0.0), (0.6, 0.5, 0.8), PartLabel.SIDE_PANEL),
    board("back", (0.02, 0.48, 0.0), (0.58, 0.5, 0.8), PartLabel.BACK_PANEL),
    board("bottom", (0.02, 0.0, 0.0), (0.58, 0.48, 0.02), PartLabel.BOTTOM_PANEL),
    board("top", (0.0, 0.0, 0.8), (0.6, 0.5, 0.82), PartLabel.TOP_PANEL),
)


def fronts(label, count, height):
    """Returns fronts above one another that close the case, and a bar across the middle of each."""
    made = []
    for k in range(count):
        low = 0.005 + k * (height + 0.005)
        made.append(board(f"{label}_{k}", (0.003, -0.02, low), (0.597, 0.0, low + height), label))
        middle = low + height / 2
        bar = ((0.22, -0.05, middle - 0.006), (0.38, -0.02, middle + 0.006))
        made.append(board(f"handle_{k}", *bar, PartLabel.HANDLE))
    return made


def labels_built(parts, **settings):
    asset = Asset("made", "", "made", (*CASE, *parts))
    config = PipelineConfig(settings=Settings(motion=MotionSource.NETWORK, **settings))
    made = functionalize(asset, MotionSource.NETWORK, builtin_gallery(), config)
    kinds = {joint.child: joint.type.value for joint in made.object.joints if "handle" not in joint.child}
    return {part.id: (part.label, kinds.get(part.id)) for part in made.asset.parts if part.label.is_movable}


def test_a_chest_whose_fronts_are_all_called_doors_has_drawers():
    found = labels_built(fronts(DOOR, 4, 0.19))
    assert found == {f"door_{k}": (DRAWER, "prismatic") for k in range(4)}


def test_what_is_called_the_door_of_a_dishwasher_is_no_drawer():
    lowest, *others = fronts(DOOR, 4, 0.19)
    found = labels_built([replace(lowest, source=PartSource("dish_washer_door")), *others])
    assert found["door_0"] == (DOOR, "revolute")
    assert found["door_3"] == (DRAWER, "prismatic")


PLATE = ((0.003, -0.02, 0.005), (0.597, 0.0, 0.795))
BAR = ((0.54, -0.05, 0.3), (0.552, -0.02, 0.5))
FRAME = PartLabel.FACE_FRAME


def called(label, odds, seen=DOOR, front=PLATE, handle=BAR, also=()):
    """Returns what a front of a case with a handle is, which is called `label` and by the network likely is `seen`."""
    parts = (*CASE, board("front", *front, label), board("bar", *handle, PartLabel.HANDLE), *also)
    graph = parse_graph(Asset("made", "", "made", parts))
    said = Answers(labels={"front": {seen: odds + 8.0, label: 8.0}})
    names = [part.id for part in parts]
    found = complete_by_network(graph, said.about(graph), FEW, named=names)
    return found, with_corrected_fronts(Asset("made", "", "made", parts), found)


@pytest.mark.parametrize("seen", [DOOR, DRAWER])
@pytest.mark.parametrize("label", [FRAME, PartLabel.SIDE_PANEL, MISC])
def test_what_has_a_bar_and_is_called_a_part_that_stays_is_what_the_network_is_sure_of(label, seen):
    found, asset = called(label, 4.0, seen)
    assert found.completed.node("front").label is seen
    assert [edge.child for edge in found.completed.motions] == ["front"]
    assert (asset.part("front").label, asset.part("front").labelled_by) == (seen, "prediction")
    assert asset.notes == (
        f"front is called a {label}, but is a {seen} by its shape (98%): --move front=fixed keeps it still",
    )


NEXT = board("door", (0.603, -0.02, 0.005), (1.2, 0.0, 0.795), DOOR)


@pytest.mark.parametrize(
    "other",
    [
        {"odds": 1.5},  # 0.82: not sure enough
        {"handle": ((0.54, -0.05, 0.38), (0.57, -0.02, 0.42))},
        {"handle": ((0.2, 0.1, 0.82), (0.4, 0.12, 0.85))},  # on the top
        {"handle": ((0.59, -0.05, 0.3), (0.61, -0.02, 0.5)), "also": (NEXT,)},  # of the door beside it
    ],
    ids=["unsure", "a knob", "no handle", "another's handle"],
)
def test_what_is_called_a_part_that_stays_stays_otherwise(other):
    found, asset = called(FRAME, **{"odds": 4.0, **other})
    assert found.completed.node("front").label is FRAME
    assert asset.part("front").labelled_by == "name"


def test_a_front_that_shape_keeps_still_keeps_its_name():
    found, _ = called(FRAME, 4.0)
    still = with_static(found, [Refusal("front", Reason.UNLIKELY, "it lies on a wall")])
    assert still.completed.node("front").label is FRAME
    assert still.decision("front", "label") is None
    assert [refusal.part for refusal in still.refused] == ["front"]
    assert not still.completed.motions


def test_a_door_that_is_called_a_face_frame_opens_unless_the_user_fixes_it():
    parts = [board("front", *PLATE, FRAME), board("bar", *BAR, PartLabel.HANDLE)]
    assert labels_built(parts) == {"front": (DOOR, "revolute")}
    assert labels_built(parts, motions={"front": MotionChoice(Moves.FIXED)}) == {}


def test_what_the_user_moves_is_what_the_user_calls_it():
    found = labels_built(fronts(DOOR, 4, 0.19), motions={"door_0": MotionChoice(Moves.TURNS, Side.LEFT)})
    assert found["door_0"] == (DOOR, "revolute")
    assert found["door_3"] == (DRAWER, "prismatic")


def test_the_one_front_of_a_cabinet_is_a_door_as_it_is_called():
    front = board("door", (0.003, -0.02, 0.005), (0.597, 0.0, 0.795), DOOR)
    bar = board("handle", (0.54, -0.05, 0.3), (0.552, -0.02, 0.5), PartLabel.HANDLE)
    assert labels_built([front, bar]) == {"door": (DOOR, "revolute")}
