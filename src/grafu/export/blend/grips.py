"""Where a joint that stands in Blender can be taken hold of, and what a ray from the pointer makes of it.

Points are in the frame of the joint's empty: the axis is +Z through the origin, metres; borders in that of its link.
"""

from typing import Any, final

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.dataclass import dataclass
from grafu.export.blend.layout import CHILD, ID, KIND, LOWER, OPEN, TYPE, UPPER, Kind
from grafu.export.blend.marks import marks_of
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.joints.motion_choice import DIRECTIONS, Side
from grafu.vocabulary import JointType

_EDGE_ON = 0.05  # of a ray's length towards the axis: less, and the circle is seen as a line
_PARALLEL = 1e-9  # of two directions: less, and no point of one is nearest to the other


@final
@dataclass(frozen=True)
class JointGrips:
    """A joint's grip when closed, and its limits and value (radians or metres)."""

    turns: bool
    closed: Vec3
    lower: float
    upper: float
    value: float

    def point_at(self, value: float) -> Vec3:
        """Returns where the grip is at a value."""
        if not self.turns:
            return self.closed + vec3(0.0, 0.0, value)
        x, y, z = self.closed
        return vec3(x * np.cos(value) - y * np.sin(value), x * np.sin(value) + y * np.cos(value), z)

    def direction_at(self, value: float) -> Vec3:
        """Returns the direction in which the grip goes as the joint opens, a unit vector."""
        if not self.turns:
            return vec3(0.0, 0.0, 1.0)
        x, y, _ = self.point_at(value)
        return vec3(-y, x, 0.0) / np.hypot(x, y)

    def value_under(self, ray: Axis, near: float) -> float:
        """Returns the value at which the grip is under a ray; of those of a full turn, the nearest to `near`.

        Where no value is, it is `near`.
        """
        if self.turns and abs(ray.direction[2]) >= _EDGE_ON:
            x, y, _ = ray.point + (self.closed[2] - ray.point[2]) / ray.direction[2] * ray.direction
            turned = np.arctan2(y, x) - np.arctan2(self.closed[1], self.closed[0])
            return near + float((turned - near + np.pi) % (2.0 * np.pi) - np.pi)
        shift = _shift_under(self.point_at(near), self.direction_at(near), ray)
        return near + (shift / float(np.hypot(*self.closed[:2])) if self.turns else shift)


def grips_of(empty: Any) -> JointGrips | None:
    """Returns where the joint of an empty is taken hold of; None where it does not move or nothing hangs on it."""
    marks = marks_of(empty)
    if marks is None:
        return None
    lower, upper = float(empty[LOWER]), float(empty[UPPER])
    turns = motion_kind(JointType(empty[TYPE])).turns
    value = lower + (upper - lower) * min(max(float(empty[OPEN]), 0.0), 1.0)
    at_lower = JointGrips(turns, marks.range[0][0], lower, upper, value)
    return JointGrips(turns, at_lower.point_at(-lower), lower, upper, value)


def borders_of(empty: Any) -> tuple[Any, dict[Side, np.ndarray]]:
    """Returns the link of a joint's empty, and the borders that its part could turn about: two ends each, in its frame.

    The frame of the link has the axes of the object at rest, so that its sides are the object's.
    """
    link = next(child for child in empty.children if child.get(KIND) == Kind.LINK)
    part = next((one for one in link.children if one.data is not None and one.get(ID) == empty[CHILD]), None)
    if part is None:
        return link, {}
    corners = np.array(part.bound_box, dtype=np.float64)
    return link, borders(Box(corners.min(axis=0), corners.max(axis=0)))


def borders(box: Box) -> dict[Side, np.ndarray]:
    """Returns the borders of a board, by side: two ends each, 2 x 3. Its broad faces have none."""
    found = {}
    for side, direction in DIRECTIONS.items():
        across = int(np.argmax(np.abs(direction)))
        if across != box.thin_axis:
            along = np.eye(3)[3 - across - box.thin_axis] * box.half
            middle = box.center + direction * box.half
            found[side] = np.array([middle - along, middle + along])
    return found


def _shift_under(point: Vec3, direction: Vec3, ray: Axis) -> float:
    """Returns how far along a line, from a point of it, it is nearest to a ray; 0 where they are parallel."""
    between = point - ray.point
    along = float(direction @ ray.direction)
    spread = 1.0 - along * along
    if spread < _PARALLEL:
        return 0.0
    return (along * float(ray.direction @ between) - float(direction @ between)) / spread
