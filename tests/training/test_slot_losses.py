"""The losses of single slots, against values worked out by batch."""

from dataclasses import replace
from math import exp, log, sqrt

import pytest
import torch
from perfect_answers import perfect, truth_of, two_cabinets
from torch import Tensor

from grafu.graph.arrays import NONE, UNKNOWN
from grafu.training.criterion import (
    box_errors,
    category_loss,
    count_loss,
    exists_loss,
    free_exists_loss,
    mean_where,
    slot_losses,
    weighted_mean,
)
from grafu.training.loss_config import PAPER, LossConfig
from grafu.training.matcher import match_slots

TARGETS = two_cabinets()  # 16 + 12 anchored slots, 2 + 1 missing nodes, 4 + 4 free slots
ANSWERS = perfect(TARGETS)
TRUTH = truth_of(ANSWERS, TARGETS)
SLOTS, MATCHED, FREE = 16 + 12 + 8, 18 + 13, 8


def changed(values: Tensor, graph: int, slot: int, to: Tensor | float) -> Tensor:
    copy = values.clone()
    copy[graph, slot] = to
    return copy


def test_perfect_answers_cost_nothing() -> None:
    losses = vars(slot_losses(ANSWERS, TRUTH, LossConfig()))
    assert {name: float(loss) for name, loss in losses.items() if float(loss) > 1e-6} == {}


def test_ignorance_of_categories_costs_the_log_of_their_number() -> None:
    assert category_loss(torch.zeros_like(ANSWERS.category), TRUTH, TRUTH.matched).item() == pytest.approx(log(14))


def test_one_wrong_category_is_shared_by_all_matched_slots() -> None:
    logits = changed(ANSWERS.category, 0, 0, torch.zeros(14))
    assert category_loss(logits, TRUTH, TRUTH.matched).item() == pytest.approx(log(14) / MATCHED, rel=1e-5)


def test_nodes_of_unknown_label_take_no_part() -> None:
    truth = replace(TRUTH, labels=changed(TRUTH.labels, 0, 0, UNKNOWN))
    logits = changed(ANSWERS.category, 0, 0, torch.full((14,), -5.0))
    assert category_loss(logits, truth, truth.matched).item() == pytest.approx(0.0, abs=1e-6)


def test_boxes_are_squared_distances_or_absolute_differences() -> None:
    found, wanted = torch.tensor([[[1.0, -2.0, 2.0]]]), torch.zeros(1, 1, 3)
    assert box_errors(found, wanted, "squared").tolist() == [[9.0]]
    assert box_errors(found, wanted, "absolute").tolist() == [[5.0]]


def test_a_shifted_anchored_slot_pays_as_matched_and_as_anchored() -> None:
    answers = replace(ANSWERS, centre=changed(ANSWERS.centre, 0, 3, ANSWERS.centre[0, 3] + 0.1))
    losses = slot_losses(answers, TRUTH, LossConfig())
    assert losses.centre.item() == pytest.approx(3 * 0.01 / MATCHED, rel=1e-4)
    assert losses.anchor_centre.item() == pytest.approx(3 * 0.01 / 28, rel=1e-4)
    assert losses.half.item() == losses.anchor_half.item() == 0.0


def test_a_swollen_added_slot_pays_as_matched_alone() -> None:
    answers = replace(ANSWERS, half=changed(ANSWERS.half, 0, 19, ANSWERS.half[0, 19] + 0.1))
    losses = slot_losses(answers, TRUTH, LossConfig())
    assert losses.half.item() == pytest.approx(3 * 0.01 / MATCHED, rel=1e-4)
    assert losses.anchor_half.item() == 0.0


def test_the_box_of_a_slot_that_answers_for_nothing_does_not_matter() -> None:
    answers = replace(ANSWERS, centre=changed(ANSWERS.centre, 0, 16, 9.0), half=changed(ANSWERS.half, 1, 13, 9.0))
    losses = slot_losses(answers, TRUTH, LossConfig())
    assert (losses.centre + losses.half + losses.anchor_centre + losses.anchor_half).item() == 0.0


def test_existence_at_even_odds_costs_a_bit_per_slot() -> None:
    zeros = torch.zeros_like(ANSWERS.exists)
    assert exists_loss(zeros, TRUTH, balanced=False).item() == pytest.approx(log(2))
    balanced = (MATCHED * SLOTS / MATCHED + SLOTS - MATCHED) * log(2) / SLOTS
    assert exists_loss(zeros, TRUTH, balanced=True).item() == pytest.approx(balanced)
    assert free_exists_loss(zeros, TRUTH, 10.0).item() == pytest.approx((3 * 10 + 5) * log(2) / FREE)


