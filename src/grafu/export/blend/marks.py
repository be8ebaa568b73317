"""The lines that show how a joint moves: its axis, its range as an arc or an arrow, and how far it is open.

They are drawn in the frame of the joint's empty: the axis is +Z through the origin, metres. Of a joint that stands in
Blender they are read off its empty and what hangs on it.
"""

from typing import Any, final

import numpy as np

from grafu.articulation.articulated_object import JointLimits
from grafu.articulation.motion_kind import motion_kind
from grafu.dataclass import dataclass
from grafu.export.blend.layout import KIND, LOWER, OPEN, TYPE, UPPER, Kind
from grafu.geometry.box import Box
from grafu.vocabulary import JointType

_STEP = np.pi / 36.0  # of an arc: 5 degrees, straight to the eye at any size
_BEYOND = 0.08  # of the part's side, by which the axis stands out
_HEAD = 0.12  # of the radius or the travel: the arrow's head
_RADIUS = 1.2  # of the distance from the axis to the part's middle: over the door, within its free edge


@final
@dataclass(frozen=True)
class MotionMarks:
    """Pairs of points, each array k x 2 x 3: the axis, the range from closed to open, and where the joint is now."""

    axis: np.ndarray
    range: np.ndarray
    now: np.ndarray


def motion_marks(joint_type: JointType, limits: JointLimits, value: float, box: Box) -> MotionMarks:
    """Returns the marks of a joint at a value (radians or metres).

    `box` is that of what moves, closed, in the joint's frame.

    Raises:
        ValueError: if the joint is fixed.
    """
    kind = motion_kind(joint_type)
    if kind.turns:
        return _turn(limits, value, box)
    if kind.slides:
        return _slide(limits, value, box)
    raise ValueError("`joint_type` must be one that moves: got fixed")


def _turn(limits: JointLimits, value: float, box: Box) -> MotionMarks:
    x, y, middle = box.center
    radius = _RADIUS * float(np.hypot(x, y))
    start = float(np.arctan2(y, x))
    if radius < 1e-6:  # it turns about its own middle
        radius, start = 0.5 * float(np.max(box.size[:2])), 0.0

    def at(angles: np.ndarray, away: float = 1.0) -> np.ndarray:
        turned = start + angles
        flat = away * radius * np.column_stack([np.cos(turned), np.sin(turned)])
        return np.column_stack([flat, np.full(len(angles), middle)])

    steps = max(2, int(np.ceil(limits.range / _STEP)) + 1)
    arc = _chain(at(np.linspace(limits.lower, limits.upper, steps)))
    back = np.array([limits.upper - min(_HEAD, 0.5 * limits.range)])
    tip = at(np.array([limits.upper]))[0]
    head = np.array([[tip, at(back, away)[0]] for away in (1.0 - _HEAD / 2, 1.0 + _HEAD / 2)])
    spoke = np.array([[[0.0, 0.0, middle], at(np.array([value]))[0]]])
    return MotionMarks(_axis(box, 0.0, 0.0), np.concatenate([arc, head]), spoke)


def _slide(limits: JointLimits, value: float, box: Box) -> MotionMarks:
    x, y, _ = box.center
    front, travel = box.high[2], limits.range
    ends = [np.array([x, y, front + limits.lower]), np.array([x, y, front + limits.upper])]
    width = _HEAD * travel / 2
    head = [[ends[1], ends[1] + np.array([side * width, 0.0, -_HEAD * travel])] for side in (-1.0, 1.0)]
    half = 0.1 * float(np.max(box.size[:2]))
    now = np.array([[[x - half, y, front + value], [x + half, y, front + value]]])
    return MotionMarks(_axis(box, x, y), np.array([ends, *head]), now)


def _axis(box: Box, x: float, y: float) -> np.ndarray:
    beyond = _BEYOND * float(np.max(box.size))
    return np.array([[[x, y, box.low[2] - beyond], [x, y, box.high[2] + beyond]]])


def _chain(points: np.ndarray) -> np.ndarray:
    return np.stack([points[:-1], points[1:]], axis=1)


def marks_of(empty: Any) -> MotionMarks | None:
    """Returns the marks of a joint's empty, in its own frame; None where it does not move or nothing hangs on it."""
    if empty.get(KIND) != Kind.JOINT or OPEN not in empty or empty[UPPER] <= empty[LOWER]:
        return None
    link = next((child for child in empty.children if child.get(KIND) == Kind.LINK), None)
    meshes = [child for child in link.children if child.data is not None] if link is not None else []
    if not meshes:
        return None
    R = np.array(empty.rotation_quaternion.to_matrix(), dtype=np.float64)
    corners = np.concatenate([np.array(mesh.bound_box, dtype=np.float64) for mesh in meshes]) @ R
    limits = JointLimits(float(empty[LOWER]), float(empty[UPPER]))
    value = limits.lower + limits.range * min(max(float(empty[OPEN]), 0.0), 1.0)
    return motion_marks(JointType(empty[TYPE]), limits, value, Box(corners.min(axis=0), corners.max(axis=0)))
