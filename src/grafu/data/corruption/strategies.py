"""What is taken away: a table of strategies with family and weight (supplement, table Sampling weights).

A new strategy is a new row. Strategies that take nodes away forget what the edges did: all that remain are contacts.
Where a graph has none of a category, 30 to 50 % of its still parts go instead, as in the authors' code.
One node always stays, so that no input is empty. Others keep the kinds and motions of all edges that remain, or hide
labels alone: the parts, their boxes and their points stay.
"""

from collections.abc import Callable, Collection, Sequence
from functools import lru_cache, partial
from types import MappingProxyType
from typing import Literal, NamedTuple

import numpy as np

from grafu.data.corruption.config import STRATEGY_NAMES, CorruptionConfig, StrategyName
from grafu.graph.edges import Contact, ends_of
from grafu.graph.edit import as_contacts, relabelled, without_edges, without_nodes
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel

DROPPED_TOGETHER = (
    PartLabel.HANDLE,
    PartLabel.TOP_PANEL,
    PartLabel.BOTTOM_PANEL,
    PartLabel.DOOR,
    PartLabel.DRAWER,
)
"""The categories that the paper drops one at a time, and two or three at once."""

RESTORED = (PartLabel.TOP_PANEL, PartLabel.SHELF, PartLabel.DIVIDER, PartLabel.BOTTOM_PANEL, PartLabel.HANDLE)
"""The categories that the authors' code drops two or three of at once."""


def dropped_category(
    target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig, label: PartLabel
) -> FunctionalGraph:
    """Returns the graph without the parts of a category, contacts only."""
    return _without_labels(target, rng, config, [label])


def dropped_categories(
    target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig, among: Sequence[PartLabel]
) -> FunctionalGraph:
    """Returns the graph without two or three of these categories, of those that it has, contacts only."""
    present = [label for label in among if target.labelled(label)]
    count = min(len(present), int(rng.integers(2, 4)))
    labels = [present[int(k)] for k in rng.choice(len(present), count, replace=False)] if present else []
    return _without_labels(target, rng, config, labels)


def dropped_handful(target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig) -> FunctionalGraph:
    """Returns the graph without a handful (one to four, fewer if so capped) of parts of any category, contacts only."""
    handful = int(rng.integers(1, capped(_HANDFUL, config.max_dropped) + 1))
    return _without(target, [n.id for n in target.nodes], handful, rng)


def dropped_ratio(target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig) -> FunctionalGraph:
    """Returns the graph without 30 to 50 % of its parts, none of them a door or drawer, contacts only."""
    still = still_nodes(target)
    count = ratio_of(len(target.nodes), 0.3, 0.5, rng)
    return _without(target, still, capped(count, config.max_dropped), rng)


def isolated_door(target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig) -> FunctionalGraph:
    """Returns the graph with all its parts but no edge at one of its doors, contacts only."""
    doors = [n.id for n in target.labelled(PartLabel.DOOR)]
    if not doors:
        return dropped_ratio(target, rng, config)
    (door,) = some(doors, 1, rng)
    return as_contacts(without_edges(target, [e for e in target.edges if door in ends_of(e)]))


_HANDFUL = 4  # the paper states a handful; it has four free slots to restore them


def _without_labels(
    target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig, labels: Collection[PartLabel]
) -> FunctionalGraph:
    """Where fewer may go than there are, one of each label goes first: a lone top is not spared by a row of handles."""
    found = [n.id for n in target.labelled(*labels)]
    if not found:
        return dropped_ratio(target, rng, config)
    count = min(capped(len(found), config.max_dropped), len(target.nodes) - 1)
    each = [min(some([n.id for n in target.labelled(label)], 1, rng)) for label in labels]
    dropped = frozenset(each[:count])
    others = [i for i in found if i not in dropped]
    return as_contacts(without_nodes(target, dropped | some(others, count - len(dropped), rng)))


def _without(target: FunctionalGraph, among: list[str], count: int, rng: np.random.Generator) -> FunctionalGraph:
    return as_contacts(without_nodes(target, some(among, min(count, len(target.nodes) - 1), rng)))


def dropped_edges(target: FunctionalGraph, rng: np.random.Generator) -> FunctionalGraph:
    """Returns the graph with all its nodes and without 25 to 50 % of its edges.

    An edge goes in both directions at once. The authors' code stores each edge twice and draws the two on their own, so
    that most of what it removes survives one way; that is not copied.
    """
    count = ratio_of(len(target.edges), 0.25, 0.5, rng)
    picked = rng.choice(len(target.edges), count, replace=False) if count else ()
    return without_edges(target, {target.edges[int(k)] for k in picked})


