"""The network's answers taken at their face, the likeliest everywhere, as graphs in arrays: for figures in training.

Nothing is repaired: a door may hang nowhere, a drawer on one rail. What is used on furniture is decoded with more care
(`grafu.completion`).
"""

import numpy as np
from torch import Tensor

from grafu.graph.arrays import ATTACHED, DOOR, DRAWER, HANDLE, HINGE, NONE, NULL, RAIL, GraphArrays
from grafu.metrics.graph_accuracy import GraphAccuracy, compare_graphs, pair_added
from grafu.network.predictions import Predictions
from grafu.training.targets import TargetBatch

_CHILD_OF = {HINGE: DOOR, RAIL: DRAWER, ATTACHED: HANDLE}


def batch_accuracy(predictions: Predictions, targets: TargetBatch) -> list[GraphAccuracy]:
    """Returns how right the answers are, graph by graph; lengths are shares of the object's largest side."""
    scores = {name: _array(value) for name, value in vars(predictions).items()}
    wanted = {name: _array(value) for name, value in vars(targets).items()}
    width = wanted["anchors"].shape[1]
    return [
        _accuracy(_found({k: v[g] for k, v in scores.items() if v.ndim}, width), {k: v[g] for k, v in wanted.items()})
        for g in range(len(wanted["labels"]))
    ]


def _accuracy(answer: tuple[GraphArrays, np.ndarray], wanted: dict[str, np.ndarray]) -> GraphAccuracy:
    found, slots = answer
    real = wanted["mask"]
    truth = GraphArrays(
        wanted["labels"][real],
        wanted["boxes"][real].astype(np.float64),
        wanted["edges"][real][:, real],
        wanted["child"][real][:, real],
        *(wanted[name][real] for name in ("border", "sign", "slide")),
    )
    known = np.full(len(slots), NONE)
    anchored = slots < len(wanted["anchors"])
    known[anchored] = wanted["anchors"][slots[anchored]]
    return compare_graphs(found, truth, pair_added(found, truth, known, 1.0), known == NONE, 1.0)


def _found(scores: dict[str, np.ndarray], width: int) -> tuple[GraphArrays, np.ndarray]:
    """Returns the graph that is answered, and the slot of each of its nodes; the first `width` slots are inputs."""
    free = np.arange(len(scores["mask"])) >= width
    slots = np.flatnonzero(scores["mask"] & (~free | (scores["exists"] > 0)))
    pairs = np.ix_(slots, slots)
    labels = scores["category"][slots].argmax(axis=-1)
    edges = scores["edge"][pairs].argmax(axis=-1)
    np.fill_diagonal(edges, NULL)
    child = np.zeros_like(edges, dtype=bool)
    for kind, label in _CHILD_OF.items():
        child |= (edges == kind) & (labels == label)[:, None]
    boxes = np.hstack([scores["centre"][slots], scores["half"][slots]]).astype(np.float64)
    hinged, railed = child & (edges == HINGE), child & (edges == RAIL)
    mount = _best(scores["hinge_target"][pairs], hinged)
    runner = _best(scores["edge"][pairs][..., RAIL], railed)
    motions = (
        _at(scores["border"][pairs], mount),
        _at(scores["sign"][pairs], mount),
        _at(scores["slide"][pairs], runner),
    )
    return GraphArrays(labels, boxes, edges, child, *motions), slots


def _best(scores: np.ndarray, among: np.ndarray) -> np.ndarray:
    """Returns for each row the best of the columns that count, `NONE` where none does."""
    if not len(scores):
        return np.zeros(0, dtype=np.int64)
    return np.where(among.any(axis=1), np.where(among, scores, -np.inf).argmax(axis=1), NONE)


def _at(scores: np.ndarray, column: np.ndarray) -> np.ndarray:
    """Returns the likeliest code of each row at its column, `NONE` where it has none."""
    rows = np.arange(len(column))
    return np.where(column == NONE, NONE, scores[rows, column].argmax(axis=-1)) if len(column) else column


def _array(value: Tensor) -> np.ndarray:
    value = value.detach()
    return (value.float() if value.is_floating_point() else value).cpu().numpy()
