"""Where the weight that a leading joint feels acts: of arms that lift a flap upright, of leaves that fold up.

What follows the joint does not turn with it as one body. Gravity's torque about a level axis is then that of one mass
at a point of the leader's child: at the ends of the arms, say. It decides nothing about how the joint is held.
"""

from collections.abc import Mapping, Sequence
from math import cos, sin

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.articulation.kinematics import link_poses
from grafu.articulation.mass import MassProperties
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.transform import transform_points

_STEP = 1e-4  # radians: over which the change of height is taken
_EXACT = 0.02  # of the largest torque: by so much it may differ from that of one mass
_AT = (0.0, 0.5, 1.0)  # of the joint's range: where the torque is computed


def coupled_center(
    articulated: ArticulatedObject, joint: Joint, carried: Sequence[str], masses: Mapping[str, MassProperties]
) -> Vec3 | None:
    """Returns the point of a joint's child, at rest, at which all `carried` weight acts on it; None: it is at no one.

    `joint` leads others and turns about a level axis; `carried` are the ids of the links that move with it.
    """
    upper = joint.limits.upper
    mass = sum(masses[link].mass for link in carried)
    if not upper > 0 or not mass > 0:
        return None
    lifts = [_lift(articulated, joint, ratio * upper, carried, masses) for ratio in _AT]
    x = lifts[0]
    z = (x * cos(upper) - lifts[-1]) / sin(upper) if abs(sin(upper)) > _EXACT else 0.0
    if abs(sin(upper)) <= _EXACT:
        middle = _AT[1] * upper
        z = (x * cos(middle) - lifts[1]) / sin(middle)
    off = max(abs(x * cos(r * upper) - z * sin(r * upper) - lift) for r, lift in zip(_AT, lifts, strict=True))
    if off > _EXACT * max(abs(lift) for lift in lifts):
        return None
    outwards = np.cross(vec3(0.0, 0.0, 1.0), joint.axis.direction)
    return np.asarray(joint.axis.point + outwards * x / mass + vec3(0.0, 0.0, z / mass))


def _lift(
    articulated: ArticulatedObject,
    joint: Joint,
    value: float,
    carried: Sequence[str],
    masses: Mapping[str, MassProperties],
) -> float:
    """Returns by how much all weight rises for each radian of a joint at a value, kg m."""
    heights = []
    for at in (value - _STEP, value + _STEP):
        poses = link_poses(articulated, {joint.id: at})
        heights.append(
            sum(masses[k].mass * float(transform_points(poses[k], masses[k].center[None])[0, 2]) for k in carried)
        )
    return (heights[1] - heights[0]) / (2 * _STEP)
