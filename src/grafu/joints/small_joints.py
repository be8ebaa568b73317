"""Joints of small parts: each becomes a link of its own, taken out of the one whose piece it was, without hardware."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.asset.part import Asset
from grafu.geometry.arrays import Mat4, Vec3
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale
from grafu.geometry.intersection import MeshCollider, SweptBody
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.transform import translation
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import blockers_at, in_the_way, sweep, swept_box, widest_free
from grafu.joints.measuring import gap_between
from grafu.joints.no_hardware import DRAWN
from grafu.joints.plan import JointRequest
from grafu.joints.realize import Realized, joint_id
from grafu.joints.report import Clearance, Installed, Outcome
from grafu.joints.small_knobs import SOURCE as FOUND
from grafu.joints.small_requests import found_requests, stated_requests
from grafu.refusal import Asked, Reason, Refusal
from grafu.scene.border import part_axes
from grafu.scene.scene import Obstacle, metre_on
from grafu.vocabulary import MechanismClass


@final
@dataclass(frozen=True, eq=False)
class _Taken:
    """A small part: its visuals, the link that they are taken from, and everything else at rest."""

    request: JointRequest
    visuals: tuple[Visual, ...]
    link: Link
    others: tuple[Visual, ...]


def with_small_parts(
    realized: Realized,
    asset: Asset,
    config: RealizationConfig = RealizationConfig(),
    chosen: Collection[str] | None = None,
) -> Realized:
    """Returns what was realized with joints for small parts: those that the asset states, else those found by shape.

    Of the latter all, or, where parts are `chosen`, these and those that are links of their own in the asset.
    """
    made, scaled = realized.object, at_scale(config, metre_on(asset.extent))
    requests = stated_requests(asset, realized, config) or found_requests(made, asset, scaled, chosen)
    changed, outcomes = with_small_joints(made, requests, scaled)
    built = {outcome.moving for outcome in outcomes if isinstance(outcome, Installed)}
    before = (o for o in realized.report.outcomes if not (isinstance(o, Refusal) and o.part in built))
    report = replace(realized.report, outcomes=(*before, *outcomes))
    return replace(realized, object=changed, report=report)


def with_small_joints(
    made: ArticulatedObject, requests: Sequence[JointRequest], config: RealizationConfig = RealizationConfig()
) -> tuple[ArticulatedObject, tuple[Outcome, ...]]:
    """Returns the object in which small parts move by themselves, and the outcome of each request.

    What takes others along comes before them. A part that cannot move stays a piece of its link. Lengths of `config`
    are in the scale of the object (`at_scale`).
    """
    outcomes: list[Outcome] = []
    for request in sorted(requests, key=lambda r: -len(r.attached)):
        taken = _taken(made, request)
        if isinstance(taken, _Taken):
            made, outcome = _built(made, taken, config)
            outcomes.append(outcome)
        elif taken is not None:
            outcomes.append(taken)
    return made, tuple(outcomes)


def _taken(made: ArticulatedObject, request: JointRequest) -> _Taken | Refusal | None:
    """Returns the small part with what is around it; None where it was replaced, or is all that its link has."""
    names = {request.moving, *request.attached}
    link = next((link for link in made.links for v in link.visuals if v.name == request.moving), None)
    if link is None:
        return None
    own = tuple(visual for visual in link.visuals if visual.name in names)
    if len(own) == len(link.visuals):
        return Refusal(request.moving, Reason.UNSUPPORTED, "it would carry itself", Asked.SMALL_JOINT)
    others = tuple(v for other in made.links for v in other.visuals if not (other is link and v.name in names))
    return _Taken(request, own, link, others)


def _built(
    made: ArticulatedObject, taken: _Taken, config: RealizationConfig
) -> tuple[ArticulatedObject, Installed | Refusal]:
    request = taken.request
    wanted = request.reference or config.small.press
    opening, taken, clearances = _free(taken, wanted, made, config)
    if opening < config.restricted * wanted:
        why = "what stands around it leaves it no room to move"
        return made, Refusal(request.moving, Reason.BLOCKED, why, Asked.SMALL_JOINT)
    ratio, gap, mount = _figures(taken, opening, made, config)
    if request.source == FOUND and gap > config.no_hardware_gap * _extent(made):
        return made, Refusal(
            request.moving, Reason.NO_SUPPORT, f"it is {gap:.4f} m off what could carry it", Asked.SMALL_JOINT
        )
    joint = Joint(
        joint_id(request.moving), request.type, taken.link.id, request.moving, request.axis, JointLimits(0.0, opening)
    )
    if request.coupling is not None:
        leader = made.joint_of.get(request.coupling.leader)
        if leader is None:
            why = f"{request.coupling.leader}, which it follows, does not move"
            return made, Refusal(request.moving, Reason.BLOCKED, why, Asked.SMALL_JOINT)
        joint = joint.following(leader, opening / leader.limits.upper)
    names = {visual.name for visual in taken.visuals}
    links = [
        replace(link, visuals=tuple(v for v in link.visuals if v.name not in names)) if link is taken.link else link
        for link in made.links
    ]
    changed = replace(made, links=(*links, Link(request.moving, taken.visuals)), joints=(*made.joints, joint))
    return changed, Installed(
        moving=request.moving,
        joint=joint.id,
        type=request.type,
        mount=mount,
        mechanism=MechanismClass.NONE,
        template=DRAWN,
        count=0,
        source=request.source,
        initial_axis=request.axis,
        axis=request.axis,
        opening=opening,
        reference=request.reference,
        restricted=False,
        collision_share=ratio,
        largest_gap=gap,
        clearances=clearances,
        wanted=wanted,
    )


def _free(
    taken: _Taken, wanted: float, made: ArticulatedObject, config: RealizationConfig
) -> tuple[float, _Taken, tuple[Clearance, ...]]:
    """Returns how far a part moves freely, and the part made to fit.

    A button that meets what it stands on is made shorter by its travel, and travels half its length at most; a knob
    that is sunk into it ends on it.
    """
    if config.trim and taken.request.kind.turns:
        taken, notes = _seated(taken, wanted, made, config)
        return _opening(taken, wanted, made, config), taken, notes
    opening = _opening(taken, wanted, made, config)
    if opening >= config.restricted * wanted or taken.request.kind.turns or not config.trim:
        return opening, taken, ()
    length = _span(taken)
    travel = min(wanted, length / 2)
    shorter = _shortened(taken, travel)
    opening = _opening(shorter, travel, made, config)
    note = Clearance(taken.request.moving, "trimmed", travel, travel / length, "it would cut in as it is pressed")
    return opening, shorter, (note,)


def _passes_through(taken: _Taken, depth: float) -> bool:
    """Whether a part stands out of both sides of what carries it along its axis, by more than `depth` metres."""
    direction = taken.request.axis.direction
    names = {visual.name for visual in taken.visuals}
    carrier = np.concatenate([v.mesh.vertices @ direction for v in taken.link.visuals if v.name not in names])
    own = np.concatenate([visual.mesh.vertices @ direction for visual in taken.visuals])
    return bool(own.min() < carrier.min() - depth and own.max() > carrier.max() + depth)


def _seated(
    taken: _Taken, wanted: float, made: ArticulatedObject, config: RealizationConfig
) -> tuple[_Taken, tuple[Clearance, ...]]:
    """Returns a part whose inner end is pressed flat by the least depth at which it turns without cutting in.

    It stays as it is where it cuts into nothing at rest, or still does with as much of it pressed as may be, or where
    it stands out of both sides of what carries it: it has a bearing.
    """
    if _passes_through(taken, config.depth * _extent(made)):
        return taken, ()
    length = _span(taken)
    low, high = 0.0, config.small.sunk * length
    if not _cuts(taken, 0.0, made, config) or _cuts(_pressed(taken, high), wanted, made, config):
        return taken, ()
    while high - low > config.depth * _extent(made):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _cuts(_pressed(taken, middle), wanted, made, config) else (low, middle)
    note = Clearance(taken.request.moving, "trimmed", high, high / length, "it was sunk into what it stands on")
    return _pressed(taken, high), (note,)


def _cuts(taken: _Taken, upper: float, made: ArticulatedObject, config: RealizationConfig) -> bool:
    """Whether a part cuts into anything at rest, or before it has moved so far."""
    body, near = _swept(taken, upper, made, config)
    motion = taken.request.kind.along(taken.request.axis)
    return bool(blockers_at(body, np.eye(4), near)) or (
        upper > 0 and widest_free(body, motion, upper, near, config.fine_poses, config.short) < upper
    )


def _pressed(taken: _Taken, depth: float) -> _Taken:
    """Returns a part without what lies deeper than so far before its inner end, metres: pressed onto a plane."""
    direction = _outward(taken)
    plane = depth + min(float((visual.mesh.vertices @ direction).min()) for visual in taken.visuals)

    def pressed(mesh: TriangleMesh) -> TriangleMesh:
        short = np.maximum(plane - mesh.vertices @ direction, 0.0)
        return TriangleMesh(mesh.vertices + np.outer(short, direction), mesh.faces)

    visuals = (replace(v, surfaces=tuple(replace(s, mesh=pressed(s.mesh)) for s in v.surfaces)) for v in taken.visuals)
    return replace(taken, visuals=tuple(visuals))


def _outward(taken: _Taken) -> Vec3:
    """Returns the direction of the axis that leads away from the middle of what carries the part."""
    direction = taken.request.axis.direction
    names = {visual.name for visual in taken.visuals}
    carrier = Box.enclosing(visual.mesh.box for visual in taken.link.visuals if visual.name not in names)
    own = Box.enclosing(visual.mesh.box for visual in taken.visuals)
    return direction if float((own.center - carrier.center) @ direction) >= 0 else -direction


def _opening(taken: _Taken, wanted: float, made: ArticulatedObject, config: RealizationConfig) -> float:
    """Returns how far it moves before it meets what it does not meet at rest."""
    body, near = _swept(taken, wanted, made, config)
    at_rest = set(blockers_at(body, np.eye(4), near))
    free = [obstacle for obstacle in near if obstacle.id not in at_rest]
    motion = taken.request.kind.along(taken.request.axis)
    return widest_free(body, motion, wanted, free, config.fine_poses, config.short)


def _swept(
    taken: _Taken, opening: float, made: ArticulatedObject, config: RealizationConfig
) -> tuple[SweptBody, list[Obstacle]]:
    mesh = merge_meshes([visual.mesh for visual in taken.visuals])
    motion = taken.request.kind.along(taken.request.axis)
    box = swept_box(mesh.box, motion, opening)
    near = [Obstacle(v.name, MeshCollider(v.mesh)) for v in taken.others if v.mesh.box.overlaps(box)]
    return SweptBody(mesh, config.depth * _extent(made), part_axes(mesh)), in_the_way(near, box)


def _extent(made: ArticulatedObject) -> float:
    return float(Box.enclosing(link.mesh.box for link in made.links).size.max())


def _span(taken: _Taken) -> float:
    along = np.concatenate([visual.mesh.vertices @ taken.request.axis.direction for visual in taken.visuals])
    return float(np.ptp(along))


def _shortened(taken: _Taken, travel: float) -> _Taken:
    """Returns a part that ends sooner on the side to which it moves, by its travel."""
    direction, length = taken.request.axis.direction, _span(taken)
    outer = min(float((visual.mesh.vertices @ direction).min()) for visual in taken.visuals)
    T = _scaling(direction, (length - travel) / length, outer)
    visuals = (replace(v, surfaces=tuple(s.transformed(T) for s in v.surfaces)) for v in taken.visuals)
    return replace(taken, visuals=tuple(visuals))


def _scaling(direction: np.ndarray, factor: float, place: float) -> Mat4:
    """Returns the scaling along a direction that leaves the plane at `place` along it where it is."""
    S = np.eye(4)
    S[:3, :3] += (factor - 1.0) * np.outer(direction, direction)
    return np.asarray(translation(place * direction) @ S @ translation(-place * direction))


def _figures(
    taken: _Taken, opening: float, made: ArticulatedObject, config: RealizationConfig
) -> tuple[float, float, str]:
    """Returns the fraction of poses that collide, the gap in metres to what carries the part, and which part does.

    What of its carrier the part passes through at rest is its bearing: a shaft turns in its hole.
    """
    request = taken.request
    body, near = _swept(taken, opening, made, config)
    carrier = {visual.name for visual in taken.link.visuals}
    bearings = carrier & set(blockers_at(body, np.eye(4), near))
    others = [obstacle for obstacle in near if obstacle.id not in bearings]
    ratio = sweep(body, request.kind.along(request.axis), opening, others, config.fine_poses).ratio
    own = [MeshCollider(visual.mesh) for visual in taken.visuals]
    names = {visual.name for visual in taken.visuals}
    still = [visual for visual in taken.link.visuals if visual.name not in names]
    gaps = {visual.name: gap_between(own, [MeshCollider(visual.mesh)], np.eye(4)) for visual in still}
    nearest = min(gaps, key=lambda name: gaps[name])
    return ratio, gaps[nearest], nearest
