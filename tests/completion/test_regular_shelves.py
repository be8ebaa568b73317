"""Shelves that a regular row lacks come back where they stood; rows that only look regular get none."""

from collections.abc import Collection

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from grafu.completion.decode_config import DecodeConfig, RegularConfig
from grafu.completion.features import FeatureConfig
from grafu.completion.network import complete_by_network
from grafu.completion.regular_shelves import missing_shelves
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel
from network_answers import Answers

THICK, PITCH, WIDTH, DEPTH = 0.02, 0.3, 0.8, 0.35


def board(name: str, label: PartLabel, z: float, x: float = 0.02, width: float = WIDTH) -> PartNode:
    return PartNode(name, label, Box(vec3(x, 0.0, z), vec3(x + width, DEPTH, z + THICK)))


def bookcase(heights: Collection[float], top: float) -> FunctionalGraph:
    """Returns a bookcase with shelves at these heights, its top's underside at `top` (metres)."""
    sides = [
        PartNode(name, PartLabel.SIDE_PANEL, Box(vec3(x, 0.0, 0.0), vec3(x + THICK, DEPTH, top + THICK)))
        for name, x in (("left", 0.0), ("right", WIDTH + THICK))
    ]
    shelves = [board(f"shelf_{k}", PartLabel.SHELF, z) for k, z in enumerate(heights)]
    ends = [board("bottom", PartLabel.BOTTOM_PANEL, 0.0), board("top", PartLabel.TOP_PANEL, top)]
    return FunctionalGraph("bookcase", (*sides, *shelves, *ends), ())


def found_in(graph: FunctionalGraph) -> list[float]:
    return sorted(float(shelf.box.low[2]) for shelf in missing_shelves(graph, RegularConfig()))


@given(count=st.integers(3, 9), data=st.data())
def test_the_shelves_that_an_even_row_lacks_come_back(count: int, data: st.DataObject) -> None:
    heights = [PITCH * (k + 1) for k in range(count)]
    gone = data.draw(st.sets(st.sampled_from(heights), max_size=count - 2))
    left = [z for z in heights if z not in gone]
    gaps = np.diff([0.0, *left, PITCH * (count + 1)])
    assume(2 * sum(gaps < 1.5 * PITCH) >= len(gaps))  # else the pitch is in doubt
    assume(gaps.max() < 3.5 * PITCH)  # else the gap is meant so
    assert found_in(bookcase(left, PITCH * (count + 1))) == pytest.approx(sorted(gone))


@given(
    gaps=st.lists(st.floats(0.2, 0.55), min_size=3, max_size=6).filter(
        lambda gaps: all(abs(g / min(gaps) - round(g / min(gaps))) > 0.15 for g in gaps if g > min(gaps))
    )
)
def test_an_uneven_row_gets_none(gaps: list[float]) -> None:
    assume(len({round(g, 3) for g in gaps}) == len(gaps))
    heights = np.cumsum(gaps).tolist()
    assert found_in(bookcase(heights[:-1], heights[-1])) == []


def test_one_shelf_or_two_at_one_to_two_state_no_row() -> None:
    assert found_in(bookcase([PITCH], 3 * PITCH)) == []
    off = 0.03 * PITCH
    assert found_in(bookcase([PITCH, 2 * PITCH + off], 4 * PITCH)) == []


def test_one_narrow_gap_above_the_plinth_states_no_pitch() -> None:
    assert found_in(bookcase([0.1, 0.4, 0.7], 1.1)) == []  # gaps of 1, 3, 3 and 4 to one


def test_a_gap_as_high_as_many_shelves_is_meant_so() -> None:
    heights = [PITCH * k for k in range(1, 6)]
    assert found_in(bookcase(heights, 8 * PITCH)) == pytest.approx([6 * PITCH, 7 * PITCH])
    assert found_in(bookcase(heights, 9 * PITCH)) == []


def test_a_flat_part_with_another_label_fills_its_place() -> None:
    heights = [PITCH, 2 * PITCH, 3 * PITCH, 5 * PITCH, 7 * PITCH]
    graph = bookcase(heights, 8 * PITCH)
    nodes = (*graph.nodes, board("drawer", PartLabel.DRAWER, 4 * PITCH + 0.01))
    assert found_in(FunctionalGraph("bookcase", nodes, ())) == pytest.approx([6 * PITCH])


def test_rows_side_by_side_are_rows_of_their_own() -> None:
    heights = [PITCH, 2 * PITCH, 4 * PITCH]
    graph = bookcase(heights, 5 * PITCH)
    beside = [board(f"other_{k}", PartLabel.SHELF, 0.17 + 0.23 * k, x=0.9, width=0.5) for k in range(3)]
    graph = FunctionalGraph("bookcase", (*graph.nodes, *beside), ())
    assert found_in(graph) == pytest.approx([3 * PITCH])


def test_an_end_that_fits_no_pattern_is_left_aside() -> None:
    heights = [PITCH, 2 * PITCH, 3 * PITCH, 5 * PITCH]
    assert found_in(bookcase(heights, 5.6 * PITCH)) == pytest.approx([4 * PITCH])


def test_the_completed_graph_has_them_and_names_the_rule() -> None:
    graph = bookcase([PITCH, 2 * PITCH, 4 * PITCH], 5 * PITCH)
    few = FeatureConfig(points=16, anchors=2, neighbours=2)
    completion = complete_by_network(graph, Answers().about(graph), few, DecodeConfig(mirror=False))

    (added,) = completion.added
    assert float(completion.completed.node(added).box.low[2]) == pytest.approx(3 * PITCH)
    assert completion.decision(added, "exists").by == "rule"
