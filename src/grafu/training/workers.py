"""Several processes that train one network (torchrun), each on its own models: who is who, and what they agree on.

Gradients are averaged here in one message, not by torch's wrapper for modules: that wrapper stumbles over a head that
no graph of a batch needs (a batch without drawers). The same message states whether a stop was requested: Ctrl-C
and termination end a run after the current step, with everything saved.
"""

import os
import signal
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import final

import torch
from torch import Tensor, distributed, nn

from grafu.dataclass import dataclass
from grafu.processes.lifetime import END_REQUESTS

_SIGNALS = (signal.SIGINT, signal.SIGTERM)


@final
class StopRequest:
    """Whether a stop was requested. A second Ctrl-C interrupts at once."""

    def __init__(self) -> None:
        self.is_made = False

    def hear(self, number: int, _: FrameType | None) -> None:
        """Takes a signal, as its handler."""
        if self.is_made and number == signal.SIGINT:
            raise KeyboardInterrupt
        self.is_made = True
        END_REQUESTS.are_made |= number == signal.SIGTERM


@contextmanager
def stop_requests() -> Iterator[StopRequest]:
    """Yields what states whether a signal came; outside of the main thread none can come."""
    request = StopRequest()
    if threading.current_thread() is not threading.main_thread():
        yield request
        return
    before = {number: signal.signal(number, request.hear) for number in _SIGNALS}
    try:
        yield request
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@final
@dataclass(frozen=True)
class Workers:
    """This process, `rank` (0, 1, ...) of `count`, and the device that it computes on."""

    rank: int
    count: int
    device: torch.device

    @property
    def is_first(self) -> bool:
        """Whether this process writes and judges for all."""
        return self.rank == 0

    @property
    def name(self) -> str:
        """What computes, in words."""
        if self.device.type == "cpu":
            return f"on {self.count} x {torch.get_num_threads()} threads"
        return f"on {self.count} x {torch.cuda.get_device_name(self.device)}"

    def share_weights(self, module: nn.Module) -> None:
        """Gives every process the first one's weights."""
        if self.count > 1:
            for value in module.state_dict().values():
                distributed.broadcast(value, 0)

    def average_gradients(self, parameters: Iterable[nn.Parameter], is_stopping: bool) -> bool:
        """Gives every process the mean of all gradients; returns whether any of them is to stop."""
        if self.count == 1:
            return is_stopping
        known = list(parameters)
        for parameter in known:
            if parameter.grad is None:
                parameter.grad = torch.zeros_like(parameter)
        gradients: list[Tensor] = [p.grad for p in known if p.grad is not None]
        flag = torch.tensor([float(is_stopping)], device=self.device)
        message = torch.cat([flag, *(g.reshape(-1) for g in gradients)])
        distributed.all_reduce(message)
        start = 1
        for gradient in gradients:
            gradient.copy_(message[start : start + gradient.numel()].view_as(gradient) / self.count)
            start += gradient.numel()
        return bool(message[0] > 0)

    def wait(self) -> None:
        """Waits for all."""
        if self.count > 1:
            distributed.barrier()


@contextmanager
def joined_workers(device: str = "auto") -> Iterator[Workers]:
    """Yields this process among those that torchrun started, or alone; `device` "auto" is a GPU where there is one."""
    count, rank, local = (int(os.environ.get(n, d)) for n, d in (("WORLD_SIZE", 1), ("RANK", 0), ("LOCAL_RANK", 0)))
    chosen = _device(device, local)
    if count > 1:
        distributed.init_process_group("nccl" if chosen.type == "cuda" else "gloo")
    try:
        yield Workers(rank, count, chosen)
    finally:
        if count > 1:
            distributed.destroy_process_group()


def _device(name: str, local: int) -> torch.device:
    if name == "auto":
        name = "cuda" if torch.cuda.is_available() else "cpu"
    if name != "cuda":
        return torch.device(name)
    torch.cuda.set_device(local)
    return torch.device("cuda", local)


def has_device(name: str) -> bool:
    """Whether there is a device of this name: auto, cpu, cuda."""
    return name != "cuda" or torch.cuda.is_available()


def use_threads(count: int | None) -> None:
    """Sets how many threads compute on a CPU (None: one for each core)."""
    if count is not None:
        torch.set_num_threads(count)
