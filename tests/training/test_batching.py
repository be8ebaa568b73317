"""Batches: copies share rows of points, mirror images are of all at once, nothing depends on the neighbours."""

import numpy as np
import pytest
import torch

from grafu.completion.features import FeatureConfig, graph_features
from grafu.completion.features import mirrored as mirrored_features
from grafu.data.pair import GraphPair
from grafu.graph.edit import as_contacts, without_nodes
from grafu.training.batching import Showing, TrainingBatch, stack_showings
from grafu.training.sample import Sample, make_sample
from grafu.training.targets import ROW_STEP, SLOT_STEP, stepped
from small_graphs import cabinet

FEATURES = FeatureConfig(points=32, anchors=4, neighbours=4)
TARGET = cabinet()


def pair_without(*ids: str) -> GraphPair:
    return GraphPair(as_contacts(without_nodes(TARGET, ids)), TARGET, f"without {ids}", "model")


PAIRS = [pair_without(), pair_without("knob_1"), pair_without("left")]
SAMPLE: Sample = make_sample(PAIRS, FEATURES)


def shown(across: int | None = None, shares_shifted: bool = False) -> TrainingBatch:
    return stack_showings([Showing(SAMPLE, SAMPLE.copies, across)], shares_shifted)


@pytest.mark.parametrize("across", [None, 0, 1])
def test_each_graph_is_what_the_network_sees_alone(across: int | None) -> None:
    graphs = shown(across).graphs
    for number, pair in enumerate(PAIRS):
        seen = graph_features(pair.input, FEATURES)
        if across is not None:
            seen = mirrored_features(seen, across)
        real = graphs.mask[number]
        rows = graphs.point_index[number][real]
        assert np.array_equal(graphs.labels[number][real], seen.labels)
        assert graphs.boxes[number][real].numpy() == pytest.approx(seen.boxes, abs=1e-5)
        assert graphs.anchors[rows].numpy() == pytest.approx(seen.anchors, abs=1e-5)
        assert graphs.groups[rows].numpy() == pytest.approx(seen.groups, abs=1e-5)


def test_copies_with_one_frame_share_rows_of_points() -> None:
    twice = stack_showings([Showing(SAMPLE, [SAMPLE.copies[0], SAMPLE.copies[0]])], False)
    assert rows_of(twice) == len(TARGET.nodes)
    assert rows_of(shown(shares_shifted=True)) <= rows_of(shown())


def rows_of(batch: TrainingBatch) -> int:
    return len(batch.graphs.point_index[batch.graphs.mask].unique())


def test_sizes_come_in_steps_and_one_model_alone_fits_its_step() -> None:
    graphs = shown().graphs
    assert [graphs.labels.shape[1], len(graphs.anchors), len(graphs.groups)] == [20, ROW_STEP, ROW_STEP]
    assert [stepped(size, SLOT_STEP) for size in (0, 1, 4, 5)] == [0, 4, 4, 8]


def test_answers_go_with_their_graphs() -> None:
    batch = shown()
    assert len(batch) == 3
    assert batch.strategies[1] == "without ('knob_1',)"
    assert batch.targets.mask.sum(dim=1).tolist() == [len(TARGET.nodes)] * 3
    assert batch.graphs.mask.sum(dim=1).tolist() == [len(pair.input.nodes) for pair in PAIRS]
    assert torch.equal(batch.targets.anchors >= 0, batch.graphs.mask)
    assert batch.to("cpu").strategies == batch.strategies


def test_no_graph_is_no_batch() -> None:
    with pytest.raises(ValueError, match="at least one graph"):
        stack_showings([], False)
