"""How weights are moved: matrices inside the network by Muon or by Adam, all else by Adam; how far, and their average.

Muon makes every direction of a matrix's momentum count alike, scaled so that its steps are as large as Adam's: learning
rate and decay mean the same for both. The learning rate rises, then falls to zero along a cosine. A running average of
the weights is what is judged and shipped: it swings less than the weights themselves.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, final

import torch
from torch import Tensor, nn

from grafu.training.config import OptimiserConfig


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


def rate_at(step: int, steps: int, warmup: int, period: int | None = None) -> float:
    """Returns the share (0..1) of the highest learning rate for step 0, 1, ... of `steps`.

    It rises evenly over the first `warmup` steps, so that Adam's first averages do no harm, and then falls along half a
    cosine to zero at the end; or, with `period`, at that step, which the paper's training never reaches.
    """
    if step < warmup:
        return (step + 1) / (warmup + 1)
    last = steps if period is None else period
    done = (step - warmup) / max(1, last - warmup)
    return 0.5 * (1.0 + math.cos(math.pi * min(1.0, done)))


_FEATURES = 32  # numbers: a narrower matrix reads terms or writes answers


@final
class Optimiser:
    """One or two optimisers of torch that step together."""

    def __init__(self, network: nn.Module, config: OptimiserConfig) -> None:
        matrices, tables, others = _parameters(network)
        adam = torch.optim.AdamW if config.decoupled else torch.optim.Adam
        orthogonal = config.matrices == "muon"
        decayed = tables if orthogonal else [*matrices, *tables]
        groups = [{"params": decayed, "weight_decay": config.weight_decay}, {"params": others, "weight_decay": 0.0}]
        self._parts: list[torch.optim.Optimizer] = [adam(groups, lr=config.rate, betas=config.betas, fused=True)]
        if orthogonal:
            self._parts.append(
                torch.optim.Muon(
                    matrices,
                    lr=config.rate,
                    weight_decay=config.weight_decay,
                    momentum=config.momentum,
                    adjust_lr_fn="match_rms_adamw",
                )
            )

    @property
    def rate(self) -> float:
        """The learning rate of the next step."""
        return float(next(self._groups())["lr"])

    @rate.setter
    def rate(self, rate: float) -> None:
        for group in self._groups():
            group["lr"] = rate

    def zero_grad(self) -> None:
        """Forgets the gradients."""
        for part in self._parts:
            part.zero_grad()

    def step(self) -> None:
        """Moves the weights along their gradients."""
        for part in self._parts:
            part.step()

    def state(self) -> list[dict[str, Any]]:
        """Returns what the next steps depend on."""
        return [part.state_dict() for part in self._parts]

    def restore(self, state: Sequence[Mapping[str, Any]]) -> None:
        """Goes on from what `state` returned."""
        for part, stated in zip(self._parts, state, strict=True):
            part.load_state_dict(dict(stated))

    def _groups(self) -> Iterator[dict[str, Any]]:
        for part in self._parts:
            yield from part.param_groups


def _parameters(network: nn.Module) -> tuple[list[Tensor], list[Tensor], list[Tensor]]:
    """Returns matrices between features; tables and all else of two or more dimensions; biases, norms and numbers."""
    linear = (m.weight for m in network.modules() if isinstance(m, nn.Linear))
    inner = [weight for weight in linear if min(weight.shape) >= _FEATURES]
    known = {id(weight) for weight in inner}
    tables: list[Tensor] = [p for p in network.parameters() if p.ndim >= 2 and id(p) not in known]
    return inner, tables, [p for p in network.parameters() if p.ndim < 2]
