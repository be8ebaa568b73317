"""Joint values in, the motion of every link out. It knows no meshes and does not ask whether a value is allowed."""

from collections.abc import Mapping

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.errors import ArticulationError
from grafu.geometry.arrays import Mat4


def link_poses(articulated: ArticulatedObject, values: Mapping[str, float]) -> dict[str, Mat4]:
    """Returns for each link id its motion from rest, in the object frame, chained from the root outwards.

    A joint that `values` leaves out stays closed (0). Values are radians or metres; limits are not applied.

    Raises:
        ArticulationError: if `values` names a joint that the object does not have.
    """
    unknown = sorted(set(values) - {joint.id for joint in articulated.joints})
    if unknown:
        known = [joint.id for joint in articulated.joints]
        raise ArticulationError(f"joint values must name joints of `{articulated.name}`: got {unknown}, it has {known}")
    poses: dict[str, Mat4] = {}
    for link in articulated.links_from_root:
        joint = articulated.joint_of.get(link.id)
        poses[link.id] = np.eye(4) if joint is None else poses[joint.parent] @ joint.motion(values.get(joint.id, 0.0))
    return poses
