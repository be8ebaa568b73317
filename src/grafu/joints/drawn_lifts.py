"""Flaps that rise upright on the arms that the input draws, and what becomes of drawn arms and stays otherwise.

Drawn arms carry their flap where both move freely. Drawn stays, and arms that do not, are replaced where arms or stays
are built; where none are, they stay in place if the leaf clears them, and are left out if it does not.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual, VisualRole
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.swept_body import SweptBody
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import PoseFunction, in_the_way, is_free, swept_box, widest_free
from grafu.joints.plan import DrawnArms, RealizationPlan
from grafu.joints.realize import Realized, joint_id
from grafu.joints.report import LIFT_ARMS, Installed
from grafu.scene.obstacles import Obstacle


@final
@dataclass(frozen=True, eq=False)
class DrawnLift:
    """Drawn arms with what they look like."""

    arms: DrawnArms
    visuals: tuple[Visual, ...]

    @property
    def flap(self) -> str:
        """The part that they lift."""
        return self.arms.flap

    def joints(
        self, made: ArticulatedObject, around: Sequence[Visual], config: RealizationConfig
    ) -> tuple[Joint, Joint] | None:
        """Returns the joints of the arms and of the flap on them; None where they do not move far enough.

        `around` is all that neither belongs to the flap nor holds it; lengths of `config` are in the scale of `made`.
        """
        drawn = self.arms
        if drawn.on_case is None or drawn.on_flap is None or drawn.upper <= 0:
            return None
        on_case, on_flap = drawn.on_case, drawn.on_flap.reversed()
        before = made.joint_of[drawn.flap]
        flap = [v.mesh for v in made.link(drawn.flap).rigid_visuals if v.role is not VisualRole.HARDWARE]
        extent = float(Box.enclosing(link.mesh.box for link in made.links if len(link.mesh.faces)).size.max())

        def lifted(value: float) -> Mat4:
            return np.asarray(on_case.rotation(value) @ on_flap.rotation(value))

        bodies = (([v.mesh for v in self.visuals], on_case.rotation), (flap, lifted))
        upper = min(_free(meshes, motion, drawn.upper, around, config, extent) for meshes, motion in bodies)
        if upper < config.restricted * drawn.upper:
            return None
        name, limits = drawn.parts[0], JointLimits(0.0, upper)
        lead = Joint(joint_id(name), before.type, made.root, name, on_case, limits, before.after)
        return lead, replace(before, parent=name, axis=on_flap, limits=limits, slip=None).following(lead)


def drawn_lifts(plan: RealizationPlan, asset: Asset) -> dict[str, DrawnLift]:
    """Returns by flap the arms of a plan that could lift it upright."""
    lifts = (drawn for drawn in plan.arms if drawn.on_case is not None)
    return {drawn.flap: DrawnLift(drawn, _shown(drawn, asset)) for drawn in lifts}


def _shown(drawn: DrawnArms, asset: Asset) -> tuple[Visual, ...]:
    """Returns drawn arms or stays as they are shown."""
    parts = (asset.part(part) for part in drawn.parts)
    return tuple(Visual(part.id, part.surfaces, VisualRole.PART, part.label) for part in parts)


def _free(
    meshes: Sequence[TriangleMesh],
    motion: PoseFunction,
    reach: float,
    around: Sequence[Visual],
    config: RealizationConfig,
    extent: float,
) -> float:
    """Returns how far a body moves before it meets what it does not meet at rest, radians."""
    body = SweptBody(merge_meshes(list(meshes)), config.depth * extent)
    path = swept_box(Box.enclosing(mesh.box for mesh in meshes), motion, reach)
    near = in_the_way([Obstacle(v.name, MeshCollider(v.mesh)) for v in around], path)
    body.place(motion(0.0))
    met = set(body.penetrated([obstacle.collider for obstacle in near]))
    others = [obstacle for k, obstacle in enumerate(near) if k not in met]
    return widest_free(body, motion, reach, others, config.fine_poses, config.short)


def with_drawn_left(
    realized: Realized, plan: RealizationPlan, asset: Asset, config: RealizationConfig = RealizationConfig()
) -> tuple[Realized, frozenset[str]]:
    """Returns what was realized with the drawn arms and stays that stay in place, and the parts that are left out.

    A note on the joint of their leaf states what became of the latter.
    """
    gone: set[str] = set()
    for drawn in plan.arms:
        shown = {visual.name for link in realized.object.links for visual in link.visuals}
        if shown.issuperset(drawn.parts):
            continue
        visuals = _shown(drawn, asset)
        outcome = next((o for o in realized.report.installed if o.moving == drawn.flap), None)
        if outcome is not None and (outcome.stays or outcome.template == LIFT_ARMS):
            realized = _noted(realized, drawn, "replaced")
            gone |= {*drawn.parts}
        elif outcome is None or _clears(realized.object, drawn.flap, visuals, config):
            realized = _put_back(realized, visuals)
        else:
            realized = _noted(realized, drawn, "left out: they would be in its way, and no others find room")
            gone |= {*drawn.parts}
    return realized, frozenset(gone)


def _clears(made: ArticulatedObject, flap: str, visuals: tuple[Visual, ...], config: RealizationConfig) -> bool:
    """Whether a leaf moves past drawn parts all the way."""
    joint = made.joint_of[flap]
    extent = float(Box.enclosing(link.mesh.box for link in made.links if len(link.mesh.faces)).size.max())
    body = SweptBody(merge_meshes([v.mesh for v in made.link(flap).rigid_visuals]), config.depth * extent)
    obstacles = [Obstacle(v.name, MeshCollider(v.mesh)) for v in visuals]
    return joint.parent == made.root and is_free(body, joint.motion, joint.limits.upper, obstacles, config.fine_poses)


def _put_back(realized: Realized, visuals: tuple[Visual, ...]) -> Realized:
    made = realized.object
    links = (Link(link.id, (*link.visuals, *visuals)) if link.id == made.root else link for link in made.links)
    return replace(realized, object=replace(made, links=tuple(links)))


def _noted(realized: Realized, drawn: DrawnArms, what: str) -> Realized:
    note = f"the drawn {', '.join(drawn.parts)} are {what}"
    outcomes = tuple(
        replace(o, notes=(*o.notes, note)) if isinstance(o, Installed) and o.moving == drawn.flap else o
        for o in realized.report.outcomes
    )
    return replace(realized, report=replace(realized.report, outcomes=outcomes))
