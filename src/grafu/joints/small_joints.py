"""Joints of small parts: each becomes a link of its own, taken out of the one whose piece it was, without hardware."""

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link
from grafu.asset.part import Asset
from grafu.geometry.config_checks import at_scale
from grafu.geometry.intersection import MeshCollider
from grafu.joints.config import RealizationConfig
from grafu.joints.gaps import gap_between, gap_growth
from grafu.joints.limits import blockers_at, sweep
from grafu.joints.no_hardware import DRAWN
from grafu.joints.plan import JointRequest
from grafu.joints.realize import Realized, joint_id
from grafu.joints.report import Installed, Outcome
from grafu.joints.small_fit import TakenPart, extent_of, fitted, swept
from grafu.joints.small_knobs import SOURCE as FOUND
from grafu.joints.small_requests import found_requests, stated_requests
from grafu.refusal import Asked, Reason, Refusal
from grafu.scene.scale import metre_on
from grafu.vocabulary import MechanismClass


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
    built = [outcome for outcome in outcomes if isinstance(outcome, Installed)]
    answered = {visual.name for one in built for visual in changed.link(one.moving).visuals}
    answered |= {one.mount for one in built}  # what a knob turns on may be called a knob as well
    before = (o for o in realized.report.outcomes if not (isinstance(o, Refusal) and o.part in answered))
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
    moving = {request.moving for request in requests}
    for request in sorted(requests, key=lambda r: -len(moving.intersection(r.attached))):
        taken = _taken(made, request)
        if isinstance(taken, TakenPart):
            made, outcome = _built(made, taken, config)
            outcomes.append(outcome)
        elif taken is not None:
            outcomes.append(taken)
    return made, tuple(outcomes)


def _taken(made: ArticulatedObject, request: JointRequest) -> TakenPart | Refusal | None:
    """Returns the small part with what is around it; None where it was replaced, or is all that its link has."""
    names = {request.moving, *request.attached}
    link = next((link for link in made.links for v in link.visuals if v.name == request.moving), None)
    if link is None:
        return None
    own = tuple(visual for visual in link.visuals if visual.name in names)
    if len(own) == len(link.visuals):
        return Refusal(request.moving, Reason.UNSUPPORTED, "it would carry itself", Asked.SMALL_JOINT)
    others = tuple(v for other in made.links for v in other.visuals if not (other is link and v.name in names))
    return TakenPart(request, own, link, others)


def _built(
    made: ArticulatedObject, taken: TakenPart, config: RealizationConfig
) -> tuple[ArticulatedObject, Installed | Refusal]:
    request = taken.request
    wanted = request.reference or config.small.press
    opening, taken, clearances = fitted(taken, wanted, made, config)
    if opening < config.restricted * wanted:
        why = "what stands around it leaves it no room to move"
        return made, Refusal(request.moving, Reason.BLOCKED, why, Asked.SMALL_JOINT)
    ratio, gap, mount = _figures(taken, opening, made, config)
    is_off = gap > config.no_hardware_gap * extent_of(made)
    if request.source == FOUND and is_off:
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
        largest_gap=_growth(taken, opening),
        clearances=clearances,
        wanted=wanted,
        notes=(f"it is drawn {gap:.3f} m off what carries it",) if is_off and not clearances else (),
    )


def _growth(taken: TakenPart, opening: float) -> float:
    """Returns by how much the gap between the part and what carries it grows as it moves, in metres."""
    own = [MeshCollider(visual.mesh) for visual in taken.visuals]
    held = [MeshCollider(visual.mesh) for visual in taken.carriers]
    kind = taken.request.kind
    return gap_growth(own, held, kind.along(taken.request.axis), opening, kind.slides)


def _figures(
    taken: TakenPart, opening: float, made: ArticulatedObject, config: RealizationConfig
) -> tuple[float, float, str]:
    """Returns the fraction of poses that collide, the gap in metres to what carries the part, and which part does.

    What of its carrier the part passes through at rest is its bearing: a shaft turns in its hole.
    """
    request = taken.request
    body, near = swept(taken, opening, made, config)
    carrier = {visual.name for visual in taken.link.visuals}
    bearings = carrier & set(blockers_at(body, np.eye(4), near))
    others = [obstacle for obstacle in near if obstacle.id not in bearings]
    ratio = sweep(body, request.kind.along(request.axis), opening, others, config.fine_poses).ratio
    own = [MeshCollider(visual.mesh) for visual in taken.visuals]
    gaps = {v.name: gap_between(own, [MeshCollider(v.mesh)], np.eye(4)) for v in taken.carriers}
    nearest = min(gaps, key=lambda name: gaps[name])
    return ratio, gaps[nearest], nearest
