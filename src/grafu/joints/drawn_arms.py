"""Arms and stays that the input draws behind a lid or flap: which parts they are, by joints, by names and by shape.

They are part of the leaf's mechanism: no obstacle to it, and no furniture that stays where it is.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Coupling
from grafu.asset.names import spoken
from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.config_checks import at_scale
from grafu.geometry.mesh import merge_meshes
from grafu.joints.bars import Bar, bars_of
from grafu.joints.drawn_arm_config import DEFAULT_DRAWN_ARM_CONFIG, DrawnArmConfig
from grafu.joints.motion_choice import MotionChoice, Moves, Side, axis_of_motion
from grafu.joints.plan import DrawnArms, JointRequest, MotionRole, RealizationPlan
from grafu.scene.border import part_axes
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

_LIFTED = MotionChoice(Moves.LIFTS, Side.TOP)
_NAMES = frozenset({"stay", "stays", "strut", "struts", "piston", "gasspring"})
_ARMS = frozenset({"arm", "arms", "spring", "support"})
_OF_LEAF = frozenset({"lift", "lid", "flap", "gas", "stay"})
_UP = 2


def with_drawn_arms(
    plan: RealizationPlan, asset: Asset, config: DrawnArmConfig = DEFAULT_DRAWN_ARM_CONFIG
) -> RealizationPlan:
    """Returns the plan in which flaps on arms rise upright with these, and other drawn arms and stays are known."""
    scaled = at_scale(config, metre_on(asset.extent))
    plan = _with_stated(plan, asset, scaled)
    taken = {drawn.flap for drawn in plan.arms}
    found: list[DrawnArms] = []
    for request in plan.joints:
        if request.moving in taken or not _opens_up(request, asset, scaled):
            continue
        parts = _behind(request, plan, asset, scaled)
        left = tuple(part for part in parts if all(part.id not in one.parts for one in found))
        if left:
            found.append(_arms(request, left, asset, scaled))
    return replace(plan, arms=(*plan.arms, *found)) if found else plan


def _with_stated(plan: RealizationPlan, asset: Asset, config: DrawnArmConfig) -> RealizationPlan:
    """Returns the plan in which flaps whose joints are on arms that turn on the case rise on these."""
    by_part = {request.moving: request for request in plan.joints}
    lifts = {
        r.moving: by_part[r.parent]
        for r in plan.joints
        if r.parent in by_part and _lifts(by_part[r.parent], r, asset, config)
    }
    if not lifts:
        return plan
    gone: set[str] = set()
    arms: list[DrawnArms] = []
    changed: dict[str, JointRequest] = {}
    for name, lead in lifts.items():
        flap = by_part[name]
        with_it = [r for r in plan.joints if r.coupling and r.coupling.leader == lead.moving and r.moving != name]
        with_it = [r for r in with_it if _is_one_axis(r, lead, config)]
        parts = dict.fromkeys(p for r in (lead, *with_it) for p in (r.moving, *r.attached))
        own = tuple(part for part in parts if part not in (name, *flap.attached))
        gone |= {r.moving for r in (lead, *with_it)}
        arms.append(_stated_arms(flap, lead, own, asset, config))
        axis = axis_of_motion(asset.part(name), _LIFTED, asset.box)
        changed[name] = replace(
            flap, axis=axis, reference=None, mounts=(), parent="", coupling=None, role=MotionRole.LIFTED
        )
    joints = tuple(changed.get(r.moving, r) for r in plan.joints if r.moving not in gone)
    return replace(plan, joints=joints, arms=(*plan.arms, *arms))


def _lifts(lead: JointRequest, flap: JointRequest, asset: Asset, config: DrawnArmConfig) -> bool:
    """Whether a part on the case turns about a level axis and carries an upright door that turns back by as much."""
    if not (lead.kind.turns and flap.kind.turns) or lead.parent or lead.coupling or lead.drawn_at or flap.drawn_at:
        return False
    if asset.part(lead.moving).label.is_movable or asset.part(flap.moving).label is not PartLabel.DOOR:
        return False
    along = [request.axis.direction for request in (lead, flap)]
    if float(along[0] @ along[1]) > -config.opposite or abs(float(along[0][_UP])) > config.level:
        return False
    return flap.coupling is None or _is_step(flap.coupling, lead.moving, config)


def _is_step(coupling: Coupling, leader: str, config: DrawnArmConfig) -> bool:
    return coupling.leader == leader and abs(abs(coupling.multiplier) - 1.0) <= config.step


def _is_one_axis(other: JointRequest, lead: JointRequest, config: DrawnArmConfig) -> bool:
    """Whether an arm on the case turns with the leading one, about one line and alike."""
    assert other.coupling is not None
    apart = float(np.linalg.norm(lead.axis.closest_point(other.axis.point) - other.axis.point))
    alike = float(other.axis.direction @ lead.axis.direction) >= config.opposite
    return not other.parent and alike and apart <= config.within and _is_step(other.coupling, lead.moving, config)


def _stated_arms(
    flap: JointRequest, lead: JointRequest, parts: tuple[str, ...], asset: Asset, config: DrawnArmConfig
) -> DrawnArms:
    """Returns arms on the axes that are stated; where these were predicted, on those that the arms show."""
    shown = _arms(flap, tuple(asset.part(part) for part in parts), asset, config, is_lift=True)
    if flap.coupling is None and shown.on_case is not None:
        return shown
    upper = min((r.reference for r in (lead, flap) if r.reference is not None), default=shown.upper)
    return DrawnArms(flap.moving, parts, lead.axis, flap.axis.reversed(), upper)


@final
@dataclass(frozen=True, eq=False)
class _Behind:
    """The room behind a leaf: along the hinge's line, from its hinge border to the free edge, and into the case."""

    axes: np.ndarray
    low: Vec3
    high: Vec3

    def local(self, points: np.ndarray) -> np.ndarray:
        """Returns points (n, 3) along, across and behind the leaf, metres."""
        return np.asarray(points @ self.axes)

    @property
    def wide(self) -> float:
        """The leaf's size from its hinge border to its free edge, metres."""
        return float(self.high[1] - self.low[1])


