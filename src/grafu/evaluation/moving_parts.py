"""Which parts of an annotated model count, how they truly move, and how far they should open.

It reads the annotation alone; what a method makes of the model is another module's.
"""

from dataclasses import dataclass
from math import pi
from typing import final

import numpy as np

from grafu.asset.part import Asset
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.metrics.motion import Motion
from grafu.realization.make_plan import plan_from_annotation
from grafu.realization.plan import JointRequest
from grafu.vocabulary import JointType, PartLabel

LARGEST = 0.08  # of the object's largest side: what is smaller is a knob or a caster, not a door
IN_PLANE = 0.02  # of the same: what is narrower is a rod
WIDEST_TURN = pi / 2  # the widest opening that is asked of a hinge
DEPTH_SHARE = 0.75  # of a drawer's own depth: the widest opening that is asked of a slide


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
    """Returns the annotated parts that count: large enough, and carried by what stands still."""
    requests = plan_from_annotation(asset).joints
    found = (_moving_part(request, asset) for request in requests if asset.part(request.moving).rides_on is None)
    return tuple(part for part in found if part is not None)


def usual_opening(kind: JointType, axis: Axis, box: Box) -> float:
    """Returns how far a part should open where nothing is stated: radians or metres.

    A quarter turn, or three quarters of the part's own depth along the slide.
    """
    if kind is JointType.REVOLUTE:
        return WIDEST_TURN
    return DEPTH_SHARE * float(np.abs(axis.direction) @ box.size)


def box_of(asset: Asset, members: tuple[str, ...]) -> Box:
    """Returns the box around some of the asset's parts."""
    return Box.enclosing(asset.part(member).box for member in members)


def _moving_part(request: JointRequest, asset: Asset) -> MovingPart | None:
    members = (request.moving, *request.attached)
    box = box_of(asset, members)
    _, middle, largest = np.sort(box.size)
    if largest < LARGEST * asset.unit or middle < IN_PLANE * asset.unit:
        return None
    usual = usual_opening(request.type, request.axis, box)
    reference = min(request.reference or usual, usual)
    if not reference > 0:
        return None
    motion = Motion(request.type, request.axis, box.center, both_ways=request.drawn_at > 0)
    label = asset.part(request.moving).label
    return MovingPart(request.moving, label, motion, members, reference, request.drawn_at)
