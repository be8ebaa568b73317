"""What a method made of each part that counts: its motion, collisions, widest gap and opening. It draws no table."""

from collections.abc import Sequence
from math import isfinite
from typing import final

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.dataclass import dataclass
from grafu.evaluation.moving_parts import MovingPart
from grafu.metrics.collision import (
    STRICT,
    TOLERANT,
    CollisionConfig,
    ConnectivityConfig,
    collision_shares,
    largest_gaps,
)
from grafu.metrics.motion import Motion, compare_motions

OPENS = 0.7  # of the reference: what opens less is reported as restricted, and does not work
_CONNECTED = ConnectivityConfig().tolerance


@final
@dataclass(frozen=True)
class PartMeasure:
    """One part in one result.

    `found` is how it moves there. `collision` and `touch` are fractions of 50 poses, cut deeper than the tolerance and
    touching at all; `gap` is the widest distance to the static body over the input's largest side; `opening` is the
    fraction of the reference, at most 1. Of a part that is static `found`, `collision`, `touch` and `gap` are None:
    nothing was made of it, so that it is neither aligned nor connected, but collides with nothing either.
    """

    part: str
    found: Motion | None = None
    aligned: bool = False
    collision: float | None = None
    touch: float | None = None
    gap: float | None = None
    opening: float = 0.0

    @property
    def connected(self) -> bool:
        """Whether it moves and stays within 5 mm of the static body, in a unit cube."""
        return self.gap is not None and self.gap <= _CONNECTED

    @property
    def works(self) -> bool:
        """Whether it moves as it should, freely, connected, and far enough: all at once."""
        return self.aligned and self.collision == 0 and self.connected and self.opening >= OPENS


def measure_parts(
    articulated: ArticulatedObject, truth: Sequence[MovingPart], extent: float, poses: int = 50, with_touch: bool = True
) -> tuple[PartMeasure, ...]:
    """Returns one measure per part of the truth, in its order; `extent` is the input's largest side in metres.

    A part is found by its visual, whichever link holds it. `with_touch=False` saves the time that touches take.
    """
    joints = joints_by_part(articulated)
    motions = {part.id: _motion(joints[part.id], part) for part in truth if part.id in joints}
    true = {part.id: part.motion for part in truth}
    agreed = {agreement.part: agreement.whole for agreement in compare_motions(motions, true)}
    tolerant = CollisionConfig(poses=poses, tolerance=TOLERANT.tolerance, extent=extent)
    cuts = collision_shares(articulated, tolerant)
    strict = CollisionConfig(poses=poses, tolerance=STRICT.tolerance, extent=extent)
    touches = collision_shares(articulated, strict) if with_touch else {}
    gaps = largest_gaps(articulated, ConnectivityConfig(poses=poses, extent=extent))
    found = []
    for part in truth:
        joint = joints.get(part.id)
        if joint is None:
            found.append(PartMeasure(part.id))
            continue
        found.append(
            PartMeasure(
                part.id,
                motions[part.id],
                agreed[part.id],
                cuts[joint.id],
                touches.get(joint.id),
                gaps[joint.id] / extent if isfinite(gaps[joint.id]) else 1.0,
                min(joint.limits.range / part.reference, 1.0) if joint.type is part.motion.type else 0.0,
            )
        )
    return tuple(found)


def joints_by_part(articulated: ArticulatedObject) -> dict[str, Joint]:
    """Returns for each part that moves the joint above the link that holds it."""
    moving = {joint.child: joint for joint in articulated.moving_joints}
    return {v.name: moving[link.id] for link in articulated.links if link.id in moving for v in link.visuals}


def _motion(joint: Joint, part: MovingPart) -> Motion:
    return Motion(joint.type, joint.axis, part.motion.center)
