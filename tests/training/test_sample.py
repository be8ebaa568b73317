"""One model prepared for learning: copies in their own frames over points that they share."""

import numpy as np
import pytest

from grafu.completion.features import FeatureConfig, graph_features
from grafu.data.corruption.config import CorruptionConfig
from grafu.data.corruption.corrupt import MASKED, masked_pair
from grafu.data.pair import GraphPair, natural_pair
from grafu.graph.arrays import CONTACT, UNKNOWN
from grafu.graph.edit import as_contacts, without_nodes
from grafu.training.sample import CopyMix, draw_pairs, make_sample
from small_graphs import cabinet

FEATURES = FeatureConfig(points=32, anchors=4, neighbours=4)
STILL = CorruptionConfig(mirror_probability=0.0)


def lacking(*ids: str) -> GraphPair:
    target = cabinet()
    return GraphPair(as_contacts(without_nodes(target, ids)), target, "test", "model")


def test_a_copy_is_what_the_network_sees_of_its_graph() -> None:
    pair = lacking("top_1", "top_2", "left", "knob_1")
    (copy,) = make_sample([pair], FEATURES).copies
    seen = graph_features(pair.input, FEATURES)
    sample = make_sample([pair], FEATURES)
    assert np.array_equal(copy.labels, seen.labels)
    assert np.array_equal(copy.edges, seen.edges)
    assert copy.boxes == pytest.approx(seen.boxes, abs=1e-6)
    assert sample.anchors[copy.rows] * copy.stretch + copy.shift == pytest.approx(seen.anchors, abs=1e-5)
    assert sample.groups[copy.rows] * copy.stretch == pytest.approx(seen.groups, abs=1e-5)


def test_answers_stand_in_the_frame_of_the_copy() -> None:
    (copy,) = make_sample([lacking("left")], FEATURES).copies
    assert np.array_equal(copy.targets.boxes[copy.targets.anchors], copy.boxes)


def test_pairs_of_two_models_are_no_sample() -> None:
    with pytest.raises(ValueError, match="one target"):
        make_sample([natural_pair(cabinet()), natural_pair(cabinet())], FEATURES)
    with pytest.raises(ValueError, match="one target"):
        make_sample([], FEATURES)


def test_masked_labels_are_unknown_and_edges_contacts() -> None:
    pair = masked_pair(natural_pair(cabinet()))
    (copy,) = make_sample([pair], FEATURES).copies
    assert (copy.labels == UNKNOWN).all()
    assert set(copy.edges[copy.edges < 4].tolist()) == {CONTACT}
    assert copy.strategy == MASKED


def test_copies_are_drawn_by_the_mix() -> None:
    natural = natural_pair(cabinet())
    drawn = draw_pairs(natural, 300, CopyMix(0.5, 0.25, STILL, folds=2), np.random.default_rng(0))
    kinds = [pair.strategy for pair in drawn]
    assert 0.4 < kinds.count("natural") / 300 < 0.6
    assert 0.15 < kinds.count(MASKED) / 300 < 0.35
    assert len(set(kinds)) <= 4  # two folds, each the same whenever it is drawn


def test_a_mix_that_mirrors_or_adds_up_to_more_than_all_is_refused() -> None:
    with pytest.raises(ValueError, match="must not mirror"):
        CopyMix(0.5, 0.0, CorruptionConfig())
    with pytest.raises(ValueError, match="fractions of one"):
        CopyMix(0.8, 0.3, STILL)
    with pytest.raises(ValueError, match="folds"):
        CopyMix(0.8, 0.0, STILL, folds=0)
