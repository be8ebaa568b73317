"""What is only guessed to be a drawer, but is a front alone that no drawer can be behind, is a flap or a door.

A shelf or a divider stands close behind its middle, as in a secretary: a drawer would run into it. Or it is higher by
far than wide, as the doors of lockers are, begins above the eyes of a person, or has its handle at a side. It is wide
and higher than what is behind it is deep, as the fronts of shoe cabinets and dishwashers are. In a robot description
whose other drawers have boxes, a front alone is none.
"""

from collections.abc import Mapping, Set
from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.part import ROBOTS, Asset
from grafu.completion.boards_behind import BoardBehindConfig, is_board_behind
from grafu.completion.rehang import upright_borders
from grafu.completion.ways_out import rest_of
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
    edge: float = 0.25
    """How far from the lower or upper border the middle of a handle is at most that shows the other one (fraction of
    the height)."""
    off: float = 0.25
    """How far off the middle a handle is that shows a side (fraction of the width)."""
    squat: float = 0.4
    """A handle off the middle shows no door that is lower than this (fraction of its width)."""
    wide: float = 1.2
    """From this width on, in heights, a front without such a handle hangs on its lower border, else on its left."""
    tall: float = 2.0
    """From this height on, in widths, a front alone is a door, unless its handle is in the middle of its width ..."""
    high: float = 1.4
    """What begins higher than this above the floor (m) is no drawer: nothing in it could be seen. On furniture of
    usual size."""
    narrow: float = 0.22
    """... and from this width on (m): narrower ones may be pull-outs for bottles and spices."""
    deep: float = 1.2
    """What is higher than this, in depths of the whole behind it, is no drawer ..."""
    boxed: float = 0.4
    """Where another drawer of a robot description reaches this far back (fraction of the depth of the whole), boxes are
    drawn behind fronts, and a front alone is no drawer."""
    broad: float = 0.75
    """... if it is as wide as this (in heights): narrower ones may be pull-outs."""

    def __post_init__(self) -> None:
        require_positive(self, "wide", "tall", "high", "narrow", "deep", "broad")
        require_ratios(self, "plate", "box", "edge", "off", "squat", "boxed")


def with_lone_fronts(
    completion: GraphCompletion,
    asset: Asset,
    config: LoneFrontConfig = LoneFrontConfig(),
    boards: BoardBehindConfig = BoardBehindConfig(),
) -> GraphCompletion:
    """Returns the completion in which guessed drawers that can be none turn about a border. Labelled ones stay."""
    graph = completion.completed
    guessed = {d.part for d in completion.decisions if d.question == "label" and d.choice == PartLabel.DRAWER}
    rails = [edge for edge in graph.motions if isinstance(edge, Rail) and edge.child in guessed]
    fronts = [r for r in rails if r.axis == _FRONT and r.coupling is None and is_alone(r.child, graph, config)]
    given = frozenset(node.id for node in completion.input.nodes)
    draws_boxes = asset.kind in ROBOTS and any(
        graph.node(rail.child).box.size[_DEPTH] >= config.boxed * graph.box.size[_DEPTH]
        for rail in graph.rails
        if rail.child in given
    )
    found: dict[Rail, HingeBorder] = {}
    for rail in fronts:
        side = _side_of_tall(rail.child, graph, given, config)
        side = _side_of_held(rail.child, graph, given, config) if side is None else side
        if side is not None:
            found[rail] = side
        elif (box := graph.node(rail.child).box).low[_UP] - graph.box.low[_UP] >= config.high:
            found[rail] = _border(rail.child, graph, config, lifts=True)
        elif (
            draws_boxes
            or _is_higher_than_deep(box, graph.box, config)
            or is_board_behind(box, graph.box, rest_of(asset, rail.child, graph), boards)
        ):
            found[rail] = _border(rail.child, graph, config)
    return as_doors(completion, found) if found else completion


def is_alone(front: str, graph: FunctionalGraph, config: LoneFrontConfig = LoneFrontConfig()) -> bool:
    """Whether a front is an upright plate, and nothing that rides on it is as deep as a drawer."""
    box, depth = graph.node(front).box, float(graph.box.size[_DEPTH])
    riding = [graph.node(edge.child).box for edge in graph.attachments if edge.parent == front]
    is_plate = box.thin_axis == _DEPTH and box.size[_DEPTH] <= config.plate * depth
    return bool(is_plate and all(one.size[_DEPTH] <= config.box * depth for one in riding))


def _is_higher_than_deep(front: Box, whole: Box, config: LoneFrontConfig) -> bool:
    """Whether a broad front is higher than all that lies behind it is deep: no drawer is."""
    behind, height = float(whole.high[_DEPTH] - front.high[_DEPTH]), float(front.size[_UP])
    return height >= config.deep * behind and float(front.size[_LEVEL]) >= config.broad * height


def _border(front: str, graph: FunctionalGraph, config: LoneFrontConfig, *, lifts: bool = False) -> HingeBorder:
    """Returns the border on which such a front hangs: a wide one without a handle drops, or `lifts`."""
    box = graph.node(front).box
    at = _handle_at(front, graph)
    if at is not None and not config.edge < at[1] < 1.0 - config.edge:
        return face_to_border(_DEPTH, signed_axis(_UP, positive=at[1] <= config.edge))
    if at is not None and abs(at[0] - 0.5) >= config.off:
        return upright_borders(_DEPTH)[0 if at[0] > 0.5 else 1]
    if box.size[_LEVEL] >= config.wide * box.size[_UP]:
        return face_to_border(_DEPTH, signed_axis(_UP, positive=lifts))
    return upright_borders(_DEPTH)[0]


def _side_of_tall(front: str, graph: FunctionalGraph, given: Set[str], config: LoneFrontConfig) -> HingeBorder | None:
    """Returns the side on which a front hangs that is too high for its width to be a drawer's, else None.

    Only handles that the input has tell: predicted ones are placed as on drawers.
    """
    box, at = graph.node(front).box, _handle_at(front, graph, given)
    is_tall = box.size[_LEVEL] >= config.narrow and box.size[_UP] >= config.tall * box.size[_LEVEL]
    if not is_tall or (at is not None and abs(at[0] - 0.5) < config.off):
        return None
    return upright_borders(_DEPTH)[0 if at is None or at[0] > 0.5 else 1]


def _side_of_held(front: str, graph: FunctionalGraph, given: Set[str], config: LoneFrontConfig) -> HingeBorder | None:
    """Returns the side away from the handle that the input has at one side of a front, else None: drawers have none."""
    box, at = graph.node(front).box, _handle_at(front, graph, given)
    is_squat = box.size[_UP] < config.squat * box.size[_LEVEL]
    if is_squat or at is None or not config.off <= abs(at[0] - 0.5) <= 0.5:
        return None
    return upright_borders(_DEPTH)[0 if at[0] > 0.5 else 1]


def _handle_at(front: str, graph: FunctionalGraph, given: Set[str] | None = None) -> tuple[float, float] | None:
    """Returns how far from the left and from below the middle of a front's handles is (fractions of its sides).

    Only those `given` count; None: all.
    """
    riding = (graph.node(edge.child) for edge in graph.attachments if edge.parent == front)
    counted = (node for node in riding if given is None or node.id in given)
    handles = [node.box.center for node in counted if node.label is PartLabel.HANDLE]
    if not handles:
        return None
    box = graph.node(front).box
    at = (np.mean(handles, axis=0) - box.low) / np.maximum(box.size, 1e-12)
    return float(at[_LEVEL]), float(at[_UP])


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
