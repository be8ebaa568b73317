"""Drawers come out to the side from which they are seen, whatever was predicted."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.asset.part import Asset
from grafu.completion.ways_out import WayOutConfig, with_ways_out
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Contact, Rail
from grafu.graph.edit import with_edges
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
