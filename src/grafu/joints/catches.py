"""Which doors and drawers get a catch: those that move by themselves and that gravity neither opens nor closes.

Lids, flaps and fronts that drop or tilt are held by their weight, friction or stays. No hardware is added for a catch.
"""

from dataclasses import replace

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Link, VisualRole
from grafu.articulation.catch import DEFAULT_CATCH_CONFIG, CatchConfig
from grafu.articulation.catch_kind import CatchKind


def with_catches(
    articulated: ArticulatedObject, kind: CatchKind, config: CatchConfig = DEFAULT_CATCH_CONFIG
) -> ArticulatedObject:
    """Returns the object with catches of a kind on its doors and drawers; with `none` the object as it is."""
    if kind is CatchKind.NONE:
        return articulated
    joints = tuple(
        replace(joint, catch=kind) if _takes_one(joint, articulated.link(joint.child), config.level) else joint
        for joint in articulated.joints
    )
    return replace(articulated, joints=joints)


def _takes_one(joint: Joint, link: Link, level: float) -> bool:
    """Whether a joint is of a door or drawer, moves by itself, and moves levelly."""
    if joint.coupling is not None or not joint.kind.limited or not joint.limits.range > 0:
        return False
    if not any(visual.role is VisualRole.PART and visual.label.is_movable for visual in link.visuals):
        return False
    x, y, z = joint.axis.direction
    if joint.kind.slides:
        return abs(float(z)) <= level
    return joint.kind.turns and float(x * x + y * y) <= level**2
