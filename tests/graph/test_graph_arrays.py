"""A functional graph as arrays: codes, who hangs on whom, motions of parts."""

import numpy as np

from grafu.graph.arrays import (
    ATTACHED,
    CONTACT,
    DOOR,
    EDGE_CODES,
    EDGE_WORDS,
    HINGE,
    LABEL_CODES,
    LABELS,
    NONE,
    NULL,
    RAIL,
    SLIDE,
    TURN,
    graph_arrays,
)
from grafu.graph.functional_graph import FunctionalGraph
from small_graphs import cabinet

IDS = [node.id for node in cabinet().nodes]


def test_edges_are_codes_and_the_child_is_the_part_that_moves() -> None:
    arrays = graph_arrays(cabinet())
    left, door, drawer, knob = (IDS.index(i) for i in ("left", "door_1", "drawer_1", "knob_1"))
    assert arrays.edges[left, door] == arrays.edges[door, left] == HINGE
    assert arrays.edges[left, drawer] == RAIL
    assert arrays.edges[door, knob] == ATTACHED
    assert arrays.edges[left, IDS.index("back")] == CONTACT
    assert (np.diag(arrays.edges) == NULL).all()
    assert arrays.child[door, left]
    assert not arrays.child[left, door]
    assert arrays.child[knob, door]
    assert not arrays.child[left, IDS.index("back")]


def test_a_motion_belongs_to_the_part_that_moves() -> None:
    arrays = graph_arrays(cabinet())
    doors = arrays.labels == DOOR
    assert arrays.border[doors].tolist() == [0, 1]
    assert arrays.sign[doors].tolist() == [0, 1]
    assert (arrays.border[~doors] == NONE).all()
    assert arrays.slide[[IDS.index("drawer_1"), IDS.index("drawer_2")]].tolist() == [2, 2]
    assert (arrays.slide != NONE).sum() == 2


def test_boxes_are_centres_and_half_sizes() -> None:
    assert np.allclose(graph_arrays(cabinet()).boxes[0], [0.04, 0.2, 0.15, 0.04, 0.2, 0.15])


def test_the_codes_are_those_that_the_network_sees() -> None:
    assert {label: LABELS.index(label) for label in LABELS} == LABEL_CODES
    assert [EDGE_WORDS[code] for code in (CONTACT, HINGE, RAIL, ATTACHED)] == ["contact", "hinge", "rail", "attached"]
    assert (EDGE_WORDS[NULL], EDGE_WORDS[SLIDE], EDGE_WORDS[TURN]) == ("none", "slide", "turn")
    assert (EDGE_CODES["paper"], EDGE_CODES["all"]) == (NULL + 1, len(EDGE_WORDS))


def test_a_graph_without_nodes_is_empty_arrays() -> None:
    assert graph_arrays(FunctionalGraph("nothing", ())).boxes.shape == (0, 6)
