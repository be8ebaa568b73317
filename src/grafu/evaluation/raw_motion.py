"""Motions as they were stated, on the meshes as they are: no hardware, no clearance, no limit found by sweeping.

What is measured on it is what a method's axes are worth before anything is mended. Hinges and slides that a door or
drawer was drawn with are its hardware: they may lie in the carcass, and hold it.
"""

import re
from dataclasses import replace

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual, VisualRole
from grafu.asset.part import Asset, Part
from grafu.evaluation.moving_parts import box_of, usual_opening
from grafu.realization.plan import JointRequest, RealizationPlan

ROOT = "body"
_HARDWARE = frozenset({"hinge", "rail", "slide", "slider", "runner"})


def raw_object(asset: Asset, plan: RealizationPlan) -> ArticulatedObject:
    """Returns the asset's parts on the plan's own axes: one link per moving part with its attached parts.

    Each opens as far as was stated; where nothing was, by a quarter turn or three quarters of its own depth. A part
    that is drawn ajar starts closed. Parts of the plan that the asset does not have are left out.
    """
    requests = _requests(asset, plan)
    members = {r.moving: (r.moving, *(m for m in r.attached if _has(asset, m))) for r in requests}
    moving = {member for ids in members.values() for member in ids}
    root = ROOT
    while root in moving or _has(asset, root):
        root += "_"
    static = Link(root, tuple(_visual(p) for p in asset.parts if p.id not in moving and len(p.mesh.faces)))
    links = [_link(asset, request, members[request.moving]) for request in requests]
    joints = tuple(_joint(asset, request, members[request.moving], root) for request in requests)
    return ArticulatedObject(asset.name, root, (static, *links), joints)


def _requests(asset: Asset, plan: RealizationPlan) -> list[JointRequest]:
    """Returns one request per part, the first; what rides on another has none of its own."""
    first: dict[str, JointRequest] = {}
    for request in plan.joints:
        if _has(asset, request.moving) and len(asset.part(request.moving).mesh.faces):
            first.setdefault(request.moving, request)
    ridden = {part for request in first.values() for part in request.attached}
    taken: set[str] = set()
    kept = []
    for request in (r for r in first.values() if r.moving not in ridden):
        free = tuple(m for m in request.attached if m not in taken)
        taken.update(free)
        kept.append(replace(request, attached=free))
    return kept


def _has(asset: Asset, part_id: str) -> bool:
    return any(part.id == part_id for part in asset.parts)


def _joint(asset: Asset, request: JointRequest, members: tuple[str, ...], root: str) -> Joint:
    upper = request.reference
    if upper is None:
        upper = usual_opening(request.type, request.axis, box_of(asset, members))
    name = f"{request.moving}_joint"
    return Joint(name, request.type, root, request.moving, request.axis, JointLimits(0.0, max(upper, 0.0)))


def _link(asset: Asset, request: JointRequest, members: tuple[str, ...]) -> Link:
    parts = [asset.part(member) for member in members if len(asset.part(member).mesh.faces)]
    if request.drawn_at > 0:
        T = Joint("", request.type, "", "", request.axis, JointLimits(0.0, 0.0)).motion(-request.drawn_at)
        parts = [replace(part, surfaces=tuple(s.transformed(T) for s in part.surfaces)) for part in parts]
    return Link(request.moving, tuple(visual for part in parts for visual in _with_hardware(part)))


def _with_hardware(part: Part) -> tuple[Visual, ...]:
    """Returns a moving part without the hardware that it was drawn with, and that apart."""
    hardware = tuple(s for s in part.surfaces if _is_hardware(s.name))
    rest = tuple(s for s in part.surfaces if not _is_hardware(s.name))
    if not hardware or not rest:
        return (_visual(part),)
    drawn = Visual(f"hinge_{part.id}_drawn", hardware, VisualRole.HARDWARE, part.label)
    return (Visual(part.id, rest, label=part.label), drawn)


def _is_hardware(name: str) -> bool:
    """Whether the last word of a name, numbers left out, is that of a hinge or a slide."""
    words = re.findall("[a-z]+", name.lower())
    return bool(words) and words[-1].removesuffix("s") in _HARDWARE


def _visual(part: Part) -> Visual:
    return Visual(part.id, part.surfaces, label=part.label)
