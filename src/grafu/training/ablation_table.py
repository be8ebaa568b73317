"""The tables of an ablation, of the paper's columns and what else was asked: Markdown to read, CSV to reckon with.

A figure of a run is the mean over the kinds of input that validation shows: as found, labels hidden, parts taken away.
"""

import csv
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from statistics import fmean, stdev
from typing import final

from grafu.data.asked import VARIANTS
from grafu.metrics.graph_accuracy import GraphAccuracy
from grafu.training.ablation import Experiment

MEAN = "mean"
_NAMES = tuple(f.name for f in fields(GraphAccuracy))
_COLUMNS = {
    "existence": "existence F1",
    "category": "category",
    "centre": "centre ↓",
    "half": "half size ↓",
    "contact": "contact F1",
    "hinge": "hinge F1",
    "rail": "rail F1",
    "attached": "attached F1",
    "joint": "joint",
    "slide": "rail axis",
    "added": "added F1",
    "added_centre": "added off ↓",
    "score": "score",
}
_BETTER_LESS = ("centre", "half", "added_centre")


@final
@dataclass(frozen=True)
class Result:
    """The figures of one finished run, as `validate` names them."""

    experiment: Experiment
    seed: int
    figures: Mapping[str, float]

    def of(self, variant: str) -> dict[str, float]:
        """Returns each figure for a kind of input, or the mean over those that have it."""
        if variant != MEAN:
            return {name: self.figures[f"{variant}/{name}"] for name in _NAMES}
        every = [self.of(one) for one in VARIANTS]
        return {name: _mean([figures[name] for figures in every]) for name in _NAMES}


def markdown_table(results: Sequence[Result]) -> str:
    """Returns a table with a row for each experiment, in the order of their first results, and what each row means.

    The best of a column is bold, unless all are as good. Of several seeds it shows mean and standard deviation.
    """
    rows: dict[str, list[Result]] = {}
    for result in results:
        rows.setdefault(result.experiment.name, []).append(result)
    figures = {name: {column: _seen(ones, column) for column in _COLUMNS} for name, ones in rows.items()}
    best = {column: _best([row[column] for row in figures.values()], column) for column in _COLUMNS}
    lines = [_line(["experiment", *_COLUMNS.values()]), _line(["---", *["---:"] * len(_COLUMNS)])]
    for name, row in figures.items():
        lines.append(_line([f"`{name}`", *(_cell(values, best[column]) for column, values in row.items())]))
    meanings = [f"- `{name}`: {ones[0].experiment.says}" for name, ones in rows.items()]
    return "\n".join([*lines, "", *meanings]) + "\n"


def csv_table(results: Sequence[Result]) -> str:
    """Returns a line for each run and kind of input, and one for their mean, with every figure there is."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["experiment", "seed", "input", *_NAMES])
    for result in results:
        for variant in (*VARIANTS, MEAN):
            values = result.of(variant).values()
            cells = ["" if math.isnan(value) else f"{value:.6g}" for value in values]
            writer.writerow([result.experiment.name, result.seed, variant, *cells])
    return text.getvalue()


def _seen(results: Sequence[Result], column: str) -> list[float]:
    """Returns a figure of every seed that has it."""
    values = [result.figures["score"] if column == "score" else result.of(MEAN)[column] for result in results]
    return [value for value in values if not math.isnan(value)]


def _best(rows: Sequence[Sequence[float]], column: str) -> str:
    means = [f"{fmean(values):.3f}" for values in rows if values]
    return (min if column in _BETTER_LESS else max)(means, key=float) if len(set(means)) > 1 else ""


def _cell(values: Sequence[float], best: str) -> str:
    if not values:
        return ""
    mean = f"{fmean(values):.3f}"
    shown = f"**{mean}**" if mean == best else mean
    return shown if len(values) == 1 else f"{shown} ± {stdev(values):.3f}"


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _mean(values: Sequence[float]) -> float:
    known = [value for value in values if not math.isnan(value)]
    return fmean(known) if known else math.nan
