"""Rigid (and similarity) transforms as 4x4 matrices, `T_target_source`.

Angles are radians, positive by the right-hand rule; quaternions are wxyz.
"""

import warnings

import numpy as np

from grafu.geometry.arrays import Mat3, Mat4, Points, Vec3


def transform_points(T: Mat4, points: Points) -> Points:
    """Returns the points mapped by T."""
    return points @ T[:3, :3].T + T[:3, 3]


def transform_direction(T: Mat4, direction: Vec3) -> Vec3:
    """Returns the unit direction mapped by the linear part of T (a polar vector: mirrored like a displacement)."""
    mapped = T[:3, :3] @ direction
    return mapped / np.linalg.norm(mapped)


def translation(offset: Vec3) -> Mat4:
    """Returns the transform that shifts by `offset`."""
    T = np.eye(4)
    T[:3, 3] = offset
    return T


def from_rotation(R: Mat3, offset: Vec3 | None = None) -> Mat4:
    """Returns the transform with linear part R and translation `offset` (none: zero)."""
    T = np.eye(4)
    T[:3, :3] = R
    if offset is not None:
        T[:3, 3] = offset
    return T


def rotation_matrix(direction: Vec3, angle: float) -> Mat3:
    """Returns the rotation by `angle` about the unit `direction`."""
    from scipy.spatial.transform import Rotation  # local: scipy.spatial costs 0.1 s, and the command's help needs none

    return Rotation.from_rotvec(angle * np.asarray(direction)).as_matrix()


def quaternion_matrix(w: float, x: float, y: float, z: float) -> Mat3:
    """Returns the rotation of a quaternion of any length but 0."""
    from scipy.spatial.transform import Rotation  # local, as above

    quaternion = np.array([x, y, z, w])
    return Rotation.from_quat(quaternion / np.abs(quaternion).max()).as_matrix()  # no length over- or underflows


def roll_pitch_yaw(R: Mat3) -> Vec3:
    """Returns URDF's angles: about the fixed X, then Y, then Z axis. Where pitch is 90 degrees, yaw is 0."""
    from scipy.spatial.transform import Rotation  # local, as above

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # there roll and yaw turn about one axis, so one of them is free
        return Rotation.from_matrix(R).as_euler("xyz")


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
