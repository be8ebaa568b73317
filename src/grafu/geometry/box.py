"""Axis-aligned and oriented boxes: extents, gaps, faces, the thin axis."""

from collections.abc import Iterable, Sequence
from itertools import combinations
from math import hypot, isfinite
from typing import Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Mat3, Mat4, Points, Vec3, distinct, extremes, frozen_array
from grafu.geometry.transform import from_rotation
from grafu.shapes import Float

_AT_HIGH: Final = np.array([[bool((k >> axis) & 1) for axis in range(3)] for k in range(8)])  # of each corner


@final
@dataclass(frozen=True, eq=False, slots=True)
class Box(ArrayValue):
    """An axis-aligned box in metres.

    Raises:
        ValueError: if `high` is below `low` on some axis, or a number is not finite.
    """

    low: Vec3
    high: Vec3

    def __post_init__(self) -> None:
        low, high = frozen_array(self.low), frozen_array(self.high)
        # Six plain numbers are quicker than three calls of numpy: boxes are made by the hundred thousand.
        if not all(isfinite(a) and isfinite(b) and b >= a for a, b in zip(low.tolist(), high.tolist(), strict=True)):
            raise ValueError(f"`Box.high` must be at least `Box.low` on every axis: got low={low}, high={high}")
        object.__setattr__(self, "low", low)
        object.__setattr__(self, "high", high)

    @classmethod
    def around(cls, points: Points) -> "Box":
        """Returns the smallest box around at least one point."""
        return cls(*extremes(points))

    @classmethod
    def enclosing(cls, boxes: Iterable["Box"]) -> "Box":
        """Returns the smallest box around at least one box."""
        lows, highs = zip(*((box.low, box.high) for box in boxes), strict=True)
        return cls(np.min(lows, axis=0), np.max(highs, axis=0))

    @classmethod
    def from_center(cls, center: Vec3, half: Vec3) -> "Box":
        """Returns the box with this centre and these half sizes."""
        return cls(np.asarray(center) - half, np.asarray(center) + half)

    @property
    def center(self) -> Vec3:
        """The middle, metres."""
        return (self.low + self.high) / 2

    @property
    def half(self) -> Vec3:
        """Half the side lengths."""
        return (self.high - self.low) / 2

    @property
    def size(self) -> Vec3:
        """The side lengths."""
        return self.high - self.low

    @property
    def thin_axis(self) -> int:
        """The index of the shortest side (the first of equals)."""
        return int(np.argmin(self.size))

    @property
    def volume(self) -> float:
        """The volume, cubic metres."""
        return float(np.prod(self.size))

    @property
    def diagonal(self) -> float:
        """The length of the space diagonal."""
        return float(np.linalg.norm(self.size))

    def union(self, other: "Box") -> "Box":
        """Returns the smallest box around both."""
        return Box(np.minimum(self.low, other.low), np.maximum(self.high, other.high))

    def grown(self, margin: float) -> "Box":
        """Returns this box with every face moved outwards by `margin` (inwards at most to the centre)."""
        half = np.maximum(self.half + margin, 0.0)
        return Box.from_center(self.center, half)

    def axis_gaps(self, other: "Box") -> Vec3:
        """Returns the gap along each axis; negative where the two overlap."""
        return np.maximum(self.low - other.high, other.low - self.high)

    def gap(self, other: "Box") -> float:
        """Returns the distance between the two boxes, 0 where they touch or overlap."""
        return float(np.linalg.norm(np.maximum(self.axis_gaps(other), 0.0)))

    def overlaps(self, other: "Box", margin: float = 0.0) -> bool:
        """Whether the two, one grown by `margin`, share a point."""
        # Plain numbers, as above: boxes are compared by the hundred thousand, too.
        a, b, c = self.low.tolist()
        u, v, w = other.high.tolist()
        if a - u > margin or b - v > margin or c - w > margin:
            return False
        a, b, c = self.high.tolist()
        u, v, w = other.low.tolist()
        return bool(u - a <= margin and v - b <= margin and w - c <= margin)

    def shared_volume(self, other: "Box") -> float:
        """Returns the volume that lies in both, cubic metres."""
        sides = np.minimum(self.high, other.high) - np.maximum(self.low, other.low)
        return float(np.prod(np.maximum(sides, 0.0)))

    def intersection_over_union(self, other: "Box", margin: float = 0.0) -> float:
        """Returns the volume in both over the volume in either, each grown by `margin`; 0 where there is none."""
        a, b = self.grown(margin), other.grown(margin)
        shared = a.shared_volume(b)
        joint = a.volume + b.volume - shared
        return shared / joint if joint > 0 else 0.0

    def contains(self, points: Points) -> np.ndarray:
        """Returns for each point whether it lies in the box, its border counted in."""
        low, high = self.low.tolist(), self.high.tolist()
        inside = (points[:, 0] >= low[0]) & (points[:, 0] <= high[0])
        for k in (1, 2):  # a column at a time: numpy takes several times as long along rows of three
            inside &= (points[:, k] >= low[k]) & (points[:, k] <= high[k])
        return inside

    def face_center(self, code: int) -> Vec3:
        """Returns the centre of a face; codes 0..5 are -X, +X, -Y, +Y, -Z, +Z."""
        center = self.center.copy()
        center[code // 2] = self.high[code // 2] if code % 2 else self.low[code // 2]
        return center

    def corners(self) -> Points:
        """Returns the eight corners."""
        return np.where(_AT_HIGH, self.high, self.low)


@final
@dataclass(frozen=True, eq=False, slots=True)
class OrientedBox(ArrayValue):
    """A box with its own right-handed axes: the columns of `rotation` are its axes in the object frame."""

    center: Vec3
    half: Vec3
    rotation: Mat3

    def __post_init__(self) -> None:
        half = frozen_array(self.half)
        if not np.all(half >= 0):
            raise ValueError(f"`OrientedBox.half` must not be negative: got {half}")
        object.__setattr__(self, "center", frozen_array(self.center))
        object.__setattr__(self, "half", half)
        object.__setattr__(self, "rotation", frozen_array(self.rotation))

    @property
    def T_object_box(self) -> Mat4:
        """Maps the box's own coordinates (origin at its centre) to the object frame."""
        return from_rotation(np.asarray(self.rotation), np.asarray(self.center))

    def corners(self) -> Points:
        """Returns the eight corners in the object frame."""
        return np.where(_AT_HIGH, self.half, -self.half) @ self.rotation.T + self.center

    @classmethod
    def around(cls, points: Points, rotation: Mat3) -> "OrientedBox":
        """Returns the smallest box around the points whose axes are the columns of `rotation`."""
        local = Box.around(points @ rotation)
        return cls(rotation @ local.center, local.half, rotation)


def overlap_across(boxes: Sequence[Box], axes: Sequence[int], most: float) -> bool:
    """Whether two boxes, seen across some axes, overlap by more than this fraction of the smaller outline."""
    across = list(axes)
    for one, other in combinations(boxes, 2):
        sides = np.minimum(one.high, other.high)[across] - np.maximum(one.low, other.low)[across]
        smaller = min(np.prod(one.size[across]), np.prod(other.size[across]))
        if float(np.prod(np.maximum(sides, 0.0))) > most * float(smaller):
            return True
    return False


def yaw_of(points: Points) -> float:
    """Returns the rotation about Z, radians in (-pi/4, pi/4], in which the points fill the smallest rectangle.

    A part that already fills its axis-aligned box as well as any other (within 1 %) has yaw 0.
    """
    flat = points[:, :2]
    if _has_all_corners(flat):
        return 0.0
    hull = convex_outline(flat)
    if len(hull) < 3:  # an upright sheet: seen from above it is a line, or a point
        return _yaw_of_line(flat)
    edges = np.roll(hull, -1, axis=0) - hull
    angles = distinct(np.round(np.mod(np.arctan2(edges[:, 1], edges[:, 0]) + np.pi / 4, np.pi / 2) - np.pi / 4, 6))
    cosines, sines = np.cos(angles), np.sin(angles)
    u = np.outer(cosines, hull[:, 0]) + np.outer(sines, hull[:, 1])
    v = np.outer(cosines, hull[:, 1]) - np.outer(sines, hull[:, 0])
    areas = np.ptp(u, axis=1) * np.ptp(v, axis=1)
    best = int(np.argmin(areas))
    low, high = extremes(flat)
    straight = float(np.prod(high - low))
    return 0.0 if areas[best] >= 0.99 * straight else float(angles[best])


_AHEAD = np.stack([np.cos(np.arange(16) * np.pi / 8), np.sin(np.arange(16) * np.pi / 8)])
_STRAIGHT = 4e-15  # of the largest coordinate: what bends less is rounding


def convex_outline(flat: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, "k 2"]:
    """Returns the corners around points, counter-clockwise; fewer than three where all lie on one line."""
    if not len(flat):
        return flat
    points = sorted(set(map(tuple, _outer(flat).tolist())))
    nothing = _STRAIGHT * float(np.abs(flat).max())
    return np.array(_bending(points, nothing)[:-1] + _bending(points[::-1], nothing)[:-1] or points)


def _outer(flat: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, "m 2"]:
    """Returns the points without what lies within those that are outermost in 16 directions."""
    corners = flat[np.argmax(flat @ _AHEAD, axis=0)]
    sides, outside = np.roll(corners, -1, axis=0) - corners, np.zeros(len(flat), dtype=bool)
    is_side = sides.any(axis=1)  # of a board four of the sixteen
    for (x, y), (u, v) in zip(corners[is_side].tolist(), sides[is_side].tolist(), strict=True):
        outside |= u * (flat[:, 1] - y) < v * (flat[:, 0] - x)
    return np.concatenate([corners, flat[outside]])


def _bending(points: list[tuple[float, ...]], nothing: float) -> list[tuple[float, ...]]:
    """Returns the sorted points at which a thread bends that is drawn taut below them."""
    thread: list[tuple[float, ...]] = []
    for x, y in points:
        while len(thread) > 1:
            (x0, y0), (x1, y1) = thread[-2:]
            u, v = x - x0, y - y0
            if v * (x1 - x0) - u * (y1 - y0) > nothing * hypot(u, v):
                break
            thread.pop()
        thread.append((x, y))
    return thread


def _has_all_corners(flat: Float[np.ndarray, "n 2"]) -> bool:
    """Whether all four corners of the rectangle around points are among them: a quick answer for boards."""
    if not len(flat):
        return False
    (x, y), (low, high) = flat.T, extremes(flat)
    sides, ends = (x - low[0] < 1e-9, high[0] - x < 1e-9), (y - low[1] < 1e-9, high[1] - y < 1e-9)
    return all(bool((side & end).any()) for side in sides for end in ends)


def _yaw_of_line(flat: Float[np.ndarray, "n 2"]) -> float:
    """Returns the rotation, as of `yaw_of`, that lays an axis along points which lie on one line; 0 for one point."""
    if not len(flat) or np.ptp(flat, axis=0).max() < 1e-12:
        return 0.0
    along = np.linalg.svd(flat - flat.mean(axis=0), full_matrices=False)[2][0]
    angle = float(np.mod(np.arctan2(along[1], along[0]) + np.pi / 4, np.pi / 2) - np.pi / 4)
    return angle if abs(angle) > 1e-6 else 0.0
