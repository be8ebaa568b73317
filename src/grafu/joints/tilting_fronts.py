"""Fronts that tilt about their lower edge with the bin behind them, as of shoe cabinets and hampers, and no further.

A bin is the front's own mesh, parts that ride on it, or parts behind it that hang together and that nothing else holds.
A flap with a bin stops well before it is level: what lies in the bin would fall out.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from math import atan2, radians
from typing import final

import numpy as np

from grafu.asset.names import spoken
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.graph.functional_graph import FunctionalGraph
from grafu.joints.behind_fronts import groups_within, is_within_outline, static_boxes, touched_by
from grafu.joints.motion_choice import MotionChoice, Moves, Side, axis_of_motion
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.border import pitched_border_frame
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

_WORDS = frozenset({"tilt", "tilting", "tiltout", "tip", "tipout", "kippfront", "kippklappe"})
_OF_PIECES = frozenset({"shoe", "shoes", "schuhschrank", "schuhkipper", "chaussures", "zapatero", "scarpiera"})
_TILTED = MotionChoice(Moves.TILTS, Side.BOTTOM)
_UP, _DEPTH = 2, 1
_RAYS = 12  # along each side of a front


@final
@dataclass(frozen=True)
class TiltConfig:
    """What counts as a bin behind a front, and how far the two tilt; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("deep", "clear", "reach", "touching", "before", "tray")
    opening: float = radians(45)
    """How far a front with a bin tilts where the input states nothing (radians)."""
    most: float = radians(60)
    """What is stated to open wider than this is a flap, whatever is behind it (radians)."""
    level: float = 0.9
    """From this cosine on to the horizontal an axis is level."""
    lower: float = 0.25
    """A front tilts whose axis lies in this lower part of it (fraction of its height)."""
    upright: float = 0.3
    """Least height of a front with a bin, over how far it reaches from its axis (fraction): a lid lies flat."""
    deep: float = 0.1
    """How far a bin reaches behind its front at least (metres) ..."""
    of_height: float = 0.3
    """... and that over the front's height (fraction): thick doors of ovens stay below."""
    wide: float = 0.6
    """Least width of a bin (fraction of the front's)."""
    clear: float = 0.002
    """A bin stays this far within the outline of its front (metres)."""
    reach: float = 0.02
    """How far behind the front a bin's near end lies at most (metres)."""
    low: float = 1.1
    """Greatest height of a front that was taken for a door at a side, and has a bin (fraction of its width)."""
    steep: float = 1.2
    """Least height of what tilts with its own bin in a shoe cabinet, over its depth (ratio): drawers are deeper."""
    tall: float = 0.5
    """Least height of that bin (fraction of the front's)."""
    beyond: float = 0.02
    """How much farther from the lower edge than the front's upper edge something of it may be (fraction)."""
    before: float = 0.15
    """What is no farther behind a front than this (metres) ..."""
    tray: float = 0.02
    """... and no nearer than this, as a small tray must find room (metres), ..."""
    closed: float = 0.6
    """... on this much of it (fraction) leaves no room for a drawer: a basin, before which the front tilts ..."""
    uppermost: float = 0.75
    """... where that ends above this (fraction of the height of the whole) ..."""
    squat: float = 0.4
    """... and is no higher than this (fraction of its width)."""
    touching: float = 0.004
    """What is nearer to a bin than this and touches it holds it (metres)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(
            self, "level", "lower", "upright", "of_height", "wide", "tall", "beyond", "closed", "squat", "uppermost"
        )


def with_shown_tilts(
    plan: RealizationPlan, asset: Asset, graph: FunctionalGraph, config: TiltConfig = TiltConfig()
) -> RealizationPlan:
    """Returns a predicted plan in which fronts turn about their lower edges that are called tilting, or have a bin.

    So does a low front right before a basin: no drawer has room behind it.

    What is higher than deep in a piece that is called a shoe cabinet tilts with the bin in its own mesh.
    A front that was taken for a door at a side has a bin behind it where that fits no other motion: it is as high as
    half of the front at least, and nothing of it is farther from the lower edge than the front's upper edge is.
    """
    config = at_scale(config, metre_on(asset.extent))
    moving = {part for request in plan.joints for part in (request.moving, *request.attached)}
    static = static_boxes(asset, moving)
    joints = (_as_tilting(r, asset) if _is_shown(r, asset, static, graph, config) else r for r in plan.joints)
    stopped = (
        replace(_as_tilting(r, asset), stop=config.opening) if _is_before_basin(r, asset, graph, config) else r
        for r in joints
    )
    return replace(plan, joints=tuple(stopped))


def _is_shown(
    request: JointRequest, asset: Asset, static: Mapping[str, Box], graph: FunctionalGraph, config: TiltConfig
) -> bool:
    part = asset.part(request.moving)
    front = part.box
    if request.parent or request.coupling:
        return False
    is_front = part.label.is_movable or front.thin_axis == _DEPTH
    if is_front and _WORDS & set(spoken(part.source.name)):
        return True
    own = {part.id, *request.attached}
    if is_front and _OF_PIECES & set(spoken(asset.name)) and front.size[_UP] >= config.steep * front.size[_DEPTH]:
        boxes = [front, *(asset.part(name).box for name in request.attached)]
        return _has_bin(_as_tilting(request, asset), front, boxes, config)
    if not part.label.is_movable:
        return False
    low = front.thin_axis == _DEPTH and front.size[_UP] <= config.low * front.size[0]
    if not (low and request.kind.turns) or float(np.linalg.norm(request.axis.direction[:_UP])) > 1 - config.level:
        return False
    found = _bin(front, own, static, asset, graph, config)
    points = np.vstack([asset.part(name).mesh.vertices for name in found]) if found else np.zeros((0, 3))
    tilted = _as_tilting(request, asset)
    return _has_bin(tilted, front, [static[name] for name in found], config) and _fits(points, tilted, front, config)


def _is_before_basin(request: JointRequest, asset: Asset, graph: FunctionalGraph, config: TiltConfig) -> bool:
    """Whether a low plate with a handle and no box was to slide out, and a basin closes the room right behind it."""
    if request.parent or request.coupling:
        return False
    front, own = asset.part(request.moving).box, [asset.part(name) for name in request.attached]
    handles = [part for part in own if graph.node(part.id).label is PartLabel.HANDLE]
    is_plate = front.thin_axis == _DEPTH and front.size[_DEPTH] <= config.deep
    if not (request.kind.slides and is_plate and handles) or len(handles) < len(own):
        return False
    whole = asset.box
    is_top = front.high[_UP] >= whole.low[_UP] + config.uppermost * whole.size[_UP]
    if not is_top or front.size[_UP] > config.squat * front.size[0]:
        return False
    moving = {request.moving, *request.attached}
    behind = [p.mesh for p in asset.parts if p.id not in moving and not graph.node(p.id).label.is_movable]
    if not behind:
        return False
    steps = (np.arange(_RAYS) + 0.5) / _RAYS
    places = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2) * front.size[[0, _UP]]
    origins = np.insert(front.low[[0, _UP]] + places, 1, float(front.high[_DEPTH]), axis=1)
    met = RayCaster(merge_meshes(behind)).along(origins, np.eye(3)[_DEPTH])
    return float(((met <= config.before) & (met >= config.tray)).mean()) >= config.closed


def _fits(points: Points, tilted: JointRequest, front: Box, config: TiltConfig) -> bool:
    """Whether a bin is high enough, and stays within the circle about the lower edge that reaches the upper one."""
    tall = float(front.size[_UP])
    high = float(np.ptp(points[:, _UP])) >= config.tall * tall
    return high and float(tilted.axis.distances_to(points).max()) <= (1 + config.beyond) * tall


def _as_tilting(request: JointRequest, asset: Asset) -> JointRequest:
    axis = axis_of_motion(asset.part(request.moving), _TILTED, asset.box)
    return replace(request, type=_TILTED.type, axis=axis, reference=None, mounts=())


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
    inwards = np.abs(np.cross(np.eye(3)[_UP], request.axis.direction))
    if float(box.size[_UP]) < config.upright * float(box.size @ inwards):
        return False
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
    behind = _bin(front.box, own, static, asset, graph, config)
    upright, boxes = _upright(
        request, [asset.part(name).mesh for name in (front.id, *request.attached, *behind)], config
    )
    if not (is_stated or _has_bin(upright, boxes[0], boxes, config)):
        return request
    stop = min(request.reference or config.opening, config.most)
    return replace(request, attached=(*request.attached, *behind), reference=stop, stop=stop)


def _bin(
    front: Box,
    own: set[str],
    static: Mapping[str, Box],
    asset: Asset,
    graph: FunctionalGraph,
    config: TiltConfig,
) -> tuple[str, ...]:
    """Returns the parts behind a front that it alone holds: they touch it, or end right behind it, and nothing else."""
    inside = [name for name, box in static.items() if is_within_outline(box, front, config.clear)]
    found: list[str] = []
    for group in groups_within(inside, graph):
        box = Box.enclosing(static[name] for name in group)
        near = float(box.low[_DEPTH] - front.high[_DEPTH]) <= config.reach
        held = (name for name in touched_by(group, asset, graph, own) if _is_near(name, group, asset, config))
        if near and box.size[_DEPTH] >= config.reach and not any(True for _ in held):
            found += group
    return tuple(found)


def _is_near(name: str, group: Collection[str], asset: Asset, config: TiltConfig) -> bool:
    """Whether a part is as near to one of a group as what holds it: contacts of a graph are wider on large pieces."""
    box = asset.part(name).box
    return any(asset.part(member).box.gap(box) <= config.touching for member in group)


def _has_bin(request: JointRequest, front: Box, boxes: list[Box], config: TiltConfig) -> bool:
    """Whether what a front takes along reaches deep behind its axis, along most of its width; its mesh may do so."""
    along = np.abs(request.axis.direction)
    inwards = np.cross(np.eye(3)[_UP], request.axis.direction)
    least = max(config.deep, config.of_height * float(front.size[_UP]))
    ends = [float((box.center - request.axis.point) @ inwards + box.half @ np.abs(inwards)) for box in boxes]
    deep = [box for box, end in zip(boxes, ends, strict=True) if end >= least]
    return bool(deep) and float(Box.enclosing(deep).size @ along) >= config.wide * float(front.size @ along)


def _upright(
    request: JointRequest, meshes: Sequence[TriangleMesh], config: TiltConfig
) -> tuple[JointRequest, list[Box]]:
    """Returns the request and the boxes of a front and of what it takes along, turned upright if the front leans.

    A plate that leans is no bin, though the box around it is deep: it stands half open, or slopes as it is closed.
    """
    frame = pitched_border_frame(meshes[0], request.axis)
    leaf, axis = frame.direction(1.0, 0.0, 0.0), frame.axis_at(0.0, 0.0)
    if frame.thickness >= max(config.deep, config.of_height * frame.width):
        return request, [mesh.box for mesh in meshes]
    T = axis.rotation(-atan2(float(leaf @ np.cross(axis.direction, np.eye(3)[_UP])), float(leaf[_UP])))
    return replace(request, axis=axis), [mesh.transformed(T).box for mesh in meshes]
