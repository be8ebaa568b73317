"""Rigid (and similarity) transforms as 4x4 matrices, `T_target_source`.

Angles are radians, positive by the right-hand rule; quaternions are wxyz.
"""

from collections.abc import Sequence
from math import atan2, cos, hypot, pi, remainder, sin, sqrt
from typing import Final

import numpy as np

from grafu.geometry.arrays import Mat3, Mat4, Points, Scalars, Vec3
from grafu.shapes import Float


def transform_points(T: Mat4, points: Points) -> Points:
    """Returns the points mapped by T."""
    return points @ T[:3, :3].T + T[:3, 3]


def transform_direction(T: Mat4, direction: Vec3) -> Vec3:
    """Returns the unit direction mapped by the linear part of T (a polar vector: mirrored like a displacement)."""
    mapped = T[:3, :3] @ direction
    return mapped / np.linalg.norm(mapped)


_IDENTITY: Final = np.eye(4)  # copied: that takes a tenth of the time of making another


def translation(offset: Vec3) -> Mat4:
    """Returns the transform that shifts by `offset`."""
    T = _IDENTITY.copy()
    T[:3, 3] = offset
    return T


def from_rotation(R: Mat3, offset: Vec3 | None = None) -> Mat4:
    """Returns the transform with linear part R and translation `offset` (none: zero)."""
    T = _IDENTITY.copy()
    T[:3, :3] = R
    if offset is not None:
        T[:3, 3] = offset
    return T


def rotation_matrix(direction: Vec3, angle: float) -> Mat3:
    """Returns the rotation by `angle` about the unit `direction`."""
    x, y, z = (angle * float(part) for part in direction)
    turn = sqrt(x * x + y * y + z * z)
    ratio = 0.5 - turn**2 / 48 + turn**4 / 3840 if turn <= _SMALL else sin(turn / 2) / turn
    return _of_unit(ratio * x, ratio * y, ratio * z, cos(turn / 2))


_SMALL = 1e-3  # radians: below, a series replaces the sine over the angle


def quaternions_about(direction: Vec3, angles: Scalars) -> Float[np.ndarray, "n 4"]:
    """Returns the rotations by `angles` about the unit `direction` as quaternions, in the order xyzw."""
    turns = np.outer(angles, direction)
    angle = np.sqrt(turns[:, 0] ** 2 + turns[:, 1] ** 2 + turns[:, 2] ** 2)
    series = 0.5 - angle**2 / 48 + angle**4 / 3840
    ratio = np.where(angle <= _SMALL, series, np.sin(angle / 2) / np.maximum(angle, _SMALL))
    return np.column_stack([ratio[:, None] * turns, np.cos(angle / 2)])


def quaternion_matrix(w: float, x: float, y: float, z: float) -> Mat3:
    """Returns the rotation of a quaternion of any length but 0."""
    largest = max(abs(w), abs(x), abs(y), abs(z))  # no length over- or underflows
    w, x, y, z = w / largest, x / largest, y / largest, z / largest
    length = sqrt(x * x + y * y + z * z + w * w)
    return _of_unit(x / length, y / length, z / length, w / length)


def _of_unit(x: float, y: float, z: float, w: float) -> Mat3:
    """Returns the rotation of a quaternion of length 1."""
    return np.array(
        [
            [x * x - y * y - z * z + w * w, 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), -x * x + y * y - z * z + w * w, 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), -x * x - y * y + z * z + w * w],
        ]
    )


def euler_matrix(angles: Sequence[float], order: str = "xyz") -> Mat3:
    """Returns the rotation about fixed axes, one after another: by the first angle about the first axis of `order`."""
    x, y, z, w = 0.0, 0.0, 0.0, 1.0
    for axis, angle in zip(order, angles, strict=True):
        a, b, c = (sin(angle / 2) if axis == own else 0.0 for own in "xyz")
        d = cos(angle / 2)
        x, y, z, w = (
            d * x + w * a + (b * z - c * y),
            d * y + w * b + (c * x - a * z),
            d * z + w * c + (a * y - b * x),
            d * w - a * x - b * y - c * z,
        )
    return _of_unit(x, y, z, w)


_POLE = 1e-7  # radians: so near to a pitch of 90 degrees roll and yaw turn about one axis


def roll_pitch_yaw(R: Mat3) -> Vec3:
    """Returns URDF's angles: about the fixed X, then Y, then Z axis. Where pitch is 90 degrees, yaw is 0."""
    x, y, z, w = _quaternion(R)
    length = sqrt(x * x + y * y + z * z + w * w)
    x, y, z, w = x / length, y / length, z / length, w / length
    a, b, c, d = w - y, x + z, y + w, z - x  # twice the half angles of the sum and the difference of roll and yaw
    tilt, total, difference = 2 * atan2(hypot(c, d), hypot(a, b)), atan2(b, a), atan2(d, c)
    roll, yaw = total - difference, total + difference
    if abs(tilt) <= _POLE:
        roll, yaw = 2 * total, 0.0
    elif abs(tilt - pi) <= _POLE:
        roll, yaw = -2 * difference, 0.0
    return np.array([remainder(roll, 2 * pi), tilt - pi / 2, remainder(yaw, 2 * pi)])


def _quaternion(R: Mat3) -> tuple[float, float, float, float]:
    """Returns a rotation as a quaternion of any length, in the order xyzw, from where it is largest."""
    (a, b, c), (d, e, f), (g, h, i) = R.tolist()
    trace = a + e + i
    largest = max(a, e, i, trace)
    if largest == trace:
        return h - f, c - g, d - b, 1 + trace
    if largest == a:
        return 1 - trace + 2 * a, d + b, g + c, h - f
    if largest == e:
        return d + b, 1 - trace + 2 * e, h + f, c - g
    return g + c, h + f, 1 - trace + 2 * i, d - b


def quaternion_of(R: Mat3) -> tuple[float, float, float, float]:
    """Returns a rotation as a unit quaternion, in the order wxyz, w not negative."""
    x, y, z, w = np.array(_quaternion(R)) / np.linalg.norm(_quaternion(R)) * (-1.0 if _quaternion(R)[3] < 0 else 1.0)
    return float(w), float(x), float(y), float(z)


def rotation_about(point: Vec3, direction: Vec3, angle: float) -> Mat4:
    """Returns the rotation by `angle` about the line through `point` along the unit `direction`."""
    R = rotation_matrix(direction, angle)
    return from_rotation(R, point - R @ point)


def reflection(point: Vec3, normal: Vec3) -> Mat4:
    """Returns the mirror image across the plane through `point` with unit `normal` (supplement, eq. rail mirror)."""
    M = np.eye(3) - 2.0 * np.outer(normal, normal)
    return from_rotation(M, point - M @ point)


def invert(T: Mat4) -> Mat4:
    """Returns the inverse transform."""
    return np.linalg.inv(T)


def scale_of(T: Mat4) -> float:
    """Returns the uniform scale of a similarity transform (positive, also for a mirror image)."""
    return float(np.cbrt(abs(np.linalg.det(T[:3, :3]))))


def is_mirror(T: Mat4) -> bool:
    """Whether T turns a right hand into a left one."""
    (a, b, c), (d, e, f), (g, h, i) = T[:3, :3].tolist()  # the determinant, ten times as quick as numpy's
    return bool(a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0)
