"""The places of a table behind a leaf that hangs, and which bodies there have the shape of what carries it raised."""

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster, depths_below
from grafu.joints.drop_leaves import SOURCE, HangingLeaf
from grafu.joints.drop_support_config import DropSupportConfig
from grafu.joints.plan import JointRequest

_UP = 2
_RAYS = 16  # along each side of an outline
_UPRIGHT = vec3(0.0, 0.0, 1.0)


@final
@dataclass(frozen=True, slots=True)
class BesideLeaf:
    """A leaf that hangs, and where the parts behind it are as seen from the frame: `out` points to the leaf."""

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
        behind = -config.gap <= self.behind(box) <= config.beside * hung.size[_UP]
        span = hung.low[across] - config.gap <= box.low[across] and box.high[across] <= hung.high[across] + config.gap
        return bool(below and behind and span)

    def reaches(self, box: Box) -> bool:
        """Whether a box ends so high that the raised leaf rests on it."""
        return bool(box.high[_UP] >= self.leaf.top.box.low[_UP] - self.config.near)

    def travel(self, box: Box) -> float:
        """Returns how far a bar comes out: by a part of its length, and no farther than the raised leaf covers it."""
        covered = float(self.leaf.part.box.size[_UP])
        return min(self.config.travel * float(box.size[self.leaf.axis]), self.config.covered * covered)

    def resting(self, request: JointRequest, height: float) -> JointRequest:
        """Returns the joint of the leaf that comes to lie at a height; where it was found, about a line in its edge."""
        box, axis = self.leaf.part.box, request.axis
        if request.source != SOURCE:
            return replace(request, rests=height)
        point, (inner, outer) = axis.point.copy(), self.ends(box)
        deep = float(np.clip(float(box.high[_UP]) - height, 0.0, outer - inner))
        point[self.leaf.axis] = self.leaf.sign * (inner + deep)
        return replace(request, rests=height, axis=Axis(point, axis.direction))

    def swings(self, box: Box) -> bool:
        """Whether a box has the proportions of what lies folded behind the leaf, and carries it when swung out."""
        long, tall = float(box.size[self.across]), float(self.leaf.part.box.size[_UP])
        slim = box.size[self.leaf.axis] <= self.config.slim * long
        return bool(slim and self.config.long[0] * tall <= long <= self.config.long[1] * tall)

    def slides(self, box: Box) -> bool:
        """Whether a box is a bar that points to the leaf."""
        return bool(np.delete(box.size, self.leaf.axis).max() <= self.config.slim * box.size[self.leaf.axis])


def is_shown(mesh: TriangleMesh, beside: BesideLeaf, others: Sequence[Box]) -> bool:
    """Whether shape alone shows a support: it reaches the top, nothing holds its ends, and the frame is behind it."""
    config, box, across = beside.config, mesh.box, beside.across
    if not beside.reaches(box) or not looks_like_support(mesh, beside.leaf.axis, config):
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


def path_of_swing(box: Box, beside: BesideLeaf) -> Box:
    """Returns the box that a support sweeps before the frame as it swings out about either of its ends."""
    axis, gap = beside.leaf.axis, beside.config.gap
    low, high = box.low + gap, box.high - gap
    length = float(box.size[beside.across])
    if beside.leaf.sign > 0:
        high[axis] = box.low[axis] + length
    else:
        low[axis] = box.high[axis] - length
    return Box(low, np.maximum(low, high))


def _pin_end(mesh: TriangleMesh, beside: BesideLeaf) -> int:
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


def pin_of(mesh: TriangleMesh, beside: BesideLeaf) -> Axis:
    """Returns the axis of a support at one of its ends, on the frame: the positive sense swings it out."""
    box, end = mesh.box, _pin_end(mesh, beside)
    point = box.center.copy()
    point[beside.across] = box.low[beside.across] if end < 0 else box.high[beside.across]
    point[beside.leaf.axis] = beside.leaf.sign * beside.ends(box)[0]
    along = -float(end) * (np.arange(3) == beside.across)
    return Axis(point, _UPRIGHT * float(np.cross(along, beside.out)[_UP]))
