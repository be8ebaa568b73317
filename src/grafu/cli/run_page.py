"""The page of a run of several inputs: index.html in the folder of the results, over the pages of the models."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from grafu.cli.job import MODEL_PAGE, JobResult, Succeeded

if TYPE_CHECKING:
    from grafu.viewer.run_rows import RunEntry

RUN_PAGE = "index.html"


def write_index(results: Sequence[JobResult], out: Path) -> Path | None:
    """Writes the page of a run into the folder of its results and returns its path.

    A page of an earlier run is replaced. Where nothing succeeded, or a file of that name is none of ours, nothing is
    written: None.

    Raises:
        ExportError: if it cannot be written.
    """
    from grafu.export.whole_file import write_whole
    from grafu.viewer.run_page import run_page
    from grafu.viewer.run_rows import functionalized_run

    path = out / RUN_PAGE
    if not any(isinstance(result, Succeeded) for result in results) or (path.exists() and not _is_ours(path)):
        return None
    run = functionalized_run(out.resolve().name or "Run", [_entry(result) for result in results])
    write_whole(run_page(run), path)
    return path


def _is_ours(path: Path) -> bool:
    from grafu.viewer.shell import is_page_of_ours

    return path.is_file() and is_page_of_ours(path.read_bytes())


def _entry(result: JobResult) -> "RunEntry":
    from grafu.viewer.run_rows import RunEntry

    job = result.job
    if isinstance(result, Succeeded):
        link = f"{job.name}/{MODEL_PAGE}"
        return RunEntry(job.name, result.report, "", link, result.picture, result.seconds)
    return RunEntry(job.name, None, result.why)
