"""Completes a graph by rules of geometry: the baseline and the fallback of the network.

It looks at labels, boxes and contacts. Every door leaves with a hinge or a refusal, every drawer with its rails, every
handle with its door or drawer. Edges that the input states already are kept as they are.

Labels for unlabelled parts, where shape and place say clearly what moves; everything else stays static.

A handle is a small piece in front of an upright front; a front with a handle opens. Where most of a model is
unlabelled, a plate that closes the front is a door and a box that reaches the front is a drawer, with less confidence.
It looks at boxes alone: which of two plates is a false front, no box can tell.
"""

from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.completion.answers import move_parts
from grafu.completion.doors import hang_door, slide_door
from grafu.completion.drawers import run_drawer
from grafu.completion.handles import attach_handles
from grafu.completion.rule_scene import RuleScene, offset_ratio, overlap_ratio
from grafu.geometry.box import Box
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import SignedAxis
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import code_to_direction, opposite
from grafu.vocabulary import PartLabel

_FRONTS: tuple[SignedAxis, ...] = (2, 3, 0, 1)
_WITH_HANDLE, _WITHOUT = 0.8, 0.5  # scores of a guess

# All lengths below are fractions of the object's largest side.
_PLATE = 0.07  # thickest door
_LEAST_SIDE = 0.1  # narrowest door
_LEAST_DEPTH = 0.12  # shallowest drawer
_SKIN = 0.1  # how far behind the outermost face a front may lie
_HANDLE = 0.08  # thickest handle
_TOUCH = 0.01
_SLAB = 0.08  # a lower box without a handle may be a thick panel


@final
@dataclass(frozen=True, slots=True)
class _FrontGuess:
    """An unlabelled part that may open in `direction`."""

    node: PartNode
    direction: SignedAxis
    label: PartLabel


def guess_labels(graph: FunctionalGraph) -> tuple[dict[str, PartLabel], tuple[Decision, ...]]:
    """Returns labels for some of the unknown parts, and a decision with its score for each."""
    unknown = graph.labelled(PartLabel.UNKNOWN)
    if not unknown:
        return {}, ()
    fronts = [front for node in unknown for front in _fronts_of(node, graph)]
    handles = _handles(unknown, graph)
    found: dict[str, tuple[PartLabel, float]] = {}
    for front in fronts:
        own = [h for h in (*handles, *graph.labelled(PartLabel.HANDLE)) if _sits_in_front(h.box, front, graph)]
        found |= {h.id: (PartLabel.HANDLE, _WITH_HANDLE) for h in own if h.label is PartLabel.UNKNOWN}
        if own:
            found[front.node.id] = (_label_with_handles(front, own), _WITH_HANDLE)
        elif _mostly_unknown(graph) and front.direction == 2 and front.node.id not in found and _closes(front, graph):
            found[front.node.id] = (front.label, _WITHOUT)
    named = {part: label for part, (label, _) in found.items()}
    decisions = (
        Decision(part, "label", label.value, score, PartLabel.UNKNOWN.value, 1 - score)
        for part, (label, score) in found.items()
    )
    return named, tuple(decisions)


def _label_with_handles(front: _FrontGuess, handles: list[PartNode]) -> PartLabel:
    """Returns the front's label: a wide plate with its handle in the very middle is the front of a drawer."""
    box, across = front.node.box, 1 - front.direction // 2
    middle = np.mean([h.box.center for h in handles], axis=0)
    centred = abs(offset_ratio(box, middle, across)) < 0.15 and abs(offset_ratio(box, middle, 2)) < 0.3
    wide = float(box.size[across]) >= 1.2 * float(box.size[2])
    return PartLabel.DRAWER if centred and wide else front.label


def _mostly_unknown(graph: FunctionalGraph) -> bool:
    return 2 * len(graph.labelled(PartLabel.UNKNOWN)) > len(graph.nodes)


def _extent(graph: FunctionalGraph) -> float:
    return max(float(graph.box.size.max()), 1e-9)


