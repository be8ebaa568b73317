"""A line in space with a sense: the axis of a joint."""

from functools import lru_cache
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Mat4, Points, Scalars, Vec3, frozen_array
from grafu.geometry.transform import is_mirror, rotation_about, transform_direction, transform_points, translation

_REMEMBERED = 4096  # rotations: those of a few doors


@final
@dataclass(frozen=True, eq=False, slots=True)
class Axis(ArrayValue):
    """A point (metres) and a unit direction; rotation is positive by the right-hand rule.

    Raises:
        ValueError: if the direction has no length or a number is not finite.
    """

    point: Vec3
    direction: Vec3

    def __post_init__(self) -> None:
        direction = np.asarray(self.direction, dtype=np.float64)
        length = float(np.linalg.norm(direction))
        if not np.isfinite(length) or length < 1e-12 or not np.all(np.isfinite(self.point)):
            raise ValueError(
                f"`Axis` needs a finite point and a direction with a length: got {self.point}, {direction}"
            )
        unit = direction if abs(length - 1.0) < 1e-15 else direction / length
        object.__setattr__(self, "point", frozen_array(self.point))
        object.__setattr__(self, "direction", frozen_array(unit))

    def rotation(self, angle: float) -> Mat4:
        """Returns the rotation by `angle` radians about this axis, read-only: sweep after sweep asks for the same."""
        return _rotation(self.point.tobytes(), self.direction.tobytes(), float(angle))

    def shift(self, distance: float) -> Mat4:
        """Returns the translation by `distance` metres along this axis."""
        return translation(self.direction * distance)

    def through(self, point: Vec3) -> "Axis":
        """Returns the parallel axis through another point."""
        return Axis(point, self.direction)

    def reversed(self) -> "Axis":
        """Returns the same line with the opposite sense."""
        return Axis(self.point, -self.direction)

    def transformed(self, T: Mat4, rotational: bool = True) -> "Axis":
        """Returns this axis mapped by T.

        A rotation axis is a pseudovector: a mirror image also reverses its sense. With
        `rotational=False` the direction is an ordinary displacement.
        """
        direction = transform_direction(T, self.direction)
        if rotational and is_mirror(T):
            direction = -direction
        return Axis(transform_points(T, self.point[None])[0], direction)

    def distance_to(self, point: Vec3) -> float:
        """Returns the distance of a point from the line, in metres."""
        offset = point - self.point
        return float(np.linalg.norm(offset - self.direction * (offset @ self.direction)))

    def distances_to(self, points: Points) -> Scalars:
        """Returns the distance of each of many points from the line, in metres."""
        offsets = points - self.point
        across = offsets - np.outer(offsets @ self.direction, self.direction)
        return np.asarray(np.linalg.norm(across, axis=1))

    def angle_to(self, other: "Axis") -> float:
        """Returns the angle between the senses of two axes, radians in [0, pi]."""
        return float(np.arccos(np.clip(self.direction @ other.direction, -1.0, 1.0)))

    def closest_point(self, point: Vec3) -> Vec3:
        """Returns the point of the line nearest to `point`."""
        return self.point + self.direction * float((point - self.point) @ self.direction)


@lru_cache(maxsize=_REMEMBERED)
def _rotation(point: bytes, direction: bytes, angle: float) -> Mat4:
    return frozen_array(rotation_about(np.frombuffer(point), np.frombuffer(direction), angle))
