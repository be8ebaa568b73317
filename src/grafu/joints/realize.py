"""`realize`: a plan on an asset becomes an articulated object and a report. It reads and writes no files.

Doors come first, then drawers, whose rails must respect what the doors already need; joints on moving bodies come after
those that carry them. One part that cannot be built does not cost the others theirs.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from time import perf_counter
from typing import final

from grafu.articulation.articulated_object import (
    ArticulatedObject,
    Coupling,
    Joint,
    JointLimits,
    Link,
    Visual,
    VisualRole,
)
from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.axis import Axis
from grafu.geometry.blocks import forget_large_shapes
from grafu.joints.build import Built
from grafu.joints.build_all import in_order
from grafu.joints.clearance.adopt import adopt
from grafu.joints.clearance.carve import Path, obstruction
from grafu.joints.config import RealizationConfig
from grafu.joints.joint_choice import short_of_chosen
from grafu.joints.levels import Builder, Levels
from grafu.joints.nesting import above, bodies_of, bodies_on, posed
from grafu.joints.order import OpeningOrder
from grafu.joints.plan import AUTOMATIC, JointRequest, RealizationPlan
from grafu.joints.report import Clearance, Installed, RealizationReport
from grafu.processes.cache import NO_CACHE, Cache
from grafu.scene.border import part_axes
from grafu.scene.scene import JointMotion, MovingBody, Scene
from grafu.scene.shapes import Shapes
from grafu.templates.template import Gallery


@final
@dataclass(frozen=True)
class Realized:
    """The working object, the outcome of each request, and the final scene.

    The scene holds the parts as they are built, at rest, all hardware, the moving bodies that have a joint, and their
    motions with the final opening as `upper` and the order in which they open. What a joint on a moving body moves in
    step with that body belongs to it there.
    """

    object: ArticulatedObject
    report: RealizationReport
    scene: Scene


def realize(
    plan: RealizationPlan,
    asset: Asset,
    gallery: Gallery,
    config: RealizationConfig = RealizationConfig(),
    cache: Cache = NO_CACHE,
) -> Realized:
    """Returns the asset with every joint of the plan that can be built; what `cache` holds is not built again."""
    started = perf_counter()
    requests = in_order(plan.joints)
    free = tuple(replace(request, choice=AUTOMATIC) for request in requests)
    scene, closed, axes = cache.value("closed", _closed_scene, asset, free, config)
    shapes = cache.value("shapes", Shapes)
    scene = scene.sharing(shapes)
    requests = [replace(r, axis=axes[r.moving]) if r.moving in axes else r for r in requests]
    levels = Builder(gallery, config, cache).all_levels(requests, scene)
    articulated = _assembled(asset, levels)
    installed = [_installed(b, articulated, levels, closed, config) for b in levels.built.values()]
    skipped = [*plan.refused, *levels.skipped]
    timings = (("realize", perf_counter() - started),)
    final = _final_scene(levels).afresh()
    shapes.tidy()
    forget_large_shapes()
    return Realized(articulated, RealizationReport((*installed, *skipped), timings), final)


def _final_scene(levels: Levels) -> Scene:
    """Returns the scene in which only those move that have a joint, each as far as it opens."""
    scene, bodies = levels.scene, {name: levels.scene.moving_bodies[name] for name in levels.built}
    for name in reversed(list(levels.built)):  # what is carried comes after its carrier
        if name in levels.couplings and levels.couplings[name].leader in above(name, levels.parent_of):
            body, carrier = bodies.pop(name), levels.parent_of[name]
            bodies[carrier] = MovingBody(carrier, (*bodies[carrier].members, *body.members))
            own = tuple((carrier if owner == name else owner, visual) for owner, visual in scene.hardware)
            scene = replace(scene, hardware=own)
    joint_motions = {name: _final_motion(levels.built[name], levels.orders[name]) for name in bodies}
    return replace(scene, moving_bodies=bodies, joint_motions=joint_motions)


def _final_motion(built: Built, order: OpeningOrder) -> JointMotion:
    return JointMotion(built.placement.axis, built.request.type, order.upper, after=order.after)


def _closed_scene(
    asset: Asset, requests: Sequence[JointRequest], config: RealizationConfig
) -> tuple[Scene, dict[str, tuple[Clearance, ...]], dict[str, Axis]]:
    """Returns the scene with every part that is drawn ajar closed, what was noted about it, and the axes that moved.

    Closing a part also moves what it carries, and the axes of that.
    """
    scene = Scene({p.id: p for p in asset.parts if len(p.mesh.faces)}, bodies_of(requests), asset.extent)
    parent_of = {request.moving: request.parent for request in requests}
    kinds = {request.moving: request.kind for request in requests}
    notes: dict[str, tuple[Clearance, ...]] = {}
    moved: dict[str, Axis] = {}
    for request in requests:
        if request.drawn_at <= 0:
            continue
        motion = request.kind.along(moved.get(request.moving, request.axis))
        axes = part_axes(scene.parts[request.moving].mesh)
        path = Path(request.moving, motion, 1e-6, axes, request.kind.turns)
        scene, joined = adopt(scene, path, obstruction(scene, path, config).blockers, config)
        T = motion(-request.drawn_at)
        carried = bodies_on(request.moving, parent_of)
        members = [m for body in (request.moving, *carried) for m in scene.moving_bodies[body].members]
        scene = scene.replaced(posed(scene.parts[m], T) for m in members)
        given = {other.moving: other.axis for other in requests if other.moving in carried}
        moved |= {body: kinds[body].mapped_axis(moved.get(body, axis), T) for body, axis in given.items()}
        note = Clearance(request.moving, "closed", request.drawn_at, 0.0, "was drawn ajar")
        notes[request.moving] = (*joined, note)
    return scene, notes, moved


def _installed(
    built: Built,
    articulated: ArticulatedObject,
    levels: Levels,
    closed: dict[str, tuple[Clearance, ...]],
    config: RealizationConfig,
) -> Installed:
    request, placement = built.request, built.placement
    order, (ratio, gap) = levels.orders[request.moving], levels.figures[request.moving]
    joint = articulated.joint_of[request.moving]
    short = short_of_chosen(request, placement.template, order.upper, config.plan)
    notes = (*placement.notes, *short, *_note(order))
    return Installed(
        moving=request.moving,
        joint=joint_id(request.moving),
        type=request.type,
        mount=placement.mount,
        mechanism=placement.mechanism,
        template=placement.template,
        count=placement.count,
        source=request.source,
        initial_axis=request.axis,
        axis=joint.axis,
        opening=joint.limits.upper,
        reference=request.reference,
        restricted=joint.limits.upper < config.restricted * built.wanted,
        collision_share=ratio,
        largest_gap=gap,
        after=joint.after,
        clearances=(*closed.get(request.moving, ()), *built.clearances),
        notes=(*notes, *levels.notes.get(request.moving, ())),
        left_out=placement.left_out,
        wanted=built.wanted,
    )


def _note(order: OpeningOrder) -> tuple[str, ...]:
    return (order.note,) if order.note else ()


def joint_id(moving: str) -> str:
    """Returns the id of the joint above a moving part."""
    return f"{moving}_joint"


def _assembled(asset: Asset, levels: Levels) -> ArticulatedObject:
    """Returns the tree: one static root, one link per moving body; those without a joint are visuals of the root."""
    scene = levels.scene
    at_home = {m for moving in levels.built for m in scene.moving_bodies[moving].members}
    static = [_part_visual(p) for p in scene.parts.values() if p.id not in at_home]
    static += [visual for owner, visual in scene.hardware if not owner]
    root = _free_name("body", {*scene.parts, *levels.built})
    links = [Link(root, tuple(static))]
    joints: dict[str, Joint] = {}
    for moving, b in levels.built.items():
        parts = [_part_visual(scene.parts[m]) for m in scene.moving_bodies[moving].members]
        links.append(Link(moving, (*parts, *scene.hardware_of(moving))))
        order, parent = levels.orders[moving], levels.parent_of[moving] or root
        after = tuple(joint_id(name) for name in order.after)
        limits = JointLimits(0.0, order.upper)
        joints[moving] = Joint(
            joint_id(moving), b.request.type, parent, moving, b.placement.axis, limits, after, slip=b.placement.slip
        )
    return ArticulatedObject(asset.name, root, tuple(links), _coupled_joints(joints, levels.couplings))


def _coupled_joints(joints: Mapping[str, Joint], couplings: Mapping[str, Coupling]) -> tuple[Joint, ...]:
    """Returns the joints, by the moving body, with those coupled that follow another."""
    found: dict[str, Joint] = {}

    def made(moving: str) -> Joint:
        if moving not in found:
            joint, coupling = joints[moving], couplings.get(moving)
            led = coupling and joint.following(made(coupling.leader), coupling.multiplier, coupling.offset)
            found[moving] = led or joint
        return found[moving]

    return tuple(made(moving) for moving in joints)


def _part_visual(part: Part) -> Visual:
    role = VisualRole.ADDED if part.labelled_by == "added" else VisualRole.PART
    return Visual(part.id, part.surfaces, role, part.label)


def _free_name(name: str, taken: set[str]) -> str:
    while name in taken:
        name += "_"
    return name
