"""A scene's shelves and dividers before the judge of `grafu.judging.panels`, which shares nothing with their maker."""

from collections.abc import Sequence

from grafu.additions.step import Addition
from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual, VisualRole
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.judging.panels import PanelFault, panel_faults
from grafu.metrics.judged import judged_piece
from grafu.scene.scene import Scene
from grafu.vocabulary import JointType


def faults_of_panels(additions: Sequence[Addition], scene: Scene, skin: float | None = None) -> list[PanelFault]:
    """Returns (panel, fault, other part) for all that is wrong; a cut of less than `skin` metres is a touch."""
    skin = 0.001 * scene.extent if skin is None else skin
    return panel_faults(judged_piece(_standing(additions, scene)), {addition.part.id for addition in additions}, skin)


def _standing(additions: Sequence[Addition], scene: Scene) -> ArticulatedObject:
    """The scene with what was added, its moving bodies on joints."""
    parts = {**{p.id: p for p in scene.static_parts}, **{a.part.id: a.part for a in additions}}
    still = [Visual(p.id, p.surfaces, VisualRole.PART, p.label) for p in parts.values()]
    links = [Link("static body", (*still, *(visual for owner, visual in scene.hardware if not owner)))]
    joints = []
    for moving in scene.moving_bodies.values():
        members = (scene.parts[member] for member in moving.members)
        riding = [Visual(p.id, p.surfaces, VisualRole.PART, p.label) for p in members]
        links.append(Link(moving.id, (*riding, *scene.hardware_of(moving.id))))
        joints.append(_joint(moving.id, scene))
    return ArticulatedObject("scene", "static body", tuple(links), tuple(joints))


def _joint(moving: str, scene: Scene) -> Joint:
    joint_motion = scene.joint_motions.get(moving)
    if joint_motion is None:
        anywhere = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
        return Joint(moving, JointType.FIXED, "static body", moving, anywhere, JointLimits(0.0, 0.0))
    return Joint(
        moving, joint_motion.type, "static body", moving, joint_motion.axis, JointLimits(0.0, joint_motion.upper)
    )