def _room(request: JointRequest, part: Part) -> _Behind:
    sides, center = part_axes(part.mesh), part.box.center
    along = request.axis.direction
    out = sides[:, int(np.argmax(np.abs(sides.T @ request.kind.sets_off(request.axis, center))))]
    out = out * np.sign(float(out @ request.kind.sets_off(request.axis, center)))
    across = np.cross(out, along)
    across = across * np.sign(float(across @ (center - request.axis.closest_point(center))))
    axes = np.column_stack([along, across, -out])
    local = part.mesh.vertices @ axes
    return _Behind(axes, local.min(axis=0), local.max(axis=0))


def _opens_up(request: JointRequest, asset: Asset, config: DrawnArmConfig) -> bool:
    """Whether a lid or flap on the case turns about a level axis, and rises."""
    if not request.kind.turns or request.parent or request.coupling or request.drawn_at:
        return False
    part, axis = asset.part(request.moving), request.axis
    if part.label is not PartLabel.DOOR or abs(float(axis.direction[_UP])) > config.level:
        return False
    from_axis = part.box.center - axis.closest_point(part.box.center)
    out = np.cross(axis.direction, from_axis)
    return float(out[_UP]) > config.level * float(np.linalg.norm(out)) or float(from_axis[_UP]) < 0


def _behind(request: JointRequest, plan: RealizationPlan, asset: Asset, config: DrawnArmConfig) -> tuple[Part, ...]:
    """Returns the arms and stays behind a leaf: those that are called so, else like bars at both its ends."""
    moving = {part for one in plan.joints for part in (one.moving, *one.attached)}
    room = _room(request, asset.part(request.moving))
    inside = [
        p
        for p in asset.parts
        if p.id not in moving
        and not p.carried_by
        and p.label in _ODDS
        and len(p.mesh.faces)
        and _is_in(p, room, config)
    ]
    called = [part for part in inside if _is_called(part)]
    if called:
        return tuple(called)
    bars = [(part, bar) for part in inside for bar in _only_bars(part, config) if _is_arm(bar, room, config)]
    is_pair = any(_are_alike(a, b, room, config) for _, a in bars for _, b in bars)
    return tuple(dict.fromkeys(part for part, _ in bars)) if is_pair else ()


