"""What a page of many models is made from: plain tables with kinds of columns. It knows neither reports nor markup."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, final

Cell = str | int | float | None
ColumnKind = Literal["text", "light", "number", "percent", "seconds"]
WORDS: tuple[ColumnKind, ...] = ("text", "light")
LIGHTS = ("failed", "red", "yellow", "green")


@final
@dataclass(frozen=True, slots=True)
class Column:
    """A column: its heading, how its values are written, whether their spread is drawn, and what it means in words.

    A share (0..1) in a column of percents is written as a percentage; a column of lights holds one of `LIGHTS`.
    """

    name: str
    kind: ColumnKind = "text"
    histogram: bool = False
    about: str = ""

    def __post_init__(self) -> None:
        if self.histogram and self.kind in WORDS:
            raise ValueError(f"`Column.histogram` is for numbers: `{self.name}` is a column of text")

    def words(self, value: Cell) -> str:
        """Returns a value as it is written; None is a dash."""
        if value is None:
            return "–"
        if isinstance(value, str):
            return value
        if self.kind == "percent":
            return f"{100 * value:.1f} %"
        if self.kind == "seconds":
            return f"{value:.1f}"
        return str(value) if isinstance(value, int) else f"{value:.3g}"


@final
@dataclass(frozen=True, slots=True)
class RunRow:
    """One row: a cell per column, the first of which is its name.

    `badness` orders the rows, the largest first. `link` is a relative address, `picture` a small WebP file; `flagged`
    calls for a look.
    """

    cells: tuple[Cell, ...]
    badness: float = 0.0
    link: str = ""
    picture: bytes = b""
    flagged: bool = False


@final
@dataclass(frozen=True)
class RunTable:
    """A table of a run, worst first.

    Raises:
        ValueError: if a row has not one cell per column, or a number stands in no number's column.
    """

    title: str
    columns: tuple[Column, ...]
    rows: tuple[RunRow, ...]
    lead: str = ""

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row.cells) != len(self.columns):
                raise ValueError(f"`{self.title}` has {len(self.columns)} columns: a row has {len(row.cells)} cells")
            for column, cell in zip(self.columns, row.cells, strict=True):
                if column.kind not in WORDS and isinstance(cell, str):
                    raise ValueError(f"`{column.name}` is a column of numbers: got `{cell}`")
                if column.kind == "light" and cell not in LIGHTS:
                    raise ValueError(f"`{column.name}` is a column of {', '.join(LIGHTS)}: got `{cell}`")

    @property
    def worst_first(self) -> tuple[RunRow, ...]:
        """The rows by falling badness; equals stay in order."""
        return tuple(sorted(self.rows, key=lambda row: -row.badness))

    def numbers(self, index: int) -> list[float]:
        """Returns the numbers of a column, without what is missing."""
        cells = [row.cells[index] for row in self.rows]
        return [float(cell) for cell in cells if isinstance(cell, int | float)]


@final
@dataclass(frozen=True, slots=True)
class Figure:
    """One number of the whole run, and what it counts; `flagged` calls for a look."""

    value: str
    what: str
    flagged: bool = False


@final
@dataclass(frozen=True)
class Run:
    """A whole run: its name, its figures and its tables."""

    title: str
    figures: Sequence[Figure]
    tables: Sequence[RunTable]
    lead: str = ""
