"""Bins behind doors at the side: buckets that are open above slide out once the door is open, on rails or without.

A bin is known by its shape and size, whatever it is called, or by its name. A bin that its front carries is a pull-out
unit.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.names import spoken
from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster, depths_below
from grafu.graph.edges import Slide
from grafu.graph.functional_graph import FunctionalGraph
from grafu.joints.behind_fronts import groups_within, is_within_outline, static_boxes
from grafu.joints.plan import JointRequest, MotionRole, RealizationPlan
from grafu.scene.scale import metre_on

SOURCE = "rule"
"""`JointRequest.source` of a bin: its shape, or its name, and the door before it show that it slides."""
_WORDS = frozenset({"bin", "bucket", "waste", "trash", "garbage", "rubbish", "recycling", "abfall", "mulleimer"})
_UP, _DEPTH = 2, 1
_OUT = vec3(0.0, -1.0, 0.0)
_RAYS = 16  # along each side of an outline


@final
@dataclass(frozen=True)
class WasteBinConfig:
    """What counts as a bin behind a door at the side; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("clear", "below", "touching")
    upright: float = 0.9
    """From this cosine on to the vertical a door is hinged at a side."""
    clear: float = 0.01
    """A bin stays this far within the outline of its doors (metres)."""
    below: float = 0.02
    """How far below them it ends at most (metres)."""
    touching: float = 0.001
    """What is nearer to a part than this and beside or above it holds it (metres)."""
    low: float = 0.3
    """How far above the lower end of its doors it ends at most, a basin does not (fraction of their height)."""
    wide: float = 0.5
    """Least width of a bin that no name shows (fraction of that of its doors)."""
    deep: float = 0.5
    """Least depth of a bin that no name shows (fraction of the depth of the whole)."""
    tall: float = 0.35
    """Least height of a bin that no name shows (fraction of that of its doors)."""
    open: float = 0.4
    """What of its outline, seen from above, is open down to its lower half at least (fraction)."""
    floor: float = 0.6
    """What of its outline, seen from above, has a floor at least (fraction)."""
    walls: float = 0.7
    """What of its outline, seen from its sides, is covered at least (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, "clear", "below", "touching")
        require_ratios(self, "upright", "low", "wide", "deep", "tall", "open", "floor", "walls")


def with_waste_bins(
    plan: RealizationPlan, asset: Asset, graph: FunctionalGraph, config: WasteBinConfig = WasteBinConfig()
) -> RealizationPlan:
    """Returns the plan in which bins behind doors at the side slide out; joints that it has stay as they are."""
    doors = [asset.part(r.moving).box for r in plan.joints if _hangs_at_side(r, asset.part(r.moving).box, config)]
    if not doors:
        return plan
    config = at_scale(config, metre_on(asset.extent))
    moving = {part for request in plan.joints for part in (request.moving, *request.attached)}
    static = static_boxes(asset, moving)
    behind = {name: _before(box, doors) for name, box in static.items()}
    inside = {name for name, front in behind.items() if front and _is_within(static[name], front, config)}
    inside -= {name for name in inside if _is_fixed(name, inside, static, graph, config)}
    found: list[JointRequest] = []
    for group in groups_within(sorted(inside), graph):
        front = Box.enclosing(box for name in group if (box := behind[name]) is not None)
        parts = [asset.part(name) for name in group]
        if _is_bin(parts, front, asset, config):
            found.append(_sliding(parts))
    return replace(plan, joints=(*plan.joints, *found)) if found else plan


def with_stated_bins(plan: RealizationPlan, asset: Asset, config: WasteBinConfig = WasteBinConfig()) -> RealizationPlan:
    """Returns the plan in which buckets that slide level as the input states, and are no drawers, are bins."""
    joints = (replace(r, role=MotionRole.BIN) if _is_stated(r, asset, config) else r for r in plan.joints)
    return replace(plan, joints=tuple(joints))


def _is_stated(request: JointRequest, asset: Asset, config: WasteBinConfig) -> bool:
    part = asset.part(request.moving)
    free = request.role is MotionRole.NONE and request.source != SOURCE and not part.label.is_movable
    level = request.kind.slides and abs(float(request.axis.direction[_UP])) < config.upright
    return free and level and is_bucket(part.mesh, config)


def _hangs_at_side(request: JointRequest, door: Box, config: WasteBinConfig) -> bool:
    """Whether a front that faces -Y turns about an upright axis."""
    upright = request.kind.turns and abs(float(request.axis.direction[_UP])) >= config.upright
    return bool(upright and door.thin_axis == _DEPTH and not request.parent)


def _before(box: Box, doors: Sequence[Box]) -> Box | None:
    """Returns the box around the doors that a part stands behind; None where there is none."""
    across = [0, _UP]
    near = [d for d in doors if (np.minimum(d.high, box.high) > np.maximum(d.low, box.low))[across].all()]
    before = [door for door in near if door.high[_DEPTH] <= box.center[_DEPTH]]
    return Box.enclosing(before) if before else None


def _is_within(box: Box, front: Box, config: WasteBinConfig) -> bool:
    """Whether a part is behind the outline of its doors; inset ones end above the floor that it stands on."""
    lower = front.low - vec3(0.0, 0.0, config.below + config.clear)
    stands = box.low[_UP] <= front.low[_UP] + config.low * front.size[_UP]
    return bool(stands) and is_within_outline(box, Box(lower, front.high), config.clear)


def _is_fixed(
    name: str, inside: Collection[str], static: Mapping[str, Box], graph: FunctionalGraph, config: WasteBinConfig
) -> bool:
    """Whether something beside or above a part holds it, such as the wall that a runner is on; a bin only stands."""
    box = static[name]
    others = (static[other] for other in graph.neighbours[name] if other in static and other not in inside)
    return any(o.gap(box) <= config.touching and o.high[_UP] > box.low[_UP] + config.clear for o in others)


def _is_bin(parts: Sequence[Part], front: Box, asset: Asset, config: WasteBinConfig) -> bool:
    """Whether parts that hang together are a bucket, and large enough or called a bin."""
    mesh = merge_meshes([part.mesh for part in parts])
    size, whole = mesh.box.size, asset.box.size
    large = size[0] >= config.wide * front.size[0] and size[_DEPTH] >= config.deep * whole[_DEPTH]
    large = bool(large and size[_UP] >= config.tall * front.size[_UP])
    named = any(_WORDS & set(spoken(part.source.name)) for part in parts)
    return (large or named) and is_bucket(mesh, config)


def is_bucket(mesh: TriangleMesh, config: WasteBinConfig = WasteBinConfig()) -> bool:
    """Whether a body is a bucket: open above down to its lower half, with a floor, and closed at its sides."""
    box = mesh.box
    if not (box.size > 0).all():
        return False
    rays, above = RayCaster(mesh), float(box.size.max())
    depths = depths_below(rays, box, _UP, _RAYS, above)
    deep = np.isfinite(depths) & (depths >= float(box.size[_UP]) / 2)
    is_open = float(deep.mean()) >= config.open and float(np.isfinite(depths).mean()) >= config.floor
    sides = (depths_below(rays, box, k, _RAYS, above) for k in (0, _DEPTH))
    return is_open and all(float(np.isfinite(side).mean()) >= config.walls for side in sides)


def _sliding(parts: Sequence[Part]) -> JointRequest:
    largest = max(parts, key=lambda part: float(np.prod(part.box.size)))
    others = tuple(part.id for part in parts if part is not largest)
    axis = Axis(Box.enclosing(part.box for part in parts).center, _OUT)
    return JointRequest(largest.id, Slide.joint_type, axis, SOURCE, attached=others, role=MotionRole.BIN)
