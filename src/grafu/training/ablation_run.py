"""Runs of an ablation, each trained until its end in a folder of its own, never twice, and its figures kept there.

OUT/<experiment>/seed_<S>/               the files of the run, see `grafu.training.loop`
OUT/<experiment>/seed_<S>/figures.json   what its best weights reach in validation; there once it is finished

Several at once, each in a process of its own, are faster than one after another. A process that dies takes no other
with it. Being asked to stop ends all after the current step, with everything saved.
"""

import json
import math
import multiprocessing
from collections import deque
from collections.abc import Generator, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import final

from grafu.asset.json_files import finite, read_own_json
from grafu.dataclass import dataclass
from grafu.errors import AssetError, ExportError, FunctionalizationError, UnreadableAsset
from grafu.export.whole_file import write_whole
from grafu.processes.allocator import keep_freed_memory
from grafu.processes.lifetime import end_with_parent, interrupts_later, started_by_main_thread
from grafu.training.ablation import Experiment
from grafu.training.checkpoint import has_progress, load_best, read_config
from grafu.training.config import TrainingConfig
from grafu.training.loop import RunOptions, train
from grafu.training.source import Source
from grafu.training.workers import joined_workers, stop_requests, use_threads

SCHEMA = "grafu.ablation/1"
FIGURES = "figures.json"


@final
@dataclass(frozen=True)
class AblationRun:
    """One experiment with one seed, on one source, in one folder; `device` as `joined_workers` takes it."""

    experiment: Experiment
    seed: int
    source: Source
    folder: Path
    device: str = "auto"

    @property
    def config(self) -> TrainingConfig:
        """The experiment's config with this seed."""
        return replace(self.experiment.config, seed=self.seed)


@final
@dataclass(frozen=True)
class RunEvent:
    """What happened to a run: it did `steps` steps more, or ended with figures, or cannot go on."""

    steps: int = 0
    figures: Mapping[str, float] | None = None
    failure: str = ""

    @property
    def is_last(self) -> bool:
        """Whether nothing more happens to the run."""
        return self.figures is not None or bool(self.failure)


def known_figures(run: AblationRun) -> dict[str, float] | None:
    """Returns the figures of a finished run, None where it is to be begun or gone on with.

    Raises:
        UnreadableAsset: if its folder holds a run that was asked to do otherwise, or a damaged file.
    """
    path, config = run.folder / FIGURES, run.folder / "config.json"
    if not path.is_file() and not has_progress(run.folder):
        return None
    if read_config(_read(config), config) != run.config:
        raise UnreadableAsset(f"`{run.folder}` holds a run of other steps or another config: choose another --out")
    if not path.is_file():
        return None
    stated = _read(path)
    figures = stated.get("figures") if isinstance(stated, dict) and stated.get("schema") == SCHEMA else None
    if not isinstance(figures, dict) or not all(
        value is None or finite(value) is not None for value in figures.values()
    ):
        raise UnreadableAsset(f"`{path}` must be of the form `{SCHEMA}`: remove it")
    return {name: math.nan if value is None else float(value) for name, value in figures.items()}


def do_run(run: AblationRun) -> Generator[RunEvent, None, None]:
    """Trains until the end, from where it was cut if it was; what goes wrong is the last event, and is not raised.

    When a signal asks it to stop there is no last event, and the same call goes on later.
    """
    try:
        yield from _train(run)
    except (FunctionalizationError, ArithmeticError) as error:
        yield RunEvent(failure=str(error))


def _train(run: AblationRun) -> Generator[RunEvent, None, None]:
    done = 0
    with (
        joined_workers(run.device) as workers,
        closing(train(run.config, run.source, run.folder, workers, RunOptions(resume=True))) as reports,
    ):
        for report in reports:
            yield RunEvent(steps=report.step - done)
            done = report.step
    if done < run.config.steps:
        return
    best = load_best(run.folder)
    named = {name: None if math.isnan(value) else value for name, value in best.figures.items()}
    stated = {"schema": SCHEMA, "step": best.step, "figures": named}
    write_whole(json.dumps(stated, indent=1) + "\n", run.folder / FIGURES)
    yield RunEvent(figures=best.figures)


def _read(path: Path) -> object:
    try:
        return read_own_json(path, "a file of an ablation")
    except AssetError as error:
        raise UnreadableAsset(f"{error}: remove its folder, or choose another --out") from None


def begin_ablation(folder: Path, asked: Mapping[str, str]) -> None:
    """Notes in OUT/ablation.json what is asked for, so that no folder gets the tables of two ablations.

    Raises:
        ExportError: if the folder holds another ablation, or cannot be written.
    """
    path = folder / "ablation.json"
    wanted = {"schema": SCHEMA} | dict(asked)
    if not path.is_file():
        if others := [name for name in ("table.md", "table.csv") if (folder / name).exists()]:
            raise ExportError(f"`{folder}` holds `{others[0]}` and no ablation: choose another --out")
        write_whole(json.dumps(wanted, indent=1) + "\n", path)
    elif _read(path) != wanted:
        raise ExportError(f"`{folder}` holds another ablation ({path.name} states which): choose another --out")


_LOOK = 0.5  # seconds between two checks whether a stop was requested


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
    """A process that does one run, and what it states."""

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
    keep_freed_memory()
    use_threads(threads)
    try:
        for event in do_run(run):
            connection.send(event)
    except BrokenPipeError:  # the parent is gone; what was saved last stands
        return
    finally:
        connection.close()
