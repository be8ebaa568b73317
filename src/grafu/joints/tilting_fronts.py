"""Fronts that tilt about their lower edge with the bin behind them, as of shoe cabinets and hampers, and no further.

A bin is the front's own mesh, parts that ride on it, or parts behind it that hang together and that nothing else holds.
A flap with a bin stops well before it is level: what lies in the bin would fall out.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from math import radians
from typing import final

import numpy as np

from grafu.asset.names import spoken
from grafu.asset.part import Asset
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.graph.functional_graph import FunctionalGraph
from grafu.joints.behind_fronts import groups_within, is_within_outline, static_boxes, touched_by
from grafu.joints.motion_choice import MotionChoice, Moves, Side, axis_of_motion
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.scene import metre_on

_WORDS = frozenset({"tilt", "tilting", "tiltout", "kippfront", "kippklappe"})
_OF_PIECES = frozenset({"shoe", "shoes", "schuhschrank", "schuhkipper", "chaussures", "zapatero", "scarpiera"})
_TILTED = MotionChoice(Moves.TILTS, Side.BOTTOM)
_UP, _DEPTH = 2, 1


@final
@dataclass(frozen=True)
class TiltConfig:
    """What counts as a bin behind a front, and how far the two tilt; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("deep", "clear", "reach")
    opening: float = radians(45)
    """How far a front with a bin tilts where the input states nothing (radians)."""
    most: float = radians(60)
    """What is stated to open wider than this is a flap, whatever is behind it (radians)."""
    level: float = 0.9
    """From this cosine on to the horizontal an axis is level."""
    lower: float = 0.25
    """A front tilts whose axis lies in this lower part of it (fraction of its height)."""
    deep: float = 0.07
    """How far a bin reaches behind its front at least (metres) ..."""
    of_height: float = 0.15
    """... and that over the front's height (fraction)."""
    wide: float = 0.6
    """Least width of a bin (fraction of the front's)."""
    clear: float = 0.002
    """A bin stays this far within the outline of its front (metres)."""
    reach: float = 0.02
    """How far behind the front a bin's near end lies at most (metres)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "level", "lower", "of_height", "wide")


def stated_tilts(motions: Mapping[str, MotionChoice]) -> frozenset[str]:
    """Returns the ids of the parts that the user states to tilt."""
    return frozenset(part for part, choice in motions.items() if choice.moves is Moves.TILTS)


def with_named_tilts(plan: RealizationPlan, asset: Asset) -> RealizationPlan:
    """Returns a predicted plan in which fronts that are called tilting turn about their lower edges."""
    return replace(plan, joints=tuple(_named(request, asset) for request in plan.joints))


def _named(request: JointRequest, asset: Asset) -> JointRequest:
    part = asset.part(request.moving)
    if request.parent or request.coupling or not _WORDS & set(spoken(part.source.name)):
        return request
    return replace(request, type=_TILTED.type, axis=axis_of_motion(part, _TILTED, asset.box), reference=None, mounts=())


def with_tilts(
    plan: RealizationPlan,
    asset: Asset,
    graph: FunctionalGraph,
    stated: Collection[str] = (),
    config: TiltConfig = TiltConfig(),
) -> RealizationPlan:
    """Returns the plan in which fronts that drop take the bins behind them along, and open no further than those may.

    Fronts that are `stated` to tilt, or called so, stop there without a bin, too.
    """
    if not any(_drops(request, asset, config) for request in plan.joints):
        return plan
    config = at_scale(config, metre_on(asset.extent))
    moving = {part for request in plan.joints for part in (request.moving, *request.attached)}
    static = static_boxes(asset, moving)
    of_piece = bool(_OF_PIECES & set(spoken(asset.name)))
    named = {p.id for p in asset.parts if of_piece or _WORDS & set(spoken(p.source.name))}
    joints = (
        _tilted(r, asset, static, graph, r.moving in named or r.moving in stated, config)
        if _drops(r, asset, config)
        else r
        for r in plan.joints
    )
    return replace(plan, joints=tuple(joints))


def _drops(request: JointRequest, asset: Asset, config: TiltConfig) -> bool:
    """Whether an upright front turns about its lower edge."""
    if not request.kind.turns or float(np.linalg.norm(request.axis.direction[:_UP])) < config.level:
        return False
    box = asset.part(request.moving).box
    return float(request.axis.point[_UP] - box.low[_UP]) <= config.lower * float(box.size[_UP])


def _tilted(
    request: JointRequest,
    asset: Asset,
    static: Mapping[str, Box],
    graph: FunctionalGraph,
    is_stated: bool,
    config: TiltConfig,
) -> JointRequest:
    if request.reference is not None and request.reference > config.most and not is_stated:
        return request
    front = asset.part(request.moving)
    own = {front.id, *request.attached}
    behind = _bin(front.box, own, static, graph, config)
    boxes = [front.box, *(asset.part(name).box for name in (*request.attached, *behind))]
    if not (is_stated or _has_bin(request, front.box, boxes, config)):
        return request
    stop = min(request.reference or config.opening, config.most)
    return replace(request, attached=(*request.attached, *behind), reference=stop, stop=stop)


def _bin(
    front: Box, own: set[str], static: Mapping[str, Box], graph: FunctionalGraph, config: TiltConfig
) -> tuple[str, ...]:
    """Returns the parts behind a front that it alone holds: they touch it, or end right behind it, and nothing else."""
    inside = [name for name, box in static.items() if is_within_outline(box, front, config.clear)]
    found: list[str] = []
    for group in groups_within(inside, graph):
        box = Box.enclosing(static[name] for name in group)
        near = float(box.low[_DEPTH] - front.high[_DEPTH]) <= config.reach
        if near and box.size[_DEPTH] >= config.reach and not touched_by(group, graph, own):
            found += group
    return tuple(found)


def _has_bin(request: JointRequest, front: Box, boxes: list[Box], config: TiltConfig) -> bool:
    """Whether what a front takes along reaches deep behind its axis, along most of its width; its mesh may do so."""
    along = np.abs(request.axis.direction)
    inwards = np.cross(np.eye(3)[_UP], request.axis.direction)
    least = max(config.deep, config.of_height * float(front.size[_UP]))
    ends = [float((box.center - request.axis.point) @ inwards + box.half @ np.abs(inwards)) for box in boxes]
    deep = [box for box, end in zip(boxes, ends, strict=True) if end >= least]
    return bool(deep) and float(Box.enclosing(deep).size @ along) >= config.wide * float(front.size @ along)
