"""Means over marked entries: what is not marked never counts, whatever it is."""

import torch

from grafu.training.averages import mean_where, weighted_mean


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
