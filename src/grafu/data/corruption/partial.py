"""Strategies that keep the kinds and motions of all edges that remain: inputs that are functional in part."""

import numpy as np

from grafu.data.corruption.choosing import capped, idle_nodes, share_of, some, still_nodes
from grafu.data.corruption.config import CorruptionConfig
from grafu.graph.edit import without_edges, without_nodes
from grafu.graph.functional_graph import FunctionalGraph


def dropped_edges(target: FunctionalGraph, rng: np.random.Generator) -> FunctionalGraph:
    """Returns the graph with all its nodes and without 25 to 50 % of its edges.

    An edge goes in both directions at once. The authors' code stores each edge twice and draws the two on their own, so
    that most of what it removes survives one way (official.md 5); that is not copied.
    """
    count = share_of(len(target.edges), 0.25, 0.5, rng)
    picked = rng.choice(len(target.edges), count, replace=False) if count else ()
    return without_edges(target, {target.edges[int(k)] for k in picked})


def dropped_nodes(target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig) -> FunctionalGraph:
    """Returns the graph without 30 to 50 % of its nodes, doors and drawers among them (one node always stays)."""
    ids = [n.id for n in target.nodes]
    count = min(capped(share_of(len(ids), 0.3, 0.5, rng), config.max_dropped), max(len(ids) - 1, 0))
    return without_nodes(target, some(ids, count, rng))


def dropped_idle(target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig) -> FunctionalGraph:
    """Returns the graph without a random number of parts that do not move, at least one, all functional edges kept.

    Where each part stands at a functional edge the graph stays as it is: nothing is to be added then. With
    `keep_functional_edges` off, any part goes that is no door and no drawer, and its edges with it (authors' code).
    """
    ids = idle_nodes(target) if config.keep_functional_edges else still_nodes(target)
    most = min(capped(len(ids), config.max_dropped), len(target.nodes) - 1)
    return without_nodes(target, some(ids, int(rng.integers(1, most + 1)), rng)) if most > 0 else target