_ODDS = (PartLabel.MISC, PartLabel.UNKNOWN, PartLabel.BAR)


def _is_called(part: Part) -> bool:
    words = set(spoken(part.source.name))
    return bool(words & _NAMES) or bool(words & _ARMS and words & _OF_LEAF)


def _is_in(part: Part, room: _Behind, config: DrawnArmConfig) -> bool:
    """Whether a part lies behind a leaf, within its outline, its nearer end by the inner face."""
    local = room.local(part.mesh.vertices)
    low, high = local.min(axis=0), local.max(axis=0)
    inner = float(room.high[2])
    is_within = (low[:2] >= room.low[:2] - config.within).all() and (high[:2] <= room.high[:2] + config.within).all()
    return bool(is_within and inner - config.within <= low[2] <= inner + config.near)


def _only_bars(part: Part, config: DrawnArmConfig) -> Sequence[Bar]:
    return tuple(bars_of(part.mesh, config.slim))


def _is_arm(bar: Bar, room: _Behind, config: DrawnArmConfig) -> bool:
    """Whether a bar is as long as an arm or a stay, neither level nor square to the leaf, and at one of its ends."""
    direction = np.abs(room.axes.T @ bar.direction)
    if bar.length < config.least * room.wide or direction[2] > config.square or direction[0] > 1 - config.square:
        return False
    at, (low, high) = float(room.local(bar.center[None])[0, 0]), (float(room.low[0]), float(room.high[0]))
    return min(at - low, high - at) <= config.ends * (high - low)


def _are_alike(a: Bar, b: Bar, room: _Behind, config: DrawnArmConfig) -> bool:
    """Whether two bars are at either end of a leaf, alike, and at one place of its depth and height."""
    one, other = room.local(a.center[None])[0], room.local(b.center[None])[0]
    middle = float(room.low[0] + room.high[0]) / 2
    allowed = config.alike * room.wide
    is_apart = one[0] < middle < other[0]
    return bool(is_apart and np.abs(one - other)[1:].max() <= allowed and abs(a.length - b.length) <= allowed)


def _arms(
    request: JointRequest, parts: tuple[Part, ...], asset: Asset, config: DrawnArmConfig, is_lift: bool = False
) -> DrawnArms:
    """Returns the parts as what holds a leaf; of one that is to rise upright with the pivots that their bars show."""
    ids = tuple(part.id for part in parts)
    plain = DrawnArms(request.moving, ids)
    if not parts or not (is_lift or request.role is MotionRole.LIFTED):
        return plain
    flap = asset.part(request.moving)
    room = _room(replace(request, axis=axis_of_motion(flap, _LIFTED, asset.box)), flap)
    mesh = merge_meshes([part.mesh for part in parts])
    bars = [bar for bar in bars_of(mesh, config.slim) if _is_arm(bar, room, config)]
    if not bars:
        return plain
    pivots = [bar.pivots() for bar in bars]  # the lower one carries the flap
    on_flap, on_case = (np.mean([pair[k] for pair in pivots], axis=0) for k in (0, 1))
    arm = on_flap - on_case
    out = -room.axes[:, 2]
    along = room.axes[:, 0] * np.sign(float(np.cross(room.axes[:, 0], arm) @ out) or 1.0)
    below = float(np.arctan2(-arm[_UP], abs(float(arm @ out))))
    upper = below + min(below, config.steepest) - config.spare
    if below <= 0:
        return plain
    return replace(plain, on_case=Axis(on_case, along), on_flap=Axis(on_flap, along), upper=upper)
