"""Strategies that take nodes away and forget what the edges did: all that remain are contacts.

Where a graph has none of a category, 30 to 50 % of its still parts go instead, as in the authors' code (official.md 5).
One node always stays, so that no input is empty.
"""

from collections.abc import Collection, Sequence

import numpy as np

from grafu.data.corruption.choosing import capped, share_of, some, still_nodes
from grafu.data.corruption.config import CorruptionConfig
from grafu.graph.edges import ends_of
from grafu.graph.edit import as_contacts, without_edges, without_nodes
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


def dropped_share(target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig) -> FunctionalGraph:
    """Returns the graph without 30 to 50 % of its parts, none of them a door or drawer, contacts only."""
    still = still_nodes(target)
    count = share_of(len(target.nodes), 0.3, 0.5, rng)
    return _without(target, still, capped(count, config.max_dropped), rng)


def isolated_door(target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig) -> FunctionalGraph:
    """Returns the graph with all its parts but no edge at one of its doors, contacts only."""
    doors = [n.id for n in target.labelled(PartLabel.DOOR)]
    if not doors:
        return dropped_share(target, rng, config)
    (door,) = some(doors, 1, rng)
    return as_contacts(without_edges(target, [e for e in target.edges if door in ends_of(e)]))


_HANDFUL = 4  # the paper says a handful; it has four free slots to restore them


def _without_labels(
    target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig, labels: Collection[PartLabel]
) -> FunctionalGraph:
    """Where fewer may go than there are, one of each label goes first: a lone top is not spared by a row of handles."""
    found = [n.id for n in target.labelled(*labels)]
    if not found:
        return dropped_share(target, rng, config)
    count = min(capped(len(found), config.max_dropped), len(target.nodes) - 1)
    each = [min(some([n.id for n in target.labelled(label)], 1, rng)) for label in labels]
    dropped = frozenset(each[:count])
    others = [i for i in found if i not in dropped]
    return as_contacts(without_nodes(target, dropped | some(others, count - len(dropped), rng)))


def _without(target: FunctionalGraph, among: list[str], count: int, rng: np.random.Generator) -> FunctionalGraph:
    return as_contacts(without_nodes(target, some(among, min(count, len(target.nodes) - 1), rng)))
