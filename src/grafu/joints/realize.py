"""`realize`: a plan on an asset becomes an articulated object and a report. It reads and writes no files.

Doors come first, then drawers, whose rails must respect what the doors already need. One part that cannot be built does
not cost the others theirs.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import radians
from time import perf_counter
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual, VisualRole
from grafu.asset.part import Asset, Part
from grafu.geometry.budget import within
from grafu.geometry.intersection import forget_large_shapes
from grafu.joints.build import Built
from grafu.joints.build_all import build_fairly, in_order
from grafu.joints.clearance.carve import Path, obstruction
from grafu.joints.clearance.make import adopt
from grafu.joints.config import RealizationConfig
from grafu.joints.joint_choice import short_of_chosen
from grafu.joints.measuring import Measured, measure_all
from grafu.joints.order import BuiltJoint, Order, order_joints, stand_aside
from grafu.joints.plan import AUTOMATIC, JointRequest, RealizationPlan
from grafu.joints.report import Clearance, Installed, RealizationReport
from grafu.processes.cache import NO_CACHE, Cache
from grafu.scene.border import part_axes
from grafu.scene.scene import JointMotion, MovingBody, Scene
from grafu.templates.template import Gallery

_ORDERING = 0.5  # of the time that is left when all joints stand; the rest is for measuring them


@final
@dataclass(frozen=True)
class Realized:
    """The working object, the outcome of each request, and the final scene.

    The scene holds the parts as they are built, at rest, all hardware, the moving bodies that have a joint, and their
    ways with the final opening as `upper` and the order in which they open.
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
    scene, closed = cache.value("closed", _closed_scene, asset, free, config)
    built, failed, scene = build_fairly(requests, scene, gallery, config, cache)
    skipped = [*plan.refused, *failed]
    order = partial(cache.value, "order", _orders, tuple(built), scene, config)
    orders = within(_ORDERING, order, partial(_without_order, built))
    measured = measure_all(built, orders, scene, config, cache)
    built, scene = list(measured.built), measured.scene
    installed = [_installed(b, measured, closed, config) for b in built]
    skipped += measured.skipped
    articulated = _assembled(asset, scene, built, measured.orders)
    timings = (("realize", perf_counter() - started),)
    final = _final_scene(scene, built, measured.orders).afresh()
    forget_large_shapes()
    return Realized(articulated, RealizationReport((*installed, *skipped), timings), final)


def _final_scene(scene: Scene, built: Sequence[Built], orders: Mapping[str, Order]) -> Scene:
    """Returns the scene in which only those move that have a joint, each as far as it opens."""
    ids = [b.request.moving for b in built]
    joint_motions = {b.request.moving: _final_motion(b, orders[b.request.moving]) for b in built}
    return replace(scene, moving_bodies={i: scene.moving_bodies[i] for i in ids}, joint_motions=joint_motions)


def _final_motion(built: Built, order: Order) -> JointMotion:
    return JointMotion(built.placement.axis, built.request.type, order.upper, after=order.after)


def _closed_scene(
    asset: Asset, requests: Sequence[JointRequest], config: RealizationConfig
) -> tuple[Scene, dict[str, tuple[Clearance, ...]]]:
    """Returns the scene with every part that is drawn ajar closed, and what was noted about it."""
    moving_bodies = {r.moving: MovingBody(r.moving, (r.moving, *r.attached)) for r in requests}
    scene = Scene({p.id: p for p in asset.parts if len(p.mesh.faces)}, moving_bodies, asset.extent)
    notes: dict[str, tuple[Clearance, ...]] = {}
    for request in requests:
        if request.drawn_at <= 0:
            continue
        motion = request.kind.along(request.axis)
        axes = part_axes(scene.parts[request.moving].mesh)
        path = Path(request.moving, motion, 1e-6, axes, request.kind.turns)
        scene, joined = adopt(scene, path, obstruction(scene, path, config).blockers, config)
        T = motion(-request.drawn_at)
        members = scene.moving_bodies[request.moving].members
        scene = scene.replaced(_moved(scene.parts[m], T) for m in members)
        note = Clearance(request.moving, "closed", request.drawn_at, 0.0, "was drawn ajar")
        notes[request.moving] = (*joined, note)
    return scene, notes


def _moved(part: Part, T: np.ndarray) -> Part:
    return replace(part, surfaces=tuple(s.transformed(T) for s in part.surfaces))


def _orders(built: Sequence[Built], scene: Scene, config: RealizationConfig) -> dict[str, Order]:
    movings = [_built_joint(b) for b in built]
    return stand_aside(order_joints(movings, scene, config), movings, scene, config)


def _built_joint(built: Built) -> BuiltJoint:
    placement = built.placement
    motion = built.request.kind.along(placement.axis)
    turns = built.request.kind.turns
    least = radians(90) if turns and built.request.choice.opening is None else placement.upper
    return BuiltJoint(built.request.moving, motion, placement.upper, least, placement.in_way)


def _without_order(built: Sequence[Built], why: str) -> dict[str, Order]:
    """Returns for each moving body an order without waiting; a note says that neighbours may meet, and why."""
    note = f"whether it must wait for its neighbours was not found out: {why}"
    return {b.request.moving: Order((), b.placement.upper, note) for b in built}


def _installed(
    built: Built, measured: Measured, closed: dict[str, tuple[Clearance, ...]], config: RealizationConfig
) -> Installed:
    request, placement = built.request, built.placement
    order, (ratio, gap) = measured.orders[request.moving], measured.figures[request.moving]
    waits = tuple(joint_id(name) for name in order.after)
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
        axis=placement.axis,
        opening=order.upper,
        reference=request.reference,
        restricted=order.upper < config.restricted * built.wanted,
        collision_share=ratio,
        largest_gap=gap,
        after=waits,
        clearances=(*closed.get(request.moving, ()), *built.clearances),
        notes=(*placement.notes, *short_of_chosen(request, placement.template, order.upper), *_note(order)),
        wanted=built.wanted,
    )


def _note(order: Order) -> tuple[str, ...]:
    return (order.note,) if order.note else ()


def joint_id(moving: str) -> str:
    """Returns the id of the joint above a moving part."""
    return f"{moving}_joint"


def _assembled(asset: Asset, scene: Scene, built: Sequence[Built], orders: Mapping[str, Order]) -> ArticulatedObject:
    """Returns the tree: one static root, one link per moving body; those without a joint are visuals of the root."""
    by_id = {b.request.moving: b for b in built}
    at_home = {m for moving in by_id for m in scene.moving_bodies[moving].members}
    static = [_part_visual(p) for p in scene.parts.values() if p.id not in at_home]
    static += [visual for owner, visual in scene.hardware if not owner]
    root = _free_name("body", {*scene.parts, *by_id})
    links = [Link(root, tuple(static))]
    joints = []
    for moving, b in by_id.items():
        parts = [_part_visual(scene.parts[m]) for m in scene.moving_bodies[moving].members]
        links.append(Link(moving, (*parts, *scene.hardware_of(moving))))
        order = orders[moving]
        limits = JointLimits(0.0, order.upper)
        after = tuple(joint_id(name) for name in order.after)
        joints.append(Joint(joint_id(moving), b.request.type, root, moving, b.placement.axis, limits, after))
    return ArticulatedObject(asset.name, root, tuple(links), tuple(joints))


def _part_visual(part: Part) -> Visual:
    role = VisualRole.ADDED if part.labelled_by == "added" else VisualRole.PART
    return Visual(part.id, part.surfaces, role, part.label)


def _free_name(name: str, taken: set[str]) -> str:
    while name in taken:
        name += "_"
    return name
