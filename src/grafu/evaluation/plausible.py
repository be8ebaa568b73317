"""Could people have meant this motion: it fits the part, hangs where something holds it, opens freely, and outwards.

It asks no annotation how the part truly moves: another door of the same cabinet may be hinged on either side. Meshes
are taken as they are; nothing is mended.
"""

from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.evaluation.measures import OPENS, joints_by_part
from grafu.evaluation.moving_parts import MovingPart, usual_opening
from grafu.geometry.arrays import Points
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.sampling import distances_up_to, sample_surface
from grafu.geometry.swept_body import SweptBody
from grafu.geometry.transform import transform_points
from grafu.metrics.collision import TOLERANT
from grafu.vocabulary import PartLabel

NEAR = 0.03  # of the object's largest side: what is farther from the pin, or from a slide, holds nothing
HELD = 0.5  # of the hinge line must have both the part and the body beside it
LEVER = 1 / 3  # of the distance from the pin to the far edge: a handle nearer than that opens nothing
_LINE_POINTS, _SAMPLES = 9, 200
_POSES = 35  # of 50: those up to the opening that is asked for


@final
@dataclass(frozen=True)
class Plausibility:
    """Whether a motion is one that people could have meant; `why` names the first thing that speaks against it."""

    plausible: bool
    why: str = ""


def judge_motion(raw: ArticulatedObject, asset: Asset, part: MovingPart) -> Plausibility:
    """Returns whether the motion of a part in a raw object is plausible."""
    joint = joints_by_part(raw).get(part.id)
    if joint is None:
        return Plausibility(False, "it is static")
    case = _Case(raw, asset, part, joint)
    for objection in (case.wrong_type, case.not_held, case.not_outwards, case.handle_at_the_pin, case.not_free):
        if why := objection():
            return Plausibility(False, why)
    return Plausibility(True)


@final
class _Case:
    """One part with its motion, its own mesh and the static body."""

    def __init__(self, raw: ArticulatedObject, asset: Asset, part: MovingPart, joint: Joint) -> None:
        self._asset, self._part, self._joint = asset, part, joint
        self._moving: TriangleMesh = raw.link(joint.child).body_mesh
        self._static: TriangleMesh = raw.link(raw.root).body_mesh
        usual = usual_opening(joint.type, joint.axis, self._moving.box)
        self._reach = OPENS * (min(part.reference, usual) if joint.type is part.motion.type else usual)

    def wrong_type(self) -> str:
        """Returns why a door may not slide out, or a drawer turn."""
        label, usual = self._part.label, self._joint.kind.label
        if not label.is_movable or label is usual or self._joint.type is self._part.motion.type:
            return ""
        return f"a {self._part.label.value} that is {self._joint.type.value}"

    def not_held(self) -> str:
        """Returns why nothing holds it: beside its hinge line, or along its slide."""
        near = NEAR * self._asset.extent
        if not len(self._static.faces):
            return "there is no body"
        if self._joint.kind.slides:
            held, body = MeshCollider(self._static), MeshCollider(self._moving)
            for value in np.linspace(0.0, self._reach, 5):
                body.place(self._joint.motion(float(value)))
                if body.distance(held) > near:
                    return "it comes off the body"
            return ""
        points = self._hinge_line()
        both = (distances_up_to(points, self._moving, near) <= near) & (
            distances_up_to(points, self._static, near) <= near
        )
        return "" if both.mean() >= HELD else "nothing holds it along its hinge line"

    def not_outwards(self) -> str:
        """Returns why it does not move away from the body."""
        samples = sample_surface(self._moving, _SAMPLES).points
        body, T = self._static.box, self._joint.motion(self._reach)
        moved = transform_points(T, samples)
        inside = [float(body.contains(points).mean()) for points in (samples, moved)]
        middle = self._moving.box.center[None]
        out = [_outside(body, points) for points in (middle, transform_points(T, middle))]
        travelled = float(np.linalg.norm(transform_points(T, middle) - middle))
        if inside[1] > inside[0] + 0.02:
            return "it moves into the body"
        return "" if out[1] - out[0] > 0.1 * travelled else "it does not move away from the body"

    def handle_at_the_pin(self) -> str:
        """Returns why its handles cannot open it."""
        if not self._joint.kind.turns:
            return ""
        members = (self._asset.part(m) for m in self._part.members[1:])
        handles = [p.box.center for p in members if p.label is PartLabel.HANDLE]
        far = max(self._joint.axis.distance_to(corner) for corner in self._moving.box.corners())
        levers = [self._joint.axis.distance_to(center) for center in handles]
        return "its handle sits beside the pin" if levers and max(levers) < LEVER * far else ""

    def not_free(self) -> str:
        """Returns why it does not open: it cuts into the body along the path."""
        body, obstacle = SweptBody(self._moving, TOLERANT.tolerance * self._asset.extent), MeshCollider(self._static)
        for value in np.linspace(0.0, self._reach, _POSES):
            body.place(self._joint.motion(float(value)))
            if body.penetrates(obstacle):
                return "it cuts into the body along its path"
        return ""

    def _hinge_line(self) -> Points:
        """Returns points on the axis beside the part, its ends left out."""
        axis = self._joint.axis
        start = axis.closest_point(self._moving.box.center)
        along = (self._moving.box.corners() - start) @ axis.direction
        values = np.linspace(along.min(), along.max(), _LINE_POINTS + 2)[1:-1]
        return start + values[:, None] * axis.direction


def _outside(box: Box, points: Points) -> float:
    """Returns how far a point lies outside a box, metres; negative inside."""
    beyond = np.maximum(box.low - points[0], points[0] - box.high)
    return float(np.linalg.norm(np.maximum(beyond, 0.0)) + min(beyond.max(), 0.0))
