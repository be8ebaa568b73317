"""Several jobs at once, each in a process of its own kind: one that crashes or hangs memory takes no other with it."""

import multiprocessing
import signal
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool

from grafu.cli.job import Failed, Job, JobResult, run_job

Run = Callable[[Job], JobResult]
CRASHED = "the process died while working on it (out of memory, or a crash in a native library)"


def run_jobs(jobs: list[Job], workers: int, run: Run = run_job) -> Iterator[JobResult]:
    """Yields each job's result as it ends, `workers` at a time; `run` must be a function of a module.

    A worker's death breaks the whole pool, and nobody knows which job did it: those left are run again one by one, each
    in a fresh pool, and the one that kills its worker again is the one that fails.
    """
    suspects: list[Job] = []
    for job, result in _run_pool(jobs, workers, run):
        if result is None:
            suspects.append(job)
        else:
            yield result
    for job in suspects:
        [(_, result)] = _run_pool([job], 1, run)
        yield result or Failed(job, CRASHED, users_fault=False)


def _run_pool(jobs: list[Job], workers: int, run: Run) -> Iterator[tuple[Job, JobResult | None]]:
    """Yields each job with its result, or None where its worker died."""
    context = multiprocessing.get_context("spawn")  # fork would copy locks that native libraries hold
    with ProcessPoolExecutor(min(workers, len(jobs)), context, initializer=_die_on_interrupt) as pool:
        try:
            futures = {pool.submit(run, job): job for job in jobs}
            for future in as_completed(futures):
                yield futures[future], _result_of(future)
        except BaseException:  # an interruption, or a caller that stops asking
            pool.shutdown(wait=False, cancel_futures=True)
            for worker in multiprocessing.active_children():
                worker.terminate()
            raise


def _result_of(future: "Future[JobResult]") -> JobResult | None:
    try:
        return future.result()
    except BrokenProcessPool:
        return None


def _die_on_interrupt() -> None:
    """Lets Ctrl-C end a worker without a traceback; the parent says the one line."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
