"""From the inputs of one call to its jobs: names, and places that are apart. It reads no input."""

from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path

from grafu.cli.job import Failed, Job, JobOptions
from grafu.cli.messages import one_line
from grafu.errors import AssetError
from grafu.export.output_names import output_name, same_place, why_not_apart


def jobs_of(inputs: Sequence[Path], shared: JobOptions) -> tuple[list[Job], list[Failed]]:
    """Returns the jobs, and those inputs that are refused for the name or the place of their results.

    Raises:
        AssetError: if the results of two inputs would go to one place.
    """
    refused: list[Failed] = []
    named: dict[str, list[Job]] = defaultdict(list)
    for path in inputs:
        try:
            job = Job(path, output_name(path), shared)
        except AssetError as error:
            refused.append(Failed(Job(path, path.name, shared), one_line(str(error)), users_fault=True))
        else:
            named[same_place(job.name)].append(job)
    for jobs in named.values():
        if len(jobs) > 1:
            raise AssetError(
                f"inputs must have different names, for results go to DIR/<name>: got {jobs[0].input} and "
                f"{jobs[1].input}; give their folders where these differ, or run them into different --out"
            )
    judged = [(jobs[0], why_not_apart(jobs[0].folder, inputs)) for jobs in named.values()]
    refused += [Failed(job, why, users_fault=True) for job, why in judged if why]
    return [job for job, why in judged if not why], refused
