"""Jobs in processes: a result each, and a crash that takes no other job with it."""

import os
from pathlib import Path

from grafu.cli.job import Failed, Job, JobOptions
from grafu.cli.limit_options import why_stopped
from grafu.cli.pool import run_jobs
from grafu.processes.limits import Ending, Limits


def fake_run(job: Job) -> Failed:
    """Stands in for `run_job`; in a worker of its own it dies at the input called `crash`."""
    if job.name == "crash":
        os._exit(11)
    return Failed(job, f"ran {job.name}", users_fault=True)


def jobs(*names: str) -> list[Job]:
    return [Job(Path(name), name, JobOptions(Path("out"))) for name in names]


def test_every_job_comes_back() -> None:
    found = {result.job.name: result.why for result in run_jobs(jobs("a", "b", "c"), 2, fake_run)}

    assert found == {"a": "ran a", "b": "ran b", "c": "ran c"}


def test_a_crash_fails_one_job_alone() -> None:
    found = {result.job.name: result for result in run_jobs(jobs("a", "crash", "b"), 1, fake_run)}

    assert (found["a"].why, found["b"].why) == ("ran a", "ran b")
    assert found["crash"].why == why_stopped(Ending.DIED, Limits())
    assert not found["crash"].users_fault
