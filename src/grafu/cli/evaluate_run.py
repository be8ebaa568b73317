"""Runs `evaluate`: does what is not done, counts it on a bar, keeps the rows, and writes the tables.

The page of an evaluation: its tables to sort, over the figures that count.
"""

import argparse
import os
import shlex
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

from grafu.cli.limit_options import limits_of, why_stopped
from grafu.cli.messages import complain, say
from grafu.cli.pool import run_all
from grafu.cli.progress import with_progress
from grafu.cli.run_page import RUN_PAGE, is_free_for_page
from grafu.cli.tables import plain_table, wide_console
from grafu.errors import ExportError, OptionError
from grafu.evaluation.bootstrap import Figure
from grafu.evaluation.dataset import find_models
from grafu.evaluation.methods import parse_method
from grafu.evaluation.output import build_tables, output_files
from grafu.evaluation.perform import failed, perform
from grafu.evaluation.records import NAME, Row, append_rows, begin_rows, done
from grafu.evaluation.results import Results, collect
from grafu.evaluation.table import Cell, Column, Kind, Table, shown
from grafu.evaluation.tasks import EvaluationPlan, Task, key_of
from grafu.export.files import ExportFiles, require_free, write_files
from grafu.export.whole_file import write_whole
from grafu.processes.limits import Limits
from grafu.viewer import run_table
from grafu.viewer.run_page import run_page

_KINDS: dict[Kind, run_table.ColumnKind] = {
    "text": "text",
    "count": "number",
    "share": "percent",
    "number": "number",
}
_HEADLINES = {"aligned": "aligned with the annotation", "works_fixed": "work as built"}


def evaluation_page(title: str, tables: Sequence[Table]) -> str:
    """Returns the page of a run: a table for each, models worst first, intervals beside the figures."""
    motion = next((table for table in tables if table.name == "motion"), None)
    figures = _headlines(motion) if motion is not None else []
    return run_page(run_table.Run(title, figures, [_page_table(table) for table in tables]))


def _page_table(table: Table) -> run_table.RunTable:
    columns: list[run_table.Column] = []
    for k, column in enumerate(table.columns):
        columns.append(_page_column(column, histogram=table.name in ("models", "ood") and column.kind != "text"))
        if _has_interval(table, k):
            columns.append(run_table.Column(f"{column.title}, 95 %", about="the interval of the figure beside it"))
    rows = tuple(_page_row(table, row, len(table.rows) - k) for k, row in enumerate(table.rows))
    return run_table.RunTable(table.title, tuple(columns), rows, " ".join(table.notes))


def _page_column(column: Column, *, histogram: bool) -> run_table.Column:
    better = {"more": "more is better", "less": "less is better", "": ""}[column.better]
    return run_table.Column(column.title, _KINDS[column.kind], histogram, better)


def _page_row(table: Table, row: Sequence[Cell], rank: int) -> run_table.RunRow:
    cells: list[run_table.Cell] = []
    for k, (cell, column) in enumerate(zip(row, table.columns, strict=True)):
        cells.append(_page_cell(cell, column))
        if _has_interval(table, k):
            cells.append(_interval(cell, column))
    return run_table.RunRow(tuple(cells), badness=float(rank), flagged=_calls_for_a_look(table, row))


def _has_interval(table: Table, k: int) -> bool:
    return any(isinstance(row[k], Figure) for row in table.rows)


def _page_cell(cell: Cell, column: Column) -> run_table.Cell:
    if isinstance(cell, Figure):
        return cell.value
    if isinstance(cell, bool):
        return ("yes" if cell else "no") if column.kind == "text" else int(cell)
    return cell


def _interval(cell: Cell, column: Column) -> str | None:
    if not isinstance(cell, Figure):
        return None
    ends = run_table.Column(column.title, _KINDS[column.kind])
    return f"{ends.words(cell.low)} to {ends.words(cell.high)}"


def _calls_for_a_look(table: Table, row: Sequence[Cell]) -> bool:
    """Whether a model has a part that is wrong, or that does not work as built."""
    found = dict(zip((column.name for column in table.columns), row, strict=True))
    return table.name == "models" and (found["wrong"] != 0 or found["works"] != found["parts"])


