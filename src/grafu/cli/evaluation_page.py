"""The page of an evaluation: its tables to sort, over the figures that count. It writes no files."""

from collections.abc import Sequence

from grafu.evaluation.bootstrap import Figure
from grafu.evaluation.table import Cell, Column, Kind, ResultTable
from grafu.viewer import run_table
from grafu.viewer.run_page import run_page

_KINDS: dict[Kind, run_table.ColumnKind] = {
    "text": "text",
    "count": "number",
    "ratio": "percent",
    "number": "number",
}
_HEADLINES = {"aligned": "aligned with the annotation", "works_fixed": "work as built"}


def evaluation_page(title: str, tables: Sequence[ResultTable]) -> str:
    """Returns the page of a run: a table for each, models worst first, intervals beside the figures."""
    motion = next((table for table in tables if table.name == "motion"), None)
    figures = _headlines(motion) if motion is not None else []
    return run_page(run_table.Run(title, figures, [_page_table(table) for table in tables]))


def _page_table(table: ResultTable) -> run_table.RunTable:
    columns: list[run_table.RunColumn] = []
    for k, column in enumerate(table.columns):
        columns.append(_page_column(column, histogram=table.name in ("models", "ood") and column.kind != "text"))
        if _has_interval(table, k):
            columns.append(run_table.RunColumn(f"{column.title}, 95 %", about="the interval of the figure beside it"))
    rows = tuple(_page_row(table, row, len(table.rows) - k) for k, row in enumerate(table.rows))
    return run_table.RunTable(table.title, tuple(columns), rows, " ".join(table.notes))


def _page_column(column: Column, *, histogram: bool) -> run_table.RunColumn:
    better = {"more": "more is better", "less": "less is better", "": ""}[column.better]
    return run_table.RunColumn(column.title, _KINDS[column.kind], histogram, better)


def _page_row(table: ResultTable, row: Sequence[Cell], rank: int) -> run_table.RunRow:
    cells: list[run_table.Cell] = []
    for k, (cell, column) in enumerate(zip(row, table.columns, strict=True)):
        cells.append(_page_cell(cell, column))
        if _has_interval(table, k):
            cells.append(_interval(cell, column))
    return run_table.RunRow(tuple(cells), badness=float(rank), flagged=_calls_for_a_look(table, row))


def _has_interval(table: ResultTable, k: int) -> bool:
    return any(isinstance(row[k], Figure) for row in table.rows)


def _page_cell(cell: Cell, column: Column) -> run_table.Cell:
    if isinstance(cell, Figure):
        return cell.value
    if isinstance(cell, str) and column.kind != "text":
        return None  # a word in place of a number that is not known
    if isinstance(cell, bool):
        return ("yes" if cell else "no") if column.kind == "text" else int(cell)
    return cell


def _interval(cell: Cell, column: Column) -> str | None:
    if not isinstance(cell, Figure):
        return None
    ends = run_table.RunColumn(column.title, _KINDS[column.kind])
    return f"{ends.words(cell.low)} to {ends.words(cell.high)}"


def _calls_for_a_look(table: ResultTable, row: Sequence[Cell]) -> bool:
    """Whether a model has a part that is wrong, or that does not work as built."""
    found = dict(zip((column.name for column in table.columns), row, strict=True))
    return table.name == "models" and (found["wrong"] != 0 or found["works"] != found["parts"])


def _headlines(motion: ResultTable) -> list[run_table.RunFigure]:
    """Returns of each method the figures that count, over all objects."""
    names = [column.name for column in motion.columns]
    said = []
    for row in motion.rows:
        found = dict(zip(names, row, strict=True))
        if found["over"] == "objects" and found["data"] == "all":
            for name, words in _HEADLINES.items():
                cell = found[name]
                if isinstance(cell, Figure):
                    said.append(run_table.RunFigure(f"{100 * cell.value:.1f} %", f"{found['method']}: {words}"))
    return said
