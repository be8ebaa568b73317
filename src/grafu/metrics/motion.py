"""Do two sets of joints agree: same type, same signed direction within 10 degrees, and for hinges the same border.

The paper matches motions one to one by axis position and sign. Here position means the border: which side of the part
the axis lies on, so that a pin moved from the panel's middle to its corner still agrees (docs/metrics.md).
"""

from collections.abc import Mapping
from math import radians
from typing import final

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.motion_kind import motion_kind
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.vocabulary import JointType

ANGLE = radians(10)


@final
@dataclass(frozen=True, slots=True)
class Motion:
    """How one part moves: positive motion along or about `axis` opens. `center` is the middle of its box, metres.

    `both_ways` states about a true motion that the part was drawn half open: either sense agrees with it.
    """

    type: JointType
    axis: Axis
    center: Vec3
    both_ways: bool = False


@final
@dataclass(frozen=True, slots=True)
class MotionAgreement:
    """What of one part's true motion was found; nothing of a part that was left static agrees."""

    part: str
    type: bool
    direction: bool
    border: bool

    @property
    def whole(self) -> bool:
        """Whether type, direction and border agree."""
        return self.type and self.direction and self.border


def motion_agreement(
    found: ArticulatedObject, truth: ArticulatedObject, angle: float = ANGLE
) -> tuple[MotionAgreement, ...]:
    """Returns one agreement per moving joint of `truth`; links are matched by id, `angle` is in radians."""
    return compare_motions(motions_of(found), motions_of(truth), angle)


def agreement_ratio(agreements: tuple[MotionAgreement, ...]) -> float:
    """Returns the fraction of true motions that agree as a whole, 1 where there are none."""
    return sum(a.whole for a in agreements) / len(agreements) if agreements else 1.0


def motions_of(articulated: ArticulatedObject) -> dict[str, Motion]:
    """Returns the motion of each moving link by its id."""
    return {
        joint.child: Motion(joint.type, joint.axis, articulated.link(joint.child).body_mesh.box.center)
        for joint in articulated.moving_joints
    }


def compare_motions(
    found: Mapping[str, Motion], truth: Mapping[str, Motion], angle: float = ANGLE
) -> tuple[MotionAgreement, ...]:
    """Returns one agreement per part of `truth`, in its order."""
    return tuple(_compare(part, found.get(part), motion, angle) for part, motion in truth.items())


def _compare(part: str, found: Motion | None, truth: Motion, angle: float) -> MotionAgreement:
    if found is None:
        return MotionAgreement(part, False, False, False)
    same_type = found.type is truth.type
    senses = (truth.axis, truth.axis.reversed()) if truth.both_ways else (truth.axis,)
    same_direction = same_type and any(found.axis.angle_to(sense) <= angle for sense in senses)
    return MotionAgreement(part, same_type, same_direction, same_direction and _same_border(found, truth))


def _same_border(found: Motion, truth: Motion) -> bool:
    """Whether both axes pass the part's middle on one side; a slide has no border."""
    if not motion_kind(truth.type).turns:
        return True
    to_found = found.axis.closest_point(truth.center) - truth.center
    to_truth = truth.axis.closest_point(truth.center) - truth.center
    return float(to_found @ to_truth) > 0
