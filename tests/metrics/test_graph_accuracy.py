"""How well a graph was completed, against figures worked out by hand."""

from dataclasses import replace
from math import isnan, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Attached, Contact, Edge, Hinge, Rail, Slide, Turn, ends_of
from grafu.graph.edit import as_contacts, with_edges, without_edges, without_nodes
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.metrics.graph_accuracy import GraphAccuracy, Ratio, graph_accuracy, total_accuracy
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel
from small_graphs import cabinet

TRUTH = cabinet()
ERRORS = {"centre", "half", "added_centre"}


def moved(node: PartNode, name: str, x: float) -> PartNode:
    return replace(node, id=name, box=Box(node.box.low + vec3(x, 0.0, 0.0), node.box.high + vec3(x, 0.0, 0.0)))


def with_knob_again(label: PartLabel, x: float) -> FunctionalGraph:
    """The cabinet without its last knob, and a new node a bit off."""
    bare = without_nodes(TRUTH, ["knob_4"])
    return replace(bare, nodes=(*bare.nodes, replace(moved(TRUTH.node("knob_4"), "new", x), label=label)))


def test_the_truth_is_right_in_everything() -> None:
    figures = graph_accuracy(TRUTH, TRUTH).by_name()
    assert figures.pop("added") != figures.pop("added_centre")  # nothing was added: both are not numbers
    assert isnan(figures.pop("slides"))  # a cabinet has neither
    assert isnan(figures.pop("turns"))
    assert {name: value for name, value in figures.items() if value != (0.0 if name in ERRORS else 1.0)} == {}


def test_the_non_functional_graph_has_its_nodes_and_contacts_alone() -> None:
    accuracy = graph_accuracy(as_contacts(TRUTH), TRUTH)
    assert accuracy.existence.value == 1.0
    assert accuracy.edges == Ratio(12.0, 20.0)
    assert accuracy.contact.value == pytest.approx(2 * 12 / (20 + 12))
    assert accuracy.hinge.value == accuracy.rail.value == accuracy.attached.value == 0.0
    assert accuracy.joint == Ratio(0.0, 2.0)
    assert accuracy.slide == Ratio(0.0, 2.0)
    assert accuracy.parent == Ratio(0.0, 4.0)


def test_a_completion_counts_as_its_completed_graph() -> None:
    still = as_contacts(TRUTH)
    refused = tuple(Refusal(n.id, Reason.NO_MOTION, "none") for n in still.nodes if n.label.is_movable)
    assert graph_accuracy(GraphCompletion(still, still, "rule", refused=refused), TRUTH) == graph_accuracy(still, TRUTH)


def test_a_door_may_have_its_border_right_and_its_sign_wrong() -> None:
    bare = without_edges(TRUTH, [e for e in TRUTH.hinges if e.child == "door_1"])
    accuracy = graph_accuracy(with_edges(bare, [Hinge("left", "door_1", 0, 1)]), TRUTH)
    assert (accuracy.border.value, accuracy.sign.value, accuracy.joint.value) == (1.0, 0.5, 0.5)
    assert accuracy.mount.value == 1.0


def test_a_door_on_another_part_has_its_motion_but_not_its_mount() -> None:
    bare = without_edges(TRUTH, [e for e in TRUTH.hinges if e.child == "door_1"])
    accuracy = graph_accuracy(with_edges(bare, [Hinge("back", "door_1", 0, 0)]), TRUTH)
    assert accuracy.joint.value == 1.0
    assert accuracy.mount == Ratio(1.0, 2.0)
    assert accuracy.hinge.value == pytest.approx(0.5)  # one of two found, one of two true


def test_a_drawer_that_slides_the_wrong_way_is_wrong() -> None:
    bare = without_edges(TRUTH, [e for e in TRUTH.rails if e.child == "drawer_1"])
    accuracy = graph_accuracy(with_edges(bare, [Rail("left", "drawer_1", 3)]), TRUTH)
    assert accuracy.slide == Ratio(1.0, 2.0)
    assert accuracy.rail.value == 1.0


def test_a_handle_on_another_door_has_no_parent() -> None:
    bare = without_edges(TRUTH, [e for e in TRUTH.attachments if e.child == "knob_1"])
    assert graph_accuracy(with_edges(bare, [Attached("door_2", "knob_1")]), TRUTH).parent == Ratio(3.0, 4.0)


