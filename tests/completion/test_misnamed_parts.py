"""Doors and drawers that are called another part are corrected where the network is sure; all other names are kept."""

from dataclasses import replace
from math import log

import pytest

from grafu.asset.part import Asset, PartSource
from grafu.completion.features import FeatureConfig
from grafu.completion.misnamed_parts import with_corrected_names
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
    asset = with_corrected_names(asset_of(stated), found)
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
        (MISC, DRAWER, 0.94, ("front",), ()),  # not sure enough without a handle
        (MISC, DRAWER, 0.99, (), ()),
        (DOOR, DRAWER, 0.9, ("front",), (Hinge("side_0", "front", 0, 0),)),  # its motion is stated
    ],
)
def test_all_other_names_are_kept(stated, seen, probability, named, edges):
    found = completed(stated, seen, probability, named, edges)
    assert found.completed.node("front").label is stated
    assert found.decision("front", "label") is None
    assert with_corrected_names(asset_of(stated), found) == asset_of(stated)


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
    return found, with_corrected_names(Asset("made", "", "made", parts), found)


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


KNOB = ((0.54, -0.05, 0.38), (0.57, -0.02, 0.42))
NO_BAR = {
    "a knob": {"handle": KNOB},
    "no handle": {"handle": ((0.2, 0.1, 0.82), (0.4, 0.12, 0.85))},  # on the top
    "another's handle": {"handle": ((0.59, -0.05, 0.3), (0.61, -0.02, 0.5)), "also": (NEXT,)},  # of the door beside it
}


@pytest.mark.parametrize("other", NO_BAR.values(), ids=NO_BAR)
def test_without_a_bar_the_network_must_be_surer(other):
    assert called(FRAME, 3.5, **other)[0].completed.node("front").label is DOOR  # 0.97
    found, asset = called(FRAME, 2.5, **other)  # 0.92
    assert found.completed.node("front").label is FRAME
    assert asset.part("front").labelled_by == "name"


BOARD_BEFORE = board("board", (0.003, -0.06, 0.0), (0.597, -0.04, 0.8), PartLabel.BACK_PANEL)
KNOBS = tuple(
    board(f"knob_{k}", (0.1 * k, -0.05, 0.7), (0.1 * k + 0.03, -0.02, 0.74), PartLabel.HANDLE) for k in (1, 2)
)


@pytest.mark.parametrize(
    "other",
    [
        {"odds": 1.5},  # 0.82: not sure enough
        {
            "front": ((0.02, 0.44, 0.02), (0.58, 0.46, 0.78)),
            "handle": NO_BAR["no handle"]["handle"],
            "also": (BOARD_BEFORE,),
        },
        {"handle": KNOB, "also": KNOBS},
        {"handle": KNOB, "also": (board("drawer", (0.1, -0.015, 0.1), (0.5, -0.005, 0.3), DRAWER),)},
    ],
    ids=["unsure", "hidden", "a panel of controls", "around a drawer"],
)
def test_what_is_called_a_part_that_stays_stays_otherwise(other):
    found, asset = called(FRAME, **{"odds": 4.0, **other})
    assert found.completed.node("front").label is FRAME
    assert asset.part("front").labelled_by == "name"


def test_one_of_two_doors_without_a_handle_that_is_called_another_part_opens():
    doors = [
        board("left_door", (0.003, -0.02, 0.005), (0.2985, 0.0, 0.795), DOOR),
        board("right_door", (0.3015, -0.02, 0.005), (0.597, 0.0, 0.795), MISC),
    ]
    assert labels_built(doors) == dict.fromkeys(("left_door", "right_door"), (DOOR, "revolute"))


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


def called_a_door(name, seen, odds, also=()):
    """Returns the completion of a case, a board of which is called a door and by the network likely is `seen`."""
    boards = [replace(part, label=DOOR) if part.id == name else part for part in CASE]
    parts = (*boards, board("front", *PLATE, DOOR), *also)
    graph = parse_graph(Asset("made", "", "made", parts))
    said = Answers(labels={name: {seen: odds + 8.0, DOOR: 8.0}, "front": {DOOR: 20.0}})
    names = [part.id for part in parts]
    return complete_by_network(graph, said.about(graph), FEW, named=names).completed.node(name).label


PULL = board("pull", (-0.02, 0.1, 0.3), (0.0, 0.12, 0.5), PartLabel.HANDLE)


def test_a_panel_that_is_called_a_door_is_a_panel():
    assert called_a_door("left", PartLabel.SIDE_PANEL, 4.0) is PartLabel.SIDE_PANEL
    assert called_a_door("back", PartLabel.BACK_PANEL, 4.0) is PartLabel.BACK_PANEL
    assert called_a_door("bottom", PartLabel.BOTTOM_PANEL, 4.0) is PartLabel.BOTTOM_PANEL


def test_what_is_called_a_door_is_one_otherwise():
    assert called_a_door("left", PartLabel.SIDE_PANEL, 3.0) is DOOR  # 0.95: not sure enough
    assert called_a_door("left", PartLabel.SIDE_PANEL, 4.0, (PULL,)) is DOOR  # a handle is on it
    assert called_a_door("top", PartLabel.TOP_PANEL, 4.0) is DOOR  # a lid looks like a top


def test_a_side_that_is_called_a_door_stays_unless_the_user_opens_it():
    sides = [replace(part, label=DOOR) if part.id == "left" else part for part in CASE]
    parts = (*sides, board("front", *PLATE, DOOR), board("bar", *BAR, PartLabel.HANDLE))
    config = PipelineConfig(settings=Settings(motion=MotionSource.NETWORK))
    made = functionalize(Asset("made", "", "made", parts), MotionSource.NETWORK, builtin_gallery(), config)
    assert [joint.child for joint in made.object.joints if "handle" not in joint.child] == ["front"]
    assert made.asset.part("left").label is PartLabel.SIDE_PANEL
    (note,) = [note for note in made.asset.notes if note.startswith("left ")]
    assert note.startswith("left is called a door, but is a side panel by its shape (")
    assert note.endswith("): --move left=left moves it as a door")