def test_padding_neither_exists_nor_not() -> None:
    exists = changed(ANSWERS.exists, 1, 14, 30.0)  # a slot of padding
    assert not bool(ANSWERS.mask[1, 14])
    assert exists_loss(exists, TRUTH, balanced=False).item() == pytest.approx(0.0, abs=1e-6)
    assert free_exists_loss(exists, TRUTH, 10.0).item() == pytest.approx(0.0, abs=1e-6)


def test_padding_slots_must_not_exist_and_count_with_those_that_are_not_anchored() -> None:
    dull = ~TRUTH.anchored & ~TRUTH.free  # as a network with padding slots would mark them
    truth = replace(TRUTH, padding=dull)
    fires = torch.where(dull, 30.0, ANSWERS.exists)
    slots, padding = int((TRUTH.anchored | TRUTH.free).sum()), int(dull.sum())
    assert padding > 0
    assert exists_loss(fires, truth, balanced=False).item() == pytest.approx(30 * padding / (slots + padding))
    assert free_exists_loss(fires, truth, 10.0).item() == pytest.approx(30 * padding / (FREE + padding), rel=1e-4)
    assert count_loss(fires, truth, 0.0).item() == pytest.approx(0.0, abs=1e-3)  # of free slots alone


def test_padding_slots_answer_for_no_node() -> None:
    targets = two_cabinets()
    dull = torch.zeros_like(ANSWERS.mask)
    dull[:, -2:] = True  # the two last free slots, which answered for what is missing
    matching = match_slots(replace(ANSWERS, padding=dull), targets, PAPER)
    assert (matching[:, -2:] == NONE).all()


def test_an_anchored_slot_must_exist_even_if_matched_to_nothing() -> None:
    truth = replace(TRUTH, matched=changed(TRUTH.matched, 0, 0, False))
    assert exists_loss(ANSWERS.exists, truth, balanced=False).item() == pytest.approx(0.0, abs=1e-6)


def test_the_count_is_off_by_the_root_of_what_fires_wrongly() -> None:
    half = torch.where(TRUTH.free, 0.0, ANSWERS.exists)  # each of four free slots fires by half: 2 expected
    assert count_loss(half, TRUTH, 0.0).item() == pytest.approx((sqrt(0) + sqrt(1)) / 2)
    assert count_loss(half, TRUTH, 0.01).item() == pytest.approx((sqrt(1.01) - 0.1) / 2)


def test_the_count_asks_for_no_more_than_there_are_free_slots() -> None:
    truth = replace(TRUTH, missing=TRUTH.missing + 10)
    all_fire = torch.where(TRUTH.free, 30.0, ANSWERS.exists)
    assert count_loss(all_fire, truth, 0.01).item() == pytest.approx(0.0, abs=1e-6)
    missing = [float(n) for n in truth.missing]  # 12 and 11: the paper counts all of them
    wanted = sum(sqrt(n - 4) for n in missing) / 2
    assert count_loss(all_fire, truth, 0.0, capped=False).item() == pytest.approx(wanted, rel=1e-4)


def test_the_count_has_a_slope_that_ends() -> None:
    exists = torch.zeros_like(ANSWERS.exists).requires_grad_()
    count_loss(exists, TRUTH, 0.01).backward()
    assert exists.grad is not None
    assert exists.grad.isfinite().all()
    assert exists.grad.abs().max() <= 5 * 0.25


def test_a_sure_mistake_costs_its_logit() -> None:
    exists = changed(ANSWERS.exists, 0, 16, 3.0)  # a free slot that should not fire
    assert free_exists_loss(exists, TRUTH, 10.0).item() == pytest.approx(log(1 + exp(3.0)) / FREE, rel=1e-4)


def test_the_mean_is_of_the_marked_values() -> None:
    assert mean_where(torch.tensor([1.0, 3.0, torch.inf]), torch.tensor([True, True, False])).item() == 2.0


def test_weights_count() -> None:
    assert weighted_mean(torch.tensor([1.0, 4.0, torch.nan]), torch.tensor([2.0, 1.0, 0.0])).item() == 2.0


def test_the_mean_of_nothing_is_nothing_and_moves_nothing() -> None:
    values = torch.tensor([1.0, 2.0], requires_grad=True)
    mean = mean_where(values, torch.tensor([False, False]))
    mean.backward()
    assert mean.item() == 0.0
    assert values.grad is not None
    assert values.grad.tolist() == [0.0, 0.0]