def _fronts_of(node: PartNode, graph: FunctionalGraph) -> list[_FrontGuess]:
    """Returns the directions in which a part may open, by its shape and by how near to the outside it lies."""
    size, found = node.box.size / _extent(graph), []
    for direction in _FRONTS:
        depth, across = float(size[direction // 2]), float(size[1 - direction // 2])
        if _behind_outside(node.box, direction, graph) > _SKIN or (node.box.thin_axis == 2 and depth < _LEAST_DEPTH):
            continue
        if depth <= _PLATE and min(across, size[2]) >= max(_LEAST_SIDE, 2.5 * depth):
            found += [_FrontGuess(node, direction, PartLabel.DOOR)] if not _is_frame(node, direction, graph) else []
        elif depth >= _LEAST_DEPTH and across >= _LEAST_SIDE and 0.03 <= size[2] <= 0.55 and not _is_case(node, graph):
            found.append(_FrontGuess(node, direction, PartLabel.DRAWER))
    return found


def _is_case(node: PartNode, graph: FunctionalGraph) -> bool:
    """Whether a box is as wide and deep as the object, or holds another part of some size: the case of something."""
    ratio = node.box.size / np.maximum(graph.box.size, 1e-9)
    others = (n.box for n in graph.nodes if n.id != node.id and 0.05 < n.box.volume / max(node.box.volume, 1e-12) < 0.9)
    held = any(all(overlap_ratio(box, node.box, a) > 0.95 for a in range(3)) for box in others)
    return held or bool(ratio[0] * ratio[1] > 0.85 and (ratio[2] > 0.6 or node.box.size[2] < _SLAB * _extent(graph)))


def _is_frame(node: PartNode, direction: SignedAxis, graph: FunctionalGraph) -> bool:
    """Whether an upright plate has another plate in it: a face frame, a fixed front with a hole."""
    others = [a for a in range(3) if a != direction // 2]
    extent, least = _extent(graph), _LEAST_SIDE * _extent(graph)
    return any(
        n.id != node.id
        and min(float(n.box.size[a]) for a in others) > least
        and all(overlap_ratio(n.box, node.box, a) > 0.99 and n.box.size[a] < 0.97 * node.box.size[a] for a in others)
        and float(n.box.axis_gaps(node.box)[direction // 2]) <= _TOUCH * extent
        and float(n.box.size[direction // 2]) <= _PLATE * extent
        for n in graph.nodes
    )


def _is_flanked(front: _FrontGuess, graph: FunctionalGraph) -> bool:
    """Whether something stands beside each flank of a box, along most of its height and depth."""
    box, across = front.node.box, 1 - front.direction // 2
    others = (n.box for n in graph.nodes if n.id != front.node.id)
    beside = [b for b in others if all(overlap_ratio(box, b, a) > 0.5 for a in (2, front.direction // 2))]
    sides = {bool(b.center[across] > box.center[across]) for b in beside}
    return len(sides) == 2


def _behind_outside(box: Box, direction: SignedAxis, graph: FunctionalGraph) -> float:
    outward = code_to_direction(direction)
    return float((graph.box.face_center(direction) - box.face_center(direction)) @ outward) / _extent(graph)


def _handles(unknown: tuple[PartNode, ...], graph: FunctionalGraph) -> tuple[PartNode, ...]:
    """Returns the parts that are small enough in two directions to be grasped."""
    extent = _extent(graph)
    return tuple(
        n for n in unknown if np.sort(n.box.size)[1] <= _HANDLE * extent and float(n.box.size.max()) <= 0.6 * extent
    )


def _sits_in_front(handle: Box, front: _FrontGuess, graph: FunctionalGraph) -> bool:
    """Whether a box stands out from a front, within its outline: as wide as the front it would be a batten."""
    box, direction, extent = front.node.box, front.direction, _extent(graph)
    axis, outward = direction // 2, code_to_direction(direction)
    others = [a for a in range(3) if a != axis]
    out = float((handle.face_center(direction) - box.face_center(direction)) @ outward)
    away = float((handle.face_center(opposite(direction)) - box.face_center(direction)) @ outward)
    inside = all(overlap_ratio(handle, box, a) > 0.95 for a in others)
    widest = 0.9 if direction == 2 else 0.6  # on the sides and the back, posts and battens are more common than handles
    smaller = all(handle.size[a] < widest * box.size[a] for a in others)
    return inside and smaller and out > 0 and away <= _TOUCH * extent


def _closes(front: _FrontGuess, graph: FunctionalGraph) -> bool:
    """Whether a front without a handle looks like one that opens: upright, not a plinth, nothing before it."""
    size = front.node.box.size
    across, height = float(size[1 - front.direction // 2]), float(size[2])
    if front.label is PartLabel.DOOR and (across > 4 * height or height > 12 * across):
        return False
    if front.label is PartLabel.DRAWER and (height < _SLAB * _extent(graph) or not _is_flanked(front, graph)):
        return False
    return not any(_covers(node, front) for node in graph.nodes if node.id != front.node.id)


def _covers(node: PartNode, front: _FrontGuess) -> bool:
    axis, outward = front.direction // 2, code_to_direction(front.direction)
    ahead = float((node.box.center - front.node.box.face_center(front.direction)) @ outward) > 0
    others = [a for a in range(3) if a != axis]
    return ahead and float(np.prod([overlap_ratio(front.node.box, node.box, a) for a in others])) > 0.3


def complete_by_rule(graph: FunctionalGraph) -> GraphCompletion:
    """Returns the graph with a motion, or a stated reason against it, for every door and drawer.

    Parts without a label become doors, drawers or handles where their shape and place say so clearly. Scores are
    fractions of votes in 0..1: they rank decisions and are no probabilities.
    """
    labels, label_decisions = guess_labels(graph)
    attached = attach_handles(relabelled(graph, labels))
    scene = RuleScene(attached.graph)
    motions = move_parts(
        scene,
        lambda door: hang_door(door, scene),
        lambda drawer: run_drawer(drawer, scene),
        lambda door, other: slide_door(door, other, scene),
    )
    return GraphCompletion(
        graph,
        with_edges(scene.graph, motions.edges),
        "rule",
        (),
        (*label_decisions, *attached.decisions, *motions.decisions),
        (*attached.refused, *motions.refused),
    )
