"""What is only guessed to be a drawer, but is a front alone that no drawer can be behind, is a flap or a door.

A shelf or a divider stands close behind its middle, as in a secretary: a drawer would run into it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.completion.rehang import upright_borders
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.graph.completion import BY_BOTH, Decision, GraphCompletion
from grafu.graph.edges import Hinge, HingeBorder, Rail
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import face_to_border, sign_for_opening, signed_axis
from grafu.vocabulary import PartLabel

_LEVEL: Final = 0
_DEPTH: Final = 1
_UP: Final = 2
_FRONT: Final = 2  # the face that looks to -Y


@final
@dataclass(frozen=True, slots=True)
class LoneFrontConfig:
    """Which fronts have no drawer behind them, and on which border they hang.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    plate: float = 0.12
    """Greatest thickness of a front alone (fraction of the depth of the whole)."""
    box: float = 0.25
    """What rides on it and is deeper is the box of a drawer (the same fraction)."""
    board: float = 0.25
    """Greatest thickness of a shelf or divider (fraction of its next side)."""
    near: float = 0.5
    """How far behind the front it begins at most (fraction of the depth of the whole) ..."""
    deep: float = 0.2
    """... how far it reaches back at least (the same fraction) ..."""
    inside: float = 0.15
    """... how far it is from both borders of the front that it lies between (fraction of their distance) ..."""
    along: float = 0.5
    """... and how much of the front it takes in the other direction (fraction)."""
    edge: float = 0.25
    """How far from the lower or upper border the middle of a handle is at most that shows the other one (fraction of
    the height)."""
    off: float = 0.25
    """How far off the middle a handle is that shows a side (fraction of the width)."""
    wide: float = 1.2
    """From this width on, in heights, a front without such a handle hangs on its lower border, else on its left."""

    def __post_init__(self) -> None:
        require_positive(self, "wide")
        require_ratios(self, "plate", "box", "board", "near", "deep", "inside", "along", "edge", "off")


def with_lone_fronts(completion: GraphCompletion, config: LoneFrontConfig = LoneFrontConfig()) -> GraphCompletion:
    """Returns the completion in which guessed drawers that can be none turn about a border. Labelled ones stay."""
    graph = completion.completed
    guessed = {d.part for d in completion.decisions if d.question == "label" and d.choice == PartLabel.DRAWER}
    rails = [edge for edge in graph.motions if isinstance(edge, Rail) and edge.child in guessed]
    still = _still(graph)
    found = {}
    for rail in rails:
        if rail.axis == _FRONT and rail.coupling is None and is_alone(rail.child, graph, config):
            border = _border(rail.child, graph, still, config)
            if border is not None:
                found[rail] = border
    return as_doors(completion, found) if found else completion


def _still(graph: FunctionalGraph) -> list[Box]:
    """Returns the boxes of what neither moves nor rides on what does."""
    moving = {edge.child for edge in graph.motions}
    riding = {edge.child for edge in graph.attachments if edge.parent in moving}
    return [node.box for node in graph.nodes if node.id not in moving | riding]


def is_alone(front: str, graph: FunctionalGraph, config: LoneFrontConfig = LoneFrontConfig()) -> bool:
    """Whether a front is an upright plate, and nothing that rides on it is as deep as a drawer."""
    box, depth = graph.node(front).box, float(graph.box.size[_DEPTH])
    riding = [graph.node(edge.child).box for edge in graph.attachments if edge.parent == front]
    is_plate = box.thin_axis == _DEPTH and box.size[_DEPTH] <= config.plate * depth
    return bool(is_plate and all(one.size[_DEPTH] <= config.box * depth for one in riding))


def _border(front: str, graph: FunctionalGraph, still: Sequence[Box], config: LoneFrontConfig) -> HingeBorder | None:
    """Returns the border on which such a front hangs; None: it may be that of a drawer."""
    box = graph.node(front).box
    at = _handle_at(front, graph)
    if not any(_is_in_the_way(board, box, graph.box, config) for board in still):
        return None
    if at is not None and not config.edge < at[1] < 1.0 - config.edge:
        return face_to_border(_DEPTH, signed_axis(_UP, positive=at[1] <= config.edge))
    if at is not None and abs(at[0] - 0.5) >= config.off:
        return upright_borders(_DEPTH)[0 if at[0] > 0.5 else 1]
    if box.size[_LEVEL] >= config.wide * box.size[_UP]:
        return face_to_border(_DEPTH, signed_axis(_UP, positive=False))
    return upright_borders(_DEPTH)[0]


def _handle_at(front: str, graph: FunctionalGraph) -> tuple[float, float] | None:
    """Returns how far from the left and from below the middle of a front's handles is (fractions of its sides)."""
    riding = (graph.node(edge.child) for edge in graph.attachments if edge.parent == front)
    handles = [node.box.center for node in riding if node.label is PartLabel.HANDLE]
    if not handles:
        return None
    box = graph.node(front).box
    at = (np.mean(handles, axis=0) - box.low) / np.maximum(box.size, 1e-12)
    return float(at[_LEVEL]), float(at[_UP])


def _is_in_the_way(board: Box, front: Box, whole: Box, config: LoneFrontConfig) -> bool:
    """Whether a shelf or a divider stands close behind the middle of a front."""
    sides, depth = np.sort(board.size), float(whole.size[_DEPTH])
    thin = board.thin_axis
    if thin == _DEPTH or sides[0] > config.board * sides[1] or board.size[_DEPTH] < config.deep * depth:
        return False
    gap = float(board.low[_DEPTH] - front.high[_DEPTH])
    if not -float(front.size[_DEPTH]) <= gap <= config.near * depth:
        return False
    other = _LEVEL if thin == _UP else _UP
    margin = config.inside * float(front.size[thin])
    is_between = front.low[thin] + margin <= board.low[thin] and board.high[thin] <= front.high[thin] - margin
    common = min(board.high[other], front.high[other]) - max(board.low[other], front.low[other])
    return bool(is_between and common >= config.along * front.size[other])


def as_doors(completion: GraphCompletion, borders: Mapping[Rail, HingeBorder]) -> GraphCompletion:
    """Returns the completion in which fronts that were to slide out to the front turn about a border each instead."""
    hinges = {
        rail.child: Hinge(rail.parent, rail.child, border, sign_for_opening(_DEPTH, border, _FRONT))
        for rail, border in borders.items()
    }
    graph = relabelled(completion.completed, dict.fromkeys(hinges, PartLabel.DOOR))
    decisions = (
        one for d in completion.decisions for one in (_of_door(d, hinges[d.part]) if d.part in hinges else [d])
    )
    return replace(completion, completed=with_edges(graph, hinges.values()), decisions=tuple(decisions))


def _of_door(decision: Decision, hinge: Hinge) -> list[Decision]:
    """Returns a decision on a drawer as those on a door."""
    if decision.question == "label":
        scores = dict([*decision.others, (decision.runner_up, decision.runner_up_score)])
        score = scores.get(PartLabel.DOOR.value, 0.0)
        return [Decision(decision.part, "label", PartLabel.DOOR.value, score, decision.choice, decision.score, BY_BOTH)]
    if decision.question == "slide":
        border = Decision(decision.part, "border", str(hinge.border), decision.score, by=BY_BOTH)
        return [border, Decision(decision.part, "sign", str(hinge.sign), decision.score, by=BY_BOTH)]
    return [decision]
