"""Whose handle is whose: every handle goes to the door or drawer that it sits on. It looks at boxes alone."""

from typing import Final, final

import numpy as np

from grafu.completion.config import RuleConfig
from grafu.completion.rule_scene import NodeBoxes
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Scalars
from grafu.geometry.box import Box
from grafu.graph.completion import Decision
from grafu.graph.edges import Attached
from grafu.graph.edit import with_edges
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

_FRONTS = (PartLabel.DOOR, PartLabel.DRAWER)
_UP: Final = 2
_FLUSH = 1e-3  # of a handle's largest side: what overlaps by less ends in one plane
_NO_PARENT = "this handle sits on no door or drawer: label the part behind it, or leave it as decoration"


@final
@dataclass(frozen=True)
class Attachments:
    """The graph with its handles attached, their confidences, and the handles that sit on nothing that moves."""

    graph: FunctionalGraph
    decisions: tuple[Decision, ...]
    refused: tuple[Refusal, ...]


def attach_handles(graph: FunctionalGraph, config: RuleConfig = RuleConfig()) -> Attachments:
    """Returns the graph with an attached edge per handle; handles that are attached already stay as they are."""
    movable = NodeBoxes(graph.labelled(*_FRONTS))
    held = {edge.child for edge in graph.attachments}
    edges: list[Attached] = []
    decisions: list[Decision] = []
    refused: list[Refusal] = []
    for handle in graph.labelled(PartLabel.HANDLE):
        if handle.id in held:
            continue
        nodes = () if sits_on_static(handle, graph) else movable.nodes
        misfits = _misfits(handle, movable, graph) if nodes else []
        apart = (stands_apart(handle.box, node, config.handle_apart * float(graph.box.size.max())) for node in nodes)
        fits = ((misfit, n.id) for misfit, n, is_apart in zip(misfits, nodes, apart, strict=True) if not is_apart)
        ranked = sorted(fits, key=lambda item: item[0])
        if not ranked or ranked[0][0] > config.handle_reach:
            refused.append(Refusal(handle.id, Reason.NO_MOTION, _NO_PARENT))
            continue
        edges.append(Attached(ranked[0][1], handle.id))
        decisions.append(_decision(handle, ranked))
    return Attachments(with_edges(graph, edges), tuple(decisions), tuple(refused))


def sits_on_static(handle: PartNode, graph: FunctionalGraph) -> bool:
    """Whether a handle touches what is larger and does not move, and no door or drawer: a knob of an oven.

    Handles that touch one another are pieces of one. Smaller things that it touches are its own posts. What has a
    category of its own carries it only where the handle stands beside all doors and drawers: a handle that hangs before
    one may touch a frame. One that is above a lid and does not touch it is not the lid's: a knob of a washing machine.
    """
    pieces = _pieces(handle, graph)
    touched = [(piece, graph.node(o)) for piece in pieces for o in graph.neighbours[piece.id]]
    if any(node.label in _FRONTS for _, node in touched):
        return False
    beside = all(_stands_beside(handle.box, part) or _is_lid(part) for part in graph.labelled(*_FRONTS))
    others = ((piece, node) for piece, node in touched if node.label is not PartLabel.HANDLE)
    larger = (node for piece, node in others if float(np.sort(node.box.size)[1]) > float(piece.box.size.max()))
    return any(beside or node.label is PartLabel.MISC for node in larger)


def _pieces(handle: PartNode, graph: FunctionalGraph) -> list[PartNode]:
    """Returns the handles that touch a handle, directly or through others, itself counted."""
    found = {handle.id: handle}
    queue = [handle.id]
    while queue:
        touched = (graph.node(other) for other in graph.neighbours[queue.pop()])
        new = {n.id: n for n in touched if n.label is PartLabel.HANDLE and n.id not in found}
        found |= new
        queue += new
    return list(found.values())


def _is_lid(part: PartNode) -> bool:
    return part.label is PartLabel.DOOR and part.box.thin_axis == _UP


def stands_apart(handle: Box, part: PartNode, reach: float) -> bool:
    """Whether a handle stands beside a door or drawer, farther from it than `reach` (metres): it is not its."""
    return _stands_beside(handle, part) and handle.gap(part.box) > reach


def _stands_beside(handle: Box, part: PartNode) -> bool:
    """Whether nothing of a handle lies before or behind a door or drawer, seen from where it may face.

    One that ends in the plane of a face lies before or behind it, not beside.
    """
    flush = _FLUSH * float(handle.size.max())
    apart = (handle.low > part.box.high - flush) | (part.box.low > handle.high - flush)
    faces = (part.box.thin_axis,) if part.label is PartLabel.DOOR else (0, 1)
    return all(bool(np.delete(apart, axis).any()) for axis in faces)


def _misfits(handle: PartNode, parts: NodeBoxes, graph: FunctionalGraph) -> list[float]:
    """Returns how badly a handle fits each part, as a fraction of the object: its gap, and how far it hangs over."""
    extent = max(float(graph.box.size.max()), 1e-9)
    touching = [part.id in graph.neighbours[handle.id] for part in parts.nodes]
    overhang = (1.0 - _ratios_in_front(handle.box, parts)) * float(handle.box.size.max())
    return ((parts.gaps(handle.box) + overhang) / extent - 0.002 * np.array(touching)).tolist()


def _ratios_in_front(handle: Box, parts: NodeBoxes) -> Scalars:
    """Returns for each part the largest fraction of the handle in front of one of its faces, along an axis."""
    inside = parts.overlap_ratios(handle)
    return np.max([np.delete(inside, axis, axis=1).prod(axis=1) for axis in range(3)], axis=0)


def _decision(handle: PartNode, ranked: list[tuple[float, str]]) -> Decision:
    weights = np.exp(-np.array([max(misfit, 0.0) for misfit, _ in ranked]) / 0.01)
    ratios = weights / weights.sum()
    runner_up, second = (ranked[1][1], float(ratios[1])) if len(ranked) > 1 else ("", 0.0)
    return Decision(handle.id, "parent", ranked[0][1], float(ratios[0]), runner_up, second)
