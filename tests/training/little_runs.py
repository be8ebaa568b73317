"""A training run so small that a test can afford it: few weights, few points, models of a remembered handful."""

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import final

from grafu.data.pair import GraphPair, record_of, record_pair
from grafu.network.config import GraFuConfig
from grafu.synth.generate import make_specimen
from grafu.training.config import TINY, TrainingConfig, ValidationConfig

LITTLE = replace(
    TINY,
    network=GraFuConfig(
        hidden=16,
        heads=2,
        encoder_layers=1,
        decoder_layers=1,
        edge=8,
        category=8,
        points=8,
        geometry=8,
        dropout=0.0,
        geometry_dropout=0.0,
        name_dropout=0.0,
    ),
    validation=ValidationConfig(models=2, every=2, batch=6),
    steps=4,
)


SMALL = (4, 5, 9)  # the first of seed 3 with 4 to 16 parts and labels: to look for them takes longer than a run


@final
@dataclass(frozen=True)
class FewModels:
    """Three small synthetic models, over and over."""

    seed: int = 3

    @property
    def name(self) -> str:
        return "few models"

    @property
    def maker_seed(self) -> int:
        return self.seed

    def pair(self, number: int) -> GraphPair:
        return few_pairs(self.seed)[number % 3]


@lru_cache(maxsize=2)
def few_pairs(seed: int) -> tuple[GraphPair, ...]:
    pairs = tuple(record_pair(record_of(make_specimen(seed, index, 64))) for index in SMALL)
    assert all(4 <= len(pair.input.nodes) <= 16 for pair in pairs)
    return pairs


def little(steps: int = 4, **changes: object) -> TrainingConfig:
    return replace(LITTLE, steps=steps, **changes)
