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
from torch.optim.swa_utils import AveragedModel, get_ema_multi_avg_fn

from grafu.training.config import OptimiserConfig

_Tensors = tuple[Tensor, ...] | list[Tensor]


def averaged(module: nn.Module, decay: float) -> AveragedModel:
    """Returns a copy of a module whose weights are the exponential moving average, over 1 / (1 - decay) steps.

    The weights before the first step are not in it. After n steps the decay is at most (1 + n) / (10 + n), so that the
    first steps, which are noise, are soon forgotten.

    Raises:
        ValueError: if `decay` is not in 0..1.
    """
    if not 0.0 <= decay < 1.0:
        raise ValueError(f"`decay` must be in 0..1: got {decay}")

    def update(averages: _Tensors, weights: _Tensors, count: Tensor | int) -> None:
        steps = int(count) + 1
        move = get_ema_multi_avg_fn(min(decay, (1 + steps) / (10 + steps)))  # type: ignore[no-untyped-call]
        move(averages, weights, count)

    return AveragedModel(module, multi_avg_fn=update)


def rate_at(step: int, steps: int, warmup: int, period: int | None = None) -> float:
    """Returns the fraction (0..1) of the highest learning rate at step 0, 1, ... of `steps`.

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
        """Goes on from what `state` returned.

        Raises:
            ValueError: if it is the state of another network or other optimisers; torch's own errors where a key lacks.
        """
        for part, stated in zip(self._parts, state, strict=True):
            part.load_state_dict(dict(stated))
            for parameter, moments in part.state.items():
                for name, value in moments.items():
                    if isinstance(value, Tensor) and value.ndim and value.shape != parameter.shape:
                        raise ValueError(f"`{name}` must be of shape {parameter.shape}: got {value.shape}")

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
