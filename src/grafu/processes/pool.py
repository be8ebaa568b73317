"""Many pieces of work by several processes: one that crashes, or takes too much, takes no other with it."""

from collections import deque
from collections.abc import Callable, Generator, Sequence
from multiprocessing.connection import wait
from typing import TypeVar

from grafu.processes.limits import Ending, Limits, Outcome
from grafu.processes.worker import Start, Worker, nothing

Item = TypeVar("Item")
Result = TypeVar("Result")


def run_each(
    items: Sequence[Item],
    workers: int,
    run: Callable[[Item], Result],
    limits: Limits = Limits(),
    prepare: Callable[[], None] = nothing,
    start: Start = "spawn",
) -> Generator[tuple[Item, Outcome[Result]], None, None]:
    """Yields each item with how it ended, as it ends, `workers` at a time; `run` must be a function of a module.

    The limits hold for each item. A worker serves until it dies, is stopped, or keeps too much memory; another takes
    its place. All end with the generator: close it.
    """
    waiting = deque(items)
    working: dict[Worker[Item, Result], Item] = {}
    try:
        while waiting or working:
            while waiting and len(working) < workers:
                worker = Worker(run, limits, prepare, start)
                working[worker] = waiting.popleft()
                worker.give(working[worker])
            wait([worker.connection for worker in working], min(_patience(working), default=None))
            for worker, item in list(working.items()):
                outcome = worker.outcome()
                if outcome is None:
                    continue
                del working[worker]
                if outcome.ending is Ending.DONE:
                    if waiting and not worker.is_worn:
                        working[worker] = waiting.popleft()
                        worker.give(working[worker])
                    else:
                        worker.stop()
                yield item, outcome
    finally:
        for worker in working:
            worker.stop()


def _patience(workers: "dict[Worker[Item, Result], Item]") -> list[float]:
    return [worker.patience for worker in workers if worker.patience is not None]