def _headlines(motion: Table) -> list[run_table.Figure]:
    """Returns of each method the figures that count, over all objects."""
    names = [column.name for column in motion.columns]
    said = []
    for row in motion.rows:
        found = dict(zip(names, row, strict=True))
        if found["over"] == "objects" and found["data"] == "all":
            for name, words in _HEADLINES.items():
                cell = found[name]
                if isinstance(cell, Figure):
                    said.append(run_table.Figure(f"{100 * cell.value:.1f} %", f"{found['method']}: {words}"))
    return said


EXIT_DONE, EXIT_FAILED, EXIT_INTERRUPTED = 0, 1, 130
_SHOWN = ("aligned", "reasonable", "collision", "collision_fixed", "connected_fixed", "works", "works_fixed")


def run_evaluation(options: argparse.Namespace) -> int:
    """Measures what is not measured yet and writes the tables; returns 1 where a task failed, 130 where it was stopped.

    Raises:
        FunctionalizationError: if the options are wrong, there is nothing to measure, or files cannot be written.
    """
    plan = _plan(options)
    file = options.out / NAME
    _require_room(options.out)
    rows = begin_rows(file, anew=options.overwrite)
    jobs = options.jobs or os.cpu_count() or 1
    try:
        first = plan.first_tasks()
        _do(first, rows, file, jobs, limits_of(options))
        pairs = plan.twin_tasks(rows)
        _do(pairs, rows, file, jobs, limits_of(options))
    except KeyboardInterrupt:
        complain(f"interrupted; {len(rows)} rows stand in {file}, and the same command goes on")
        return EXIT_INTERRUPTED
    results = collect((*first, *pairs), rows)
    tables = build_tables(plan, results)
    files = ExportFiles(output_files(plan, results, tables, _command(options)))
    write_files(files, options.out / "tables", overwrite=True)
    write_whole(evaluation_page(f"Evaluation on {plan.data}", tables), options.out / RUN_PAGE)
    _say(tables, results, options.out)
    return EXIT_FAILED if results.failures else EXIT_DONE


def _require_room(out: Path) -> None:
    """Refuses a folder in which something that is not ours stands where tables or the page go, before any work."""
    require_free(out / "tables", overwrite=True)
    if not is_free_for_page(out / RUN_PAGE):
        raise ExportError(f"`{out / RUN_PAGE}` is no page of grafu's, so it is kept: choose another --out")


def _plan(options: argparse.Namespace) -> EvaluationPlan:
    methods = tuple(parse_method(word) for word in _words(options.methods))
    absent = next((method for method in methods if method.folder is not None and not method.folder.is_dir()), None)
    if absent is not None:
        raise OptionError(f"`{absent.folder}` of the method {absent.name} must be a folder with an entry per model id")
    return EvaluationPlan(options.data, find_models(options.data), methods, _words(options.tables), options.seeds)


def _words(text: str) -> tuple[str, ...]:
    return tuple(word.strip() for word in text.split(",") if word.strip())


def _do(tasks: Sequence[Task], rows: dict[str, Row], file: Path, jobs: int, limits: Limits) -> None:
    """Does the tasks that have no row yet, and keeps each row at once."""
    left = [task for task in tasks if not done(rows, key_of(task))]
    if not left:
        return
    with closing(
        run_all(left, jobs, perform, lambda task, how: failed(task, why_stopped(how, limits)), limits)
    ) as made:
        for row in with_progress(made, len(left), "tasks"):
            append_rows(file, [row])
            rows[row.key] = row


def _command(options: argparse.Namespace) -> str:
    """Returns the command that gives these tables, whatever it was spelled like."""
    words = ["grafu", "evaluate", "--data", options.data, "--methods", options.methods, "--tables", options.tables]
    return shlex.join([*words, "--seeds", str(options.seeds), "--out", str(options.out)])


def _say(tables: Sequence[Table], results: Results, out: Path) -> None:
    motion = next((table for table in tables if table.name == "motion"), None)
    if motion is not None:
        _print_motion(motion)
    for failure in results.failures:
        complain(f"{failure.model}: {failure.what}: {failure.error}")
    say(f"written to {out / 'tables' / 'index.md'}; to look at: {out / RUN_PAGE}")


def _print_motion(table: Table) -> None:
    names = [column.name for column in table.columns]
    kept = [column for column in table.columns if column.name in ("method", "data", *_SHOWN)]
    printed = plain_table(*(column.title for column in kept))
    for row in table.rows:
        if row[names.index("over")] == "objects":
            cells = ((row[names.index(column.name)], column) for column in kept)
            printed.add_row(*(shown(c.value if isinstance(c, Figure) else c, column) for c, column in cells))
    wide_console().print(printed)
