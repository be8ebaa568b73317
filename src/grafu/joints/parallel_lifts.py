"""Flaps that rise upright on arms, after all else is built: a joint of the arms on the case, one of the flap on them.

A flap that is to rise so is built as one that turns about its upper edge; where arms find room they replace its hinges,
and the flap's joint turns it back by as much as the arms turn, so that it stays upright.
"""

import re
from collections.abc import Collection
from dataclasses import replace

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, VisualRole
from grafu.asset.names import spoken
from grafu.asset.part import Asset, Part, PartSource
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.joints.config import RealizationConfig
from grafu.joints.leaves import Leaf, leaf_of
from grafu.joints.lift_arm_config import DEFAULT_LIFT_ARM_CONFIG, LiftArmConfig
from grafu.joints.lift_arms import ArmPlace, Arms, arm_places, arms_of, furthest, walls_beside
from grafu.joints.motion_choice import MotionChoice, Moves, Side, axis_of_motion
from grafu.joints.plan import JointRequest, MotionRole, RealizationPlan
from grafu.joints.realize import Realized, joint_id
from grafu.joints.report import LIFT_ARMS, Installed, Outcome, RealizationReport
from grafu.scene.scene import Obstacle, metre_on
from grafu.vocabulary import MechanismClass

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
) -> Realized:
    """Returns what was realized with arms instead of hinges on flaps that are to rise upright, where they find room."""
    for flap in flaps:
        if flap in realized.object.joint_of:
            realized = _with_arms(realized, flap, config, arms)
    return realized


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
    return _lifted(realized, place, arms, upper)


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
    around = [
        (link.id, v)
        for link in made.links
        if link.id != flap
        for v in link.rigid_visuals
        if len(v.mesh.faces) and not _is_hinge_of(v.name, flap)
    ]
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


def _is_hinge_of(name: str, flap: str) -> bool:
    """Whether a piece of hardware belongs to one of the hinges of a flap, by its name."""
    return re.fullmatch(rf"(hinge|support)_{re.escape(flap)}_\d+_[a-z]+(_[a-z]+)*", name) is not None


def _lifted(realized: Realized, place: ArmPlace, arms: Arms, upper: float) -> Realized:
    """Returns what was realized with the flap on its arms, instead of its hinges."""
    made, flap = realized.object, place.leaf.part
    before, name = made.joint_of[flap], f"{flap}_arms"
    lead = Joint(
        joint_id(name), before.type, made.root, name, place.axis(place.on_case), JointLimits(0.0, upper), before.after
    )
    axis = place.axis(place.on_flap).reversed()
    follow = replace(before, parent=name, axis=axis, limits=JointLimits(0.0, upper), slip=None).following(lead)
    own = [v for v in made.link(flap).visuals if v.role is not VisualRole.HARDWARE]
    links = []
    for link in made.links:
        left = tuple(v for v in link.visuals if not _is_hinge_of(v.name, flap))
        if link.id == flap:
            links.append(Link(flap, (*own, *arms.dynamic)))
        elif link.id == made.root:
            links.append(Link(link.id, (*left, *arms.static, *arms.swinging)))
        else:
            links.append(link)
    others = (
        replace(j, after=tuple(lead.id if a == before.id else a for a in j.after))
        for j in made.joints
        if j.id != before.id
    )
    changed = replace(made, links=(*links, Link(name, arms.moving)), joints=(*others, lead, follow))
    return replace(realized, object=changed, report=_reported(realized, lead, follow, _mount(made, arms)))


def _mount(made: ArticulatedObject, arms: Arms) -> str:
    """Returns the part of the case that a plate rests on; the root where none does."""
    plate = MeshCollider(arms.static[0].mesh)
    parts = (v for v in made.link(made.root).visuals if v.role is not VisualRole.HARDWARE and len(v.mesh.faces))
    near = {v.name: MeshCollider(v.mesh).distance(plate) for v in parts if v.mesh.box.overlaps(plate.box, _NEAR)}
    return min(near, key=lambda name: near[name], default=made.root)


def _reported(realized: Realized, lead: Joint, follow: Joint, mount: str) -> RealizationReport:
    """Returns the report with the arms' joint, and the flap's as it is on them."""
    outcomes: list[Outcome] = []
    for outcome in realized.report.outcomes:
        if not (isinstance(outcome, Installed) and outcome.moving == follow.child):
            outcomes.append(outcome)
            continue
        on_arms = replace(
            outcome,
            mount=mount,
            mechanism=MechanismClass.NONE,
            template=LIFT_ARMS,
            count=len(_ENDS),
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
