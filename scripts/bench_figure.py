"""One measured figure with its spread, its bar and its ratio to the page's, and the table of all."""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median
from typing import Final

from stated.store import Stored

WORK: Final = "a fixed piece of work"
"""The figure by which seconds of two machines, or of two hours of one, are compared."""
HEAD: Final = ("figure", "measured", "least", "most", "unit", "bar", "met", "over the page's")
PRINTED: Final = 7  # columns that the page shows: all but the ratio
_RATE, _SECONDS = "a second", "s"


@dataclass(frozen=True)
class Figure:
    """A figure: the values of its runs, at least one; the bar that the median is held against, if it has one.

    `at_least` states that more is better. Units are `s` (seconds), `a second` (a rate), `MB`, `degrees`, `mm` or none.

    Raises:
        ValueError: if there is no value.
    """

    name: str
    values: tuple[float, ...]
    unit: str = ""
    bar: float | None = None
    at_least: bool = False

    def __post_init__(self) -> None:
        if not self.values:
            raise ValueError(f"a figure has at least one value: `{self.name}` has none")

    @property
    def value(self) -> float:
        """The median of the runs."""
        return median(self.values)

    @property
    def met(self) -> str:
        """`yes` or `NO`; empty without a bar."""
        if self.bar is None:
            return ""
        return "yes" if (self.value >= self.bar if self.at_least else self.value <= self.bar) else "NO"


@dataclass(frozen=True)
class Section:
    """What one part of the bench measured: figures, and tables in Markdown that stand below them."""

    figures: tuple[Figure, ...]
    text: str = ""


def figure_table(figures: Sequence[Figure], page: Stored | None) -> str:
    """Returns the table of all figures. `page` holds those that were printed last; None: there is no ratio."""
    work = next((figure.value for figure in figures if figure.name == WORK), None)
    rows = [[*_cells(figure), _ratio(figure, work, page)] for figure in figures]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in (HEAD, ["---"] * len(HEAD), *rows)) + "\n"


def _cells(figure: Figure) -> list[str]:
    bar = "" if figure.bar is None else f"{'>=' if figure.at_least else '<='} {figure.bar:g}"
    spread = [_number(value) for value in (figure.value, min(figure.values), max(figure.values))]
    return [figure.name, *spread, figure.unit, bar, figure.met]


def _number(value: float) -> str:
    """Returns a number with three digits that matter."""
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.3g}"


def _ratio(figure: Figure, work: float | None, page: Stored | None) -> str:
    """Returns the figure over the page's; of times and rates, both in units of the fixed piece of work."""
    try:
        if page is None:
            return ""
        then = float(page.cell(figure.name, HEAD[1]))
        speed = float(page.cell(WORK, HEAD[1])) / work if work else 1.0
    except KeyError:
        return "new"
    scale = {_SECONDS: speed, _RATE: 1.0 / speed}.get(figure.unit, 1.0) if figure.name != WORK else 1.0
    return f"{figure.value * scale / then:.2f}" if then else ""
