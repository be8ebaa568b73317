"""A table as a value: columns with a kind, rows of cells; in four forms that all say the same.

Markdown to read, CSV and JSON to reckon with, LaTeX to print.
"""

import csv
import io
import json
from collections.abc import Callable
from typing import Final, Literal, final

from grafu.dataclass import dataclass
from grafu.evaluation.bootstrap import Figure

Kind = Literal["text", "count", "ratio", "number"]
Cell = str | int | float | bool | Figure | None


@final
@dataclass(frozen=True, slots=True)
class Column:
    """A column: its name in CSV and JSON, its heading, and how its cells are shown (`ratio`: in per cent).

    `better` states which way is better, for the arrow in its heading.
    """

    name: str
    title: str
    kind: Kind = "text"
    better: Literal["", "more", "less"] = ""


@final
@dataclass(frozen=True)
class ResultTable:
    """A named table; `notes` state what its figures mean.

    Raises:
        ValueError: if a row is not as long as the columns are many, or two columns have one name.
    """

    name: str
    title: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[Cell, ...], ...]
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if len({column.name for column in self.columns}) < len(self.columns):
            raise ValueError(f"columns of `{self.name}` must have different names: got {self.columns}")
        wrong = [row for row in self.rows if len(row) != len(self.columns)]
        if wrong:
            raise ValueError(f"a row of `{self.name}` must have {len(self.columns)} cells: got {wrong[0]}")


_ARROWS = {"": "", "more": " ↑", "less": " ↓"}
_TEX_ARROWS = {"": "", "more": r" $\uparrow$", "less": r" $\downarrow$"}
_TEX_SPECIAL = {
    "\\": r"\textbackslash{}", "&": r"\&", "%": r"\%", "$": r"\$", "#": r"\#", "_": r"\_", "{": r"\{", "}": r"\}",
    "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "<": r"\textless{}", ">": r"\textgreater{}",
}  # fmt: skip


def shown(cell: Cell, column: Column) -> str:
    """Returns a cell as people read it: fractions in per cent, intervals in brackets, nothing for what is not known."""
    match cell:
        case None:
            return "–"
        case bool():
            return "yes" if cell else "no"
        case Figure(value, low, high):
            return f"{_number(value, column)} [{_number(low, column)}, {_number(high, column)}]"
        case str():
            return cell
        case _:
            return _number(cell, column)


def markdown(table: ResultTable) -> str:
    """Returns the table in Markdown, its title above and its notes below."""
    heads = [column.title + _ARROWS[column.better] for column in table.columns]
    marks = ["---" if column.kind == "text" else "---:" for column in table.columns]
    lines = [_line(heads), _line(marks)]
    lines += [_line([shown(cell, c).replace("|", "\\|") for cell, c in _cells(table, row)]) for row in table.rows]
    notes = [f"- {note}" for note in table.notes]
    return "\n".join([f"# {table.title}", "", *lines, *(["", *notes] if notes else [])]) + "\n"


def csv_text(table: ResultTable) -> str:
    """Returns the table with a header, numbers in full; of a figure its value, low and high end, in three columns."""
    spread = {c.name: any(isinstance(row[k], Figure) for row in table.rows) for k, c in enumerate(table.columns)}
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([name for c in table.columns for name in _names(c, spread[c.name])])
    for row in table.rows:
        writer.writerow([value for cell, c in _cells(table, row) for value in _values(cell, spread[c.name])])
    return text.getvalue()


def json_text(table: ResultTable) -> str:
    """Returns the table as records, numbers in full; of a figure its value, ends and count."""
    rows = [{c.name: _plain(cell) for cell, c in _cells(table, row)} for row in table.rows]
    record = {
        "schema": "grafu.table/1",
        "name": table.name,
        "title": table.title,
        "columns": [{"name": c.name, "title": c.title, "kind": c.kind, "better": c.better} for c in table.columns],
        "rows": rows,
        "notes": list(table.notes),
    }
    return json.dumps(record, indent=1, ensure_ascii=False) + "\n"


def latex(table: ResultTable) -> str:
    """Returns a `booktabs` tabular with caption and label; intervals stand small behind their figures."""
    align = "".join("l" if column.kind == "text" else "r" for column in table.columns)
    heads = [_tex(column.title) + _TEX_ARROWS[column.better] for column in table.columns]
    body = [" & ".join(_tex_cell(cell, c) for cell, c in _cells(table, row)) + r" \\" for row in table.rows]
    notes = [f"% {note}" for note in table.notes]
    return "\n".join(
        [
            *notes,
            r"\begin{table}[t]",
            r"\centering",
            rf"\caption{{{_tex(table.title)}}}",
            rf"\label{{tab:{table.name}}}",
            rf"\begin{{tabular}}{{{align}}}",
            r"\toprule",
            " & ".join(heads) + r" \\",
            r"\midrule",
            *body,
            r"\bottomrule",
            r"\end{tabular}",
            r"\end{table}",
            "",
        ]
    )


FORMS: Final[dict[str, Callable[[ResultTable], str]]] = {
    "md": markdown,
    "csv": csv_text,
    "json": json_text,
    "tex": latex,
}


def _cells(table: ResultTable, row: tuple[Cell, ...]) -> list[tuple[Cell, Column]]:
    return list(zip(row, table.columns, strict=True))


def _number(value: int | float, column: Column) -> str:
    if column.kind == "ratio":
        return f"{100 * value:.1f} %"
    if isinstance(value, int) or column.kind == "count":
        return f"{value:.0f}"
    return f"{value:.3g}"


def _names(column: Column, is_spread: bool) -> list[str]:
    return [column.name, f"{column.name}_low", f"{column.name}_high"] if is_spread else [column.name]


def _values(cell: Cell, is_spread: bool) -> list[str]:
    if isinstance(cell, Figure):
        return [_full(cell.value), _full(cell.low), _full(cell.high)]
    return [_full(cell), "", ""] if is_spread else [_full(cell)]


def _full(cell: Cell) -> str:
    match cell:
        case None:
            return ""
        case bool():
            return str(cell).lower()
        case float():
            return f"{cell:.6g}"
        case _:
            return str(cell)


def _plain(cell: Cell) -> object:
    if isinstance(cell, Figure):
        ends = {"value": cell.value, "low": cell.low, "high": cell.high}
        return {**{name: float(f"{value:.6g}") for name, value in ends.items()}, "count": cell.count}
    return float(f"{cell:.6g}") if isinstance(cell, float) else cell


def _line(cells: list[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _tex(text: str) -> str:
    return "".join(_TEX_SPECIAL.get(letter, letter) for letter in text).replace("–", "--")


def _tex_cell(cell: Cell, column: Column) -> str:
    if isinstance(cell, Figure):
        ends = f"[{_number(cell.low, column)}, {_number(cell.high, column)}]"
        return f"{_tex(_number(cell.value, column))} {{\\scriptsize {_tex(ends)}}}"
    return _tex(shown(cell, column))
