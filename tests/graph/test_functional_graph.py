"""The graph's invariants, and that pure edits keep them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.errors import GraphError
from grafu.geometry.box import Box
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Attached, Contact, Hinge, Rail
from grafu.graph.edit import (
    as_contacts,
    mirrored,
    relabelled,
    scaled,
    with_edges,
    without_edges,
    without_nodes,
)
from grafu.graph.functional_graph import FunctionalGraph, PartNode, joined_groups
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

LABELS = {
    "side": PartLabel.SIDE_PANEL,
    "door": PartLabel.DOOR,
    "drawer": PartLabel.DRAWER,
    "knob": PartLabel.HANDLE,
    "thing": PartLabel.UNKNOWN,
}
HALVES = {"side": (0.01, 0.2, 0.4), "door": (0.2, 0.01, 0.2), "drawer": (0.2, 0.2, 0.1), "knob": (0.01, 0.01, 0.01)}
EDGES = (Hinge("side", "door", 0, 0), Rail("side", "drawer", 2), Attached("door", "knob"), Contact("side", "thing"))


def node(name: str) -> PartNode:
    half = np.array(HALVES.get(name, (0.1, 0.1, 0.1)))
    return PartNode(name, LABELS[name], Box.from_center(np.array([0.3, 0.1, 0.5]), half))


def graph(*edges) -> FunctionalGraph:
    return FunctionalGraph("cabinet", tuple(node(name) for name in LABELS), edges)


@pytest.mark.parametrize(
    ("edges", "message"),
    [
        ((Contact("side", "lamp"),), "no node `lamp`"),
        ((Contact("side", "side"),), "join two parts"),
        ((Contact("side", "door"), Hinge("side", "door", 0, 0)), "at most one edge"),
        ((Contact("side", "door"), Contact("door", "side")), "at most one edge"),
        ((Hinge("side", "drawer", 0, 0),), "hinge from side panel to drawer"),
        ((Hinge("drawer", "door", 0, 0),), "hinge from drawer to door"),
        ((Rail("side", "door", 2),), "rail from side panel to door"),
        ((Attached("side", "knob"),), "attached from side panel to handle"),
        ((Attached("knob", "door"),), "attached from handle to door"),
        ((Attached("door", "knob"), Attached("drawer", "knob")), "second parent"),
        ((Rail("side", "drawer", 2), Rail("thing", "drawer", 3)), "one motion"),
        ((Hinge("side", "door", 0, 0), Hinge("thing", "door", 1, 0)), "one motion"),
        ((Hinge("side", "thing", 0, 0), Rail("side", "thing", 3)), "at most one edge"),
    ],
)
def test_a_graph_refuses(edges, message):
    with pytest.raises(GraphError, match=message):
        graph(*edges)


def test_a_graph_refuses_repeated_and_empty_ids():
    with pytest.raises(GraphError, match="`door` more than once"):
        FunctionalGraph("cabinet", (node("door"), node("door")))
    with pytest.raises(GraphError, match="must not be empty"):
        FunctionalGraph("cabinet", (PartNode("", PartLabel.DOOR, node("door").box),))


def test_an_unknown_part_may_stand_for_any():
    assert graph(Hinge("thing", "door", 0, 0), Attached("thing", "knob")).hinges
    assert graph(Hinge("side", "thing", 0, 0)).hinges


def test_a_drawer_may_run_on_two_rails_of_one_motion():
    assert len(graph(Rail("side", "drawer", 2), Rail("thing", "drawer", 2)).rails) == 2


def test_a_contact_has_no_direction_and_a_hinge_has():
    assert Contact("b", "a") == Contact("a", "b")
    assert Attached("a", "b") != Attached("b", "a")


def test_graphs_compare_and_hash_by_content():
    assert graph(*EDGES) == graph(*EDGES)
    assert hash(graph(*EDGES)) == hash(graph(*EDGES))
    assert graph(*EDGES) != graph()


def test_neighbours_and_nodes_by_id():
    full = graph(*EDGES)
    assert full.neighbours["side"] == ("door", "drawer", "thing")
    assert full.neighbours["knob"] == ("door",)
    assert "knob" in full
    assert full.node("knob").label is PartLabel.HANDLE
    with pytest.raises(GraphError, match="no node `lamp`"):
        full.node("lamp")


def test_an_empty_graph_is_a_graph():
    assert FunctionalGraph("nothing", ()).box.volume == 0


@given(st.sets(st.sampled_from(sorted(LABELS))))
def test_without_nodes_leaves_no_dangling_edge_and_the_source_whole(ids):
    full = graph(*EDGES)
    smaller = without_nodes(full, ids)
    assert {n.id for n in smaller.nodes} == set(LABELS) - ids
    assert full == graph(*EDGES)


@given(st.sets(st.sampled_from(EDGES)))
def test_without_edges_takes_away_just_these(edges):
    assert set(without_edges(graph(*EDGES), edges).edges) == set(EDGES) - edges


def test_edits_refuse_what_is_not_there():
    with pytest.raises(GraphError, match="no node `lamp`"):
        without_nodes(graph(), {"lamp"})
    with pytest.raises(GraphError, match="must be in graph"):
        without_edges(graph(), EDGES[:1])
    with pytest.raises(GraphError, match="no node `lamp`"):
        relabelled(graph(), {"lamp": PartLabel.DOOR})


def test_as_contacts_keeps_nodes_and_pairs():
    plain = as_contacts(graph(*EDGES))
    assert plain.nodes == graph().nodes
    assert len(plain.contacts) == len(plain.edges) == len(EDGES)


def test_relabelling_turns_forbidden_edges_into_contacts():
    changed = relabelled(graph(*EDGES), {"door": PartLabel.SHELF})
    assert Contact("door", "side") in changed.edges
    assert Contact("door", "knob") in changed.edges
    assert EDGES[1] in changed.edges


def test_masking_all_labels_keeps_all_edges():
    masked = relabelled(graph(*EDGES), dict.fromkeys(LABELS, PartLabel.UNKNOWN))
    assert masked.edges == EDGES


def test_a_new_edge_takes_the_place_of_the_contact():
    assert with_edges(as_contacts(graph(*EDGES)), EDGES).edges == EDGES


@given(st.integers(0, 1))
def test_mirroring_twice_changes_nothing(across):
    full = graph(*EDGES)
    assert mirrored(mirrored(full, across), across) == full
    assert mirrored(full, across) != full


def test_mirroring_left_and_right_swaps_the_hung_side_and_keeps_the_slide():
    image = mirrored(graph(*EDGES), 0)
    assert image.hinges == (Hinge("side", "door", 1, 1),)
    assert image.rails == (Rail("side", "drawer", 2),)


def test_gravity_is_not_mirrored_and_a_scale_is_positive():
    with pytest.raises(ValueError, match="0 \\(X\\) or 1"):
        mirrored(graph(), 2)
    with pytest.raises(ValueError, match="positive"):
        scaled(graph(), 0.0)


def test_scaling_scales_boxes():
    assert np.allclose(scaled(graph(), 2.0).box.size, 2 * graph().box.size)


def test_a_completion_leaves_no_movable_part_in_silence():
    with pytest.raises(GraphError, match=r"\['drawer'\] have neither"):
        GraphCompletion(graph(), graph(EDGES[0]), "rule")
    assert GraphCompletion(
        graph(), graph(EDGES[0]), "rule", refused=(Refusal("drawer", Reason.NO_MOTION, "stuck"),)
    ).refused


def test_a_completion_accounts_for_every_node():
    smaller = without_nodes(graph(*EDGES), {"knob"})
    with pytest.raises(GraphError, match="it lost \\['knob'\\]"):
        GraphCompletion(graph(*EDGES), smaller, "rule")
    with pytest.raises(GraphError, match="`added` must be"):
        GraphCompletion(smaller, graph(*EDGES), "rule")
    assert GraphCompletion(smaller, graph(*EDGES), "rule", added=("knob",)).added == ("knob",)


def test_a_completion_names_only_its_nodes_and_scores_are_fractions():
    with pytest.raises(GraphError, match="there is no \\['lamp'\\]"):
        GraphCompletion(graph(*EDGES), graph(*EDGES), "rule", decisions=(Decision("lamp", "mount", "side", 1.0),))
    with pytest.raises(GraphError, match=r"in 0\.\.1"):
        Decision("door", "mount", "side", 1.2)


def test_a_decision_is_found_by_its_question():
    decision = Decision("door", "mount", "side", 0.9, "thing", 0.1)
    completion = GraphCompletion(graph(*EDGES), graph(*EDGES), "rule", decisions=(decision,))
    assert completion.decision("door", "mount") == decision
    assert completion.decision("door", "border") is None


def test_a_way_over_others_joins() -> None:
    joined = {"a": ("b",), "b": ("a", "c"), "c": ("b",), "d": (), "e": ("f",), "f": ("e",)}
    assert joined_groups(joined) == [frozenset("abc"), frozenset("d"), frozenset("ef")]
    assert joined_groups({}) == []
