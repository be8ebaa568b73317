"""Fronts of a column, or of a row, agree on being doors or drawers."""

from math import log

import numpy as np
import pytest

from grafu.completion.decode_config import DecodeConfig
from grafu.completion.features import FeatureConfig
from grafu.completion.network import label_parts
from grafu.geometry.box import Box
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel
from network_answers import Answers

FEW = FeatureConfig(points=16, anchors=2, neighbours=2)
DOOR, DRAWER = PartLabel.DOOR, PartLabel.DRAWER


def front(name, x, z, width=0.8, height=0.2):
    return PartNode(name, PartLabel.UNKNOWN, Box(np.array([x, -0.02, z]), np.array([x + width, 0.0, z + height])))


SIDES = tuple(
    PartNode(name, PartLabel.SIDE_PANEL, Box(np.array([x, 0.0, 0.0]), np.array([x + 0.02, 0.5, 1.0])))
    for name, x in (("left", -0.02), ("right", 1.6))
)


def labels_of(odds, *fronts, config=DecodeConfig()):
    """What fronts become where the network takes each for a door with these odds against a drawer."""
    graph = FunctionalGraph("made", (*SIDES, *fronts))
    said = Answers(labels={n.id: {DOOR: 8.0 + log(odd), DRAWER: 8.0} for n, odd in zip(fronts, odds, strict=True)})
    labelled, decisions, _ = label_parts(graph, said.about(graph), FEW, config)
    scores = {decision.part: decision.score for decision in decisions}
    return [labelled.node(n.id).label for n in fronts], [scores[n.id] for n in fronts]


STACK = (front("low", 0, 0.0), front("high", 0, 0.22))


def test_wide_fronts_right_above_each_other_have_the_mean_of_their_odds():
    labels, scores = labels_of((3.0, 0.1), *STACK)
    assert labels == [DRAWER, DRAWER]
    assert scores == pytest.approx([1 / (1 + 0.3**0.5)] * 2, abs=0.01)
    assert labels_of((3.0, 0.5), *STACK)[0] == [DOOR, DOOR]


def test_a_network_that_is_sure_is_believed():
    assert labels_of((60.0, 60.0), *STACK)[0] == [DOOR, DOOR]


def test_a_column_agrees():
    three = (*STACK, front("top", 0, 0.44))
    assert len(set(labels_of((0.01, 0.01, 30.0), *three)[0])) == 1


@pytest.mark.parametrize(
    "other",
    [
        front("far", 0, 0.6),
        front("narrower", 0, 0.22, width=0.6),
        front("higher", 0, 0.22, height=0.5),
    ],
)
def test_what_is_no_column_stays_as_the_network_has_it(other):
    assert labels_of((3.0, 0.1), STACK[0], other)[0] == [DOOR, DRAWER]


ROW = (front("first", 0.0, 0.5, 0.5), front("middle", 0.52, 0.5, 0.2), front("last", 0.74, 0.5, 0.5))


def test_fronts_of_a_row_agree():
    assert labels_of((0.01, 3.0, 0.01), *ROW)[0] == [DRAWER] * 3
    assert labels_of((60.0, 0.5, 60.0), *ROW)[0] == [DOOR] * 3


@pytest.mark.parametrize(
    "other", [front("lower", 0.52, 0.5, 0.2, 0.15), front("far", 0.9, 0.5, 0.2), front("raised", 0.52, 0.55, 0.2)]
)
def test_what_is_no_row_stays_as_the_network_has_it(other):
    assert labels_of((0.01, 3.0), ROW[0], other)[0] == [DRAWER, DOOR]


@pytest.mark.parametrize(("right", "is_mirrored"), [(1.2, True), (1.1, False)])
def test_mirror_images_on_the_left_and_right_of_the_piece_agree(right, is_mirrored):
    low, high = front("low", 0.5, 0.0, 0.6, 0.2), front("high", 0.5, 0.4, 0.6, 0.1)  # between them, of other heights
    left, other = front("one", 0.0, 0.0, 0.4, 0.5), front("other", right, 0.0, 0.4, 0.5)
    labels = labels_of((0.1, 500.0, 0.001, 0.001), left, other, low, high)[0]
    assert labels == [DOOR if is_mirrored else DRAWER, DOOR, DRAWER, DRAWER]


def test_fronts_that_are_higher_than_wide_are_no_column():
    doors = (front("low", 0, 0.0, 0.4, 0.4), front("high", 0, 0.42, 0.4, 0.4))
    assert labels_of((3.0, 0.1), *doors)[0] == [DOOR, DRAWER]
