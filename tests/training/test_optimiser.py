"""Matrices move by Muon, all else by Adam, both at one rate; a run that was cut goes on alike."""

from copy import deepcopy
from dataclasses import replace

import pytest
import torch
from torch import nn

from grafu.training.config import Matrices, OptimiserConfig
from grafu.training.optimiser import Optimiser, averaged, rate_at

CONFIG = OptimiserConfig(rate=0.01, weight_decay=0.0)


def network() -> nn.Sequential:
    torch.manual_seed(0)
    return nn.Sequential(nn.Linear(3, 32), nn.GELU(), nn.Linear(32, 48), nn.GELU(), nn.Linear(48, 2))


def learn(net: nn.Module, optimiser: Optimiser, seed: int) -> None:
    points = torch.randn(16, 3, generator=torch.Generator().manual_seed(seed))
    optimiser.zero_grad()
    net(points).square().sum().backward()
    optimiser.step()


def moved(net: nn.Sequential, before: list[torch.Tensor]) -> list[torch.Tensor]:
    return [new.detach() - old for new, old in zip(net.parameters(), before, strict=True)]


@pytest.mark.parametrize("matrices", ["adam", "muon"])
def test_all_weights_move_at_the_rate(matrices: Matrices) -> None:
    net = network()
    optimiser = Optimiser(net, replace(CONFIG, matrices=matrices))
    optimiser.rate = 0.02
    before = [p.detach().clone() for p in net.parameters()]
    learn(net, optimiser, 1)
    assert optimiser.rate == 0.02
    for change in moved(net, before):
        assert 0.05 * 0.02 < float(change.square().mean().sqrt()) < 1.5 * 0.02


def evenness(matrix: torch.Tensor) -> float:
    """Returns over how many directions a matrix's strength is spread."""
    strengths = torch.linalg.svdvals(matrix.float())
    return float(strengths.sum().square() / strengths.square().sum())


def test_muon_makes_the_directions_of_a_matrix_count_alike() -> None:
    net = network()
    inner = list(net.parameters())[2]
    before = inner.detach().clone()
    learn(net, Optimiser(net, replace(CONFIG, matrices="muon")), 1)
    assert inner.grad is not None
    assert evenness(inner.grad) < 4
    assert evenness(inner.detach() - before) > 7


@pytest.mark.parametrize("matrices", ["adam", "muon"])
def test_a_restored_one_goes_on_alike(matrices: Matrices) -> None:
    config = replace(CONFIG, matrices=matrices)
    first = network()
    optimiser = Optimiser(first, config)
    learn(first, optimiser, 1)
    second = network()
    second.load_state_dict(first.state_dict())
    resumed = Optimiser(second, config)
    resumed.restore(deepcopy(optimiser.state()))
    for net, one in ((first, optimiser), (second, resumed)):
        learn(net, one, 2)
    for a, b in zip(first.parameters(), second.parameters(), strict=True):
        assert torch.equal(a, b)


def test_biases_and_norms_do_not_decay() -> None:
    net = network()
    with torch.no_grad():
        list(net.parameters())[1].fill_(1.0)
    optimiser = Optimiser(net, replace(CONFIG, weight_decay=0.5))
    for p in net.parameters():
        p.grad = torch.zeros_like(p)
    before = [p.detach().clone() for p in net.parameters()]
    optimiser.step()
    for old, new in zip(before, net.parameters(), strict=True):
        decays = old.ndim >= 2
        assert torch.allclose(new, old * (1 - 0.5 * CONFIG.rate) if decays else old)


def test_it_rises_and_falls_to_zero() -> None:
    rates = [rate_at(step, 100, 10) for step in range(101)]
    assert rates[:11] == sorted(rates[:11])
    assert rates[10] == 1.0
    assert rates[10:] == sorted(rates[10:], reverse=True)
    assert rates[100] == pytest.approx(0.0)
    assert rate_at(55, 100, 10) == pytest.approx(0.5)


def test_a_period_beyond_the_end_never_comes_to_zero() -> None:
    assert rate_at(119, 120, 0, 450) == pytest.approx(0.837, abs=0.01)  # the authors stop at 83 % of the peak


def linear(value: float) -> nn.Linear:
    layer = nn.Linear(2, 1)
    with torch.no_grad():
        for parameter in layer.parameters():
            parameter.fill_(value)
    return layer


def test_the_start_is_forgotten_and_the_rest_averaged() -> None:
    average = averaged(linear(100.0), 0.9)
    for _ in range(200):
        average.update_parameters(linear(1.0))
    assert average.module.weight.tolist() == [[pytest.approx(1.0), pytest.approx(1.0)]]
    average.update_parameters(linear(2.0))
    assert average.module.bias.item() == pytest.approx(1.1)


def test_the_first_steps_count_more() -> None:
    average = averaged(linear(100.0), 0.999)
    average.update_parameters(linear(0.0))
    average.update_parameters(linear(1.0))
    assert average.module.bias.item() == pytest.approx(9 / 12)  # a decay of (1 + 2) / (10 + 2)


def test_without_decay_it_is_the_last() -> None:
    average = averaged(linear(1.0), 0.0)
    average.update_parameters(linear(3.0))
    average.update_parameters(linear(5.0))
    assert average.module.bias.item() == 5.0


def test_it_goes_on_from_its_state() -> None:
    one = averaged(linear(1.0), 0.99)
    one.update_parameters(linear(3.0))
    other = averaged(linear(0.0), 0.99)
    other.load_state_dict(one.state_dict())
    one.update_parameters(linear(4.0))
    other.update_parameters(linear(4.0))
    assert torch.equal(one.module.weight, other.module.weight)


def test_a_decay_of_one_is_refused() -> None:
    with pytest.raises(ValueError, match="decay"):
        averaged(linear(1.0), 1.0)
