"""Made and real furniture side by side: a row for each measure, and whether the real lies within the made.

A value is compared model by model: each real model against the synthetic 5 to 95 % range. A fraction (of models without
a top, of hinges on the left) has no spread from model to model worth the name; there the fraction of all real models is
held against the 5 to 95 % range of the fractions of as many synthetic models, drawn again and again.
"""

from collections.abc import Iterable, Sequence
from math import comb
from pathlib import Path
from typing import Literal, final

import numpy as np

from grafu.asset.load import load_asset
from grafu.dataclass import dataclass
from grafu.errors import FunctionalizationError
from grafu.evaluation.statistics_measures import ModelMeasures, measure_model
from grafu.graph.annotated import annotated_edges
from grafu.graph.edit import with_edges
from grafu.graph.parse import parse_graph
from grafu.synth.specimen import Specimen

Verdict = Literal["inside", "plausible", "outside", "no real"]

_LOW, _HIGH = 5.0, 95.0  # percent
_INSIDE = (_HIGH - _LOW) / 100  # fraction of models inside if real and synthetic came from one distribution
_CHANCE = 0.05  # fewer inside than chance leaves there in one of twenty folders as large: not chance any more
_ROUNDING = 1e-3  # of a number: real files keep few digits, and what is meant to be one half is seldom quite that
_GROUPS = 1000  # how often a group of synthetic models is drawn
_GROUP = 17  # models in it where there is no real folder to take the number from


@final
@dataclass(frozen=True, slots=True)
class Spread:
    """The 5 %, 50 % and 95 % points of a measure."""

    low: float
    median: float
    high: float

    @classmethod
    def of(cls, numbers: Sequence[float]) -> "Spread":
        """Returns the spread of at least one number."""
        return cls(*(float(x) for x in np.percentile(numbers, [_LOW, 50.0, _HIGH])))

    def text(self, is_ratio: bool) -> str:
        """Returns its numbers as they stand in a table, one where all are the same."""
        numbers = (self.median,) if self.low == self.high else (self.low, self.median, self.high)
        return " · ".join(number_text(number, is_ratio) for number in numbers)

    def holds(self, number: float) -> bool:
        """Whether a number lies between the 5 % and the 95 % point, but for rounding."""
        slack = _ROUNDING * max(abs(self.low), abs(self.high)) + 1e-9
        return self.low - slack <= number <= self.high + slack


@final
@dataclass(frozen=True, slots=True)
class StatisticsRow:
    """One measure. `within` is the fraction of `models` real models inside the synthetic range (of a fraction: 0 or 1).

    `synthetic` or `real` is None where no model has the measure. `outliers` are the real models outside, by name, with
    their values; for a fraction the one real number stands under the name `all`.
    """

    measure: str
    is_ratio: bool
    synthetic: Spread | None
    real: Spread | None
    models: int = 0
    within: float | None = None
    outliers: tuple[tuple[str, float], ...] = ()

    @property
    def verdict(self) -> Verdict:
        """`inside`: every real model. `plausible`: as many as nine in ten, or fewer by chance. `outside`: too few."""
        if self.within is None:
            return "no real"
        if self.within == 1.0:
            return "inside"
        return "outside" if self.is_ratio or _chance_of(self.models, self.within) < _CHANCE else "plausible"


@final
@dataclass(frozen=True, slots=True)
class StatisticsTable:
    """All rows, the number of models on each side, and the real ones that could not be read, with the reason."""

    rows: tuple[StatisticsRow, ...]
    synthetic: int
    real: int
    unread: tuple[str, ...] = ()

    @property
    def failing(self) -> tuple[StatisticsRow, ...]:
        """The rows of which too few real models lie within the synthetic range."""
        return tuple(row for row in self.rows if row.verdict == "outside")

    def row(self, measure: str) -> StatisticsRow:
        """Returns the row of a measure. Raises KeyError where there is none."""
        for row in self.rows:
            if row.measure == measure:
                return row
        raise KeyError(measure)

    def markdown(self) -> str:
        """Returns the table as Markdown, a verdict on each row and the outliers' names behind it."""
        lines = [
            f"{self.synthetic} synthetic models, {self.real} real ones: 5 %, median, 95 %.",
            "",
            "| measure | synthetic | real | real within | verdict | outside |",
            "|---|---|---|---|---|---|",
            *(_markdown_row(row) for row in self.rows),
        ]
        return "\n".join([*lines, *([""] if self.unread else []), *(f"not read: {why}" for why in self.unread)]) + "\n"