def test_what_is_missing_is_missed() -> None:
    accuracy = graph_accuracy(without_nodes(TRUTH, ["knob_4"]), TRUTH)
    assert accuracy.existence.value == pytest.approx(2 * 17 / (17 + 18))
    assert accuracy.added == Ratio(0.0, 1.0)
    assert accuracy.attached.value == pytest.approx(2 * 3 / (3 + 4))
    assert isnan(accuracy.added_centre.value)


@pytest.mark.parametrize(("label", "x", "right"), [("handle", 0.05, 1.0), ("handle", 0.5, 0.0), ("shelf", 0.0, 0.0)])
def test_an_added_node_is_right_with_its_label_and_in_its_place(label: str, x: float, right: float) -> None:
    accuracy = graph_accuracy(with_knob_again(PartLabel(label), x), TRUTH)
    extent = TRUTH.box.size.max()
    assert accuracy.existence.value == 1.0
    assert accuracy.added.value == right
    assert accuracy.added_centre.value == pytest.approx(x / extent / 3)
    assert accuracy.centre.value == pytest.approx(x / extent / (3 * 18))
    assert accuracy.category.value == pytest.approx(1.0 if label == "handle" else 17 / 18)


def test_an_added_node_too_many_lowers_existence_and_its_edges_are_wrong() -> None:
    extra = replace(TRUTH, nodes=(*TRUTH.nodes, moved(TRUTH.node("left"), "extra", 1.0)))
    accuracy = graph_accuracy(with_edges(extra, [Contact("extra", "left")]), TRUTH)
    assert accuracy.existence.value == pytest.approx(2 * 18 / (19 + 18))
    assert accuracy.added == Ratio(0.0, 1.0)
    assert accuracy.contact.value == pytest.approx(2 * 12 / (13 + 12))
    assert accuracy.edges.value == 1.0


def test_an_unknown_true_label_asks_for_nothing() -> None:
    masked = replace(TRUTH, nodes=(replace(TRUTH.nodes[0], label=PartLabel.UNKNOWN), *TRUTH.nodes[1:]))
    assert graph_accuracy(TRUTH, masked).category == Ratio(17.0, 17.0)


@given(st.permutations(range(18)))
def test_the_order_of_nodes_does_not_matter(order: list[int]) -> None:
    found = with_knob_again(PartLabel.HANDLE, 0.05)
    turned = replace(found, nodes=tuple(found.nodes[k] for k in order))
    one, other = graph_accuracy(turned, TRUTH).by_name(), graph_accuracy(found, TRUTH).by_name()
    assert one == pytest.approx(other, nan_ok=True)


def test_graphs_without_nodes_have_nothing_to_answer() -> None:
    nothing = FunctionalGraph("nothing", ())
    assert graph_accuracy(nothing, nothing).by_name() == pytest.approx(
        dict.fromkeys(GraphAccuracy().by_name(), nan), nan_ok=True
    )
    assert graph_accuracy(nothing, TRUTH).existence.value == 0.0
    assert graph_accuracy(TRUTH, nothing).existence.value == 0.0


def test_shares_of_many_graphs_add_up() -> None:
    total = total_accuracy([graph_accuracy(TRUTH, TRUTH), graph_accuracy(as_contacts(TRUTH), TRUTH)])
    assert total.joint == Ratio(2.0, 4.0)
    assert total.existence.value == 1.0


def test_what_slides_and_turns_is_counted_by_kind_and_axis() -> None:
    ends = ({"left", "door_1"}, {"door_1", "knob_1"})
    kept = tuple(edge for edge in TRUTH.edges if set(ends_of(edge)) not in ends)
    slides = Slide("left", "door_1", 3)

    def graph(*edges: Edge) -> FunctionalGraph:
        return replace(TRUTH, edges=(*kept, *edges))

    truth = graph(slides, Turn("door_1", "knob_1", 2))
    assert {graph_accuracy(truth, truth).by_name()[name] for name in ("slides", "turns", "slide")} == {1.0}
    figures = graph_accuracy(graph(slides, Turn("door_1", "knob_1", 3)), truth).by_name()
    assert (figures["slides"], figures["turns"], figures["slide"]) == (1.0, 1.0, pytest.approx(3 / 4))
    assert graph_accuracy(graph(Contact("left", "door_1")), truth).by_name()["slides"] == 0.0
