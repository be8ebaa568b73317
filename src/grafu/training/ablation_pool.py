"""Several runs of an ablation at once, each in a process of its own, which is faster than one after another.

A process that dies takes no other with it. Being asked to stop ends all after the step at hand, with everything saved.
"""

import multiprocessing
from collections import deque
from collections.abc import Generator, Iterator, Sequence
from contextlib import closing
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import final

from grafu.processes.lifetime import end_with_parent, started_by_main_thread
from grafu.processes.signals import interrupts_later
from grafu.training.ablation_run import AblationRun, RunEvent, do_run
from grafu.training.stopping import stop_requests
from grafu.training.workers import use_threads

_LOOK = 0.5  # seconds between two looks whether somebody asked to stop


def do_runs(
    runs: Sequence[AblationRun], jobs: int = 1, threads: int = 1
) -> Generator[tuple[AblationRun, RunEvent], None, None]:
    """Yields what happens to the runs, `jobs` at a time (1: in this process), each on `threads` threads.

    A script that asks for several must start under `if __name__ == "__main__"`.

    Raises:
        ValueError: if a number is less than 1.
    """
    if min(jobs, threads) < 1:
        raise ValueError(f"`jobs` and `threads` must be at least 1: got {jobs} and {threads}")
    events = _one_by_one(runs, threads) if jobs == 1 else _at_once(runs, jobs, threads)
    with closing(events):
        yield from events


def _one_by_one(runs: Sequence[AblationRun], threads: int) -> Generator[tuple[AblationRun, RunEvent], None, None]:
    use_threads(threads)
    with stop_requests() as asked:  # between two runs; within one the loop hears them
        for run in runs:
            event = RunEvent()
            with closing(do_run(run)) as events:
                for event in events:
                    yield run, event
                    if asked.is_made:
                        return
            if not event.is_last:
                return


def _at_once(
    runs: Sequence[AblationRun], jobs: int, threads: int
) -> Generator[tuple[AblationRun, RunEvent], None, None]:
    waiting = deque(runs)
    working: dict[Connection, _Worker] = {}
    with stop_requests() as asked:
        try:
            while working or (waiting and not asked.is_made):
                while waiting and len(working) < jobs and not asked.is_made:
                    worker = _Worker(waiting.popleft(), threads)
                    working[worker.connection] = worker
                for connection in wait(list(working), _LOOK):
                    worker = working[connection]  # type: ignore[index]
                    for event in worker.events(is_stopping=asked.is_made):
                        yield worker.run, event
                    if worker.is_done:
                        del working[worker.connection]
                for worker in working.values() if asked.is_made else ():
                    worker.stop()
        finally:
            for worker in working.values():
                worker.stop()
            for worker in working.values():
                worker.process.join()


@final
class _Worker:
    """A process that does one run, and what it says."""

    def __init__(self, run: AblationRun, threads: int) -> None:
        context = multiprocessing.get_context("spawn")  # fork would copy locks that native libraries hold
        self.run = run
        self.connection, theirs = context.Pipe(duplex=False)
        arguments = (run, threads, theirs, started_by_main_thread())
        self.process: BaseProcess = context.Process(target=_work, args=arguments, daemon=True)
        self.is_done = self._is_stopped = self._has_ended = False
        with interrupts_later():
            self.process.start()
        theirs.close()

    def events(self, is_stopping: bool) -> Iterator[RunEvent]:
        """Yields what was said since; of a process that died untimely, that."""
        try:
            event = self.connection.recv()
        except EOFError:
            self.process.join()
            self.is_done = True
            if not self._has_ended and not is_stopping:
                yield RunEvent(failure="its process died (out of memory, or a crash in a native library)")
            return
        self._has_ended = event.is_last
        yield event

    def stop(self) -> None:
        """Asks the process to end after its step, once."""
        if not self._is_stopped:
            self.process.terminate()
        self._is_stopped = True


def _work(run: AblationRun, threads: int, connection: Connection, started_by_main_thread: bool) -> None:
    end_with_parent(started_by_main_thread)
    use_threads(threads)
    try:
        for event in do_run(run):
            connection.send(event)
    except BrokenPipeError:  # the parent is gone; what was saved last stands
        return
    finally:
        connection.close()