def compare(synthetic: Iterable[Specimen], real: Path | None = None) -> StatisticsTable:
    """Returns the comparison of specimens with the models in a folder (one file or folder each), or without any.

    Raises:
        ValueError: if there is no specimen.
    """
    made = [measure_model(s.asset, s.truth) for s in synthetic]
    measured, unread = measure_folder(real) if real is not None else ((), ())
    return compare_measures(made, measured, unread)


def compare_measures(
    made: Sequence[ModelMeasures], real: Sequence[ModelMeasures] = (), unread: tuple[str, ...] = ()
) -> StatisticsTable:
    """Returns the comparison of models that have been measured.

    Raises:
        ValueError: if there is no synthetic model.
    """
    if not made:
        raise ValueError("statistics need at least one specimen: got none")
    models = (*made, *real)
    values = dict.fromkeys(name for m in models for name in m.values)
    ratios = dict.fromkeys(name for m in models for name in m.tallies)
    rows = [_value_row(name, made, real) for name in values] + [_share_row(name, made, real) for name in ratios]
    return StatisticsTable(tuple(rows), len(made), len(real), unread)


def measure_folder(folder: Path) -> tuple[tuple[ModelMeasures, ...], tuple[str, ...]]:
    """Returns the measures of every model in a folder, by name, and why the others could not be read.

    A model's functional graph is its contacts and its own joints and attached parts.
    """
    measured, unread = [], []
    for path in sorted(p for p in Path(folder).iterdir() if not p.name.startswith(".")):
        try:
            asset = load_asset(path).as_annotated()
            graph = parse_graph(asset)
            measured.append(measure_model(asset, with_edges(graph, annotated_edges(asset, graph).edges)))
        except FunctionalizationError as error:
            unread.append(f"{path.name}: {error}")
    return tuple(measured), tuple(unread)


def _value_row(name: str, made: Sequence[ModelMeasures], real: Sequence[ModelMeasures]) -> StatisticsRow:
    ours = [m.values[name] for m in made if name in m.values]
    theirs = [(m.name, m.values[name]) for m in real if name in m.values]
    spread = Spread.of(ours) if ours else None
    if not theirs:
        return StatisticsRow(name, False, spread, None)
    count = len(theirs)
    outside = tuple(pair for pair in theirs if spread is None or not spread.holds(pair[1]))
    within = 1.0 - len(outside) / count
    return StatisticsRow(name, False, spread, Spread.of([value for _, value in theirs]), count, within, outside)


def _share_row(name: str, made: Sequence[ModelMeasures], real: Sequence[ModelMeasures]) -> StatisticsRow:
    ours = np.array([m.tallies[name] for m in made if name in m.tallies], dtype=np.float64).reshape(-1, 2)
    theirs = [m.tallies[name] for m in real if name in m.tallies]
    spread = _grouped(ours, len(theirs) or _GROUP) if len(ours) else None
    if not theirs:
        return StatisticsRow(name, True, spread, None)
    ratio = float(sum(yes for yes, _ in theirs) / max(sum(of for _, of in theirs), 1))
    held = spread is not None and spread.holds(ratio)
    outside = () if held else (("all", ratio),)
    return StatisticsRow(name, True, spread, Spread(ratio, ratio, ratio), len(theirs), float(held), outside)


def _chance_of(models: int, within: float) -> float:
    """Returns how likely it is that so few or fewer of so many models lie inside, if each does with nine in ten."""
    inside = round(models * within)
    return sum(comb(models, k) * _INSIDE**k * (1 - _INSIDE) ** (models - k) for k in range(inside + 1))


def _grouped(tallies: np.ndarray, size: int) -> Spread:
    """Returns the spread of the fraction in groups of `size` models, drawn with replacement, the same every time."""
    rng = np.random.default_rng(0)
    groups = tallies[rng.integers(0, len(tallies), size=(_GROUPS, size))].sum(axis=1)
    return Spread.of(list(groups[:, 0] / np.maximum(groups[:, 1], 1.0)))


def _markdown_row(row: StatisticsRow) -> str:
    within = "" if row.within is None else f"{row.within:.0%}"
    outside = ", ".join(f"{name} {number_text(value, row.is_ratio)}" for name, value in row.outliers)
    made, real = ("none" if spread is None else spread.text(row.is_ratio) for spread in (row.synthetic, row.real))
    return "| " + " | ".join([row.measure, made, real, within, row.verdict, outside]) + " |"


def number_text(number: float, is_ratio: bool) -> str:
    """Returns a number of a measure as it stands in a table."""
    return f"{number:.0%}" if is_ratio else f"{number:.3g}"
