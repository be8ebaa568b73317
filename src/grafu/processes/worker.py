"""Processes that do one piece of work after another, each stopped where one takes too much time or memory.

With several at once, a piece that crashes, or takes too much, takes no other with it.
"""

import multiprocessing
import sys
from collections import deque
from collections.abc import Callable, Generator, Sequence
from math import inf
from multiprocessing.connection import Connection, wait
from pathlib import Path
from time import monotonic
from typing import Any, Generic, Literal, TypeVar, final

from grafu.processes.cores import share_cores
from grafu.processes.lifetime import (
    clear_scratch,
    end_with_parent,
    interrupts_later,
    kill,
    leave_interrupts_to_parent,
    started_by_main_thread,
)
from grafu.processes.limits import PATIENCE, Ending, Outcome, ProcessLimits, refuse_beyond, resident_bytes

Item = TypeVar("Item")
Result = TypeVar("Result")
Start = Literal["fork", "spawn"]
_SOONEST, _LATEST = 0.05, 0.5  # seconds between two looks at a worker with limits
_FILLED = 2 * 10**9  # bytes a second: no process fills memory faster, so one with room needs no look so soon
_WORN = 0.5  # of its memory: a worker that keeps more from one piece of work to the next is not used again


def nothing() -> None:
    """Prepares nothing."""


def ignore(_: object) -> None:
    """Hears of an item that begins and does nothing."""


def quick_start() -> Start:
    """Returns how a process starts that need not import again what this one has imported.

    A fork copies one thread alone, and the locks that the others hold: it is for a process without any.
    """
    alone = sys.platform == "linux" and len(list(Path("/proc/self/task").iterdir())) == 1
    return "fork" if alone else "spawn"


def next_look(left: float, room: float) -> float:
    """Returns in how many seconds a worker must be looked at again, if it states nothing.

    `left` are the seconds until it is late, `room` the bytes until it is too large: where there is much of both it is
    seldom looked at, as each look takes the watcher's time.
    """
    return min(max(min(left, room / _FILLED), _SOONEST), _LATEST)


@final
class Worker(Generic[Item, Result]):
    """A process that runs `run` on items, within limits that hold for each; `run` must be a function of a module.

    `prepare` is called in it first, say to import; the time of an item begins after that. So many processes as `beside`
    states, itself counted, share the cores.
    """

    def __init__(
        self,
        run: Callable[[Item], Result],
        limits: ProcessLimits = ProcessLimits(),
        prepare: Callable[[], None] = nothing,
        start: Start = "spawn",  # a fork would copy locks that native libraries hold
        beside: int = 1,
    ) -> None:
        context: Any = multiprocessing.get_context(start)
        self._limits = limits
        self.connection, theirs = context.Pipe()
        arguments = (run, limits, prepare, theirs, started_by_main_thread(), beside)
        self._process = context.Process(target=_serve, args=arguments, daemon=True)
        self._deadline: float | None = None
        self._held = 0  # bytes, at the last look
        with interrupts_later():
            self._process.start()
        theirs.close()

    @property
    def patience(self) -> float | None:
        """Seconds until the next check while it reports nothing; None: no check."""
        if self._limits == ProcessLimits():
            return None
        left = inf if self._deadline is None else self._deadline - monotonic()
        return next_look(left, inf if self._limits.memory is None else float(self._limits.memory - self._held))

    def give(self, item: Item) -> None:
        """Gives it work; one that died meanwhile states it when it is asked for the outcome."""
        self._deadline = None
        try:
            self.connection.send(item)
        except OSError:
            return

    def outcome(self) -> Outcome[Result] | None:
        """Returns how the work that it was given ended; None while it is at it. A worker without a result is gone."""
        try:
            while self.connection.poll():
                results = self.connection.recv()
                if results:
                    return Outcome(Ending.DONE, results)
                self._begin()
        except (EOFError, OSError):
            self.stop()
            return Outcome(Ending.DIED)
        excess = self._excess()
        if excess is None:
            return None
        self.stop()
        return Outcome(excess)

    @property
    def is_worn(self) -> bool:
        """Whether it keeps so much memory that the next piece of work would have too little."""
        memory = self._limits.memory
        return memory is not None and resident_bytes(self._process.pid) > _WORN * memory

    def stop(self) -> None:
        """Ends it at once, with all that it started and its folders; does nothing where it is gone."""
        process = self._process.pid
        if self._process.is_alive():
            kill(process)
        self._process.join()
        clear_scratch(process)
        self.connection.close()

    def _begin(self) -> None:
        if self._limits.seconds is not None:
            self._deadline = monotonic() + PATIENCE * self._limits.seconds

    def _excess(self) -> Ending | None:
        if self._limits.memory is not None:
            self._held = resident_bytes(self._process.pid)
            if self._held > self._limits.memory:
                return Ending.LARGE
        return Ending.LATE if self._deadline is not None and monotonic() > self._deadline else None


