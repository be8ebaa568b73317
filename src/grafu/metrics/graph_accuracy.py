"""How well a graph was completed: the paper's column (supplement, Loss Ablation), and what else a motion hangs on.

Every figure is a fraction: what was right, of how many; fractions of several graphs add up. Motions are read where the
found graph states them. Where the paper's border accuracy may read the network at the true hinge, here a door that was
left without a hinge is wrong.
"""

from collections.abc import Iterable
from dataclasses import fields
from typing import final

import numpy as np
from scipy.optimize import linear_sum_assignment

from grafu.dataclass import dataclass
from grafu.graph.arrays import (
    ATTACHED,
    CONTACT,
    HINGE,
    NONE,
    NULL,
    RAIL,
    SLIDE,
    TURN,
    UNKNOWN,
    GraphArrays,
    graph_arrays,
)
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph
from grafu.shapes import Bool, Int64

NEAR = 0.1  # of the object's largest side: an added part farther off is not the one that is missing
_DISTANCE_WEIGHT = 2.0  # against 1 for another label: the paper's weights of the assignment


@final
@dataclass(frozen=True, slots=True)
class Ratio:
    """So much of so much: right answers of all, or a sum of errors of their number."""

    part: float = 0.0
    whole: float = 0.0

    def __add__(self, other: "Ratio") -> "Ratio":
        return Ratio(self.part + other.part, self.whole + other.whole)

    @property
    def value(self) -> float:
        """The quotient; not a number where there was nothing to answer."""
        return self.part / self.whole if self.whole else float("nan")


@final
@dataclass(frozen=True, slots=True)
class GraphAccuracy:
    """The figures of one graph or, added, of many.

    - `existence`: F1 of nodes, input nodes included (the paper's first figure). `added`: F1 of added nodes alone, right
      only with the label of a missing one and its centre within `NEAR`.
    - `category`: found nodes with the true label. `centre`, `half`: their mean absolute errors per coordinate (the
      paper's centroid MAE); `added_centre`: that of added nodes alone; all as fractions of the object's largest side.
    - `edges`: true edges found with their kind. `contact`, `hinge`, `rail`, `attached`, `slides`, `turns`: F1 by kind.
    - `border`, `sign`, `joint` (both) of true hinged doors, `slide`: the signed axis of what truly slides or turns.
    - `mount`: hinged doors that hang on a part that they truly hang on; `parent`: attached handles on their part.
    """

    existence: Ratio = Ratio()
    added: Ratio = Ratio()
    category: Ratio = Ratio()
    centre: Ratio = Ratio()
    half: Ratio = Ratio()
    added_centre: Ratio = Ratio()
    edges: Ratio = Ratio()
    contact: Ratio = Ratio()
    hinge: Ratio = Ratio()
    rail: Ratio = Ratio()
    attached: Ratio = Ratio()
    slides: Ratio = Ratio()
    turns: Ratio = Ratio()
    border: Ratio = Ratio()
    sign: Ratio = Ratio()
    joint: Ratio = Ratio()
    slide: Ratio = Ratio()
    mount: Ratio = Ratio()
    parent: Ratio = Ratio()

    def __add__(self, other: "GraphAccuracy") -> "GraphAccuracy":
        return GraphAccuracy(*(getattr(self, f.name) + getattr(other, f.name) for f in fields(self)))

    def by_name(self) -> dict[str, float]:
        """Returns every figure by name; those of which there was nothing to measure are not a number."""
        return {f.name: getattr(self, f.name).value for f in fields(self)}


def graph_accuracy(found: GraphCompletion | FunctionalGraph, truth: FunctionalGraph) -> GraphAccuracy:
    """Returns how well `found` states what `truth` states.

    Nodes with one id are one part. The others are added parts: each answers for the missing part that it is most like
    in label and place, one to one.
    """
    graph = found.completed if isinstance(found, GraphCompletion) else found
    mine, true = graph_arrays(graph), graph_arrays(truth)
    place = {node.id: k for k, node in enumerate(truth.nodes)}
    known = np.array([place.get(node.id, NONE) for node in graph.nodes], dtype=np.int64)
    extent = float(truth.box.size.max()) or 1.0
    return compare_graphs(mine, true, pair_added(mine, true, known, extent), known == NONE, extent)


def total_accuracy(accuracies: Iterable[GraphAccuracy]) -> GraphAccuracy:
    """Returns the figures over all nodes, edges and motions of many graphs together."""
    return sum(accuracies, GraphAccuracy())


def pair_added(
    found: GraphArrays, truth: GraphArrays, known: Int64[np.ndarray, " f"], extent: float
) -> Int64[np.ndarray, " f"]:
    """Returns for each found node its true node: `known` where that is not `NONE`, else by label and place."""
    paired = known.copy()
    added, missing = np.flatnonzero(known == NONE), np.setdiff1d(np.arange(len(truth.labels)), known)
    other = found.labels[added][:, None] != truth.labels[missing][None, :]
    apart = np.linalg.norm(found.boxes[added][:, None, :3] - truth.boxes[missing][None, :, :3], axis=-1) / extent
    rows, columns = linear_sum_assignment(other + _DISTANCE_WEIGHT * apart)
    paired[added[rows]] = missing[columns]
    return paired


