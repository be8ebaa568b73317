"""A table as a value: columns with a kind, rows of cells. Its four forms are in `table_forms`."""

from dataclasses import dataclass
from typing import Literal, final

from grafu.evaluation.bootstrap import Figure

Kind = Literal["text", "count", "share", "number"]
Cell = str | int | float | bool | Figure | None


@final
@dataclass(frozen=True, slots=True)
class Column:
    """A column: its name in CSV and JSON, its heading, and how its cells are shown (`share`: in per cent).

    `better` says which way is better, for the arrow in its heading.
    """

    name: str
    title: str
    kind: Kind = "text"
    better: Literal["", "more", "less"] = ""


@final
@dataclass(frozen=True)
class Table:
    """A named table; `notes` say what its figures mean.

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
