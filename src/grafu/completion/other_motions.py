"""How parts move that are neither doors nor drawers: racks and baskets slide, buttons are pressed, knobs turn."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from grafu.completion.answers import decision_of
from grafu.completion.view import GraphView
from grafu.completion.votes import ranking_of
from grafu.geometry.arrays import Scalars
from grafu.graph.arrays import SLIDE, TURN
from grafu.graph.completion import Decision
from grafu.graph.edges import SIGNED_AXES, Slide, Turn
from grafu.graph.functional_graph import FunctionalGraph, PartNode, is_allowed
from grafu.vocabulary import PartLabel

_KINDS: Final[Mapping[int, type[Slide | Turn]]] = {SLIDE: Slide, TURN: Turn}
_ELSEWHERE: Final = (PartLabel.DOOR, PartLabel.DRAWER, PartLabel.HANDLE)
"""What these do is decided with their hinges, rails and parents."""
_LOOSE: Final = (PartLabel.SHELF, PartLabel.MISC)
_ON_FRONTS: Final = (PartLabel.MISC, PartLabel.BAR)
"""What may move on a door or drawer, as its knobs and buttons do; of a panel the door moves on the panel."""


def other_motions(view: GraphView, graph: FunctionalGraph) -> tuple[tuple[Slide | Turn, ...], tuple[Decision, ...]]:
    """Returns the slides and turns of the input's other parts, with the confidence of each axis.

    Of a shelf or fitting and a panel that the network joins by such an edge, the first one moves, else the smaller one;
    a shelf or fitting is no larger than half of the whole. `graph` has the motions of doors and drawers; what moves
    there, or carries what does, is left as it is.
    """
    edges: list[Slide | Turn] = []
    decisions: list[Decision] = []
    volumes = np.prod(view.high - view.low, axis=1)
    settled = graph.moving | {edge.parent for edge in graph.motions}
    for node in graph.nodes:
        if node.id not in view.given - settled or node.label in _ELSEWHERE:
            continue
        answer = _motion_of(node, view, graph, volumes)
        if answer is not None:
            edges.append(answer[0])
            decisions.append(answer[1])
    return tuple(edges), tuple(decisions)


def _motion_of(
    node: PartNode, view: GraphView, graph: FunctionalGraph, volumes: Scalars
) -> tuple[Slide | Turn, Decision] | None:
    """Returns the likeliest slide or turn of a part on another one; None where none is likely enough.

    A door that slides is joined so to its own track: nothing slides on it.
    """
    slot, nodes = view.place[node.id], graph.nodes
    sliding = {edge.child for edge in graph.slides}
    carriers = [k for k, n in enumerate(nodes) if n.id in view.given and _moves_on(slot, k, view, volumes)]
    chances = {
        (kind, k): float(view.probabilities.edge[slot, k, code])
        for code, kind in _KINDS.items()
        for k in carriers
        if _fits(kind(nodes[k].id, node.id, 0), graph) and not (kind is Slide and nodes[k].id in sliding)
    }
    best = max(chances, key=lambda key: chances[key], default=None)
    if best is None or chances[best] < view.config.other_motion:
        return None
    kind, carrier = best
    axes = ranking_of(SIGNED_AXES, chances[best] * view.probabilities.slide[slot, carrier])
    edge = kind(nodes[carrier].id, node.id, axes.choice)
    return edge, decision_of(node.id, "slide" if kind is Slide else "turn", axes)


def _fits(edge: Slide | Turn, graph: FunctionalGraph) -> bool:
    parent, child = graph.node(edge.parent).label, graph.node(edge.child).label
    return is_allowed(edge, parent, child, parent_moves=edge.parent in graph.moving)


def _moves_on(slot: int, other: int, view: GraphView, volumes: Scalars) -> bool:
    """Whether of two parts that are joined by a slide or turn the first one moves."""
    mine, its = view.graph.nodes[slot].label, view.graph.nodes[other].label
    if its.is_movable:
        return mine in _ON_FRONTS and bool(volumes[slot] < volumes[other])
    half = 0.5 * float(np.prod(view.graph.box.size))
    is_loose, is_other_loose = mine in _LOOSE and volumes[slot] < half, its in _LOOSE and volumes[other] < half
    return bool(volumes[slot] < volumes[other] if is_loose == is_other_loose else is_loose)
