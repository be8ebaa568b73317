"""`realize`: a plan on an asset becomes an articulated object and a report. It reads and writes no files.

Doors come first, then drawers, whose rails must respect what the doors already need. One part that cannot be built does
not cost the others theirs.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import radians
from time import perf_counter
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual, VisualRole
from grafu.asset.part import Asset, Part
from grafu.geometry.arrays import Mat4
from grafu.geometry.intersection import MeshCollider
from grafu.realization.build import Built, build_joint
from grafu.realization.clearance.make import adopt
from grafu.realization.clearance.path import Path, obstruction
from grafu.realization.config import RealizationConfig
from grafu.realization.expectation import expected_ways
from grafu.realization.hinge.border import part_axes
from grafu.realization.joint_choice import short_of_chosen
from grafu.realization.kept import NOTHING_KEPT, Kept
from grafu.realization.limits import in_the_way, motion_about, sweep, swept_box
from grafu.realization.order import Moving, Order, order_joints, stand_aside
from grafu.realization.placement import Placement
from grafu.realization.plan import AUTOMATIC, JointRequest, RealizationPlan, Refusal
from grafu.realization.report import Clearance, Installed, RealizationReport, Skipped, SkipReason
from grafu.realization.scene import Mover, Scene, Way
from grafu.templates.template import Gallery
from grafu.vocabulary import JointType

_GAP_POSES = 5  # hardware slides or turns along itself: a gap, where there is one, opens steadily
_TOUCHING = 1e-4
_MEASURED_POSES = 50  # the paper's number of frames from rest to full extent


_Outcomes = tuple[list[Built], list[Skipped], Scene]


@final
@dataclass(frozen=True)
class Realized:
    """The working object, what came of each request, and the final scene.

    The scene holds the parts as they are built, at rest, all hardware, the movers that have a joint, and their ways
    with the final opening as `upper` and the order in which they open.
    """

    object: ArticulatedObject
    report: RealizationReport
    scene: Scene


def realize(
    plan: RealizationPlan,
    asset: Asset,
    gallery: Gallery,
    config: RealizationConfig = RealizationConfig(),
    kept: Kept = NOTHING_KEPT,
) -> Realized:
    """Returns the asset with every joint of the plan built that can be built; what is `kept` is not built again."""
    started = perf_counter()
    requests = _in_order(plan.joints)
    free = tuple(replace(request, choice=AUTOMATIC) for request in requests)
    scene, closed = kept.value("closed", _closed_scene, asset, free, config)
    built, failed, scene = _build_fairly(requests, scene, gallery, config, kept)
    skipped = [*(_refused(refusal) for refusal in plan.refused), *failed]
    orders = kept.value("order", _orders, tuple(built), scene, config)
    installed = [_installed(b, orders[b.request.moving], scene, closed, config, kept) for b in built]
    articulated = _assembled(asset, scene, built, orders)
    timings = (("realize", perf_counter() - started),)
    final = _final_scene(scene, built, orders)
    return Realized(articulated, RealizationReport((*installed, *skipped), timings), final)


def _refused(refusal: Refusal) -> Skipped:
    reason = SkipReason.REJECTED if refusal.is_decided else SkipReason.NO_MOTION
    return Skipped(refusal.part, reason, refusal.why)


def _final_scene(scene: Scene, built: list[Built], orders: dict[str, Order]) -> Scene:
    """Returns the scene in which only those move that have a joint, each as far as it opens."""
    ids = [b.request.moving for b in built]
    ways = {b.request.moving: _final_way(b, orders[b.request.moving]) for b in built}
    return replace(scene, movers={i: scene.movers[i] for i in ids}, ways=ways)


def _final_way(built: Built, order: Order) -> Way:
    return Way(built.placement.axis, built.request.type, order.upper, after=order.after)


def _build_fairly(
    requests: list[JointRequest], scene: Scene, gallery: Gallery, config: RealizationConfig, kept: Kept
) -> _Outcomes:
    """Returns what came of all requests, each joint keeping out of the expected ways of those built after it.

    Doors for which that left no place are given the way that was asked for, and all is built again; the first try
    stands unless the second builds more.
    """
    ways = kept.value("ways", expected_ways, tuple(requests), scene, config)
    first = _build_all(requests, replace(scene, ways=ways), gallery, config, kept)
    left = {skip.request for skip in first[1]}
    asked = [request for request in requests if request.moving in left and request.type is JointType.REVOLUTE]
    if not asked or not first[0]:
        return first
    wider = {r.moving: replace(ways[r.moving], axis=r.axis) for r in asked}
    second = _build_all(requests, replace(scene, ways={**ways, **wider}), gallery, config, kept)
    return second if len(second[1]) < len(first[1]) else first


def _build_all(
    requests: list[JointRequest], scene: Scene, gallery: Gallery, config: RealizationConfig, kept: Kept
) -> _Outcomes:
    """Returns the joints built, those that were not, and the scene with all hardware."""
    built: list[Built] = []
    skipped: list[Skipped] = []
    for request in requests:
        outcome = kept.value("joint", build_joint, request, scene, gallery, config)
        if isinstance(outcome, Skipped):
            skipped.append(outcome)
            scene = replace(scene, ways={name: way for name, way in scene.ways.items() if name != request.moving})
            continue
        scene = outcome.scene
        built.append(outcome)
    return built, skipped, scene


def _in_order(joints: Iterable[JointRequest]) -> list[JointRequest]:
    """Returns one request per part (the first), doors before drawers, riders never on their own."""
    first: dict[str, JointRequest] = {}
    for request in joints:
        first.setdefault(request.moving, request)
    ridden = {rider for request in first.values() for rider in request.riders}
    kept = [request for request in first.values() if request.moving not in ridden]
    return sorted(kept, key=lambda r: r.type is not JointType.REVOLUTE)


def _closed_scene(
    asset: Asset, requests: Sequence[JointRequest], config: RealizationConfig
) -> tuple[Scene, dict[str, tuple[Clearance, ...]]]:
    """Returns the scene with every part that is drawn ajar closed, and what was noted about it."""
    movers = {r.moving: Mover(r.moving, (r.moving, *r.riders)) for r in requests}
    scene = Scene({p.id: p for p in asset.parts if len(p.mesh.faces)}, movers, asset.unit)
    notes: dict[str, tuple[Clearance, ...]] = {}
    for request in requests:
        if request.drawn_at <= 0:
            continue
        motion = motion_about(request.axis, request.type)
        axes = part_axes(scene.parts[request.moving].mesh)
        path = Path(request.moving, motion, 1e-6, axes, request.type is JointType.REVOLUTE)
        scene, joined = adopt(scene, path, obstruction(scene, path, config).blockers, config)
        T = motion(-request.drawn_at)
        members = scene.movers[request.moving].members
        scene = scene.replaced(_moved(scene.parts[m], T) for m in members)
        note = Clearance(request.moving, "closed", request.drawn_at, 0.0, "was drawn ajar")
        notes[request.moving] = (*joined, note)
    return scene, notes


def _moved(part: Part, T: np.ndarray) -> Part:
    return replace(part, surfaces=tuple(s.transformed(T) for s in part.surfaces))


def _orders(built: Sequence[Built], scene: Scene, config: RealizationConfig) -> dict[str, Order]:
    movings = [_moving(b) for b in built]
    return stand_aside(order_joints(movings, scene, config), movings, scene, config)


def _moving(built: Built) -> Moving:
    placement = built.placement
    motion = motion_about(placement.axis, built.request.type)
    turns = built.request.type is JointType.REVOLUTE
    least = radians(90) if turns and built.request.choice.opening is None else placement.upper
    return Moving(built.request.moving, motion, placement.upper, least, placement.in_way)


def _installed(
    built: Built,
    order: Order,
    scene: Scene,
    closed: dict[str, tuple[Clearance, ...]],
    config: RealizationConfig,
    kept: Kept,
) -> Installed:
    request, placement = built.request, built.placement
    share, gap = _measured(built, order.upper, scene, config, kept)
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
        collision_share=share,
        largest_gap=gap,
        after=waits,
        clearances=(*closed.get(request.moving, ()), *built.clearances),
        notes=(*placement.notes, *short_of_chosen(request, placement.template, order.upper)),
    )


def _measured(built: Built, upper: float, scene: Scene, config: RealizationConfig, kept: Kept) -> tuple[float, float]:
    """Returns the share of poses that collide with static parts, and the widest gap in metres to the static body."""
    mover = built.request.moving
    motion = motion_about(built.placement.axis, built.request.type)
    near = in_the_way(scene.static_obstacles, swept_box(scene.moving_mesh(mover).box, motion, upper))
    names = {*scene.movers[mover].members, *(obstacle.id for obstacle in near)}
    around = replace(
        scene,
        parts={name: part for name, part in scene.parts.items() if name in names},
        movers={mover: scene.movers[mover]},
        hardware=tuple((mover, visual) for visual in scene.hardware_of(mover)),
        ways={},
    )
    return kept.value("measure", _measure, built.request, built.placement, upper, around, config)


def _measure(
    request: JointRequest, placement: Placement, upper: float, scene: Scene, config: RealizationConfig
) -> tuple[float, float]:
    """Returns the same in a scene that holds only what is on the mover's way."""
    mover = request.moving
    motion = motion_about(placement.axis, request.type)
    near = list(scene.static_obstacles)
    body = scene.moving_body(mover, config.depth * scene.unit, part_axes(scene.parts[mover].mesh))
    share = sweep(body, motion, upper, near, _MEASURED_POSES).share
    ends = [MeshCollider(v.mesh) for v in scene.hardware_of(mover)]
    held = [MeshCollider(v.mesh) for v in placement.static]
    return share, max(_gap(ends, held, motion(value)) for value in np.linspace(0.0, upper, _GAP_POSES))


