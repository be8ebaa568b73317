"""Which parts of an annotated model count, how they truly move, and how far they should open.

It reads the annotation alone. Motions as they were stated stand on the meshes as they are, without hardware, clearance
or a limit found by sweeping: what is measured on that is what a method's axes are worth before anything is mended.
Hinges and slides that a door or drawer was drawn with are its hardware: they may lie in the carcass, and hold it.
"""

import re
from dataclasses import replace
from math import pi
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual, VisualRole
from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.metrics.motion import Motion
from grafu.vocabulary import JointType, PartLabel

LARGEST = 0.08  # of the object's largest side: what is smaller is a knob or a caster, not a door
IN_PLANE = 0.02  # of the same: what is narrower is a rod
WIDEST_TURN = pi / 2  # the widest opening that is asked of a hinge
DEPTH_RATIO = 0.75  # of a drawer's own depth: the widest opening that is asked of a slide


@final
@dataclass(frozen=True)
class MovingPart:
    """One part that counts: its true motion in the object frame, what moves with it, how far it should open.

    `reference` is radians or metres. `drawn_at` is the joint value at which the model draws it, 0 where it is closed.

    Raises:
        ValueError: if the reference is not above 0, or `members` do not begin with the part.
    """

    id: str
    label: PartLabel
    motion: Motion
    members: tuple[str, ...]
    reference: float
    drawn_at: float = 0.0

    def __post_init__(self) -> None:
        if not self.reference > 0:
            raise ValueError(f"`MovingPart.reference` must be above 0: got {self.reference} for `{self.id}`")
        if self.members[:1] != (self.id,):
            raise ValueError(f"`MovingPart.members` must begin with the part `{self.id}`: got {self.members}")


def counted_parts(asset: Asset) -> tuple[MovingPart, ...]:
    """Returns the annotated parts that count: large enough, and carried by what is static."""
    requests = plan_from_annotation(asset).joints
    found = (_moving_part(request, asset) for request in requests if asset.part(request.moving).carried_by is None)
    return tuple(part for part in found if part is not None)


def usual_opening(joint_type: JointType, axis: Axis, box: Box) -> float:
    """Returns how far a part should open where nothing is stated: radians or metres.

    A quarter turn, or three quarters of the part's own depth along the slide.
    """
    if motion_kind(joint_type).turns:
        return WIDEST_TURN
    return DEPTH_RATIO * float(np.abs(axis.direction) @ box.size)


def box_of(asset: Asset, members: tuple[str, ...]) -> Box:
    """Returns the box around some of the asset's parts."""
    return Box.enclosing(asset.part(member).box for member in members)


def _moving_part(request: JointRequest, asset: Asset) -> MovingPart | None:
    members = (request.moving, *request.attached)
    box = box_of(asset, members)
    _, middle, largest = np.sort(box.size)
    if largest < LARGEST * asset.extent or middle < IN_PLANE * asset.extent:
        return None
    usual = usual_opening(request.type, request.axis, box)
    reference = min(request.reference or usual, usual)
    if not reference > 0:
        return None
    motion = Motion(request.type, request.axis, box.center, both_ways=request.drawn_at > 0)
    label = asset.part(request.moving).label
    return MovingPart(request.moving, label, motion, members, reference, request.drawn_at)


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