def dropped_nodes(target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig) -> FunctionalGraph:
    """Returns the graph without 30 to 50 % of its nodes, doors and drawers among them (one node always stays)."""
    ids = [n.id for n in target.nodes]
    count = min(capped(ratio_of(len(ids), 0.3, 0.5, rng), config.max_dropped), max(len(ids) - 1, 0))
    return without_nodes(target, some(ids, count, rng))


def dropped_idle(target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig) -> FunctionalGraph:
    """Returns the graph without a random number of parts that do not move, at least one, all functional edges kept.

    Where each part stands at a functional edge the graph stays as it is: nothing is to be added then. With
    `keep_functional_edges` off, any part goes that is no door and no drawer, and its edges with it (authors' code).
    """
    ids = idle_nodes(target) if config.keep_functional_edges else still_nodes(target)
    most = min(capped(len(ids), config.max_dropped), len(target.nodes) - 1)
    return without_nodes(target, some(ids, int(rng.integers(1, most + 1)), rng)) if most > 0 else target


def anonymized(target: FunctionalGraph) -> FunctionalGraph:
    """Returns the graph with every label unknown and every edge a contact."""
    return relabelled(as_contacts(target), {n.id: PartLabel.UNKNOWN for n in target.nodes})


def masked_ratio(target: FunctionalGraph, rng: np.random.Generator) -> FunctionalGraph:
    """Returns the graph with 30 to 60 % of its labels unknown; edges keep their kinds and motions."""
    ids = [n.id for n in target.nodes]
    masked = some(ids, ratio_of(len(ids), 0.3, 0.6, rng), rng)
    return relabelled(target, dict.fromkeys(masked, PartLabel.UNKNOWN))


def masked_each(graph: FunctionalGraph, rng: np.random.Generator, probability: float) -> FunctionalGraph:
    """Returns the graph with each label unknown at this chance; edges keep their kinds and motions."""
    hit = rng.random(len(graph.nodes)) < probability
    masked = [n.id for n, is_hit in zip(graph.nodes, hit, strict=True) if is_hit]
    return relabelled(graph, dict.fromkeys(masked, PartLabel.UNKNOWN)) if masked else graph


def some(ids: Sequence[str], count: int, rng: np.random.Generator) -> frozenset[str]:
    """Returns `count` of the ids (all, where there are fewer), each as likely as another."""
    if count >= len(ids):
        return frozenset(ids)
    return frozenset(ids[int(k)] for k in rng.choice(len(ids), count, replace=False))


def ratio_of(count: int, least: float, most: float, rng: np.random.Generator) -> int:
    """Returns how many of `count` things are a fraction drawn between `least` and `most`; at least one of any."""
    return min(count, max(1, round(count * rng.uniform(least, most))))


def capped(count: int, most: int | None) -> int:
    """Returns `count`, or `most` where that is less."""
    return count if most is None else min(count, most)


def idle_nodes(graph: FunctionalGraph) -> list[str]:
    """Returns the ids of the parts that do not move and stand at no functional edge, in order."""
    busy = {end for edge in graph.edges if not isinstance(edge, Contact) for end in ends_of(edge)}
    return [n.id for n in graph.nodes if n.id not in busy and not n.label.is_movable]


def still_nodes(graph: FunctionalGraph) -> list[str]:
    """Returns the ids of the parts that are no door and no drawer and do not move, in order."""
    return [n.id for n in graph.nodes if not n.label.is_movable and n.id not in graph.moving]


Family = Literal["category drop", "label masking", "edge-preserving", "authors' code"]
Corruption = Callable[[FunctionalGraph, np.random.Generator, CorruptionConfig], FunctionalGraph]


class Strategy(NamedTuple):
    """One row. `weight` is the paper's, 0 for what only the authors' code has.

    `is_boosted` states whether `edge_preserving_boost` counts: the authors' code boosts all that keep the kinds of
    edges, one of the masking strategies among them.
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
            "label masking", 0.04, lambda target, rng, _config: masked_ratio(target, rng), is_boosted=True
        ),
        "mask_random_edges_keep_types": Strategy(
            "edge-preserving", 0.10, lambda target, rng, _config: dropped_edges(target, rng), is_boosted=True
        ),
        "drop_nodes_keep_edge_types": Strategy("edge-preserving", 0.05, dropped_nodes, is_boosted=True),
        "fully_functional_drop": Strategy("edge-preserving", 0.20, dropped_idle, is_boosted=True),
        "isolate_door": Strategy("authors' code", 0.0, isolated_door),
        "random_share": Strategy("authors' code", 0.0, dropped_ratio),
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
