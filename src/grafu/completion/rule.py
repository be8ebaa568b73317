"""Completes a graph by rules of geometry: the baseline and the fallback of the network.

It looks at labels, boxes and contacts. Every door leaves with a hinge or a refusal, every drawer with its rails, every
handle with its door or drawer. Edges that the input states already are kept as they are.

Labels for unlabelled parts, where shape and place say clearly what moves; everything else stays static.

A handle is a small piece in front of an upright front; a front with a handle opens. Where most of a model is
unlabelled, a plate that closes the front is a door and a box that reaches the front is a drawer, with less confidence.
It looks at boxes alone: which of two plates is a false front, no box can tell.
"""

from typing import final

import numpy as np

from grafu.completion.answers import move_parts
from grafu.completion.config import GuessConfig, RuleConfig
from grafu.completion.doors import hang_door, slide_door
from grafu.completion.drawers import run_drawer
from grafu.completion.handles import attach_handles
from grafu.completion.rule_scene import RuleScene, offset_ratio, overlap_ratio
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import SignedAxis
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import code_to_direction, opposite
from grafu.vocabulary import PartLabel

_FRONTS: tuple[SignedAxis, ...] = (2, 3, 0, 1)


@final
@dataclass(frozen=True, slots=True)
class _FrontGuess:
    """An unlabelled part that may open in `direction`."""

    node: PartNode
    direction: SignedAxis
    label: PartLabel


def guess_labels(
    graph: FunctionalGraph, config: GuessConfig = GuessConfig()
) -> tuple[dict[str, PartLabel], tuple[Decision, ...]]:
    """Returns labels for some of the unknown parts, and a decision with its score for each."""
    unknown = graph.labelled(PartLabel.UNKNOWN)
    if not unknown:
        return {}, ()
    fronts = [front for node in unknown for front in _fronts_of(node, graph, config)]
    handles = _handles(unknown, graph, config)
    found: dict[str, tuple[PartLabel, float]] = {}
    mostly_unknown = 2 * len(unknown) > len(graph.nodes)
    for front in fronts:
        own = [h for h in (*handles, *graph.labelled(PartLabel.HANDLE)) if _sits_in_front(h.box, front, graph, config)]
        found |= {h.id: (PartLabel.HANDLE, config.with_handle) for h in own if h.label is PartLabel.UNKNOWN}
        if own:
            found[front.node.id] = (_label_with_handles(front, own, config), config.with_handle)
        elif mostly_unknown and front.direction == 2 and front.node.id not in found and _closes(front, graph, config):
            found[front.node.id] = (front.label, config.without_handle)
    named = {part: label for part, (label, _) in found.items()}
    decisions = (
        Decision(part, "label", label.value, score, PartLabel.UNKNOWN.value, 1 - score)
        for part, (label, score) in found.items()
    )
    return named, tuple(decisions)


def _label_with_handles(front: _FrontGuess, handles: list[PartNode], config: GuessConfig) -> PartLabel:
    """Returns the front's label: a wide plate with its handle in the very middle is the front of a drawer."""
    box, across = front.node.box, 1 - front.direction // 2
    middle = np.mean([h.box.center for h in handles], axis=0)
    aside, aloft = abs(offset_ratio(box, middle, across)), abs(offset_ratio(box, middle, 2))
    centred = aside < config.centred[0] and aloft < config.centred[1]
    wide = float(box.size[across]) >= config.wide * float(box.size[2])
    return PartLabel.DRAWER if centred and wide else front.label


def _extent(graph: FunctionalGraph) -> float:
    return max(float(graph.box.size.max()), 1e-9)


