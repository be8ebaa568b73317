"""The outcome of carving a grip: the part with its grip, and what was taken away."""

from dataclasses import dataclass
from typing import final

from grafu.additions.grip.config import GripKind, GripProfile
from grafu.asset.part import Part
from grafu.geometry.arrays import ArrayValue, Vec3, freeze_arrays


@final
@dataclass(frozen=True, eq=False)
class Carved(ArrayValue):
    """A part with its grip, at rest in the object frame.

    `centre` is the middle of the grip's mouth on the front, `direction` the unit vector along its length, `outward`
    the front's; `size` is its length, width and depth in metres (a through-going one is as deep as the front is
    thick). `volume` and `area` say what was taken away: cubic metres of solids, square metres of surface.
    """

    part: Part
    kind: GripKind
    profile: GripProfile
    centre: Vec3
    direction: Vec3
    outward: Vec3
    size: Vec3
    volume: float
    area: float

    def __post_init__(self) -> None:
        freeze_arrays(self)
