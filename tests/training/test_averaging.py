"""The running average of weights."""

import pytest
import torch
from torch import nn

from grafu.training.averaging import AveragedWeights


def linear(value: float) -> nn.Linear:
    layer = nn.Linear(2, 1)
    with torch.no_grad():
        for parameter in layer.parameters():
            parameter.fill_(value)
    return layer


def test_the_start_is_forgotten_and_the_rest_averaged() -> None:
    average = AveragedWeights(linear(100.0), 0.9)
    for _ in range(200):
        average.update(linear(1.0))
    assert average.weights["weight"].tolist() == [[pytest.approx(1.0), pytest.approx(1.0)]]
    average.update(linear(2.0))
    assert float(average.weights["bias"]) == pytest.approx(1.1)


def test_without_decay_it_is_the_last() -> None:
    average = AveragedWeights(linear(1.0), 0.0)
    average.update(linear(5.0))
    assert float(average.weights["bias"]) == 5.0


def test_it_goes_on_from_its_state() -> None:
    one = AveragedWeights(linear(1.0), 0.99)
    one.update(linear(3.0))
    other = AveragedWeights(linear(0.0), 0.99)
    other.restore(one.state())
    one.update(linear(4.0))
    other.update(linear(4.0))
    assert torch.equal(one.weights["weight"], other.weights["weight"])
    with pytest.raises(ValueError, match="same module"):
        other.restore({"steps": 1, "weights": {}})


def test_a_decay_of_one_is_refused() -> None:
    with pytest.raises(ValueError, match="decay"):
        AveragedWeights(linear(1.0), 1.0)
