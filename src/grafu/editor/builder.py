"""The builder's side of the server: one warm process (`grafu.editor.building`), asked for one thing at a time.

A process that is stopped or dies is replaced by another at the next order, which then begins without a cache.
"""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from threading import Lock
from typing import Any, Final, Protocol, final, runtime_checkable

from grafu.editor.building import Order
from grafu.errors import NotBuilt

PRIVATE: Final = {"ORT_DISABLE_TELEMETRY": "1"}
STOPPED: Final = "it was stopped"


@final
@dataclass(frozen=True)
class Answer:
    """What an order made, and the seconds that it took."""

    made: dict[str, Any]
    seconds: float


@runtime_checkable
class Builds(Protocol):
    """What carries out orders: `BuildProcess`, or what stands in its place."""

    def ask(self, order: Order, on_stage: Callable[[str], None]) -> Answer:
        """Returns what an order made, or raises `NotBuilt`."""
        ...

    def stop(self) -> None:
        """Ends what is being made."""
        ...


@final
class BuildProcess:
    """Starts the process, gives it orders and passes on what it tells; not a value. `ask` may run in any thread."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[str] | None = None
        self._one_at_a_time = Lock()

    def ask(self, order: Order, on_stage: Callable[[str], None]) -> Answer:
        """Returns what an order made; `on_stage` is called with each stage as it begins.

        Raises:
            NotBuilt: if something is at fault, or the process was stopped.
        """
        with self._one_at_a_time:
            process = self._running()
            try:
                return self._asked(process, order, on_stage)
            except OSError:
                raise NotBuilt(STOPPED) from None

    def _asked(self, process: "subprocess.Popen[str]", order: Order, on_stage: Callable[[str], None]) -> Answer:
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(order.line() + "\n")
        process.stdin.flush()
        for line in process.stdout:
            told = json.loads(line)
            if "stage" in told:
                on_stage(told["stage"])
            elif "error" in told:
                raise NotBuilt(told["error"])
            else:
                return Answer(told["done"], told["seconds"])
        raise NotBuilt(STOPPED)

    def stop(self) -> None:
        """Ends the process at once, whatever it does."""
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            with self._one_at_a_time:  # whoever waits for an answer sees the end of it first
                _clear(process)

    def _running(self) -> "subprocess.Popen[str]":
        if self._process is None or self._process.poll() is not None:
            if self._process is not None:
                _clear(self._process)
            self._process = subprocess.Popen(
                [sys.executable, "-m", "grafu.editor.building"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                text=True,
                encoding="utf-8",
                env={**os.environ, **PRIVATE, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
            )
        return self._process


def _clear(process: "subprocess.Popen[str]") -> None:
    """Waits for a process that ends, and closes what led to it."""
    process.wait()
    for stream in (process.stdin, process.stdout):
        if stream is not None:
            with suppress(OSError):
                stream.close()
