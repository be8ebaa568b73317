"""The losses of pairs of slots, against values worked out by batch."""

from dataclasses import replace
from math import log

import pytest
import torch
from perfect_answers import perfect, place, targets_of, truth_of

from grafu.graph.arrays import NULL
from grafu.training.criterion import Choices, choice_loss, edge_loss, hinge_targets, pair_losses, parents
from grafu.training.loss_config import LossConfig
from grafu.training.targets import stack_targets
from small_graphs import cabinet

KINDS = LossConfig().edge_kinds
TARGETS = stack_targets([targets_of(cabinet())])
ANSWERS = perfect(TARGETS)
TRUTH = truth_of(ANSWERS, TARGETS)
# Two-way: 12 contacts, 2 hinges, 2 rails, 4 attached; all other of the 18 x 17 pairs are null
WEIGHT = 2 * (12 * 1.0 + 2 * 5.0 + 2 * 5.0 + 4 * 3.0 + (153 - 20) * 0.2)


def test_perfect_answers_cost_nothing() -> None:
    losses = vars(pair_losses(ANSWERS, TRUTH, KINDS))
    assert {name: float(loss) for name, loss in losses.items() if float(loss) > 1e-5} == {}


def test_ignorance_of_edges_costs_the_log_of_their_kinds() -> None:
    assert edge_loss(torch.zeros_like(ANSWERS.edge), TRUTH, KINDS).item() == pytest.approx(log(5), rel=1e-5)


@pytest.mark.parametrize(("a", "b", "weight"), [("left", "back", 1.0), ("left", "door_1", 5.0), ("left", "right", 0.2)])
def test_a_pair_weighs_what_its_true_kind_weighs(a: str, b: str, weight: float) -> None:
    logits = ANSWERS.edge.clone()
    logits[0, place(a), place(b)] = 0.0
    assert edge_loss(logits, TRUTH, KINDS).item() == pytest.approx(weight * log(5) / WEIGHT, rel=1e-4)


def test_pairs_with_itself_or_with_a_slot_that_is_no_node_do_not_count() -> None:
    logits = ANSWERS.edge.clone()
    logits[0, 3, 3] = torch.tensor([9.0, 0.0, 0.0, 0.0, 0.0])
    logits[0, 3, 20] = logits[0, 20, 3] = torch.tensor([9.0, 0.0, 0.0, 0.0, 0.0])
    assert edge_loss(logits, TRUTH, KINDS).item() == pytest.approx(0.0, abs=1e-5)
    assert (TRUTH.edges[0, 20] == NULL).all()


def test_handles_choose_among_doors_and_drawers_and_abstaining() -> None:
    zeros = torch.zeros_like(ANSWERS.parent)
    assert choice_loss(zeros, torch.zeros(()), parents(TRUTH)).item() == pytest.approx(log(4 + 1))
    assert choice_loss(zeros, torch.tensor(log(3.0)), parents(TRUTH)).item() == pytest.approx(log(4 + 3))


def test_doors_choose_among_static_parts_and_abstaining() -> None:
    zeros = torch.zeros_like(ANSWERS.hinge_target)
    assert choice_loss(zeros, torch.zeros(()), hinge_targets(TRUTH, nested=False)).item() == pytest.approx(log(10 + 1))


def test_only_the_rows_of_those_who_choose_count() -> None:
    scores = ANSWERS.parent.clone()
    scores[0, place("left")] = torch.randn(scores.shape[-1])
    assert choice_loss(scores, ANSWERS.parent_abstain, parents(TRUTH)).item() == pytest.approx(0.0, abs=1e-5)


def test_a_handle_whose_parent_is_no_slot_should_abstain() -> None:
    rows = TRUTH.child.clone()
    rows[0, place("knob_1")] = False
    truth = replace(TRUTH, child=rows)
    scores = ANSWERS.parent.clone()
    scores[0, place("knob_1")] = -20.0
    assert choice_loss(scores, torch.zeros(()), parents(truth)).item() == pytest.approx(0.0, abs=1e-5)
    scores[0, place("knob_1")] = 0.0
    assert choice_loss(scores, torch.zeros(()), parents(truth)).item() == pytest.approx(log(5) / 4, rel=1e-4)


def test_a_door_on_two_parts_may_choose_either() -> None:
    scores = torch.tensor([[[0.0, log(2.0), log(3.0), log(4.0)]]]).expand(1, 4, 4)
    right = torch.zeros(1, 4, 4, dtype=torch.bool)
    right[0, 0, 1] = right[0, 0, 2] = True
    candidates = torch.ones(1, 4, 4, dtype=torch.bool)
    candidates[0, 0, 0] = False
    chooses = torch.tensor([[True, False, False, False]])
    loss = choice_loss(scores, torch.zeros(()), Choices(chooses, candidates, right))
    assert loss.item() == pytest.approx(-log((2 + 3) / (2 + 3 + 4 + 1)))


def test_nobody_chooses_and_there_is_nothing_to_choose() -> None:
    scores = torch.zeros(1, 2, 2, requires_grad=True)
    nothing = torch.zeros(1, 2, 2, dtype=torch.bool)
    no_one = torch.zeros(1, 2, dtype=torch.bool)
    zero = torch.zeros(())
    some, none = Choices(~no_one, nothing, nothing), Choices(no_one, nothing, nothing)
    loss = choice_loss(scores, zero, none) + choice_loss(scores, zero, some)
    loss.backward()
    assert loss.item() == 0.0
    assert scores.grad is not None
    assert (scores.grad == 0.0).all()


def test_gradients_push_the_right_candidate_up_and_the_others_down() -> None:
    scores = torch.zeros_like(ANSWERS.parent).requires_grad_()
    abstain = torch.zeros((), requires_grad=True)
    choice_loss(scores, abstain, parents(TRUTH)).backward()
    assert scores.grad is not None
    assert abstain.grad is not None
    row = scores.grad[0, place("knob_1")]
    assert row[place("door_1")].item() == pytest.approx((1 / 5 - 1) / 4)
    assert row[place("door_2")].item() == pytest.approx(1 / 5 / 4)
    assert row[place("left")].item() == 0.0
    assert abstain.grad.item() == pytest.approx(1 / 5)
