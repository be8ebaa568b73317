"""How little a stated joint looks like one of furniture, where its frame must be guessed. It mends no joint.

In the object frame the front is -Y: drawers slide out there, doors swing out there, lids lift; what sets off
sideways is a little odd, and so is what comes out behind.
"""

import numpy as np

from grafu.articulation.articulated_object import Joint, JointLimits
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.transform import transform_points
from grafu.vocabulary import JointType

_SIDEWAYS = 0.8  # how much of setting off to the front it is to set off sideways, or out behind
_A_LITTLE = 1e-3  # radians or metres: how far a joint is moved to see where the part sets off


def strangeness(kind: JointType, axis: Axis, lower: float, upper: float, box: Box, whole: Box) -> float:
    """Returns from 0 (as expected) to 1 how odd a joint is for a part with this box of an object with that box.

    Half of it is where the part sets off to; of a hinge the other half is how far its axis runs from the part, or
    how much across the part's plane.
    """
    sense = 1.0 if abs(upper) >= abs(lower) else -1.0
    x, y, z = _sets_off(kind, axis, sense * _A_LITTLE, box.center).tolist()
    lifts = z if kind is JointType.REVOLUTE and box.thin_axis == 2 else -1.0
    out_behind = _SIDEWAYS * y if box.center[1] > whole.center[1] else -1.0
    backwards = (1.0 - max(-y, lifts, _SIDEWAYS * abs(x), out_behind)) / 2
    if kind is not JointType.REVOLUTE:
        return backwards
    across = abs(float(axis.direction[box.thin_axis]))
    return 0.5 * backwards + 0.5 * max(min(_distance(axis, box) / max(box.diagonal, 1e-12), 1.0), across)


def _sets_off(kind: JointType, axis: Axis, value: float, point: Vec3) -> Vec3:
    """Returns the unit direction in which a point sets off; zero where it turns on the spot."""
    motion = Joint("", kind, "", "", axis, JointLimits(0.0, 0.0)).motion(value)
    step = transform_points(motion, point[None])[0] - point
    length = float(np.linalg.norm(step))
    return step / length if length > 1e-12 else np.zeros(3)


def _distance(axis: Axis, box: Box) -> float:
    """Returns how far a line passes a box, measured in the plane across the line."""
    first = np.cross(axis.direction, np.eye(3)[int(np.argmin(np.abs(axis.direction)))])
    first /= np.linalg.norm(first)
    across = np.stack([first, np.cross(axis.direction, first)])
    corners, point = box.corners() @ across.T, across @ axis.point
    outside = np.maximum(np.maximum(corners.min(axis=0) - point, point - corners.max(axis=0)), 0.0)
    return float(np.linalg.norm(outside))
