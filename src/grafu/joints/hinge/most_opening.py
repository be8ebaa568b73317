"""How far what turns may open at most, whatever is free: doors, flaps until they are level, lids. It sweeps nothing."""

from math import atan2, pi

import numpy as np

from grafu.geometry.arrays import Vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.config import RealizationConfig
from grafu.joints.plan import JointRequest
from grafu.scene.border import BorderFrame


def most_opening(request: JointRequest, frame: BorderFrame, mesh: TriangleMesh, config: RealizationConfig) -> float:
    """Returns how far what hangs so opens at most, radians: a door to `door_opening`, a lid past upright.

    A flap opens until it is level, and so does the front of a desk that slopes up from its hinges, however flat; one
    that goes up opens wider where that is stated. Nothing opens further than it is to stop, unless the user chose an
    opening or a leader states it.
    """
    most = config.door_opening
    if request.choice.opening is not None or request.coupling is not None:
        return most
    axis, across = frame.direction(0.0, 0.0, 1.0), frame.direction(1.0, 0.0, 0.0)
    if abs(float(axis[2])) <= config.level_axis:
        leaf = _along(mesh, axis, across, config.sloping)
        level = atan2(float(leaf[2]), -float(np.cross(axis, leaf)[2])) % pi
        if abs(float(across[2])) < config.upright and float(leaf[2]) < config.rising:
            most = min(config.lid_opening, most)
        elif float(leaf[2]) < 0:
            most = max(level, min(request.reference or 0.0, most))
        else:
            most = level
    return min(most, request.stop or pi)


def _along(mesh: TriangleMesh, axis: Vec3, across: Vec3, thin: float) -> Vec3:
    """Returns the unit direction of a leaf from its hinge border: `across`, unless it is a board that slopes."""
    normal = np.cross(axis, across)
    plane = np.column_stack([across, normal])
    points = mesh.vertices @ plane
    sides = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2]
    local = points @ sides.T
    if np.ptp(local[:, 1]) > thin * np.ptp(local[:, 0]):
        return across
    along = sides[0] * np.sign(sides[0, 0])
    return np.asarray(plane @ along)
