"""An articulated object as the judges of `grafu.judging` see it: meshes, motions, and nothing of how it was made."""

from typing import Final

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Visual, VisualRole
from grafu.articulation.sweep import values_before
from grafu.judging.piece import JudgedBody, JudgedMotion, JudgedPart, JudgedPiece, Origin

_ORIGINS: Final[dict[VisualRole, Origin]] = {
    VisualRole.PART: "input",
    VisualRole.ADDED: "added",
    VisualRole.HARDWARE: "hardware",
}


def judged_piece(articulated: ArticulatedObject) -> JudgedPiece:
    """Returns the object at rest: its root is what is static, each other link a body.

    A body starts where its joint may start: what it waits for is fully open.
    """
    above = {joint.child: joint for joint in articulated.moving_joints}
    bodies = []
    for link in articulated.links:
        if link.id == articulated.root:
            continue
        parts, joint = tuple(map(_part, link.visuals)), above.get(link.id)
        if joint is None:
            bodies.append(JudgedBody(link.id, parts))
            continue
        values = values_before(articulated, joint.id)
        starts = {child: values[other.id] for child, other in above.items() if child != link.id}
        bodies.append(JudgedBody(link.id, parts, _motion(joint), starts))
    return JudgedPiece(tuple(map(_part, articulated.link(articulated.root).visuals)), tuple(bodies))


def _part(visual: Visual) -> JudgedPart:
    return JudgedPart(visual.name, visual.mesh, visual.label, _ORIGINS[visual.role])


def _motion(joint: Joint) -> JudgedMotion:
    return JudgedMotion(joint.kind.turns, joint.axis, joint.limits.lower, joint.limits.upper)
