"""What moves together in synthetic furniture: which moving part carries which, and where each is at joint values.

A body is a moving part, or a still part alone. Small joints (knobs, buttons) move no body: they stay at rest.
"""

from collections.abc import Callable, Collection, Mapping

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import AnnotatedJoint, Asset
from grafu.geometry.arrays import Mat4
from grafu.graph.annotated import carrying_part


def bodies_of(asset: Asset) -> dict[str, str]:
    """Returns for each part the moving part that it moves as one with: itself where it moves or nothing carries it."""
    joints = {joint.part for joint in asset.joints}
    return {p.id: p.id if p.id in joints else carrying_part(p.id, joints, asset) or p.id for p in asset.parts}


def carriers_of(asset: Asset) -> dict[str, str]:
    """Returns for each moving part the moving part that carries it; "" where a still one does."""
    joints = {joint.part for joint in asset.joints}
    return {part: carrying_part(part, joints, asset) for part in joints}


def moving_with(asset: Asset, part: str) -> frozenset[str]:
    """Returns a part and all that rides on it, directly or on what rides on it."""
    found = {part}
    while True:
        more = {p.id for p in asset.parts if p.carried_by in found} - found
        if not more:
            return frozenset(found)
        found |= more


def busy_in(asset: Asset) -> frozenset[str]:
    """Returns the parts that move or carry others: those that are neither joined to others nor cut."""
    moving = frozenset(joint.part for joint in (*asset.joints, *asset.small_joints))
    return moving | frozenset(p.carried_by for p in asset.parts if p.carried_by)


def led_by(joints: Collection[AnnotatedJoint], part: str) -> dict[str, Callable[[float], float]]:
    """Returns for each joint that follows a part's, directly or not, its value at a value of that part's."""
    found: dict[str, Callable[[float], float]] = {part: lambda value: value}
    left = [joint for joint in joints if joint.coupling is not None and joint.part != part]
    while ready := [j for j in left if j.coupling is not None and j.coupling.leader in found]:
        for joint in ready:
            assert joint.coupling is not None
            found[joint.part] = _after(found[joint.coupling.leader], joint.coupling.value)
        left = [joint for joint in left if joint.part not in found]
    del found[part]
    return found


def poses_at(
    joints: Mapping[str, AnnotatedJoint], carriers: Mapping[str, str], values: Mapping[str, float]
) -> dict[str, Mat4]:
    """Returns the 4x4 motion from rest of each moving part that these joint values move; others stay at rest.

    What is carried moves with its carrier. Followers have the values that are given for them, or stay closed.
    """

    def pose(part: str) -> Mat4:
        own = joints[part]
        motion = motion_kind(own.type).transform(own.axis, values.get(part, 0.0))
        return pose(carriers[part]) @ motion if carriers[part] else motion

    def is_moved(part: str) -> bool:
        return part in values or bool(carriers[part] and is_moved(carriers[part]))

    return {part: np.asarray(pose(part)) for part in joints if is_moved(part)} if values else {}


def _after(first: Callable[[float], float], then: Callable[[float], float]) -> Callable[[float], float]:
    return lambda value: then(first(value))
