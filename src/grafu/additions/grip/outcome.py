"""The outcome of carving a grip: the part with its grip, or a reason from a closed list."""

from dataclasses import dataclass
from enum import StrEnum
from typing import final

from grafu.additions.grip.config import GripKind, GripProfile
from grafu.asset.part import Part
from grafu.geometry.arrays import ArrayValue, Vec3, freeze_arrays


class GripRefusal(StrEnum):
    """Why a front takes no grip."""

    NO_MOTION = "no motion"  # how the part moves is not known: so neither is its free edge
    TOO_SMALL = "too small"  # no room for fingers within its edges
    NO_THICKNESS = "no thickness"  # a sheet, which takes no groove
    TOO_THIN = "too thin"  # no wall would be left behind a groove
    TOO_THICK = "too thick"  # a hole or notch would not come out behind
    UNEVEN = "uneven"  # mouldings, slats or openings where a grip could sit
    GLASS = "glass"  # what can be seen through is not carved
    TAKEN = "taken"  # handles, hinges or rails sit there
    NO_FINGER_ROOM = "no finger room"  # something stands right behind or before it
    WOULD_BREAK = "would break"  # the front would fall apart or change its outline


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


@final
@dataclass(frozen=True)
class Refused:
    """No grip: the part, the reason, and what was tried."""

    part: str
    reason: GripRefusal
    detail: str = ""
