"""The experiments of the supplement's two ablations, and the choices beside them: which config each trains by.

`losses` holds terms of the loss out, and takes one by one the choices in which the paper, the authors' code and `base`
differ. `folds` varies the number of corrupted copies of each model. `departures` takes back, one by one, what `base`
does otherwise than the paper. Here nothing is trained.

Their tables hold the paper's columns and what else was asked: Markdown to read, CSV to reckon with. A figure of a run
is the mean over the kinds of input that validation shows: as found, labels hidden, parts taken away.
"""

import csv
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from functools import lru_cache
from statistics import fmean, stdev
from types import MappingProxyType
from typing import Literal, final, get_args

from grafu.data.corruption.corrupt import VARIANTS
from grafu.data.pair import GraphPair
from grafu.dataclass import dataclass
from grafu.metrics.graph_accuracy import GraphAccuracy
from grafu.training.config import TrainingConfig
from grafu.training.departures import DEPARTURES, taken_back, without_departures
from grafu.training.loss_config import HOLD_OUTS, OFFICIAL, PAPER, LossConfig, held_out
from grafu.training.sample import CopyMix
from grafu.training.source import FurFunSource, Source

AblationKind = Literal["losses", "folds", "departures"]
KINDS: tuple[AblationKind, ...] = get_args(AblationKind)

FULL = "full"
FOLDS_TRIED = (0, 5, 10, 17, 20)
"""The supplement's four numbers of copies (Data Augmentation, Validation), and its choice, 17."""
FOLD_MODELS = 200
"""Synthetic models of the fold ablation: about as many as the paper trains on, so that the number of copies matters."""


@final
@dataclass(frozen=True)
class Experiment:
    """One row of a table: the name is that of its folder, `states` describes in words what differs."""

    name: str
    states: str
    config: TrainingConfig


@final
@dataclass(frozen=True)
class FirstModels:
    """The first `count` models of a source, over and over; each is remembered.

    Raises:
        ValueError: if `count` is less than 1.
    """

    source: Source
    count: int

    def __post_init__(self) -> None:
        if self.count < 1:
            raise ValueError(f"`count` must be at least 1: got {self.count}")

    @property
    def name(self) -> str:
        """What it is, in words."""
        return f"the first {self.count} models of {self.source.name}"

    @property
    def maker_seed(self) -> int | None:
        """The seed that its furniture was made with, if it was made."""
        return self.source.maker_seed

    def pair(self, number: int) -> GraphPair:
        """Returns the natural pair of model `number` of the endless sequence."""
        return _kept_pair(self, number % self.count)


_HELD_OUT: Mapping[str, str] = MappingProxyType(
    {
        "hinge_target": "no loss on which part a door hangs on",
        "parent": "no loss on which part a handle is on",
        "centre": "no loss on centres",
        "boxes": "no loss on half sizes, of input nodes neither",
        "anchors": "no loss that ties input nodes to where they were given",
        "firing": "no loss on free slots that fire, nor on their number",
    }
)

CHOICES: Mapping[str, tuple[str, Mapping[str, object]]] = MappingProxyType(
    {
        "paper": ("every loss as the paper has it", vars(PAPER)),
        "official": ("every loss as the authors' code has it", vars(OFFICIAL)),
        "all_assigned": ("input nodes are assigned, not pinned (paper)", {"pinned": False}),
        "entropy_assigns": ("cross-entropy of categories assigns (paper)", {"match_cost": "cross-entropy"}),
        "squared_boxes": ("squared errors of boxes (paper, authors' code)", {"box_error": "squared"}),
        "free_positive_10": (
            "a free slot that should exist weighs ten times as much (paper, authors' code)",
            {"free_positive": 10.0},
        ),
        "exists_balanced": (
            "slots that should exist weigh as much as all others (authors' code)",
            {"exists_balanced": True},
        ),
        "sharp_count": ("the root in the loss of the count starts at a millionth (paper)", {"count_smoothing": 1e-6}),
        "whole_count": (
            "the count is of all missing nodes (paper)",
            {"count_capped": False},
        ),
        "light_motions": ("motions weigh .3 (authors' code)", {"border": 0.3, "sign": 0.3, "slide": 0.3}),
    }
)
"""What the paper, the authors' code and `base` do differently: in words, and as `LossConfig`."""


def experiments(kind: AblationKind, config: TrainingConfig) -> tuple[Experiment, ...]:
    """Returns the rows of a table, each trained as the config states but for one thing.

    The first row of `losses` is the config's own loss; choices that the config makes already are left out.
    """
    return {"losses": _losses, "folds": _folds, "departures": _departures}[kind](config)


