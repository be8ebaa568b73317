"""What carries a table's drop leaf once it is raised: gate legs and brackets swing out below it, lopers slide out.

They are found beside leaves that hang (`drop_leaves`), by name, or by shape: a plank under the top along the frame, or an
open frame that stands on the floor there. They move on what the table has, without hardware. Until the leaf is up it is
in their way, so they wait for it.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import pi
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster, depths_below
from grafu.graph.edges import Hinge, Slide
from grafu.graph.functional_graph import joined_groups
from grafu.joints.drop_leaves import (
    SOURCE,
    HangingLeaf,
    hanging_leaves,
    is_called_support,
    moving_parts,
    with_drop_leaves,
)
from grafu.joints.drop_support_config import DropSupportConfig
from grafu.joints.plan import JointRequest, MotionRole, RealizationPlan
from grafu.scene.scene import metre_on
from grafu.vocabulary import PartLabel

_UP = 2
_RAYS = 16  # along each side of an outline
_QUARTER = pi / 2
_UPRIGHT = vec3(0.0, 0.0, 1.0)


@final
@dataclass(frozen=True, slots=True)
class _Beside:
    """A leaf that hangs, as the parts behind it are seen from it: `axis` looks along the way from the frame to it."""

    leaf: HangingLeaf
    config: DropSupportConfig

    @property
    def across(self) -> int:
        """The axis along the edge of the top that the leaf hangs from."""
        return 1 - self.leaf.axis

    @property
    def out(self) -> Vec3:
        """From the frame to the leaf."""
        return vec3(*(float(self.leaf.sign) * (np.arange(3) == self.leaf.axis)))

    def ends(self, box: Box) -> tuple[float, float]:
        """Returns how far out a box begins and ends, metres."""
        low, high = box.low[self.leaf.axis], box.high[self.leaf.axis]
        return (float(low), float(high)) if self.leaf.sign > 0 else (float(-high), float(-low))

    def behind(self, box: Box) -> float:
        """Returns how far behind the hanging leaf's inner face a box ends, metres."""
        return self.ends(self.leaf.part.box)[0] - self.ends(box)[1]

    def is_below_and_behind(self, box: Box) -> bool:
        """Whether a box is under the top, close behind the leaf, and within its span."""
        hung, config, across = self.leaf.part.box, self.config, self.across
        below = box.high[_UP] <= self.leaf.top.box.low[_UP] + config.gap
        behind = -config.gap <= self.behind(box) <= config.beside
        span = hung.low[across] - config.gap <= box.low[across] and box.high[across] <= hung.high[across] + config.gap
        return bool(below and behind and span)

    def swings(self, box: Box) -> bool:
        """Whether a box has the proportions of what lies folded behind the leaf, and carries it when swung out."""
        long, tall = float(box.size[self.across]), float(self.leaf.part.box.size[_UP])
        slim = box.size[self.leaf.axis] <= self.config.slim * long
        return bool(slim and self.config.long[0] * tall <= long <= self.config.long[1] * tall)

    def slides(self, box: Box) -> bool:
        """Whether a box is a bar that points to the leaf."""
        return bool(np.delete(box.size, self.leaf.axis).max() <= self.config.slim * box.size[self.leaf.axis])


def with_drop_supports(
    plan: RealizationPlan, asset: Asset, config: DropSupportConfig = DropSupportConfig()
) -> RealizationPlan:
    """Returns a predicted plan in which what carries the raised leaves that it has swings or slides out.

    What is called a support and was predicted to move in another way is one; other joints stay as they are.
    """
    leaves = hanging_leaves(plan, asset)
    found = _found(leaves, plan, asset, at_scale(config, metre_on(asset.extent))) if leaves else {}
    taken = {name for request in found.values() for name in (request.moving, *request.attached)}
    kept = tuple(request for request in plan.joints if request.moving not in taken)
    refused = tuple(refusal for refusal in plan.refused if refusal.part not in taken)
    return replace(plan, joints=(*kept, *found.values()), refused=refused) if found else plan


