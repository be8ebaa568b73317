"""A running average of the weights, which is what is judged and shipped: it swings less than the weights themselves."""

from typing import final

import torch
from torch import Tensor, nn


@final
class AveragedWeights:
    """An exponential average over the weights of a module, of the length 1 / (1 - decay) steps.

    The first steps count fully: after n of them the decay is at most (1 + n) / (10 + n), so that the weights at the
    start, which are noise, are forgotten at once.
    """

    def __init__(self, module: nn.Module, decay: float) -> None:
        if not 0.0 <= decay < 1.0:
            raise ValueError(f"`decay` must be in 0..1: got {decay}")
        self.decay = decay
        self.steps = 0
        self.weights = {name: value.detach().clone() for name, value in module.state_dict().items()}

    @torch.no_grad()
    def update(self, module: nn.Module) -> None:
        """Takes one more step's weights into the average."""
        self.steps += 1
        decay = min(self.decay, (1 + self.steps) / (10 + self.steps))
        floats: list[Tensor] = []
        news: list[Tensor] = []
        for name, value in module.state_dict().items():
            if value.is_floating_point():
                floats.append(self.weights[name])
                news.append(value.detach())
            else:
                self.weights[name].copy_(value)
        torch._foreach_lerp_(floats, news, 1.0 - decay)

    def state(self) -> dict[str, object]:
        """Returns what `restore` takes."""
        return {"steps": self.steps, "weights": self.weights}

    def restore(self, state: dict[str, object]) -> None:
        """Goes on from the state of an earlier average over the same module.

        Raises:
            ValueError: if it is of another module.
        """
        weights = state["weights"]
        if not isinstance(weights, dict) or weights.keys() != self.weights.keys():
            raise ValueError("the average must be of the same module: got weights of other names")
        for name, value in self.weights.items():
            value.copy_(weights[name])
        self.steps = int(str(state["steps"]))
