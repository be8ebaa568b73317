"""Distances from a training distribution: z-scores, the nearest member, features that never change."""

import pytest
from measured_cabinets import cabinet

from grafu.evaluation.distribution import FEATURE_NAMES, Distribution, graph_features
from grafu.graph.parse import parse_graph


def test_distances_are_in_standard_deviations() -> None:
    space = Distribution([(0.0, 10.0, 5.0), (2.0, 10.0, 5.0)])  # mean 1, deviation 1; two features never change
    assert space.scores((4.0, 10.0, 5.0)) == (3.0, 0.0, 0.0)
    far = space.distance((4.0, 10.0, 8.0))
    assert far.from_middle == pytest.approx(18**0.5)
    assert (far.nearest, far.from_nearest) == (1, pytest.approx(13**0.5))


def test_a_member_lies_on_itself() -> None:
    members = [(float(k), float(k * k % 5)) for k in range(6)]
    space = Distribution(members)
    for number, member in enumerate(members):
        found = space.distance(member)
        assert (found.nearest, found.from_nearest) == (number, pytest.approx(0.0))


def test_features_of_two_lengths_are_refused() -> None:
    with pytest.raises(ValueError, match="one length"):
        Distribution([(1.0,), (1.0, 2.0)])
    with pytest.raises(ValueError, match="one length"):
        Distribution([])


def test_the_features_are_those_of_the_supplement() -> None:
    graph = parse_graph(cabinet())
    found = dict(zip(FEATURE_NAMES, graph_features(graph), strict=True))
    assert found["nodes"] == 9
    assert (found["side panel"], found["door"], found["drawer"], found["handle"], found["leg"]) == (2, 1, 1, 1, 0)
    assert found["average degree"] == pytest.approx(2 * len(graph.contacts) / 9)
    assert (found["width"], found["height"]) == (pytest.approx(1.0), pytest.approx(1.0))
