"""Made furniture as an articulated object: its true joints as links, joints and limits, and which opens before which.

It moves nothing and draws nothing: the joints are those that the asset states.
"""

from collections.abc import Mapping

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.kinematics import all_before
from grafu.asset.part import AnnotatedJoint, Asset, Part
from grafu.synth.truth.clashes import Clashes, clashes_of


def articulated_of(whole: Asset) -> ArticulatedObject:
    """Returns one static root link with all still parts, and a link for each joint with what rides on its part.

    Joints open from 0 to their upper limit. A joint waits (`after`) for each moving part that it would run into where
    that part is closed, but not where it is open: a drawer waits for the doors before it.

    Raises:
        ArticulationError: if an upper limit is negative or not finite.
        ValueError: if two joints name one part, or one names a part that rides on another.
    """
    moving_bodies = {joint.part for joint in whole.joints}
    riding = sorted(i for i in moving_bodies if whole.part(i).rides_on)
    if len(moving_bodies) < len(whole.joints) or riding:
        raise ValueError(f"each joint of `{whole.name}` must have a part of its own that rides on nothing: {riding}")
    root = _free_name("body", {part.id for part in whole.parts})
    still = [part for part in whole.parts if (part.rides_on or part.id) not in moving_bodies]
    links = [Link(root, tuple(_visual(part) for part in still))]
    clashes, waits = clashes_of(whole), dict[str, tuple[str, ...]]()
    for joint in sorted(whole.joints, key=lambda j: len(clashes.bodies_hit(j.part))):
        waits[joint.part] = _waits_for(joint.part, clashes, waits)
    for joint in whole.joints:
        members = [part for part in whole.parts if joint.part in (part.id, part.rides_on)]
        links.append(Link(joint.part, tuple(_visual(part) for part in members)))
    joints = tuple(_joint(joint, root, waits[joint.part]) for joint in whole.joints)
    return ArticulatedObject(whole.name, root, tuple(links), joints)


def _waits_for(part: str, clashes: Clashes, waits: Mapping[str, tuple[str, ...]]) -> tuple[str, ...]:
    """Returns the moving parts that must be open before a part moves, none of which waits for that part itself."""
    others = [other for other in clashes.bodies_hit(part) if part not in all_before(other, waits)]
    if not others:
        return ()
    still_hit = {clashes.carrier(hit) for hit in clashes.hits(part, others)}
    return tuple(other for other in others if other not in still_hit)


def _joint(joint: AnnotatedJoint, root: str, after: tuple[str, ...]) -> Joint:
    limits = JointLimits(0.0, joint.upper)
    return Joint(_joint_id(joint.part), joint.type, root, joint.part, joint.axis, limits, tuple(map(_joint_id, after)))


def _joint_id(part: str) -> str:
    return f"{part}_joint"


def _visual(part: Part) -> Visual:
    return Visual(part.id, part.surfaces, label=part.label)


def _free_name(wanted: str, taken: set[str]) -> str:
    return wanted if wanted not in taken else _free_name(f"{wanted}_", taken)
