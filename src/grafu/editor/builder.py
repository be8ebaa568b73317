"""The builder's side of the server: one warm process (`grafu.editor.building`), asked for one thing at a time.

A process that is stopped or dies is replaced by another at the next order, which then begins without a cache.
"""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import Condition, Lock
from typing import Any, Final, Protocol, final, runtime_checkable

from grafu.dataclass import dataclass
from grafu.editor.building import GIVE_WAY, Order
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

    def give_way(self) -> None:
        """Ends the order `judge`, if that is in work: what it made is nothing."""
        ...

    def stop(self) -> None:
        """Ends what is being made."""
        ...


@final
class Turns:
    """Lets one order at a time be in work, and `judge` only where no other waits; not a value."""

    def __init__(self) -> None:
        self._changed = Condition()
        self._is_taken = False
        self._waiting = 0  # orders that `judge` gives way to

    @contextmanager
    def taken(self, can_wait: bool) -> Iterator[None]:
        """Waits for its turn, and has it for the body."""
        with self._changed:
            self._waiting += not can_wait
            self._changed.wait_for(lambda: not self._is_taken and not (can_wait and self._waiting))
            self._waiting -= not can_wait
            self._is_taken = True
        try:
            yield
        finally:
            with self._changed:
                self._is_taken = False
                self._changed.notify_all()

    @property
    def is_wanted(self) -> bool:
        """Whether an order waits that `judge` gives way to."""
        return self._waiting > 0


@final
class BuildProcess:
    """Starts the process, gives it orders and passes on what it tells; not a value. `ask` may run in any thread."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[str] | None = None
        self._turns = Turns()
        self._sending = Lock()
        self._judging: subprocess.Popen[str] | None = None

    def ask(self, order: Order, on_stage: Callable[[str], None]) -> Answer:
        """Returns what an order made; `on_stage` is called with each stage as it begins.

        The order `judge` gives way to every other one, from whichever page: then it made nothing.

        Raises:
            NotBuilt: if something is at fault, or the process was stopped.
        """
        can_wait = order.do == "judge"
        if not can_wait:
            self.give_way()
        with self._turns.taken(can_wait):
            process = self._running()
            try:
                return self._asked(process, order, on_stage)
            except (OSError, ValueError):  # its streams are closed
                raise NotBuilt(STOPPED) from None
            finally:
                self._judging = None

    def _asked(self, process: "subprocess.Popen[str]", order: Order, on_stage: Callable[[str], None]) -> Answer:
        assert process.stdout is not None
        self._send(process, order.line())
        if order.do == "judge":
            self._judging = process
            if self._turns.is_wanted:  # by an order that came before this one was sent
                self.give_way()
        for line in process.stdout:
            told = json.loads(line)
            if "stage" in told:
                on_stage(told["stage"])
            elif "error" in told:
                raise NotBuilt(told["error"])
            else:
                return Answer(told["done"], told["seconds"])
        raise NotBuilt(STOPPED)

    def _send(self, process: "subprocess.Popen[str]", line: str) -> None:
        assert process.stdin is not None
        with self._sending:
            process.stdin.write(line + "\n")
            process.stdin.flush()

    def give_way(self) -> None:
        """Ends the order `judge`, if that is in work; the process stays, with its cache."""
        process = self._judging
        if process is not None:
            with suppress(OSError, ValueError):  # it has ended
                self._send(process, GIVE_WAY)

    def stop(self) -> None:
        """Ends the process at once, whatever it does."""
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            with self._turns.taken(can_wait=False):  # whoever waits for an answer sees the end of it first
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
