"""Several jobs at once, each in a process with limits of its own: one that crashes or takes too much takes no other."""

from collections.abc import Callable, Generator, Sequence
from contextlib import closing
from importlib import import_module
from typing import TypeVar

from grafu.cli.job import Failed, Job, JobResult, run_job
from grafu.cli.limit_options import why_stopped
from grafu.cli.verb import prepare_verb
from grafu.processes.limits import Ending, Limits
from grafu.processes.worker import run_each

Item = TypeVar("Item")
Result = TypeVar("Result")
Run = Callable[[Job], JobResult]


def run_jobs(jobs: list[Job], workers: int, run: Run = run_job) -> Generator[JobResult, None, None]:
    """Yields each job's result as it ends, `workers` at a time; `run` must be a function of a module."""

    def failed(job: Job, ending: Ending) -> JobResult:
        return Failed(job, why_stopped(ending, job.options.limits), users_fault=ending is not Ending.DIED)

    return run_all(jobs, workers, run, failed, jobs[0].options.limits)


def run_all(
    items: Sequence[Item],
    workers: int,
    run: Callable[[Item], Result],
    failed: Callable[[Item, Ending], Result],
    limits: Limits = Limits(),
) -> Generator[Result, None, None]:
    """Yields the result of each item as it ends, `workers` at a time; `run` must be a function of a module.

    An item whose process was stopped or died gets the result that `failed` gives it; the others go on.
    """
    with closing(run_each(items, workers, run, limits, _prepare)) as ended:
        for item, outcome in ended:
            yield outcome.results[0] if outcome.ending is Ending.DONE else failed(item, outcome.ending)


def _prepare() -> None:
    """Imports what takes long: no model pays for it with its own time."""
    prepare_verb()
    import_module("grafu.pipeline.functionalize")
