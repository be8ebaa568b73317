"""What the network is to answer: codes, frames, mirror images, padding."""

import numpy as np
import pytest
import torch

from grafu.graph.arrays import HANDLE, NONE, NULL
from grafu.graph.edit import mirrored, without_nodes
from grafu.graph.functional_graph import FunctionalGraph
from grafu.training.targets import GraphTargets, graph_targets, mirrored_targets, stack_targets
from small_graphs import cabinet

IDS = [node.id for node in cabinet().nodes]
ORIGIN = np.zeros(3)


def targets_of(graph: FunctionalGraph, given: list[str] | None = None) -> GraphTargets:
    return graph_targets(graph, IDS if given is None else given, ORIGIN, 1.0)


def same(a: GraphTargets, b: GraphTargets) -> bool:
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in a.__dataclass_fields__)


def test_boxes_stand_in_the_frame_of_the_input() -> None:
    targets = graph_targets(cabinet(), ["left"], np.array([0.04, 0.2, 0.0]), 2.0)
    assert targets.boxes[0] == pytest.approx([0.0, 0.0, 0.075, 0.02, 0.1, 0.075])
    assert targets.anchors.tolist() == [0]


def test_an_input_node_that_is_no_target_is_an_error() -> None:
    with pytest.raises(KeyError, match="ghost"):
        graph_targets(cabinet(), ["ghost"], ORIGIN, 1.0)


@pytest.mark.parametrize("across", [0, 1])
def test_the_mirrored_answers_are_the_answers_of_the_mirrored_graph(across: int) -> None:
    assert same(mirrored_targets(targets_of(cabinet()), across), targets_of(mirrored(cabinet(), across)))


def test_mirroring_twice_changes_nothing() -> None:
    assert same(mirrored_targets(mirrored_targets(targets_of(cabinet()), 0), 0), targets_of(cabinet()))


def test_gravity_is_not_mirrored() -> None:
    with pytest.raises(ValueError, match="must be 0"):
        mirrored_targets(targets_of(cabinet()), 2)


def test_padding_is_null_and_unmarked() -> None:
    small = without_nodes(cabinet(), ["knob_4", "knob_3"])
    batch = stack_targets([targets_of(cabinet()), targets_of(small, IDS[:5])])
    assert batch.mask.sum(dim=1).tolist() == [18, 16]
    assert (batch.edges[1, 16:] == NULL).all()
    assert (batch.anchors[1, 5:] == NONE).all()
    assert not batch.child[1, :, 16:].any()
    assert (batch.labels == HANDLE).sum(dim=1).tolist() == [4, 2]
    assert batch.to("cpu").boxes.dtype is torch.float32


def test_an_empty_graph_has_empty_answers() -> None:
    batch = stack_targets([targets_of(FunctionalGraph("nothing", ()), [])])
    assert batch.edges.shape == (1, 0, 0)
    with pytest.raises(ValueError, match="at least one graph"):
        stack_targets([])
