"""Where a hand pulls a joint, and in which direction: at the middle of its handle, else at the front's free edge."""

from collections.abc import Mapping
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.articulation.kinematics import link_poses
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Vec3, freeze_arrays
from grafu.geometry.transform import invert, transform_points
from grafu.vocabulary import PartLabel

_EDGE = 0.02  # of the greatest distance from the axis: what is as far belongs to the free edge


@final
@dataclass(frozen=True, eq=False, slots=True)
class GripPoint(ArrayValue):
    """A point (metres) and the unit direction in which it sets off when the joint opens further; object frame."""

    point: Vec3
    direction: Vec3

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float64)


def grip_point(articulated: ArticulatedObject, joint: Joint, values: Mapping[str, float] | None = None) -> GripPoint:
    """Returns where a joint's child is pulled with joints at these values (radians or metres; left out: closed).

    The direction is zero where the point turns on the spot.
    """
    values = values or {}
    poses = link_poses(articulated, values)
    at_rest = grip_at_rest(articulated, joint)
    point = transform_points(poses[joint.child], at_rest[None])[0]
    moved = joint.motion(values.get(joint.id, 0.0))
    direction = joint.kind.sets_off(joint.axis, transform_points(moved, at_rest[None])[0])
    to_parent = poses[joint.child] @ invert(moved)
    return GripPoint(point, to_parent[:3, :3] @ direction)


def grip_at_rest(articulated: ArticulatedObject, joint: Joint) -> Vec3:
    """Returns the grip of a joint's child at rest, metres: the middle of its handles, else of its free edge.

    The free edge of what turns is farthest from the axis, that of what slides first on its way.
    """
    link = articulated.link(joint.child)
    handles = [v.mesh.vertices for v in link.visuals if v.label is PartLabel.HANDLE and len(v.mesh.vertices)]
    if handles:
        return _middle(np.vstack(handles))
    vertices = link.body_mesh.vertices
    if not len(vertices):
        return joint.axis.point
    far = joint.axis.distances_to(vertices) if joint.kind.turns else vertices @ joint.axis.direction
    return _middle(vertices[far >= far.max() - _EDGE * max(float(np.ptp(far)), 1e-9)])


def _middle(points: np.ndarray) -> Vec3:
    return np.asarray((points.min(axis=0) + points.max(axis=0)) / 2)
