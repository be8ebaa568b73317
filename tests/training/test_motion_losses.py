"""The losses of motions, against values worked out by batch."""

from dataclasses import replace
from math import log

import pytest
import torch
from perfect_answers import perfect, place, targets_of, truth_of

from grafu.graph.arrays import NONE
from grafu.training.criterion import motion_losses
from grafu.training.targets import stack_targets
from small_graphs import cabinet

TARGETS = stack_targets([targets_of(cabinet())])
ANSWERS = perfect(TARGETS)
TRUTH = truth_of(ANSWERS, TARGETS)
DOOR, MOUNT = place("door_1"), place("left")


def test_perfect_answers_cost_nothing() -> None:
    losses = vars(motion_losses(ANSWERS, TRUTH))
    assert {name: float(loss) for name, loss in losses.items() if float(loss) > 1e-5} == {}


def test_ignorance_costs_the_log_of_the_choices() -> None:
    blank = replace(
        ANSWERS,
        border=torch.zeros_like(ANSWERS.border),
        sign=torch.zeros_like(ANSWERS.sign),
        slide=torch.zeros_like(ANSWERS.slide),
    )
    losses = motion_losses(blank, TRUTH)
    assert losses.border.item() == pytest.approx(log(4))
    assert losses.sign.item() == pytest.approx(log(2))
    assert losses.slide.item() == pytest.approx(log(6))


def test_each_hinge_counts_once_where_the_door_asks_about_its_mount() -> None:
    border = ANSWERS.border.clone()
    border[0, DOOR, MOUNT] = 0.0
    assert motion_losses(replace(ANSWERS, border=border), TRUTH).border.item() == pytest.approx(log(4) / 2, rel=1e-5)


def test_other_pairs_do_not_count() -> None:
    border = ANSWERS.border.clone()
    border[0, MOUNT, DOOR] = border[0, DOOR, place("right")] = -border[0, DOOR, MOUNT]
    assert motion_losses(replace(ANSWERS, border=border), TRUTH).border.item() == pytest.approx(0.0, abs=1e-5)


def test_a_motion_that_is_not_known_is_not_asked_for() -> None:
    codes = TRUTH.border.clone()
    codes[0, DOOR] = NONE
    border = ANSWERS.border.clone()
    border[0, DOOR] = 0.0
    losses = motion_losses(replace(ANSWERS, border=border), replace(TRUTH, border=codes))
    assert losses.border.item() == pytest.approx(0.0, abs=1e-5)


def test_a_graph_without_motions_costs_nothing() -> None:
    nothing = replace(TRUTH, child=torch.zeros_like(TRUTH.child))
    assert sum(float(loss) for loss in vars(motion_losses(ANSWERS, nothing)).values()) == 0.0
