"""Which nodes, and how many, a corruption takes: draws that its strategies share. It edits no graph."""

from collections.abc import Sequence

import numpy as np

from grafu.graph.edges import Contact, ends_of
from grafu.graph.functional_graph import FunctionalGraph


def some(ids: Sequence[str], count: int, rng: np.random.Generator) -> frozenset[str]:
    """Returns `count` of the ids (all, where there are fewer), each as likely as another."""
    if count >= len(ids):
        return frozenset(ids)
    return frozenset(ids[int(k)] for k in rng.choice(len(ids), count, replace=False))


def share_of(count: int, least: float, most: float, rng: np.random.Generator) -> int:
    """Returns how many of `count` things are a share drawn between `least` and `most`; at least one of any."""
    return min(count, max(1, round(count * rng.uniform(least, most))))


def capped(count: int, most: int | None) -> int:
    """Returns `count`, or `most` where that is less."""
    return count if most is None else min(count, most)


def idle_nodes(graph: FunctionalGraph) -> list[str]:
    """Returns the ids of the parts that do not move and stand at no functional edge, in order."""
    busy = {end for edge in graph.edges if not isinstance(edge, Contact) for end in ends_of(edge)}
    return [n.id for n in graph.nodes if n.id not in busy and not n.label.is_movable]


def still_nodes(graph: FunctionalGraph) -> list[str]:
    """Returns the ids of the parts that are no door and no drawer, in order."""
    return [n.id for n in graph.nodes if not n.label.is_movable]