def compare_graphs(
    found: GraphArrays,
    truth: GraphArrays,
    pairing: Int64[np.ndarray, " f"],
    added: Bool[np.ndarray, " f"],
    extent: float,
) -> GraphAccuracy:
    """Returns the figures of found nodes against true ones, given which answers for which.

    `pairing` holds a true node for each found one, or `NONE`; `added` marks those that the input lacked; `extent` is
    the object's largest side.
    """
    place = np.full(len(truth.labels), NONE)  # of each true node among the found ones
    place[pairing[pairing != NONE]] = np.flatnonzero(pairing != NONE)
    return GraphAccuracy(
        *_node_figures(found, truth, pairing, added, extent),
        *_edge_figures(found, truth, place),
        *_motion_figures(found, truth, place),
        *(_choice_figure(found, truth, pairing, kind) for kind in (HINGE, ATTACHED)),
    )


def _node_figures(
    found: GraphArrays, truth: GraphArrays, pairing: np.ndarray, added: np.ndarray, extent: float
) -> tuple[Ratio, ...]:
    """Returns existence, added, category, centre, half, added centre."""
    mine, theirs = np.flatnonzero(pairing != NONE), pairing[pairing != NONE]
    apart = (found.boxes[mine] - truth.boxes[theirs]) / extent
    distance = np.linalg.norm(apart[:, :3], axis=1)
    same, labelled, new = found.labels[mine] == truth.labels[theirs], truth.labels[theirs] != UNKNOWN, added[mine]
    missing = len(truth.labels) - int((~added).sum())
    return (
        _f1(len(mine), len(found.labels), len(truth.labels)),
        _f1(int((new & same & (distance <= NEAR)).sum()), int(added.sum()), missing),
        _ratio(same[labelled]),
        Ratio(float(np.abs(apart[:, :3]).sum()), 3.0 * len(mine)),
        Ratio(float(np.abs(apart[:, 3:]).sum()), 3.0 * len(mine)),
        Ratio(float(np.abs(apart[new, :3]).sum()), 3.0 * float(new.sum())),
    )


def _edge_figures(found: GraphArrays, truth: GraphArrays, place: np.ndarray) -> tuple[Ratio, ...]:
    """Returns edges and the six kinds in the order of `GraphAccuracy`; each pair of nodes counts once."""
    once = np.triu(np.ones_like(truth.edges, dtype=bool), 1)
    answered = np.where((place == NONE)[:, None] | (place == NONE)[None, :], NULL, _at(found.edges, place, place))
    true, answer = truth.edges[once], answered[once]
    all_found = found.edges[np.triu(np.ones_like(found.edges, dtype=bool), 1)]
    right = true == answer
    kinds = (
        _f1(int((right & (true == kind)).sum()), int((all_found == kind).sum()), int((true == kind).sum()))
        for kind in (CONTACT, HINGE, RAIL, ATTACHED, SLIDE, TURN)
    )
    return _ratio(right[true != NULL]), *kinds


def _motion_figures(found: GraphArrays, truth: GraphArrays, place: np.ndarray) -> tuple[Ratio, ...]:
    """Returns border, sign, joint, slide."""
    doors, drawers = truth.border != NONE, truth.slide != NONE
    border, sign, slide = (
        (place != NONE) & (_at(mine, place) == true)
        for mine, true in ((found.border, truth.border), (found.sign, truth.sign), (found.slide, truth.slide))
    )
    return _ratio(border[doors]), _ratio(sign[doors]), _ratio((border & sign)[doors]), _ratio(slide[drawers])


def _choice_figure(found: GraphArrays, truth: GraphArrays, pairing: np.ndarray, kind: int) -> Ratio:
    """Returns how many children of edges of a kind hang, by such an edge, on a part that they truly hang on."""
    wanted = truth.child & (truth.edges == kind)
    answered = pairing != NONE
    children, carriers = np.nonzero(found.child & (found.edges == kind) & answered[:, None] & answered[None, :])
    stated = np.zeros_like(wanted)
    stated[pairing[children], pairing[carriers]] = True
    hanging = wanted.any(axis=1)
    return _ratio((stated & wanted).any(axis=1)[hanging])


def _at(values: np.ndarray, rows: np.ndarray, columns: np.ndarray | None = None) -> np.ndarray:
    """Returns the values at some places; what it returns at the place `NONE` means nothing."""
    if not len(values):
        return np.full((len(rows),) if columns is None else (len(rows), len(columns)), NONE)
    return values[rows] if columns is None else values[np.ix_(rows, columns)]


def _f1(right: int, found: int, true: int) -> Ratio:
    return Ratio(2.0 * right, float(found + true))


def _ratio(right: np.ndarray) -> Ratio:
    return Ratio(float(right.sum()), float(right.size))
