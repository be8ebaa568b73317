"""Whatever the boxes and labels, flat, nested or apart: the rule answers for every part and changes no input."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.completion.rule import complete_by_rule
from grafu.geometry.box import Box
from grafu.geometry.touching import near_pairs
from grafu.graph.edges import Contact
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel

steps = st.sampled_from([0.0, 0.02, 0.3, 0.5, 1.0])
corners = st.tuples(steps, steps, steps).map(np.array)
movable = st.sampled_from([PartLabel.DOOR, PartLabel.DRAWER, PartLabel.HANDLE, PartLabel.UNKNOWN])
labels = st.one_of(movable, st.sampled_from(list(PartLabel)))
parts = st.tuples(labels, corners, corners)


def graph_of(drawn: list) -> FunctionalGraph:
    boxes = [Box(low, low + size) for _, low, size in drawn]
    nodes = tuple(
        PartNode(f"p{k}", label, box) for k, ((label, _, _), box) in enumerate(zip(drawn, boxes, strict=True))
    )
    edges = tuple(Contact(f"p{a}", f"p{b}") for a, b in near_pairs(boxes, 0.005))
    return FunctionalGraph("drawn", nodes, edges)


@settings(max_examples=150, deadline=None)
@given(st.lists(parts, max_size=7))
def test_every_part_is_answered(drawn):
    graph = graph_of(drawn)
    completion = complete_by_rule(graph)
    assert completion.input == graph == graph_of(drawn)
    held = {edge.child for edge in completion.completed.attachments} | {r.part for r in completion.refused}
    assert {n.id for n in completion.completed.labelled(PartLabel.HANDLE)} <= held
    assert completion == complete_by_rule(graph)


@settings(max_examples=50, deadline=None)
@given(st.lists(parts, max_size=6), st.sampled_from([0.125, 8.0]))
def test_the_scale_changes_nothing(drawn, factor):
    # Powers of two keep every number exact, so that ties stay ties.
    scaled = [(label, low * factor, size * factor) for label, low, size in drawn]
    graph, other = graph_of(drawn), graph_of(scaled)
    other = FunctionalGraph(other.model_id, other.nodes, graph.edges)
    assert set(complete_by_rule(graph).completed.edges) == set(complete_by_rule(other).completed.edges)
