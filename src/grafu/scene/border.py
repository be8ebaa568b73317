"""The border frame of a door: the one place where a door's hinge side gets coordinates.

X runs from the hinge border across the door, Y is where the door sets off to when it opens (its outer side), Z is the
opening axis, right-handed. The origin lies on the hinge border's front edge at half the door's length: the door fills
0 <= x <= width, -thickness <= y <= 0, |z| <= length / 2.
"""

from dataclasses import replace
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Mat3, Mat4, Points, Vec3, freeze_arrays, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.geometry.transform import from_rotation, rotation_matrix, transform_points

_THIN_BOARD = 0.008
_FRONT_RAYS = 48  # along each side of a door
SNAP = np.cos(np.radians(8.0))
"""Cosine: an initial axis within 8 degrees of a box axis is snapped onto it; a larger angle is a deliberate slant."""


@final
@dataclass(frozen=True, eq=False, slots=True)
class BorderFrame(ArrayValue):
    """See the module's docstring; `rotation` has X, Y, Z as columns in the object frame."""

    origin: Vec3
    rotation: Mat3
    width: float
    thickness: float
    length: float

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float64)

    @property
    def board(self) -> float:
        """The door's thickness, or a thin board's (8 mm) where it is a mere sheet: what steps are measured in."""
        return max(self.thickness, _THIN_BOARD)

    @property
    def T_object_border(self) -> Mat4:
        """Maps border coordinates to the object frame."""
        return from_rotation(self.rotation, self.origin)

    def to_object(self, points: Points) -> Points:
        """Returns points of the border frame in the object frame."""
        return transform_points(self.T_object_border, points)

    def to_border(self, points: Points) -> Points:
        """Returns points of the object frame in the border frame."""
        return (points - self.origin) @ self.rotation

    def direction(self, x: float, y: float, z: float) -> Vec3:
        """Returns a direction of the border frame in the object frame."""
        return self.rotation @ vec3(x, y, z)

    def axis_at(self, x: float, y: float) -> Axis:
        """Returns the opening axis through (x, y, 0)."""
        return Axis(self.to_object(vec3(x, y, 0.0)[None])[0], self.rotation[:, 2])


def part_axes(mesh: TriangleMesh) -> Mat3:
    """Returns the axes of a part's own box as columns: the object frame's, turned about Z where the part is turned."""
    return rotation_matrix(vec3(0.0, 0.0, 1.0), mesh.yaw)


def border_frame(mesh: TriangleMesh, axis: Axis) -> BorderFrame:
    """Returns the frame of the border that an initial opening axis runs along (paper: a border of the part's box).

    Of the two sides across the axis, the longer one decides which border is nearest.
    """
    axes = part_axes(mesh)
    along = int(np.argmax(np.abs(axes.T @ axis.direction)))
    if abs(float(axes[:, along] @ axis.direction)) < SNAP:
        return _slanted(mesh, axis)
    z = axes[:, along] * np.sign(float(axes[:, along] @ axis.direction))
    local = Box.around(mesh.vertices @ axes)
    across = [k for k in range(3) if k != along]
    wide = max(across, key=lambda k: float(local.size[k]))
    side = float(axis.point @ axes[:, wide]) - float(local.center[wide])
    x = axes[:, wide] * (-1.0 if side > 0 else 1.0)
    return _framed(mesh, x, z)


def pitched_border_frame(mesh: TriangleMesh, axis: Axis) -> BorderFrame:
    """Returns the frame of the border of a leaf that is turned about its own axis: a flap that stands half open.

    Its sides are those of the smallest rectangle around the leaf, seen along its axis; those of `border_frame` are
    those of the leaf's own box, which is deep around a leaf that stands at a slant.
    """
    z = np.asarray(axis.direction)
    x = np.eye(3)[int(np.argmin(np.abs(z)))]
    x = x - z * float(z @ x)
    x /= np.linalg.norm(x)
    T = from_rotation(np.stack([x, np.cross(z, x), z]), np.zeros(3))
    frame = border_frame(mesh.transformed(T), Axis(transform_points(T, axis.point[None])[0], vec3(0.0, 0.0, 1.0)))
    return replace(frame, origin=frame.origin @ T[:3, :3], rotation=T[:3, :3].T @ frame.rotation)


def _slanted(mesh: TriangleMesh, axis: Axis) -> BorderFrame:
    """Returns the frame about an axis that follows no side of the part's box."""
    to_center = mesh.box.center - axis.closest_point(mesh.box.center)
    return _framed(mesh, to_center / np.linalg.norm(to_center), np.asarray(axis.direction))


def _framed(mesh: TriangleMesh, x: Vec3, z: Vec3) -> BorderFrame:
    rotation = np.column_stack([x, np.cross(z, x), z])
    local = Box.around(mesh.vertices @ rotation)
    origin = vec3(float(local.low[0]), float(local.high[1]), float(local.center[2]))
    width, thickness, length = (float(s) for s in local.size)
    return BorderFrame(rotation @ origin, rotation, width, thickness, length)


def without_handle(frame: BorderFrame, mesh: TriangleMesh, ratio: float, play: float) -> BorderFrame:
    """Returns the frame with its front where a fraction of what is seen of the door from in front is reached.

    A handle of the door's mesh stands out of that. Fronts that differ by less than `play`, metres, are one.
    """
    steps = (np.arange(_FRONT_RAYS) + 0.5) / _FRONT_RAYS
    x, z = (side.ravel() for side in np.meshgrid(steps * frame.width, (steps - 0.5) * frame.length))
    start = frame.to_object(np.column_stack([x, np.full(len(x), frame.board), z]))
    depths = RayCaster(mesh).along(start, frame.direction(0.0, -1.0, 0.0)) - frame.board
    met = np.sort(depths[np.isfinite(depths)])
    stands_out = float(met[int(ratio * len(met))]) if len(met) else 0.0
    if not play < stands_out < frame.thickness:
        return frame
    origin = frame.to_object(vec3(0.0, -stands_out, 0.0)[None])[0]
    return replace(frame, origin=origin, thickness=frame.thickness - stands_out)