def _fronts_of(node: PartNode, graph: FunctionalGraph, config: GuessConfig) -> list[_FrontGuess]:
    """Returns the directions in which a part may open, by its shape and by how near to the outside it lies."""
    size, found = node.box.size / _extent(graph), []
    for direction in _FRONTS:
        depth, across = float(size[direction // 2]), float(size[1 - direction // 2])
        is_tray = node.box.thin_axis == 2 and depth < config.least_depth
        if _behind_outside(node.box, direction, graph) > config.skin or is_tray:
            continue
        if depth <= config.plate and min(across, size[2]) >= max(config.least_side, config.plate_ratio * depth):
            if not _is_frame(node, direction, graph, config):
                found.append(_FrontGuess(node, direction, PartLabel.DOOR))
        elif _is_box(depth, across, float(size[2]), config) and not _is_case(node, graph, config):
            found.append(_FrontGuess(node, direction, PartLabel.DRAWER))
    return found


def _is_box(depth: float, across: float, height: float, config: GuessConfig) -> bool:
    """Whether a part has the size of a drawer, fractions of the object's largest side."""
    lowest, highest = config.heights
    return depth >= config.least_depth and across >= config.least_side and lowest <= height <= highest


def _is_case(node: PartNode, graph: FunctionalGraph, config: GuessConfig) -> bool:
    """Whether a box is as wide and deep as the object, or holds another part of some size: the case of something."""
    ratio = node.box.size / np.maximum(graph.box.size, 1e-9)
    least, most = config.held
    volume = max(node.box.volume, 1e-12)
    others = (n.box for n in graph.nodes if n.id != node.id and least < n.box.volume / volume < most)
    if any(all(overlap_ratio(box, node.box, a) > config.inside for a in range(3)) for box in others):
        return True
    footprint, height = config.case
    is_slab = bool(node.box.size[2] < config.slab * _extent(graph))
    return bool(ratio[0] * ratio[1] > footprint and (ratio[2] > height or is_slab))


def _is_frame(node: PartNode, direction: SignedAxis, graph: FunctionalGraph, config: GuessConfig) -> bool:
    """Whether an upright plate has another plate in it: a face frame, a fixed front with a hole."""
    others = [a for a in range(3) if a != direction // 2]
    extent, least = _extent(graph), config.least_side * _extent(graph)
    inside, smaller = config.in_frame
    return any(
        n.id != node.id
        and min(float(n.box.size[a]) for a in others) > least
        and all(overlap_ratio(n.box, node.box, a) > inside for a in others)
        and all(n.box.size[a] < smaller * node.box.size[a] for a in others)
        and float(n.box.axis_gaps(node.box)[direction // 2]) <= config.touch * extent
        and float(n.box.size[direction // 2]) <= config.plate * extent
        for n in graph.nodes
    )


def _is_flanked(front: _FrontGuess, graph: FunctionalGraph, config: GuessConfig) -> bool:
    """Whether something stands beside each flank of a box, along most of its height and depth."""
    box, across = front.node.box, 1 - front.direction // 2
    others = (n.box for n in graph.nodes if n.id != front.node.id)
    beside = [b for b in others if all(overlap_ratio(box, b, a) > config.flanked for a in (2, front.direction // 2))]
    sides = {bool(b.center[across] > box.center[across]) for b in beside}
    return len(sides) == 2


def _behind_outside(box: Box, direction: SignedAxis, graph: FunctionalGraph) -> float:
    outward = code_to_direction(direction)
    return float((graph.box.face_center(direction) - box.face_center(direction)) @ outward) / _extent(graph)


def _handles(unknown: tuple[PartNode, ...], graph: FunctionalGraph, config: GuessConfig) -> tuple[PartNode, ...]:
    """Returns the parts that are small enough in two directions to be grasped."""
    thick, long = config.handle * _extent(graph), config.longest_handle * _extent(graph)
    return tuple(n for n in unknown if np.sort(n.box.size)[1] <= thick and float(n.box.size.max()) <= long)


def _sits_in_front(handle: Box, front: _FrontGuess, graph: FunctionalGraph, config: GuessConfig) -> bool:
    """Whether a box stands out from a front, within its outline: as wide as the front it would be a batten."""
    box, direction, extent = front.node.box, front.direction, _extent(graph)
    axis, outward = direction // 2, code_to_direction(direction)
    others = [a for a in range(3) if a != axis]
    out = float((handle.face_center(direction) - box.face_center(direction)) @ outward)
    away = float((handle.face_center(opposite(direction)) - box.face_center(direction)) @ outward)
    inside = all(overlap_ratio(handle, box, a) > config.inside for a in others)
    widest = config.handle_widths[0 if direction == 2 else 1]
    smaller = all(handle.size[a] < widest * box.size[a] for a in others)
    return inside and smaller and out > 0 and away <= config.touch * extent


def _closes(front: _FrontGuess, graph: FunctionalGraph, config: GuessConfig) -> bool:
    """Whether a front without a handle looks like one that opens: upright, not a plinth, nothing before it."""
    size = front.node.box.size
    across, height = float(size[1 - front.direction // 2]), float(size[2])
    flattest, slimmest = config.door_ratios
    if front.label is PartLabel.DOOR and (across > flattest * height or height > slimmest * across):
        return False
    is_slab = height < config.slab * _extent(graph)
    if front.label is PartLabel.DRAWER and (is_slab or not _is_flanked(front, graph, config)):
        return False
    return not any(_covers(node, front, config) for node in graph.nodes if node.id != front.node.id)


def _covers(node: PartNode, front: _FrontGuess, config: GuessConfig) -> bool:
    axis, outward = front.direction // 2, code_to_direction(front.direction)
    ahead = float((node.box.center - front.node.box.face_center(front.direction)) @ outward) > 0
    others = [a for a in range(3) if a != axis]
    return ahead and float(np.prod([overlap_ratio(front.node.box, node.box, a) for a in others])) > config.covered


def complete_by_rule(graph: FunctionalGraph, config: RuleConfig = RuleConfig()) -> GraphCompletion:
    """Returns the graph with a motion, or a stated reason against it, for every door and drawer.

    Parts without a label become doors, drawers or handles where their shape and place say so clearly. Scores are
    fractions of votes in 0..1: they rank decisions and are no probabilities.
    """
    labels, label_decisions = guess_labels(graph, config.guess)
    attached = attach_handles(relabelled(graph, labels), config)
    scene = RuleScene(attached.graph, config)
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
