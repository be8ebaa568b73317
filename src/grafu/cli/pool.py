"""Several jobs at once, each in a process of its own kind: one that crashes or hangs memory takes no other with it."""

import multiprocessing
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from typing import TypeVar

from grafu.cli.job import Failed, Job, JobResult, run_job

Item = TypeVar("Item")
Result = TypeVar("Result")
Run = Callable[[Job], JobResult]
CRASHED = "the process died while working on it (out of memory, or a crash in a native library)"


def run_jobs(jobs: list[Job], workers: int, run: Run = run_job) -> Iterator[JobResult]:
    """Yields each job's result as it ends, `workers` at a time; `run` must be a function of a module."""
    return run_all(jobs, workers, run, lambda job: Failed(job, CRASHED, users_fault=False))


def run_all(
    items: Sequence[Item], workers: int, run: Callable[[Item], Result], crashed: Callable[[Item], Result]
) -> Iterator[Result]:
    """Yields the result of each item as it ends, `workers` at a time; `run` must be a function of a module.

    A worker's death breaks the whole pool, and nobody knows which item did it: those left are run again one by one,
    each in a fresh pool, and the one that kills its worker again gets the result that `crashed` gives it.
    """
    suspects: list[Item] = []
    for item, results in _run_pool(items, workers, run):
        if not results:
            suspects.append(item)
        yield from results
    for item in suspects:
        [(_, results)] = _run_pool([item], 1, run)
        yield from results or [crashed(item)]


def _run_pool(
    items: Sequence[Item], workers: int, run: Callable[[Item], Result]
) -> Iterator[tuple[Item, list[Result]]]:
    """Yields each item with its result, or with none where its worker died."""
    context = multiprocessing.get_context("spawn")  # fork would copy locks that native libraries hold
    with ProcessPoolExecutor(min(workers, len(items)), context, initializer=_die_on_interrupt) as pool:
        try:
            futures = {pool.submit(run, item): item for item in items}
            for future in as_completed(futures):
                yield futures[future], _result_of(future)
        except BaseException:  # an interruption, or a caller that stops asking
            pool.shutdown(wait=False, cancel_futures=True)
            for worker in multiprocessing.active_children():
                worker.terminate()
            raise


def _result_of(future: "Future[Result]") -> list[Result]:
    try:
        return [future.result()]
    except BrokenProcessPool:
        return []


def _die_on_interrupt() -> None:
    """Lets Ctrl-C end a worker without a traceback; the parent says the one line."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