@final
class ReusedWorker(Generic[Item, Result]):
    """A worker for one item after the other; another takes its place after it died, was stopped or is worn."""

    def __init__(
        self,
        run: Callable[[Item], Result],
        limits: ProcessLimits,
        prepare: Callable[[], None] = nothing,
        beside: int = 1,
    ) -> None:
        self._run, self._limits, self._prepare, self._beside = run, limits, prepare, beside
        self._worker: Worker[Item, Result] | None = None

    def outcome_of(self, item: Item) -> Outcome[Result]:
        """Returns how work on an item ended; when it is interrupted meanwhile, the worker ends."""
        worker = self._worker or Worker(self._run, self._limits, self._prepare, beside=self._beside)
        self._worker = None
        try:
            worker.give(item)
            while (outcome := worker.outcome()) is None:
                wait([worker.connection], worker.patience)
        except BaseException:
            worker.stop()
            raise
        if outcome.ending is Ending.DONE and not worker.is_worn:
            self._worker = worker
        elif outcome.ending is Ending.DONE:
            worker.stop()
        return outcome

    def stop(self) -> None:
        """Ends the worker, where there is one."""
        if self._worker is not None:
            self._worker.stop()
        self._worker = None


def _serve(
    run: Callable[[Any], object],
    limits: ProcessLimits,
    prepare: Callable[[], None],
    connection: Connection,
    started_by_main_thread: bool,
    beside: int,
) -> None:
    """Works until the pipe is closed: an empty tuple states that work begins, one with a result that it is done."""
    leave_interrupts_to_parent()
    end_with_parent(started_by_main_thread)
    if limits.memory is not None:
        refuse_beyond(limits.memory)
    share_cores(beside)
    prepare()
    while True:
        try:
            item = connection.recv()
            connection.send(())
            connection.send((run(item),))
        except (EOFError, BrokenPipeError):
            return


def run_each(
    items: Sequence[Item],
    workers: int,
    run: Callable[[Item], Result],
    limits: ProcessLimits = ProcessLimits(),
    prepare: Callable[[], None] = nothing,
    start: Start = "spawn",
    on_begin: Callable[[Item], None] = ignore,
) -> Generator[tuple[Item, Outcome[Result]], None, None]:
    """Yields each item with how it ended, as it ends, `workers` at a time; `run` must be a function of a module.

    `on_begin` is called here with each item as it is given to a worker. The limits hold for each item. A worker serves
    until it dies, is stopped, or keeps too much memory; another takes its place. All end with the generator: close it.
    """
    waiting = deque(items)
    working: dict[Worker[Item, Result], Item] = {}
    try:
        while waiting or working:
            while waiting and len(working) < workers:
                worker = Worker(run, limits, prepare, start, min(workers, len(items)))
                working[worker] = waiting.popleft()
                _give(worker, working[worker], on_begin)
            wait([worker.connection for worker in working], min(_patience(working), default=None))
            for worker, item in list(working.items()):
                outcome = worker.outcome()
                if outcome is None:
                    continue
                del working[worker]
                if outcome.ending is Ending.DONE:
                    if waiting and not worker.is_worn:
                        working[worker] = waiting.popleft()
                        _give(worker, working[worker], on_begin)
                    else:
                        worker.stop()
                yield item, outcome
    finally:
        for worker in working:
            worker.stop()


def _give(worker: Worker[Item, Result], item: Item, on_begin: Callable[[Item], None]) -> None:
    on_begin(item)
    worker.give(item)


def _patience(workers: "dict[Worker[Item, Result], Item]") -> list[float]:
    return [worker.patience for worker in workers if worker.patience is not None]