def with_supported_leaves(
    plan: RealizationPlan, asset: Asset, config: DropSupportConfig = DropSupportConfig()
) -> RealizationPlan:
    """Returns a predicted plan in which leaves that hang from a table's top swing up, and what carries them comes out."""
    scaled = at_scale(config, metre_on(asset.extent))

    def supports(leaf: HangingLeaf) -> frozenset[str]:
        found = _found([leaf], plan, asset, scaled)
        return frozenset(name for request in found.values() for name in (request.moving, *request.attached))

    return with_drop_supports(with_drop_leaves(plan, asset, supports=supports), asset, config)


def _found(
    leaves: Sequence[HangingLeaf], plan: RealizationPlan, asset: Asset, config: DropSupportConfig
) -> dict[str, JointRequest]:
    """Returns what carries leaves that hang, by the part that moves."""
    hung, moving = {leaf.part.id for leaf in leaves}, moving_parts(plan)
    free = [part for part in asset.parts if part.id not in hung and _may_carry(part, moving)]
    still = [part for part in asset.parts if part.id not in moving and part.id not in hung]
    besides = [_Beside(leaf, config) for leaf in leaves]
    found: dict[str, JointRequest] = {}
    for group in _groups(free, config.touching):
        box = Box.enclosing(part.box for part in group)
        nearest = min(besides, key=lambda one: abs(one.behind(box)))
        request = _request(group, nearest, still)
        found |= {} if request is None else {request.moving: request}
    return found


def with_stated_supports(
    plan: RealizationPlan, asset: Asset, config: DropSupportConfig = DropSupportConfig()
) -> RealizationPlan:
    """Returns the plan in which what swings or slides out behind a leaf, wherever that is stated, is its support."""
    leaves = hanging_leaves(plan, asset)
    if not leaves:
        return plan
    config = at_scale(config, metre_on(asset.extent))
    hung = {leaf.part.id for leaf in leaves}
    besides = [_Beside(leaf, config) for leaf in leaves]
    joints = (
        replace(r, role=MotionRole.SUPPORT) if r.moving not in hung and _is_stated(r, asset, besides) else r
        for r in plan.joints
    )
    return replace(plan, joints=tuple(joints))


def _may_carry(part: Part, moving: frozenset[str]) -> bool:
    named = is_called_support(part) and part.carried_by is None
    return named or (part.id not in moving and part.label not in (PartLabel.DRAWER, PartLabel.HANDLE, PartLabel.DOOR))


def _groups(free: Sequence[Part], touching: float) -> Iterator[tuple[Part, ...]]:
    """Yields the parts that may carry a leaf: what is called so and touches as one, everything else by itself."""
    named = {part.id: part for part in free if is_called_support(part)}
    near = {a: [b for b in named if b != a and named[a].box.overlaps(named[b].box, touching)] for a in named}
    yield from (tuple(named[name] for name in sorted(group)) for group in joined_groups(near))
    yield from ((part,) for part in free if part.id not in named)


def _request(group: tuple[Part, ...], beside: _Beside, still: Sequence[Part]) -> JointRequest | None:
    """Returns how parts that hang together carry a leaf; None where they do not."""
    box, named = Box.enclosing(part.box for part in group), is_called_support(group[0])
    if not beside.is_below_and_behind(box):
        return None
    own = {beside.leaf.top.id, *(part.id for part in group)}
    others = [part.box for part in still if part.id not in own]
    mesh = merge_meshes([part.mesh for part in group])
    largest = max(group, key=lambda part: float(np.prod(np.sort(part.box.size)[1:])))
    attached = tuple(part.id for part in group if part is not largest)
    made = JointRequest(
        largest.id, Slide.joint_type, Axis(box.center, beside.out), SOURCE, attached=attached, role=MotionRole.SUPPORT
    )
    if named and beside.slides(box):
        return replace(made, reference=beside.config.travel * float(box.size[beside.leaf.axis]))
    if not beside.swings(box) or not (named or _is_shown(mesh, beside, others)):
        return None
    if any(other.overlaps(_path(box, beside)) for other in others):
        return None
    axis = _pin(box, beside, _pin_end(mesh, beside))
    return replace(made, type=Hinge.joint_type, axis=axis, reference=_QUARTER)


