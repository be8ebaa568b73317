"""The weights of the losses are the paper's, and nonsense is refused."""

from dataclasses import replace

import pytest

from grafu.graph.arrays import EDGE_CODES
from grafu.training.loss_config import HOLD_OUTS, OFFICIAL, PAPER, LossConfig, held_out


def test_the_weights_are_the_papers() -> None:
    assert (PAPER.match_category, PAPER.match_centre, PAPER.pinned) == (1.0, 2.0, False)
    assert (PAPER.category, PAPER.centre, PAPER.half) == (1.0, 1.0, 0.5)
    assert (PAPER.exists, PAPER.free_exists, PAPER.count, PAPER.free_positive) == (1.0, 3.0, 1.0, 10.0)
    assert (PAPER.anchor_centre, PAPER.anchor_half) == (0.3, 0.3)
    assert (PAPER.edge, PAPER.parent, PAPER.hinge_target) == (1.0, 0.5, 0.5)
    assert PAPER.edge_kinds[: EDGE_CODES["paper"]] == (1.0, 5.0, 5.0, 3.0, 0.2)
    assert (PAPER.border, PAPER.sign, PAPER.slide) == (1.0, 1.0, 1.0)


def test_the_authors_code_weighs_motions_less_and_pins_anchors() -> None:
    assert (OFFICIAL.border, OFFICIAL.sign, OFFICIAL.slide) == (0.3, 0.3, 0.3)
    assert OFFICIAL.pinned
    assert OFFICIAL.match_cost == "probability"


def test_a_negative_weight_is_an_error() -> None:
    with pytest.raises(ValueError, match=r"must not be negative: got .*parent"):
        LossConfig(parent=-1.0)
    with pytest.raises(ValueError, match="must not be negative"):
        replace(PAPER, edge_kinds=(1.0, 1.0, 1.0, 1.0, -1.0))


def test_every_kind_of_edge_has_a_weight() -> None:
    with pytest.raises(ValueError, match="must be 7 weights"):
        LossConfig(edge_kinds=(1.0, 1.0))


def test_an_experiment_holds_its_terms_out_and_no_others() -> None:
    assert held_out(PAPER, "firing") == replace(PAPER, free_exists=0.0, count=0.0)
    assert len(HOLD_OUTS) == 6
    assert all(held_out(PAPER, name) != PAPER for name in HOLD_OUTS)
    with pytest.raises(KeyError, match="everything"):
        held_out(PAPER, "everything")