def training_models(kind: AblationKind, source: Source) -> Source:
    """Returns what is trained on: of `folds`, few models of what has no end; a FurFun release is few as it is."""
    return source if kind != "folds" or isinstance(source, FurFunSource) else FirstModels(source, FOLD_MODELS)


def _losses(config: TrainingConfig) -> tuple[Experiment, ...]:
    full = Experiment(FULL, "the loss as it is trained by", config)
    rows = [_with_loss(config, f"no_{name}", _HELD_OUT[name], held_out(config.loss, name)) for name in HOLD_OUTS]
    for name, (states, changes) in CHOICES.items():
        rows.append(_with_loss(config, name, states, LossConfig(**(vars(config.loss) | dict(changes)))))
    return (full, *(row for row in rows if row.config != config))


def _with_loss(config: TrainingConfig, name: str, states: str, loss: LossConfig) -> Experiment:
    return Experiment(name, states, replace(config, loss=loss))


def _folds(config: TrainingConfig) -> tuple[Experiment, ...]:
    """Returns the numbers of copies, and an endless stream of copies.

    Every graph of a batch is of another model: without copies those of one model would all be the same.
    """
    graphs = config.sampling.models * config.sampling.copies
    even = replace(config, sampling=replace(config.sampling, models=graphs, copies=1))
    rows = [
        Experiment(f"folds_{count}", f"{count} corrupted copies of each model", replace(even, mix=_mix(config, count)))
        for count in FOLDS_TRIED
    ]
    endless = replace(_mix(config, 17), folds=None)
    return (*rows, Experiment("folds_endless", "every corrupted copy is a new one", replace(even, mix=endless)))


def _departures(config: TrainingConfig) -> tuple[Experiment, ...]:
    """Returns the config, each departure of it from the paper taken back, and all of them."""
    rows = [Experiment(one.name, one.taken_back, taken_back(config, one)) for one in DEPARTURES]
    full = Experiment(FULL, "the config with its departures", config)
    every = Experiment("paper", "all of them: the paper's network, losses and training", without_departures(config))
    return (full, *(row for row in (*rows, every) if row.config != config))


def _mix(config: TrainingConfig, count: int) -> CopyMix:
    """Returns the model as it was found and its copies, each as often as the others (supplement)."""
    return CopyMix(natural=1 / (count + 1), masked=0.0, corruption=config.mix.corruption, folds=count)


@lru_cache(maxsize=FOLD_MODELS)
def _kept_pair(models: FirstModels, number: int) -> GraphPair:
    return models.source.pair(number)


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
REAL = "real/aligned"
"""The figure of a run on annotated models: the mean of their fractions of motions that are as annotated."""
_BETTER_LESS = ("centre", "half", "added_centre")


@final
@dataclass(frozen=True)
class AblationResult:
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


def markdown_table(results: Sequence[AblationResult]) -> str:
    """Returns a table with a row for each experiment, in the order of their first results, and what each row means.

    The best of a column is bold, unless all are as good. Of several seeds it shows mean and standard deviation.
    """
    rows: dict[str, list[AblationResult]] = {}
    for result in results:
        rows.setdefault(result.experiment.name, []).append(result)
    shown = _COLUMNS | ({REAL: "real GT-aligned"} if any(REAL in one.figures for one in results) else {})
    figures = {name: {column: _seen(ones, column) for column in shown} for name, ones in rows.items()}
    best = {column: _best([row[column] for row in figures.values()], column) for column in shown}
    lines = [_line(["experiment", *shown.values()]), _line(["---", *["---:"] * len(shown)])]
    for name, row in figures.items():
        lines.append(_line([f"`{name}`", *(_cell(values, best[column]) for column, values in row.items())]))
    meanings = [f"- `{name}`: {ones[0].experiment.states}" for name, ones in rows.items()]
    return "\n".join([*lines, "", *meanings]) + "\n"


def csv_table(results: Sequence[AblationResult]) -> str:
    """Returns a line for each run and kind of input, and one for their mean, with every figure there is."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    with_real = any(REAL in one.figures for one in results)
    writer.writerow(["experiment", "seed", "input", *_NAMES, *([REAL] if with_real else [])])
    for result in results:
        for variant in (*VARIANTS, MEAN):
            real = [result.figures.get(REAL, math.nan) if variant == MEAN else math.nan] if with_real else []
            values = (*result.of(variant).values(), *real)
            cells = ["" if math.isnan(value) else f"{value:.6g}" for value in values]
            writer.writerow([result.experiment.name, result.seed, variant, *cells])
    return text.getvalue()


def _seen(results: Sequence[AblationResult], column: str) -> list[float]:
    """Returns a figure of every seed that has it."""
    if column in ("score", REAL):
        values = [result.figures.get(column, math.nan) for result in results]
    else:
        values = [result.of(MEAN)[column] for result in results]
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
