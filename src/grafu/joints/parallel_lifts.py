"""Flaps that rise upright on arms, after all else is built: a joint of the arms on the case, one of the flap on them.

A flap that is to rise so is built as one that turns about its upper edge; where arms find room they replace its hinges,
and the flap's joint turns it back by as much as the arms turn, so that it stays upright.
"""

import re
from collections.abc import Collection, Mapping
from dataclasses import replace
from types import MappingProxyType

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual, VisualRole
from grafu.asset.names import spoken
from grafu.asset.part import Asset, Part, PartSource
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.joints.config import RealizationConfig
from grafu.joints.drawn_lifts import DrawnLift
from grafu.joints.leaves import Leaf, leaf_of
from grafu.joints.lift_arm_config import DEFAULT_LIFT_ARM_CONFIG, LiftArmConfig
from grafu.joints.lift_arms import ArmPlace, Arms, arm_places, arms_of, furthest, walls_beside
from grafu.joints.motion_choice import MotionChoice, Moves, Side, axis_of_motion
from grafu.joints.no_hardware import DRAWN
from grafu.joints.plan import JointRequest, MotionRole, RealizationPlan
from grafu.joints.realize import Realized, joint_id
from grafu.joints.report import LIFT_ARMS, Installed, Outcome, RealizationReport
from grafu.scene.obstacles import Obstacle
from grafu.scene.scale import metre_on
from grafu.vocabulary import MechanismClass

NONE_DRAWN: Mapping[str, DrawnLift] = MappingProxyType({})
NO_ARMS = "it turns about its upper edge: lift arms find no room, or would hardly lift it"
_NEAR = 0.001  # metres: what a plate rests on is nearer
_ENDS = ("left", "right")
_LIFTED = MotionChoice(Moves.LIFTS, Side.TOP)
_PARALLEL = frozenset({"parallel", "hochlift"})
_LIFT = frozenset({"lift", "lifts", "flap", "door", "hochlift"})


def with_named_lifts(plan: RealizationPlan, asset: Asset) -> RealizationPlan:
    """Returns a predicted plan in which upright fronts that are called parallel lifts rise on arms."""
    return replace(plan, joints=tuple(_named(request, asset) for request in plan.joints))


def _named(request: JointRequest, asset: Asset) -> JointRequest:
    part = asset.part(request.moving)
    words = set(spoken(part.source.name))
    if request.parent or request.coupling or not (words & _PARALLEL and words & _LIFT):
        return request
    axis = axis_of_motion(part, _LIFTED, asset.box)
    return replace(request, type=_LIFTED.type, axis=axis, reference=None, mounts=(), role=MotionRole.LIFTED)


def with_lifted(plan: RealizationPlan, stated: Collection[str]) -> RealizationPlan:
    """Returns the plan in which the stated flaps are to rise on arms."""
    joints = (replace(r, role=MotionRole.LIFTED) if r.moving in stated else r for r in plan.joints)
    return replace(plan, joints=tuple(joints)) if stated else plan


def with_parallel_lifts(
    realized: Realized,
    flaps: Collection[str],
    config: RealizationConfig,
    arms: LiftArmConfig = DEFAULT_LIFT_ARM_CONFIG,
    drawn: Mapping[str, DrawnLift] = NONE_DRAWN,
) -> Realized:
    """Returns what was realized with arms instead of hinges on flaps that are to rise upright, where they find room.

    Arms that are `drawn` for a flap are tried first.
    """
    for flap in flaps:
        if flap not in realized.object.joint_of:
            continue
        on_drawn = _on_drawn(realized, drawn[flap], config) if flap in drawn else None
        realized = on_drawn or _with_arms(realized, flap, config, arms)
    return realized


def _on_drawn(realized: Realized, drawn: DrawnLift, config: RealizationConfig) -> Realized | None:
    """Returns what was realized with a flap on the arms that are drawn; None where these do not lift it far enough."""
    made, flap = realized.object, drawn.flap
    extent = float(Box.enclosing(link.mesh.box for link in made.links if len(link.mesh.faces)).size.max())
    around = tuple(v for _, v in _around(made, flap))
    joints = drawn.joints(made, around, at_scale(config, metre_on(extent)))
    if joints is None:
        return None
    lead, follow = joints
    mount = _nearest_part(made, drawn.visuals[0].mesh, extent)
    own = tuple(v for v in made.link(flap).visuals if v.role is not VisualRole.HARDWARE)
    return _lifted(realized, (lead, follow), {flap: own, lead.child: drawn.visuals}, (mount, DRAWN, 0))


def _with_arms(realized: Realized, flap: str, config: RealizationConfig, arms_config: LiftArmConfig) -> Realized:
    made = realized.object
    whole = Box.enclosing(link.mesh.box for link in made.links if len(link.mesh.faces))
    extent = float(whole.size.max())
    fold, lift = at_scale(config.fold, metre_on(extent)), at_scale(arms_config, metre_on(extent))
    own = next(v for v in made.link(flap).visuals if v.name == flap)
    leaf = leaf_of(Part(flap, own.label, own.surfaces, PartSource(flap)), whole, fold)
    found = None if leaf is None else _best(made, leaf, lift, config.depth * extent)
    if found is None:
        return _noted(realized, flap)
    place, arms, upper = found
    return _on_built(realized, place, arms, upper)


def _noted(realized: Realized, flap: str) -> Realized:
    outcomes = (
        replace(o, notes=(*o.notes, NO_ARMS)) if isinstance(o, Installed) and o.moving == flap else o
        for o in realized.report.outcomes
    )
    return replace(realized, report=replace(realized.report, outcomes=tuple(outcomes)))


