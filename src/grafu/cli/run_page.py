"""The page over a folder of results: index.html, with a row for each finished model in it, of whatever run."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from grafu.cli.job import MODEL_PAGE, JobResult, Succeeded, small_picture_in
from grafu.visible import writable

if TYPE_CHECKING:
    from grafu.viewer.run_table import RunEntry

RUN_PAGE = "index.html"


def write_index(results: Sequence[JobResult], out: Path) -> Path | None:
    """Writes the page over all finished models of a folder of results, and the inputs that failed; returns its path.

    It is written for several inputs, and for one where there is such a page; models of earlier runs stay on it. Where
    nothing succeeded, or a file of that name is none of ours, nothing is written: None.

    Raises:
        ExportError: if it cannot be written.
    """
    path = out / RUN_PAGE
    is_due = path.exists() or len(results) > 1
    if not is_due or not any(isinstance(result, Succeeded) for result in results) or not is_free_for_page(path):
        return None
    write_index_of(out, results)
    return path


def write_index_of(out: Path, results: Sequence[JobResult] = ()) -> None:
    """Writes the page over these results and all finished models of a folder of results, whatever is there.

    Raises:
        ExportError: if it cannot be written.
    """
    from grafu.export.whole_file import write_whole
    from grafu.viewer.run_page import run_page
    from grafu.viewer.run_table import functionalized_run

    run = functionalized_run(out.resolve().name or "Run", _entries(results, out))
    write_whole(writable(run_page(run)), out / RUN_PAGE)


def is_free_for_page(path: Path) -> bool:
    """Whether a page may be written there: nothing is there, or a page of ours."""
    from grafu.asset.regular_files import read_head
    from grafu.viewer.shell import HEAD_BYTES, is_page_of_ours

    if not os.path.lexists(path):
        return True
    try:
        return not path.is_symlink() and is_page_of_ours(read_head(path, HEAD_BYTES))
    except OSError:
        return False


def _entries(results: Sequence[JobResult], out: Path) -> "list[RunEntry]":
    from grafu.cli.earlier import finished_in
    from grafu.viewer.run_table import RunEntry

    done = {result.job.name for result in results if isinstance(result, Succeeded)}
    entries = [_entry(result) for result in results]
    for name, report in finished_in(out, but=done):
        seconds, folder = sum(report.timings.values()), out / name
        link = f"{name}/{MODEL_PAGE}" if (folder / MODEL_PAGE).is_file() else ""
        entries.append(RunEntry(name, report, "", link, small_picture_in(folder), seconds))
    return entries


def _entry(result: JobResult) -> "RunEntry":
    from grafu.viewer.run_table import RunEntry

    job = result.job
    if isinstance(result, Succeeded):
        link = f"{job.name}/{MODEL_PAGE}"
        return RunEntry(job.name, result.report, "", link, result.picture, result.seconds)
    return RunEntry(job.name, None, result.why)
