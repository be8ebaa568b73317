"""Which parts that are only guessed to be doors or drawers stay static: by shape, by what they carry, or as too weak.

A label that the input states is no guess.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.completion.guessed_shapes import shape_against
from grafu.completion.lids_above import lid_on
from grafu.completion.twins import static_twin
from grafu.completion.wall_panels import wall_behind
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import triangle_bounds
from grafu.graph.completion import BY_BOTH, Decision, GraphCompletion
from grafu.graph.edges import Hinge, Rail, ends_of
from grafu.graph.edit import relabelled, without_edges, without_nodes
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import MOVABLE_VALUES, PartLabel


@final
@dataclass(frozen=True, slots=True)
class StaticGuessConfig:
    """From where on a part that is guessed to be a door or drawer moves.

    Raises:
        ValueError: if a fraction is not between 0 and 1, or `legs` not above 0.
    """

    slide: float = 0.5
    """Least score of the side that a drawer slides to. Of 150 real drawers whose names were hidden the least has 0.65;
    what has less on other models is no drawer: a burner, a stair, a mattress."""
    sign: float = 0.6
    """Least score of the side that a door opens to: below it both are alike, which they are of no front of a case. Of
    107 real doors whose names were hidden the least has 0.90."""
    label: float = 0.45
    """Least score of being a door or a drawer, together."""
    alone: float = 0.5
    """A part carries what is above it where nothing else stands at as much of its height (fraction) ..."""
    covers: float = 0.5
    """... and what is above covers as much of it, seen from above (fraction)."""
    touch: float = 0.01
    """How far a part may end above the floor, or what it carries below its top (fraction of the largest side)."""
    legs: int = 3
    """So many legs that end below a part carry it."""
    closed: float = 0.8
    """What slides away from another front that covers this much of it is the case behind that front (fraction) ..."""
    front: float = 0.3
    """... whose thickness is at most this (fraction of the depth of what it covers)."""
    cuts: float = 0.1
    """What cuts into what stays in more of its poses than this, as it was built, was guessed wrong (fraction). No joint
    of 55 real pieces whose names were hidden does in any."""

    def __post_init__(self) -> None:
        require_ratios(self, *(name for name in self.__dataclass_fields__ if name != "legs"))
        require_positive(self, "legs")


_UP = 2


def with_static_guesses(
    completion: GraphCompletion, asset: Asset, config: StaticGuessConfig = StaticGuessConfig()
) -> GraphCompletion:
    """Returns the completion in which no part moves that is only guessed to, and cannot; all others move as they did.

    What stays static is refused with the reason, and of no category, whose runner-up is what it was taken for. What was
    added to it is left out.
    """
    while doubtful := tuple(static_guesses(completion, asset, config)):
        completion = with_static(completion, doubtful)
    return completion


def with_static(completion: GraphCompletion, doubtful: Sequence[Refusal]) -> GraphCompletion:
    """Returns the completion in which the parts that are refused stay static; what hangs on them still moves.

    Each was guessed to be a door or drawer, and becomes what its name states, or a part of no category.
    """
    still, graph = {refusal.part for refusal in doubtful}, completion.completed
    stated = {node.id: node.label for node in completion.input.nodes if node.label is not PartLabel.UNKNOWN}
    called = {name: label for name, label in stated.items() if not label.is_movable}
    gone = {e.child for e in graph.attachments if e.parent in still and e.child in completion.added}
    moved = {frozenset(ends_of(edge)) for edge in graph.motions if edge.child in still}
    as_parts = relabelled(graph, {name: called.get(name, PartLabel.MISC) for name in still})
    rest = without_edges(as_parts, [edge for edge in as_parts.edges if frozenset(ends_of(edge)) in moved])

    def is_kept(decision: Decision) -> bool:
        is_moot = decision.part in gone or (decision.question == "parent" and decision.choice in still)
        is_guess = decision.question == "label" and decision.part not in called
        return not is_moot and (decision.part not in still or is_guess)

    return replace(
        completion,
        completed=without_nodes(rest, gone),
        added=tuple(name for name in completion.added if name not in gone),
        decisions=tuple(_as_static(d) if d.part in still else d for d in completion.decisions if is_kept(d)),
        refused=(*(refusal for refusal in completion.refused if refusal.part not in still | gone), *doubtful),
        rides=tuple(pair for pair in completion.rides if (still | gone).isdisjoint(pair)),
    )


def _as_static(guess: Decision) -> Decision:
    """Returns the decision that a part is of no category, against what it was taken for."""
    score = guess.runner_up_score if guess.runner_up == PartLabel.MISC else 0.0
    return Decision(guess.part, "label", PartLabel.MISC, score, guess.choice, guess.score, BY_BOTH)


def static_guesses(
    completion: GraphCompletion, asset: Asset, config: StaticGuessConfig = StaticGuessConfig()
) -> Iterator[Refusal]:
    """Yields a refusal for each part that is only guessed to be a door or drawer, and stays static.

    What the input has a handle on moves as it is predicted, unless no door or drawer has its shape.
    """
    graph = completion.completed
    guesses = [(d, graph.node(d.part)) for d in guessed_to_move(completion)]
    bounds = {part.id: _Bounds.of(part) for part in asset.parts} if guesses else {}
    touch = config.touch * float(asset.box.size.max())
    for guess, node in guesses:
        taken, held = taken_for(guess), _is_held(node, completion)
        if not held and (
            carried := _carried(node, completion, bounds, asset.box, config) or lid_on(node, completion, touch)
        ):
            yield Refusal(node.id, Reason.CARRIES, f"{taken}, but {carried} stands on it and on nothing else")
        elif not held and _stands_on_legs(node, completion, asset.box, config):
            yield Refusal(node.id, Reason.CARRIES, f"{taken}, but legs carry it")
        elif not held and (front := _front_of_case(node, graph, asset.box, config)):
            yield Refusal(node.id, Reason.UNLIKELY, f"{taken}, but it would slide away from {front}, which closes it")
        elif not held and (wall := _wall_of_door(node, asset, graph)):
            yield Refusal(node.id, Reason.UNLIKELY, f"{taken}, but it lies on {wall}, a wall with nothing behind it")
        elif not held and (twin := static_twin(guess, completion, touch)):
            yield Refusal(node.id, Reason.UNLIKELY, f"{taken}, but {twin} on the other side is like it, and is none")
        elif (not held and (why := _unlikely(node, guess, completion, config))) or (
            why := shape_against(node, asset, graph, held)
        ):
            yield Refusal(node.id, Reason.UNLIKELY, f"{taken}, but {why}")


def _wall_of_door(node: PartNode, asset: Asset, graph: FunctionalGraph) -> str:
    return wall_behind(node, asset, graph) if node.label is PartLabel.DOOR else ""


def guessed_to_move(completion: GraphCompletion) -> tuple[Decision, ...]:
    """Returns the decisions on the labels of doors and drawers that the input does not call either."""
    graph, given = completion.completed, {n.id for n in completion.input.nodes if n.label.is_movable}
    labelled = (decision for decision in completion.decisions if decision.question == "label")
    return tuple(d for d in labelled if graph.node(d.part).label.is_movable and d.part not in given)


def taken_for(guess: Decision) -> str:
    """Returns in words what a part was guessed to be, from the decision on its label."""
    return f"it is taken for a {guess.choice} ({guess.score:.0%})"


def _unlikely(node: PartNode, guess: Decision, completion: GraphCompletion, config: StaticGuessConfig) -> str:
    """Returns why a guess is too weak, in words; empty where it is not."""
    sure = guess.score + (guess.runner_up_score if guess.runner_up in MOVABLE_VALUES else 0.0)
    if sure < config.label:
        return "it is likelier neither door nor drawer"
    motion = next(iter(completion.completed.motions_of(node.id)), None)
    if isinstance(motion, Hinge):
        decision, least = completion.decision(node.id, "sign"), config.sign
    elif isinstance(motion, Rail):
        decision, least = completion.decision(node.id, "slide"), config.slide
    else:
        return ""
    if decision is None or decision.score >= least:
        return ""
    return f"which way it would open is not clear ({decision.score:.0%})"


def _carried(
    node: PartNode, completion: GraphCompletion, bounds: Mapping[str, "_Bounds"], whole: Box, config: StaticGuessConfig
) -> str:
    """Returns the static part that a part alone keeps up; empty for none.

    At a height at which nothing else stands it bears all that is above: a drawer from what is below it, as it may hang
    from what is above where nothing is; a door from the floor, as a lid lies on a case.
    """
    touched = [completion.completed.node(name) for name in completion.input.neighbours[node.id]]
    supports = {other.id for other in touched if other.label.is_support}
    if not supports:
        return ""
    touch = config.touch * float(whole.size.max())
    others = [name for name in bounds if name != node.id and not _rides(name, node, completion)]
    low, high = _alone(node.box, [bounds[name].within(node.box) for name in others])
    if high - low < config.alone * node.box.size[2]:
        return ""
    if node.label is PartLabel.DOOR:
        stands = node.box.low[2] <= whole.low[2] + touch
    else:
        stands = any(bounds[name].low[:, 2].min() <= low - touch for name in supports)
    if not stands:
        return ""
    return next((n for n in sorted(supports) if bounds[n].covered(node.box, high - touch) >= config.covers), "")


def _stands_on_legs(node: PartNode, completion: GraphCompletion, whole: Box, config: StaticGuessConfig) -> bool:
    """Whether several legs end below a part that they touch, within its outline: the frame of a bed or a table."""
    touch = config.touch * float(whole.size.max())
    touched = (completion.completed.node(name) for name in completion.input.neighbours[node.id])
    boxes = [other.box for other in touched if other.label is PartLabel.LEG]
    under = [
        box
        for box in boxes
        if abs(float(box.high[2] - node.box.low[2])) <= touch
        and bool((box.center[:2] >= node.box.low[:2]).all() and (box.center[:2] <= node.box.high[:2]).all())
    ]
    return len(under) >= config.legs


def _front_of_case(node: PartNode, graph: FunctionalGraph, whole: Box, config: StaticGuessConfig) -> str:
    """Returns the door or drawer that covers the face opposite to where a part would slide to; empty for none."""
    rail = next((rail for rail in graph.rails if rail.child == node.id), None)
    if rail is None or rail.axis // 2 == _UP:
        return ""
    axis, box, reach = rail.axis // 2, node.box, config.touch * float(whole.size.max())
    across = [k for k in range(3) if k != axis]
    area = max(float(np.prod(box.size[across])), 1e-12)
    for other in graph.nodes:
        front = other.box
        if other.id == node.id or not other.label.is_movable or front.size[axis] > config.front * box.size[axis]:
            continue
        gap = box.low[axis] - front.high[axis] if rail.axis % 2 else front.low[axis] - box.high[axis]
        shared = np.maximum(np.minimum(front.high, box.high) - np.maximum(front.low, box.low), 0.0)[across]
        if abs(float(gap)) <= reach and float(np.prod(shared)) >= config.closed * area:
            return other.id
    return ""


def _is_held(node: PartNode, completion: GraphCompletion) -> bool:
    """Whether a handle that the input has is on one of the sides of a part."""
    graph = completion.completed
    handles = [e.child for e in graph.attachments if e.parent == node.id and e.child not in completion.added]
    boxes = [graph.node(handle).box for handle in handles]
    return any(node.box.low[2] <= box.center[2] <= node.box.high[2] for box in boxes)


def _rides(name: str, node: PartNode, completion: GraphCompletion) -> bool:
    """Whether a part touches nothing but the node, beside it: it is fixed to its side."""
    box = completion.completed.node(name).box
    beside = box.low[2] >= node.box.low[2] and box.high[2] <= node.box.high[2]
    return bool(beside) and set(completion.input.neighbours[name]) == {node.id}


@final
@dataclass(frozen=True, slots=True)
class _Bounds:
    """The lowest and highest corners of the triangles of a part, metres."""

    low: Points
    high: Points

    @classmethod
    def of(cls, part: Part) -> "_Bounds":
        """Returns the corners of a part's triangles."""
        return cls(*triangle_bounds(part.mesh.triangles))

    def within(self, box: Box) -> "_Bounds":
        """Returns the corners of those triangles that stand at the heights of a box."""
        near = (self.high[:, 2] > box.low[2]) & (self.low[:, 2] < box.high[2])
        return _Bounds(self.low[near], self.high[near])

    def covered(self, box: Box, height: float) -> float:
        """Returns the fraction of a box that lies below what is above a height, seen from above."""
        above = self.low[:, 2] >= height
        if not above.any():
            return 0.0
        low = np.maximum(self.low[above].min(axis=0), box.low)[:2]
        high = np.minimum(self.high[above].max(axis=0), box.high)[:2]
        return float(np.prod(np.maximum(high - low, 0.0) / np.maximum(box.size[:2], 1e-9)))


def _alone(box: Box, others: Sequence[_Bounds]) -> tuple[float, float]:
    """Returns the lowest and the highest end of the largest span of a box's height in which nothing else is."""
    low = np.concatenate([[box.low[2]], *(one.low[:, 2] for one in others), [box.high[2]]])
    high = np.concatenate([[box.low[2]], *(one.high[:, 2] for one in others), [box.high[2]]])
    order = np.argsort(low, kind="stable")
    starts = np.clip(low[order][1:], box.low[2], box.high[2])
    ends = np.clip(np.maximum.accumulate(high[order])[:-1], box.low[2], box.high[2])
    largest = int(np.argmax(starts - ends))
    return float(ends[largest]), float(starts[largest])