def _best(
    made: ArticulatedObject, leaf: Leaf, lift: LiftArmConfig, depth: float
) -> tuple[ArmPlace, Arms, float] | None:
    """Returns the arms that lift a flap furthest, and how far they turn; None where none lift it far enough."""
    flap = leaf.part
    joint, own = made.joint_of[flap], made.link(flap)
    body: tuple[TriangleMesh, ...] = tuple(v.mesh for v in own.rigid_visuals if v.role is not VisualRole.HARDWARE)
    around = _around(made, flap)
    still = [v.mesh for link, v in around if link == joint.parent]
    walls = walls_beside(leaf, RayCaster(merge_meshes(still)), lift) if still else None
    if walls is None or joint.parent != made.root or joint.coupling is not None:
        return None
    obstacles = [Obstacle(v.name, MeshCollider(v.mesh)) for _, v in around]
    tall, best = leaf.height[1] - leaf.height[0], None
    for place in arm_places(leaf, *walls, lift):
        arms = arms_of(place, flap, f"{flap}_arms")
        upper = furthest(place, arms, body, obstacles, depth)
        rise = place.rise(upper)
        if rise >= lift.least * tall and (best is None or rise > best[0].rise(best[2])):
            best = (place, arms, upper)
        if rise >= lift.enough * tall:
            break
    return best


def _around(made: ArticulatedObject, flap: str) -> list[tuple[str, Visual]]:
    """Returns all that neither belongs to a flap nor to its hinges, each with its link."""
    others = ((link.id, v) for link in made.links if link.id != flap for v in link.rigid_visuals)
    return [(link, v) for link, v in others if len(v.mesh.faces) and not _is_hinge_of(v.name, flap)]


def _is_hinge_of(name: str, flap: str) -> bool:
    """Whether a piece of hardware belongs to one of the hinges of a flap, by its name."""
    return re.fullmatch(rf"(hinge|support)_{re.escape(flap)}_\d+_[a-z]+(_[a-z]+)*", name) is not None


def _on_built(realized: Realized, place: ArmPlace, arms: Arms, upper: float) -> Realized:
    """Returns what was realized with the flap on arms that are built, instead of its hinges."""
    made, flap = realized.object, place.leaf.part
    before, name = made.joint_of[flap], f"{flap}_arms"
    lead = Joint(
        joint_id(name), before.type, made.root, name, place.axis(place.on_case), JointLimits(0.0, upper), before.after
    )
    axis = place.axis(place.on_flap).reversed()
    follow = replace(before, parent=name, axis=axis, limits=JointLimits(0.0, upper), slip=None).following(lead)
    own = [v for v in made.link(flap).visuals if v.role is not VisualRole.HARDWARE]
    root = [v for v in made.link(made.root).visuals if not _is_hinge_of(v.name, flap)]
    links = {
        flap: (*own, *arms.dynamic),
        made.root: (*root, *arms.static, *arms.swinging),
        name: arms.moving,
    }
    mount = _nearest_part(made, arms.static[0].mesh, _NEAR)
    return _lifted(realized, (lead, follow), links, (mount, LIFT_ARMS, len(_ENDS)))


def _lifted(
    realized: Realized,
    joints: tuple[Joint, Joint],
    changed: Mapping[str, tuple[Visual, ...]],
    hardware: tuple[str, str, int],
) -> Realized:
    """Returns what was realized with a flap on its arms; `changed` is what the links hold that are new or change.

    `hardware` is the mount, the template and the count that the report states.
    """
    made, (lead, follow) = realized.object, joints
    links = []
    for link in made.links:
        visuals = changed.get(link.id, link.visuals)
        links.append(Link(link.id, tuple(v for v in visuals if not _is_hinge_of(v.name, follow.child))))
    others = (
        replace(j, after=tuple(lead.id if a == follow.id else a for a in j.after))
        for j in made.joints
        if j.id != follow.id
    )
    arms = Link(lead.child, changed[lead.child])
    turning = replace(made, links=(*links, arms), joints=(*others, lead, follow))
    return replace(realized, object=turning, report=_reported(realized, lead, follow, hardware))


def _nearest_part(made: ArticulatedObject, mesh: TriangleMesh, near: float) -> str:
    """Returns the part of the case that something is nearest to, within a distance, metres; the root where none is."""
    body = MeshCollider(mesh)
    parts = (v for v in made.link(made.root).visuals if v.role is not VisualRole.HARDWARE and len(v.mesh.faces))
    found = {v.name: MeshCollider(v.mesh).distance(body) for v in parts if v.mesh.box.overlaps(mesh.box, near)}
    return min(found, key=lambda name: found[name], default=made.root)


def _reported(realized: Realized, lead: Joint, follow: Joint, hardware: tuple[str, str, int]) -> RealizationReport:
    """Returns the report with the arms' joint, and the flap's as it is on them."""
    mount, template, count = hardware
    outcomes: list[Outcome] = []
    for outcome in realized.report.outcomes:
        if not (isinstance(outcome, Installed) and outcome.moving == follow.child):
            outcomes.append(outcome)
            continue
        on_arms = replace(
            outcome,
            mount=mount,
            mechanism=MechanismClass.NONE,
            template=template,
            count=count,
            restricted=False,
            collision_share=0.0,
            largest_gap=0.0,
            clearances=(),
            wanted=None,
            reference=None,
        )
        turn = lead.limits.upper
        outcomes.append(replace(on_arms, moving=lead.child, joint=lead.id, axis=lead.axis, opening=turn, notes=()))
        outcomes.append(replace(on_arms, axis=follow.axis, opening=turn, after=(), notes=()))
    return replace(realized.report, outcomes=tuple(outcomes))