def _is_shown(mesh: TriangleMesh, beside: _Beside, others: Sequence[Box]) -> bool:
    """Whether shape alone shows a support: it reaches the top, nothing holds its ends, and the frame is behind it."""
    config, box, across = beside.config, mesh.box, beside.across
    reaches = box.high[_UP] >= beside.leaf.top.box.low[_UP] - config.near
    if not reaches or not looks_like_support(mesh, beside.leaf.axis, config):
        return False
    inner, beyond = beside.ends(box)[0], config.gap * (np.arange(3) == across)
    ends = Box(box.low - beyond, box.high + beyond)
    if any(o.overlaps(ends) and beside.ends(o)[1] > inner + config.gap for o in others):
        return False
    back = [o for o in others if abs(beside.ends(o)[1] - inner) <= config.reach and o.high[_UP] > box.low[_UP]]
    along = [min(o.high[across], box.high[across]) - max(o.low[across], box.low[across]) for o in back]
    return bool(max(along, default=0.0) >= config.behind * box.size[across])


def looks_like_support(mesh: TriangleMesh, axis: int, config: DropSupportConfig = DropSupportConfig()) -> bool:
    """Whether a body, seen along `axis`, is a plank that is longer than high, or an open frame, and no door."""
    box = mesh.box
    if box.size[_UP] <= config.low * box.size[1 - axis]:
        return True
    depths = depths_below(RayCaster(mesh), box, axis, _RAYS, float(box.size.max()))
    return float(np.isfinite(depths).mean()) <= config.open


def _path(box: Box, beside: _Beside) -> Box:
    """Returns the box that a support sweeps before the frame as it swings out about either of its ends."""
    axis, gap = beside.leaf.axis, beside.config.gap
    low, high = box.low + gap, box.high - gap
    length = float(box.size[beside.across])
    if beside.leaf.sign > 0:
        high[axis] = box.low[axis] + length
    else:
        low[axis] = box.high[axis] - length
    return Box(low, np.maximum(low, high))


def _pin_end(mesh: TriangleMesh, beside: _Beside) -> int:
    """Returns the end about which a support swings: -1 or 1 along the leaf.

    A gate's leg is at its other end, a bracket is highest at its pin; else it is the end nearer to the leaf's middle.
    """
    box, across, config = mesh.box, beside.across, beside.config
    length, along = config.end * float(box.size[across]), mesh.vertices[:, across]
    heights = mesh.vertices[:, _UP]
    first = float(heights[along <= box.low[across] + length].min())
    last = float(heights[along >= box.high[across] - length].min())
    is_gate = bool(box.low[_UP] <= beside.leaf.part.box.low[_UP] - config.near)
    if abs(first - last) >= config.differ * float(box.size[_UP]):
        return -1 if (first < last) != is_gate else 1
    return -1 if box.center[across] >= beside.leaf.part.box.center[across] else 1


def _pin(box: Box, beside: _Beside, end: int) -> Axis:
    """Returns the axis of a support at one of its ends, on the frame: the positive sense swings it out."""
    point = box.center.copy()
    point[beside.across] = box.low[beside.across] if end < 0 else box.high[beside.across]
    point[beside.leaf.axis] = beside.leaf.sign * beside.ends(box)[0]
    along = -float(end) * (np.arange(3) == beside.across)
    return Axis(point, _UPRIGHT * float(np.cross(along, beside.out)[_UP]))


def _is_stated(request: JointRequest, asset: Asset, besides: Sequence[_Beside]) -> bool:
    """Whether a request is of a support: beside a leaf, towards it or about an upright axis, and no door or drawer."""
    part, way = asset.part(request.moving), request.axis.direction
    if request.role is not MotionRole.NONE or request.parent or request.coupling is not None:
        return False
    bodies = [asset.part(name).mesh for name in (request.moving, *request.attached)]
    mesh = merge_meshes(bodies)
    for beside in besides:
        aligned = beside.config.aligned
        turns = request.kind.turns and abs(float(way[_UP])) >= aligned and beside.swings(mesh.box)
        slides = request.kind.slides and float(way @ beside.out) >= aligned and beside.slides(mesh.box)
        shown = is_called_support(part) or slides or looks_like_support(mesh, beside.leaf.axis, beside.config)
        if (turns or slides) and shown and beside.is_below_and_behind(mesh.box):
            return True
    return False
