"""Strategies that hide labels. The parts, their boxes and their points stay."""

import numpy as np

from grafu.data.corruption.choosing import share_of, some
from grafu.graph.edit import as_contacts, relabelled
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel


def anonymized(target: FunctionalGraph) -> FunctionalGraph:
    """Returns the graph with every label unknown and every edge a contact."""
    return relabelled(as_contacts(target), {n.id: PartLabel.UNKNOWN for n in target.nodes})


def masked_share(target: FunctionalGraph, rng: np.random.Generator) -> FunctionalGraph:
    """Returns the graph with 30 to 60 % of its labels unknown; edges keep their kinds and motions."""
    ids = [n.id for n in target.nodes]
    masked = some(ids, share_of(len(ids), 0.3, 0.6, rng), rng)
    return relabelled(target, dict.fromkeys(masked, PartLabel.UNKNOWN))


def masked_each(graph: FunctionalGraph, rng: np.random.Generator, probability: float) -> FunctionalGraph:
    """Returns the graph with each label unknown at this chance; edges keep their kinds and motions."""
    hit = rng.random(len(graph.nodes)) < probability
    masked = [n.id for n, is_hit in zip(graph.nodes, hit, strict=True) if is_hit]
    return relabelled(graph, dict.fromkeys(masked, PartLabel.UNKNOWN)) if masked else graph
