"""The table of strategies: name, family, weight (supplement, table Sampling weights). A new strategy is a new row."""

from collections.abc import Callable
from functools import lru_cache, partial
from types import MappingProxyType
from typing import Literal, NamedTuple

import numpy as np

from grafu.data.corruption.config import STRATEGY_NAMES, CorruptionConfig, StrategyName
from grafu.data.corruption.dropping import (
    DROPPED_TOGETHER,
    RESTORED,
    dropped_categories,
    dropped_category,
    dropped_handful,
    dropped_share,
    isolated_door,
)
from grafu.data.corruption.masking import anonymized, masked_share
from grafu.data.corruption.partial import dropped_edges, dropped_idle, dropped_nodes
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel

Family = Literal["category drop", "label masking", "edge-preserving", "authors' code"]
Corruption = Callable[[FunctionalGraph, np.random.Generator, CorruptionConfig], FunctionalGraph]


class Strategy(NamedTuple):
    """One row. `weight` is the paper's, 0 for what only the authors' code has.

    `is_boosted` says whether `edge_preserving_boost` counts: the authors' code boosts all that keep the kinds of edges,
    one of the masking strategies among them.
    """

    family: Family
    weight: float
    apply: Corruption
    is_boosted: bool = False


def _drop(label: PartLabel) -> Corruption:
    return partial(dropped_category, label=label)


STRATEGIES: MappingProxyType[StrategyName, Strategy] = MappingProxyType(
    {
        "drop_handles": Strategy("category drop", 0.15, _drop(PartLabel.HANDLE)),
        "drop_top": Strategy("category drop", 0.15, _drop(PartLabel.TOP_PANEL)),
        "drop_bottom": Strategy("category drop", 0.10, _drop(PartLabel.BOTTOM_PANEL)),
        "drop_doors": Strategy("category drop", 0.08, _drop(PartLabel.DOOR)),
        "drop_drawers": Strategy("category drop", 0.08, _drop(PartLabel.DRAWER)),
        "drop_multi_cat": Strategy("category drop", 0.10, partial(dropped_categories, among=DROPPED_TOGETHER)),
        "random": Strategy("category drop", 0.05, dropped_handful),
        "fully_anonymized": Strategy("label masking", 0.05, lambda target, _rng, _config: anonymized(target)),
        "mask_materials_keep_edges": Strategy(
            "label masking", 0.04, lambda target, rng, _config: masked_share(target, rng), is_boosted=True
        ),
        "mask_random_edges_keep_types": Strategy(
            "edge-preserving", 0.10, lambda target, rng, _config: dropped_edges(target, rng), is_boosted=True
        ),
        "drop_nodes_keep_edge_types": Strategy("edge-preserving", 0.05, dropped_nodes, is_boosted=True),
        "fully_functional_drop": Strategy("edge-preserving", 0.20, dropped_idle, is_boosted=True),
        "isolate_door": Strategy("authors' code", 0.0, isolated_door),
        "random_share": Strategy("authors' code", 0.0, dropped_share),
        "drop_completion": Strategy("authors' code", 0.0, partial(dropped_categories, among=RESTORED)),
    }
)


@lru_cache(maxsize=64)
def probabilities(config: CorruptionConfig) -> tuple[float, ...]:
    """Returns the chance of each strategy, in the order of `STRATEGY_NAMES`; they add up to 1.

    Raises:
        ValueError: if every weight is 0.
    """
    given = dict(config.weights)
    weights = [
        given.get(name, STRATEGIES[name].weight)
        * (config.edge_preserving_boost if STRATEGIES[name].is_boosted else 1.0)
        for name in STRATEGY_NAMES
    ]
    total = sum(weights)
    if not total > 0:
        raise ValueError("`weights` must leave at least one strategy: all are 0")
    return tuple(weight / total for weight in weights)