def _gap(ends: list[MeshCollider], held: list[MeshCollider], T: Mat4) -> float:
    """Returns the distance in metres of the nearest two pieces of hardware, the moving ones posed at T."""
    for end in ends:
        end.place(T)
    nearest = float("inf")
    pairs = sorted(((one.box_gap(other), k, one, other) for k, (one, other) in enumerate(product(ends, held))))
    for least, _, one, other in pairs:
        if least >= nearest:
            break
        nearest = min(nearest, one.distance(other))
        if nearest <= _TOUCHING:
            break
    return nearest


def joint_id(moving: str) -> str:
    """Returns the id of the joint above a moving part."""
    return f"{moving}_joint"


def _assembled(asset: Asset, scene: Scene, built: list[Built], orders: dict[str, Order]) -> ArticulatedObject:
    """Returns the tree: one static root, one link per mover; movers without a joint stand with the static body."""
    moving = {b.request.moving: b for b in built}
    at_home = {m for mover in moving for m in scene.movers[mover].members}
    static = [_part_visual(p) for p in scene.parts.values() if p.id not in at_home]
    static += [visual for owner, visual in scene.hardware if not owner]
    root = _free_name("body", {*scene.parts, *moving})
    links = [Link(root, tuple(static))]
    joints = []
    for mover, b in moving.items():
        parts = [_part_visual(scene.parts[m]) for m in scene.movers[mover].members]
        links.append(Link(mover, (*parts, *scene.hardware_of(mover))))
        order = orders[mover]
        limits = JointLimits(0.0, order.upper)
        after = tuple(joint_id(name) for name in order.after)
        joints.append(Joint(joint_id(mover), b.request.type, root, mover, b.placement.axis, limits, after))
    return ArticulatedObject(asset.name, root, tuple(links), tuple(joints))


def _part_visual(part: Part) -> Visual:
    role = VisualRole.ADDED if part.labelled_by == "added" else VisualRole.PART
    return Visual(part.id, part.surfaces, role, part.label)


def _free_name(name: str, taken: set[str]) -> str:
    while name in taken:
        name += "_"
    return name
