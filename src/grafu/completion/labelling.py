"""Labels of unlabelled parts: the network's category, weighed by whether anything could carry such a part.

Labels that the input states are kept, whatever the network says.
"""

import numpy as np

from grafu.completion.answers import decision_of
from grafu.completion.decode_config import DecodeConfig
from grafu.completion.probabilities import Probabilities
from grafu.completion.votes import ranking_of
from grafu.graph.arrays import ATTACHED, DOOR, DRAWER, HANDLE, HINGE, LABELS, RAIL, UNKNOWN
from grafu.graph.completion import Decision
from grafu.graph.edges import Contact, ends_of
from grafu.graph.functional_graph import FunctionalGraph, is_allowed
from grafu.vocabulary import PartLabel

_CARRIED_BY = {DOOR: HINGE, DRAWER: RAIL, HANDLE: ATTACHED}


def choose_labels(
    graph: FunctionalGraph, probabilities: Probabilities, config: DecodeConfig
) -> tuple[dict[str, PartLabel], tuple[Decision, ...]]:
    """Returns a label, never `unknown`, for each unlabelled part, and its confidence.

    An edge that the input states at the part allows only the labels that it can join.
    """
    labels: dict[str, PartLabel] = {}
    decisions = []
    weights = _weights(probabilities, len(graph.nodes), config)
    for k, node in enumerate(graph.nodes):
        if node.label is not PartLabel.UNKNOWN:
            continue
        allowed = _allowed(graph, node.id, labels)
        ranking = ranking_of([label.value for label in LABELS], np.maximum(weights[k], 1e-9) * allowed)
        labels[node.id] = PartLabel(ranking.choice)
        decisions.append(decision_of(node.id, "label", ranking))
    return labels, tuple(decisions)


def _weights(probabilities: Probabilities, count: int, config: DecodeConfig) -> np.ndarray:
    """Returns the probability of each label of each node; less for what moves or is grasped if nothing carries it."""
    weights = probabilities.label[:count].copy()
    if count > 1:
        others = probabilities.edge[:count, :count] * (1.0 - np.eye(count))[..., None]
        for label, kind in _CARRIED_BY.items():
            carried = others[..., kind].max(axis=1)
            weights[:, label] *= config.edge_for_label + (1.0 - config.edge_for_label) * carried
    return weights


def _allowed(graph: FunctionalGraph, node_id: str, chosen: dict[str, PartLabel]) -> np.ndarray:
    """Returns 1 for each label, but `unknown`, that the stated edges at a node allow; for all where they allow none."""
    edges = [e for e in graph.edges if node_id in ends_of(e) and not isinstance(e, Contact)]
    allowed = np.ones(len(LABELS))
    allowed[UNKNOWN] = 0.0
    for k, label in enumerate(LABELS[:-1]):
        settled = {**chosen, node_id: label}
        ends = ([settled.get(end, graph.node(end).label) for end in ends_of(edge)] for edge in edges)
        allowed[k] = all(is_allowed(edge, *pair) for edge, pair in zip(edges, ends, strict=True))
    if not allowed.any():
        allowed[:-1] = 1.0
    return allowed
