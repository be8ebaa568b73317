"""A pair refuses what is not anchored, and its mirror image is one of lines in space."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.data.pair import GraphPair, natural_pair, specimen_pair
from grafu.errors import GraphError
from grafu.geometry.axis import Axis
from grafu.graph.edit import mirrored, scaled, without_nodes
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import hinge_to_axis, rail_to_axis
from grafu.synth.generate import make_specimen
from graph_strategies import functional_graphs
from small_graphs import cabinet


def motion_lines(graph: FunctionalGraph) -> dict[str, Axis]:
    hinges = {h.child: hinge_to_axis(graph.node(h.child).box, h.border, h.sign) for h in graph.hinges}
    return hinges | {r.child: rail_to_axis(graph.node(r.child).box, r.axis) for r in graph.rails}


def test_a_node_that_the_target_lacks_is_refused():
    with pytest.raises(GraphError, match="`cabinet` lacks `back`"):
        GraphPair(cabinet(), without_nodes(cabinet(), ["back"]), "natural", "cabinet")


def test_another_box_is_refused():
    with pytest.raises(GraphError, match="one box in input and target: `left`"):
        GraphPair(scaled(cabinet(), 2.0), cabinet(), "natural", "cabinet")


def test_what_is_missing_is_named_in_order():
    pair = GraphPair(without_nodes(cabinet(), ["knob_2", "back"]), cabinet(), "natural", "cabinet")
    assert pair.missing == ("back", "knob_2")
    assert natural_pair(cabinet()).missing == ()


def test_a_specimen_is_a_natural_pair():
    specimen = make_specimen(0, 1, 8)
    pair = specimen_pair(specimen)
    assert (pair.input, pair.target) == (specimen.given, specimen.truth)
    assert (pair.strategy, pair.model_id) == ("natural", specimen.id)


@given(functional_graphs(), st.sampled_from([0, 1]))
def test_mirroring_twice_changes_nothing(graph, across):
    assert mirrored(mirrored(graph, across), across) == graph


@given(functional_graphs(min_nodes=6), st.sampled_from([0, 1]))
def test_mirrored_motions_are_the_mirrored_lines(graph, across):
    M = np.eye(4)
    M[across, across] = -1.0
    images = motion_lines(mirrored(graph, across))
    rotating = {h.child for h in graph.hinges}
    for part, line in motion_lines(graph).items():
        wanted = line.transformed(M, rotational=part in rotating)
        assert np.allclose(images[part].direction, wanted.direction)
        assert np.allclose(images[part].point, wanted.point)


def test_points_are_mirrored_too():
    image = mirrored(cabinet(4), 0)
    assert np.array_equal(image.nodes[3].points.points, cabinet(4).nodes[3].points.points * [-1, 1, 1])


def test_points_may_be_left_out_of_the_input():
    bare = replace(cabinet(4), nodes=tuple(replace(n, points=None) for n in cabinet(4).nodes))
    assert GraphPair(bare, cabinet(4), "natural", "cabinet").missing == ()
