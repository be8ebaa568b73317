"""Several jobs at once, each in a process with limits of its own: one that crashes or takes too much takes no other.

A command about one model in a process of its own, so that nothing that the model does to it goes without a word.

The process is there before anything heavy is imported: nothing is started twice, or imported twice.
"""

import argparse
import sys
from collections.abc import Callable, Generator, Sequence
from contextlib import closing
from importlib import import_module
from pathlib import Path
from typing import TypeVar

from grafu.cli.job import Failed, Job, JobResult, run_job
from grafu.cli.limit_options import limits_of, why_stopped
from grafu.cli.telling import beneath
from grafu.cli.verb import EXIT_BAD_INPUT, EXIT_FAILED, complain, prepare_verb, run_verb
from grafu.collecting import collect_seldom
from grafu.processes.limits import Ending, ProcessLimits
from grafu.processes.worker import ignore, quick_start, run_each

_CLEAR_LINE = "\r\x1b[2K\x1b[?25h"  # the line of a progress bar that was not closed, and the cursor that it hid


def run_supervised(options: argparse.Namespace) -> int:
    """Runs the verb within the limits that the options state; returns its exit code, or states why it was stopped."""
    limits = limits_of(options)
    try:
        with closing(run_each([options], 1, run_verb, limits, _begin, quick_start())) as ended:
            [(_, outcome)] = ended
    except BaseException:
        _tidy(options)
        raise
    if outcome.ending is Ending.DONE:
        return outcome.results[0]
    _tidy(options)
    why = why_stopped(outcome.ending, limits)
    complain(why)
    if stopped := getattr(options, "on_stopped", None):
        stopped(options, why)
    return EXIT_FAILED if outcome.ending is Ending.DIED else EXIT_BAD_INPUT


def _tidy(options: argparse.Namespace) -> None:
    """Takes away what a process that was killed left: hidden files, and a line on the terminal."""
    if sys.stderr.isatty():
        beneath(sys.stderr).write(_CLEAR_LINE)
    out: Path | None = getattr(options, "out", None)
    if out is not None:
        from grafu.export.whole_file import clear_remains

        clear_remains(out)


Item = TypeVar("Item")
Result = TypeVar("Result")
Run = Callable[[Job], JobResult]


def run_jobs(
    jobs: list[Job], workers: int, run: Run = run_job, on_begin: Callable[[Job], None] = ignore
) -> Generator[JobResult, None, None]:
    """Yields each job's result as it ends, `workers` at a time; `run` must be a function of a module.

    `on_begin` is called here with each job as it begins.
    """
    return run_all(jobs, workers, run, stopped, jobs[0].options.limits, on_begin)


def stopped(job: Job, ending: Ending) -> Failed:
    """Returns the failure of a job whose process was stopped or died."""
    return Failed(job, why_stopped(ending, job.options.limits), users_fault=ending is not Ending.DIED)


def run_all(
    items: Sequence[Item],
    workers: int,
    run: Callable[[Item], Result],
    failed: Callable[[Item, Ending], Result],
    limits: ProcessLimits = ProcessLimits(),
    on_begin: Callable[[Item], None] = ignore,
) -> Generator[Result, None, None]:
    """Yields the result of each item as it ends, `workers` at a time; `run` must be a function of a module.

    `on_begin` is called here with each item as it begins. An item whose process was stopped or died gets the result
    that `failed` gives it; the others go on.
    """
    with closing(run_each(items, workers, run, limits, prepare_for_models, on_begin=on_begin)) as ended:
        for item, outcome in ended:
            yield outcome.results[0] if outcome.ending is Ending.DONE else failed(item, outcome.ending)


def _begin() -> None:
    """Prepares a process of our own for a verb."""
    collect_seldom()
    prepare_verb()


def prepare_for_models() -> None:
    """Imports what takes long: no model pays for it with its own time."""
    _begin()
    import_module("grafu.pipeline.functionalize")
