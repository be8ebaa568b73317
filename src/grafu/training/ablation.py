"""The experiments of the supplement's two ablations, and the choices beside them: which config each trains by.

`losses` holds terms of the loss out, and takes one by one the choices in which the paper, the authors' code and `base`
differ. `folds` varies the number of corrupted copies of each model. Here nothing is trained.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from types import MappingProxyType
from typing import Literal, final, get_args

from grafu.data.pair import GraphPair
from grafu.training.config import TrainingConfig
from grafu.training.lesson import CopyMix
from grafu.training.loss_config import HOLD_OUTS, OFFICIAL, PAPER, LossConfig, held_out
from grafu.training.source import FurFunSource, Source

AblationKind = Literal["losses", "folds"]
KINDS: tuple[AblationKind, ...] = get_args(AblationKind)

FULL = "full"
FOLDS_TRIED = (0, 5, 10, 17, 20)
"""The supplement's four numbers of copies (Data Augmentation, Validation), and its choice, 17."""
FOLD_MODELS = 200
"""Made models of the fold ablation: about as many as the paper trains on, so that the number of copies matters."""


@final
@dataclass(frozen=True)
class Experiment:
    """One row of a table: the name is that of its folder, `says` tells in words what it does otherwise."""

    name: str
    says: str
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
        "light_motions": ("motions weigh .3 (authors' code)", {"border": 0.3, "sign": 0.3, "slide": 0.3}),
    }
)
"""What the paper, the authors' code and `base` do differently (official.md 5 and 8): in words, and as `LossConfig`."""


def experiments(kind: AblationKind, config: TrainingConfig) -> tuple[Experiment, ...]:
    """Returns the rows of a table, each trained as the config says but for one thing.

    The first row of `losses` is the config's own loss; choices that the config makes already are left out.
    """
    return _losses(config) if kind == "losses" else _folds(config)


def training_models(kind: AblationKind, source: Source) -> Source:
    """Returns what is trained on: of `folds`, few models of what has no end; a FurFun release is few as it is."""
    return source if kind == "losses" or isinstance(source, FurFunSource) else FirstModels(source, FOLD_MODELS)


def _losses(config: TrainingConfig) -> tuple[Experiment, ...]:
    full = Experiment(FULL, "the loss as it is trained by", config)
    rows = [_with_loss(config, f"no_{name}", _HELD_OUT[name], held_out(config.loss, name)) for name in HOLD_OUTS]
    for name, (says, changes) in CHOICES.items():
        rows.append(_with_loss(config, name, says, LossConfig(**(vars(config.loss) | dict(changes)))))
    return (full, *(row for row in rows if row.config != config))


def _with_loss(config: TrainingConfig, name: str, says: str, loss: LossConfig) -> Experiment:
    return Experiment(name, says, replace(config, loss=loss))


def _folds(config: TrainingConfig) -> tuple[Experiment, ...]:
    """Returns the numbers of copies, and copies without end.

    Every graph of a batch is of another model: without copies those of one model would all be the same.
    """
    graphs = config.deal.models * config.deal.copies
    even = replace(config, deal=replace(config.deal, models=graphs, copies=1))
    rows = [
        Experiment(f"folds_{count}", f"{count} corrupted copies of each model", replace(even, mix=_mix(config, count)))
        for count in FOLDS_TRIED
    ]
    endless = replace(_mix(config, 17), folds=None)
    return (*rows, Experiment("folds_endless", "every corrupted copy is a new one", replace(even, mix=endless)))


def _mix(config: TrainingConfig, count: int) -> CopyMix:
    """Returns the model as it was found and its copies, each as often as the others (supplement)."""
    return CopyMix(natural=1 / (count + 1), masked=0.0, corruption=config.mix.corruption, folds=count)


@lru_cache(maxsize=FOLD_MODELS)
def _kept_pair(models: FirstModels, number: int) -> GraphPair:
    return models.source.pair(number)
