"""Drawers come out, and lids open, to the side from which they are seen, whatever was predicted."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.asset.part import Asset
from grafu.completion.ways_out import WayOutConfig, rest_of, rest_through, with_ways_out
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.raycast import RayCaster, open_ratios
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Contact, Hinge, Rail
from grafu.graph.edit import with_edges
from grafu.graph.motion import opening_face
from grafu.graph.parse import ParsingConfig, parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

FRONT = 2  # -Y
CASE = {
    "left": ((-0.4, 0.0, 0.0), (-0.38, 0.5, 0.3)),
    "right": ((0.38, 0.0, 0.0), (0.4, 0.5, 0.3)),
    "top": ((-0.4, 0.0, 0.28), (0.4, 0.5, 0.3)),
    "back": ((-0.4, 0.48, 0.0), (0.4, 0.5, 0.3)),
}
PLATE = ((-0.37, -0.02, 0.02), (0.37, 0.0, 0.27))
BLOCK = ((-0.37, 0.0, 0.02), (0.37, 0.47, 0.27))


def completed(drawer, axis: int, without: tuple[str, ...] = (), **also) -> tuple[GraphCompletion, Asset]:
    parts = [replace(box(n, *ends), label=PartLabel.SIDE_PANEL) for n, ends in CASE.items() if n not in without]
    parts += [replace(box("drawer", *drawer), label=PartLabel.DRAWER)]
    parts += [replace(box(n, *ends), label=PartLabel.SIDE_PANEL) for n, ends in also.items()]
    asset = Asset("made", "", "made", tuple(parts))
    graph = parse_graph(asset, ParsingConfig(contact="none"))
    graph = replace(graph, edges=tuple(e for e in graph.edges if not isinstance(e, Contact)))
    edges = [Rail(side, "drawer", axis) for side in ("left", "right") if side not in without]
    return GraphCompletion(graph, with_edges(graph, edges), "network"), asset


def axes(completion: GraphCompletion) -> set[int]:
    return {edge.axis for edge in completion.completed.edges if isinstance(edge, Rail)}


@given(axis=st.sampled_from(range(4)))
def test_a_plate_comes_out_across_itself_to_the_open_side(axis):
    completion, asset = completed(PLATE, axis)
    found = with_ways_out(completion, asset)
    assert axes(found) == {FRONT}
    if axis != FRONT:
        told = found.decision("drawer", "slide")
        assert (told.choice, told.runner_up, told.by) == ("2", str(axis), "rule")
        assert told.score >= WayOutConfig().seen


@pytest.mark.parametrize("axis", [2, 3])
def test_a_box_comes_out_of_the_open_side_of_its_case(axis):
    completion, asset = completed(BLOCK, axis)
    assert axes(with_ways_out(completion, asset)) == {FRONT}


@pytest.mark.parametrize(
    ("without", "also"),
    [(("back",), {}), ((), {"wall": ((-1.0, -0.3, -0.5), (1.0, -0.28, 1.0))})],
    ids=["open on both sides", "open on neither"],
)
def test_what_is_seen_from_both_sides_or_none_stays_as_predicted(without, also):
    completion, asset = completed(BLOCK, 3, without, **also)
    assert with_ways_out(completion, asset) is completion


def test_a_drawer_that_is_predicted_to_rise_stays():
    completion, asset = completed(PLATE, 5)
    assert with_ways_out(completion, asset) is completion


TUB = {
    "left": ((-0.4, 0.0, 0.0), (-0.38, 0.5, 0.5)),
    "right": ((0.38, 0.0, 0.0), (0.4, 0.5, 0.5)),
    "front": ((-0.4, 0.0, 0.0), (0.4, 0.02, 0.5)),
    "back": ((-0.4, 0.48, 0.0), (0.4, 0.5, 0.5)),
    "floor": ((-0.4, 0.0, 0.0), (0.4, 0.5, 0.02)),
}
LID = ((-0.38, 0.02, 0.48), (0.38, 0.48, 0.5))


def with_lid(sign: int, turned: bool = False, **also) -> tuple[GraphCompletion, Asset]:
    """Returns a tub whose lid hangs on its back; `turned` upside down, so that it closes a case from below."""

    def placed(low, high):
        return ((*low[:2], -high[2]), (*high[:2], -low[2])) if turned else (low, high)

    boards = [replace(box(n, *placed(*ends)), label=PartLabel.SIDE_PANEL) for n, ends in {**TUB, **also}.items()]
    asset = Asset("made", "", "made", (*boards, replace(box("lid", *placed(*LID)), label=PartLabel.DOOR)))
    graph = parse_graph(asset, ParsingConfig(contact="none"))
    predicted = Decision("lid", "sign", str(sign), 0.6, str(1 - sign), 0.4)
    return GraphCompletion(
        graph, with_edges(graph, [Hinge("back", "lid", 3, sign)]), "network", (), (predicted,)
    ), asset


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("sign", [0, 1])
def test_a_lid_opens_to_the_side_that_it_is_seen_from(sign, turned):
    completion, asset = with_lid(sign, turned)
    found = with_ways_out(completion, asset)
    (hinge,) = found.completed.hinges
    outside = 4 if turned else 5
    assert opening_face(2, hinge.border, hinge.sign) == outside
    assert found.decision("lid", "sign").choice == str(hinge.sign)
    assert (found is completion) == (opening_face(2, 3, sign) == outside)


@pytest.mark.parametrize(("height", "opens_up"), [(1.2, True), (0.7, False)])
@pytest.mark.parametrize("sign", [0, 1])
def test_a_lid_below_a_shelf_opens_up_where_the_shelf_is_high_enough(sign, height, opens_up):
    completion, asset = with_lid(sign, shelf=((-0.4, 0.0, height), (0.4, 0.5, height + 0.02)))
    found = with_ways_out(completion, asset)
    (hinge,) = found.completed.hinges
    assert hinge.sign == sign or opens_up
    assert not opens_up or opening_face(2, hinge.border, hinge.sign) == 5


@pytest.mark.parametrize("sign", [0, 1])
def test_a_leaf_that_is_seen_from_above_and_below_stays_as_predicted(sign):
    completion, asset = with_lid(sign)
    boards = tuple(part for part in asset.parts if part.id != "floor")
    graph = parse_graph(replace(asset, parts=boards), ParsingConfig(contact="none"))
    leaf = replace(completion, input=graph, completed=with_edges(graph, completion.completed.hinges))
    assert with_ways_out(leaf, replace(asset, parts=boards)) is leaf


@pytest.mark.parametrize(("score", "without", "front"), [(0.5, (), 2), (0.9, (), 3), (0.5, ("back",), 3)])
def test_an_upright_door_opens_to_where_it_is_seen_if_that_was_not_clear(score, without, front):
    """What is clear is believed, and a leaf that is seen from both sides does not tell."""
    boards = [replace(box(n, *ends), label=PartLabel.SIDE_PANEL) for n, ends in CASE.items() if n not in without]
    asset = Asset("made", "", "made", (*boards, replace(box("door", *PLATE), label=PartLabel.DOOR)))
    graph = parse_graph(asset, ParsingConfig(contact="none"))
    inwards = next(sign for sign in (0, 1) if opening_face(1, 0, sign) == 3)
    predicted = Decision("door", "sign", str(inwards), score, str(1 - inwards), 1 - score)
    hinged = with_edges(graph, [Hinge("left", "door", 0, inwards)])
    (hinge,) = with_ways_out(GraphCompletion(graph, hinged, "network", (), (predicted,)), asset).completed.hinges
    assert opening_face(1, hinge.border, hinge.sign) == front


@given(
    low=st.tuples(*(st.floats(-0.5, 0.3) for _ in range(3))),
    size=st.tuples(*(st.floats(0.05, 0.3) for _ in range(3))),
)
def test_what_is_left_out_of_the_rest_no_ray_along_an_axis_through_the_part_meets(low, size):
    """Most of a large model lies aside of a drawer; rays are cast on what does not alone."""
    drawer = (low, tuple(a + b for a, b in zip(low, size, strict=True)))
    completion, asset = completed(drawer, FRONT)
    part = asset.part("drawer")
    rest = rest_through(asset, "drawer", completion.completed)
    whole = RayCaster(merge_meshes([other.mesh for other in asset.parts if other is not part]))
    for axis in range(3):
        assert open_ratios(rest, part.box, axis) == open_ratios(whole, part.box, axis)


def test_what_is_aside_of_a_part_and_behind_it_is_in_the_rest():
    """What could hold a drawer is looked for beside its front and behind it, where no ray through the front leads."""
    completion, asset = completed(PLATE, FRONT)
    behind = np.array([[0.0, 0.2, 0.15]])
    assert np.isfinite(rest_of(asset, "drawer", completion.completed).along(behind, np.array([1.0, 0.0, 0.0]))).all()
