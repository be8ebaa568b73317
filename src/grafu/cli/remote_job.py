"""One model of a run on several machines, or at a URL: fetched, made by the job of the local run, its results written.

It runs in a process with limits, on whichever machine, prints nothing, and may be run again: the results are the same.
"""

from dataclasses import replace
from pathlib import Path
from typing import final

from grafu.asset.regular_files import MARKER
from grafu.cli.job import Failed, Job, JobOptions, JobResult, Succeeded, run_job
from grafu.cli.outcome import Ended, ended_of
from grafu.cli.verb import one_line
from grafu.cluster.result_upload import Upload, fetch_result, upload_at, upload_result
from grafu.cluster.storage import fetch
from grafu.cluster.urls import Place, Url
from grafu.dataclass import dataclass
from grafu.errors import ExportError, FunctionalizationError
from grafu.processes.lifetime import scratch_folder


@final
@dataclass(frozen=True)
class RemoteJob:
    """A model at a path or a URL, the name of its results and the folder that they go to.

    `present` states that something was at their place when the run began; `again` that an earlier try, which did not
    end, may have left something there.
    """

    source: Place
    name: str
    out: Place
    options: JobOptions
    present: bool = False
    again: bool = False

    @property
    def place(self) -> Place:
        """Where the results go."""
        return self.out / self.name

    def tried_again(self) -> "RemoteJob":
        """Returns the job for another try."""
        return replace(self, again=True)


def failed_job(job: RemoteJob, why: str, users_fault: bool) -> Ended:
    """Returns what is stated of a job that failed."""
    local = Job(Path(job.name), job.name, job.options)
    return ended_of(Failed(local, one_line(why), users_fault), str(job.source), str(job.place))


def run_remote_job(job: RemoteJob) -> Ended:
    """Returns what is stated of a job as it ends; a failure is a value, except for an interruption."""
    with scratch_folder() as scratch:
        folder = Path(scratch)
        try:
            return _run(job, folder)
        except FunctionalizationError as error:
            return failed_job(job, str(error), users_fault=True)


def _run(job: RemoteJob, folder: Path) -> Ended:
    state = _state(job)
    source = job.source if isinstance(job.source, Path) else fetch(job.source, _made(folder / "in"))
    out = job.out if isinstance(job.out, Path) else _made(folder / "out")
    if state is Upload.COMPLETE and isinstance(job.place, Url) and job.options.resume:
        fetch_result(job.place, _made(out / job.name))
    local = Job(source, job.name, _options(job, out, state), stated="" if source == job.source else str(job.source))
    result = _as_given(run_job(local), job)
    if isinstance(result, Succeeded) and not result.earlier and isinstance(job.place, Url):
        upload_result(out / job.name, job.place)
    return ended_of(result, str(job.source), str(job.place))


def _state(job: RemoteJob) -> Upload:
    """Returns what is at the place of the results.

    Raises:
        ExportError: if it is not grafu's, or may not be replaced.
    """
    if isinstance(job.place, Path) or not (job.present or job.again):
        return Upload.FREE  # of a path the job finds out itself
    state = upload_at(job.place)
    if state is Upload.FOREIGN:
        raise ExportError(
            f"`{job.place}` holds files and no `{MARKER}`, by which grafu knows what it wrote, so it is kept: choose "
            "another --out, or move it away"
        )
    if state is Upload.COMPLETE and not (job.options.overwrite or job.options.resume or job.again):
        raise ExportError(
            f"the output `{job.place}` exists already: choose another --out, or give --overwrite or --resume"
        )
    return state


def _options(job: RemoteJob, out: Path, state: Upload) -> JobOptions:
    """Returns the options of the local job: what an earlier try of this run wrote is replaced."""
    overwrite = job.options.overwrite or (job.again and not job.present)
    resume = job.options.resume and (isinstance(job.out, Path) or state is Upload.COMPLETE)
    return replace(job.options, out=out, overwrite=overwrite and not resume, resume=resume)


def _as_given(result: JobResult, job: RemoteJob) -> JobResult:
    """Returns the result with the places that the user gave in what it states of a failure."""
    if not isinstance(result, Failed):
        return result
    why = result.why
    for local, given in ((result.job.input, job.source), (result.job.folder, job.place)):
        why = why.replace(str(local), str(given))
    return replace(result, why=why)


def _made(folder: Path) -> Path:
    folder.mkdir(parents=True)
    return folder
