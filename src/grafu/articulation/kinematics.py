"""Joint values in, the motion of every link out; where each link's own frame stands; which joints wait for others.

Exporters and simulators need one frame per link. What has to be open before a part may move is asked by values alone.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.errors import ArticulationError
from grafu.geometry.arrays import Mat4, Vec3, frozen_array, vec3

_ALIKE = 1e-6  # radians or metres
REST: Final = frozen_array(np.eye(4))
"""The pose of a link that has not moved."""


def all_before(name: str, waits: Mapping[str, Iterable[str]]) -> set[str]:
    """Returns what a part waits for, what that waits for, and so on; `waits` states what each waits for by itself."""
    found: set[str] = set()
    queue = [name]
    while queue:
        for before in waits.get(queue.pop(), ()):
            if before not in found:
                found.add(before)
                queue.append(before)
    return found


def joint_origin(articulated: ArticulatedObject, joint: Joint) -> Vec3:
    """Returns the point of the joint's axis nearest to the middle of its child, metres, object frame at rest."""
    mesh = articulated.link(joint.child).mesh
    return joint.axis.closest_point(mesh.box.center) if len(mesh.faces) else joint.axis.point


def link_origins(articulated: ArticulatedObject) -> dict[str, Vec3]:
    """Returns the origin of every link's frame in the object frame at rest: the root's is zero, others' their joint's.

    All link frames are parallel to the object frame at rest.
    """
    joints = articulated.joint_of
    root = {articulated.root: vec3(0.0, 0.0, 0.0)}
    return root | {link: joint_origin(articulated, joint) for link, joint in joints.items()}


def with_coupled(articulated: ArticulatedObject, values: Mapping[str, float]) -> dict[str, float]:
    """Returns the values together with those of all coupled joints, which follow from their leaders'.

    A joint that `values` leaves out counts as closed (0).

    Raises:
        ArticulationError: if a value is given for a coupled joint that is not the one it has at its leader's.
    """
    coupled = articulated.couplings
    found = {name: value for name, value in values.items() if name not in coupled}

    def value_of(name: str) -> float:
        coupling = coupled.get(name)
        return found.get(name, 0.0) if coupling is None else coupling.value(value_of(coupling.leader))

    for name, coupling in coupled.items():
        value = value_of(name)
        if abs(values.get(name, value) - value) > _ALIKE:
            raise ArticulationError(f"`{name}` follows `{coupling.leader}`: it is at {value}, got {values[name]}")
        found[name] = value
    return found


def link_poses(articulated: ArticulatedObject, values: Mapping[str, float], shown: bool = False) -> dict[str, Mat4]:
    """Returns for each link id its motion from rest, in the object frame, chained from the root outwards.

    A link that hangs on none that moves has the pose `REST` itself. `shown` adds what joints are shown to do beside
    their motion (`Slip`).

    A joint that `values` leaves out stays closed (0); a coupled joint follows its leader. Values are radians or metres;
    limits are not applied.

    Raises:
        ArticulationError: if `values` names a joint that the object does not have, or puts a coupled joint elsewhere.
    """
    return dict.fromkeys(articulated.ids_from_root, REST) | moved_poses(articulated, values, shown)


def moved_poses(articulated: ArticulatedObject, values: Mapping[str, float], shown: bool = False) -> dict[str, Mat4]:
    """Returns the poses of those links alone that hang on a joint which moves: few of many, in most poses.

    Everything else is as in `link_poses`.
    """
    if unknown := values.keys() - articulated.joints_by_id.keys():
        known = [joint.id for joint in articulated.joints]
        found = sorted(unknown)
        raise ArticulationError(f"joint values must name joints of `{articulated.name}`: got {found}, it has {known}")
    values, poses = with_coupled(articulated, values), dict[str, Mat4]()
    for link in _moved(articulated, values, shown):
        joint = articulated.joint_of[link]
        motion = joint.shown_motion if shown else joint.motion
        poses[link] = poses.get(joint.parent, REST) @ motion(values.get(joint.id, 0.0))
    return poses


def _moved(articulated: ArticulatedObject, values: Mapping[str, float], shown: bool) -> Sequence[str]:
    """Returns the links that joints move, or that hang on such, every parent before its children."""
    joints = [articulated.joints_by_id[name] for name, value in values.items() if value != 0.0]
    if shown:
        joints += [joint for joint in articulated.joints if joint.slip is not None]
    if len(joints) == 1:
        return articulated.links_below[joints[0].child]
    moved = {link for joint in joints for link in articulated.links_below[joint.child]}
    return [link for link in articulated.ids_from_root if link in moved]
