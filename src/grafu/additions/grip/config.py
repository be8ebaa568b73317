"""Sizes of recessed grips. Lengths are metres, made for hands, and capped by fractions of the front."""

from dataclasses import replace
from enum import StrEnum
from typing import Literal, final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.visible import ShortRepr


class GripKind(StrEnum):
    """What is carved."""

    GROOVE = "groove"  # a U-shaped hollow in the front face; a wall stays behind it
    EDGE = "edge"  # a notch in the free edge, through the thickness: fingers reach behind the front
    HOLE = "hole"  # a round or oval hole through the front


GripProfile = Literal["sharp", "rounded"]


@final
@dataclass(frozen=True, slots=True)
class GripSize:
    """`length` along the gripped edge, `width` across it (an edge notch: how far it reaches in); `depth` of a groove.

    Raises:
        ValueError: if a length is not positive.
    """

    length: float
    width: float
    depth: float = 0.012

    def __post_init__(self) -> None:
        require_positive(self, "length", "width", "depth")

    def scaled(self, factor: float) -> "GripSize":
        """Returns the size with its length and width multiplied."""
        return GripSize(factor * self.length, factor * self.width, self.depth)


@final
@dataclass(frozen=True)
class GripSizes:
    """What grips are like where nothing else is asked: as routed and drilled by joiners.

    Four fingers are 80 mm wide, one is 20 mm thick; 35 mm is the common bore.

    Raises:
        ValueError: if a radius is not between 0 and 1.
    """

    groove: GripSize = GripSize(0.14, 0.03, 0.012)
    """Size of a groove, metres."""
    edge: GripSize = GripSize(0.10, 0.028)
    """Size of an edge notch, metres."""
    hole: GripSize = GripSize(0.035, 0.035)
    """Size of a hole, metres."""
    bottom_radius: float = 0.7
    """Radius of a groove's rounded bottom, as a fraction of its depth."""
    rim_radius: float = 0.15
    """Radius of a hole's rounded rim, as a fraction of the front's thickness."""
    beyond: float = 0.25
    """How far what cuts a notch reaches beyond the edge, as a fraction of the notch's width."""

    def __post_init__(self) -> None:
        require_ratios(self, "bottom_radius", "rim_radius", "beyond")

    def with_lengths(self, length: float, width: float, depth: float) -> "GripSizes":
        """Returns the sizes with these lengths for every kind, metres; 0: each kind's own."""
        given = {"length": length, "width": width, "depth": depth}
        stated = {name: value for name, value in given.items() if value}
        return replace(
            self,
            groove=replace(self.groove, **stated),
            edge=replace(self.edge, **stated),
            hole=replace(self.hole, **stated),
        )

    def of(self, kind: GripKind) -> GripSize:
        """Returns the size of a kind of grip."""
        return {GripKind.GROOVE: self.groove, GripKind.EDGE: self.edge, GripKind.HOLE: self.hole}[kind]


@final
@dataclass(frozen=True)
class GripTrials:
    """Which sizes and places are tried in turn, the usual one first.

    Raises:
        ValueError: if a size or a distance from the edge is not above 0.
    """

    sizes: tuple[float, ...] = (1.0, 0.7)
    """Lengths and widths, as fractions of the wanted ones."""
    margins: tuple[float, ...] = (1.0, 2.5)
    """Distances from the edge, as multiples of the margin."""
    shifts: tuple[float, ...] = (0.0, 0.15, -0.15, 0.3, -0.3, 0.4, -0.4)
    """Distances along the gripped edge from the best place, as fractions of its length."""

    def __post_init__(self) -> None:
        if not all(size > 0 for size in (*self.sizes, *self.margins)):
            raise ValueError(f"`GripTrials` must be above 0: got {self.sizes} and {self.margins}")


@final
@dataclass(frozen=True)
class GroundConfig:
    """What counts as one layer of a front, and how far around a front is looked.

    Raises:
        ValueError: if a length is not above 0.
    """

    seam: float = 0.002
    """Distance up to which layers count as one, metres."""
    over: float = 0.4
    """How far a hole's cutter stands out of a layer on both sides, as a fraction of `seam` (ratio)."""
    board: float = 0.04
    """Distance up to which two sheets are the sides of one board, metres."""
    thinnest: float = 0.001
    """Thickness up to which a layer is a sheet that takes no groove, metres."""
    around: float = 0.08
    """Distance from a front beyond which things do not matter, metres."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True)
class GripConfig(ShortRepr):
    """Which grip is carved, and what must remain.

    Raises:
        ValueError: if a length or fraction is out of its range.
    """

    kind: GripKind | Literal["auto"] = "auto"
    """What to carve; `auto` tries an edge notch, a hole and a groove in this order: best held first."""
    profile: GripProfile = "rounded"
    """Sharp corners, or rounded ends and bottoms."""
    size: tuple[float, float] | None = None
    """Length along the gripped edge and width across it, metres; none: the kind's own."""
    depth: float | None = None
    """How deep a groove goes, metres; none: 12 mm."""
    margin: float = 0.018
    """Least material between the grip and the front's edges, metres."""
    wall: float = 0.003
    """Least thickness that stays behind a groove, metres."""
    drawer_side: Literal["top", "bottom"] = "top"
    """The edge of a drawer's front at which the grip sits."""
    turned: bool = False
    """Whether a groove or oval hole lies across the gripped edge instead of along it."""
    finger_room: float = 0.02
    """Free depth that fingers need behind a notch or hole, metres."""
    length_ratio: float = 0.5
    """Longest grip, as a fraction of the gripped edge."""
    width_ratio: float = 0.3
    """Widest grip, as a fraction of the front's side across the gripped edge."""
    depth_ratio: float = 0.65
    """Deepest groove, as a fraction of the front's thickness."""
    thickest: float = 0.05
    """Thickest front through which a hole or notch is cut, metres ..."""
    thick_ratio: float = 1.5
    """... and the most of the grip's length that its thickness may be (ratio)."""
    finger_width: float = 0.02
    """One finger's width: the shortest grip, metres."""
    finger_thickness: float = 0.012
    """One finger's thickness: the narrowest grip, and the room before the front, metres."""
    shallowest: float = 0.003
    """Depth below which a groove is none, metres."""
    uneven: float = 0.25
    """Steps in the face where a groove is cut, as a fraction of its depth."""
    step: float = 0.003
    """Steps in the face where a hole is cut, metres."""
    steepest: float = 0.35
    """Most that a bowed front may slope where it is carved, metres per metre."""
    margin_ratio: float = 0.12
    """Most that the margin takes, as a fraction of the front's sides."""
    blunt: float = 0.0015
    """How far edges may be rounded, and count as straight all the same, metres."""
    shown: float = 0.8
    """Fraction of a hole behind which fingers must find room."""
    away: float = 0.06
    """What is attached and stands farther before the front leaves the hand room, metres."""
    clear: float = 0.004
    """Least distance between a grip and what is attached, metres."""
    reach_height: float = 1.0
    """Height above the floor at which tall doors are gripped (EN 12098 and joiners: 0.9 to 1.1), metres."""
    tall: float = 0.5
    """Length of the gripped edge from which on a door is gripped off its middle, metres ..."""
    upright: float = 0.9
    """... where the upright part of this edge's unit direction is at least this (ratio)."""
    high: float = 1.2
    """Height of a door's lower end above which it is gripped as low as it can be, metres."""
    end_ratio: float = 0.25
    """Least distance of such a grip from a door's ends, as a fraction of its height."""
    full: float = 0.5
    """Fraction of the box around a groove that is cut at least: less was cut where the front is not solid."""
    sizes: GripSizes = GripSizes()
    """What grips are like where nothing else is asked."""
    trials: GripTrials = GripTrials()
    """Which sizes and places are tried in turn."""
    ground: GroundConfig = GroundConfig()
    """What counts as one layer of a front."""

    def __post_init__(self) -> None:
        lengths = (
            "margin",
            "wall",
            "finger_room",
            "thickest",
            "finger_width",
            "finger_thickness",
            "shallowest",
            "step",
        )
        require_positive(
            self,
            *lengths,
            "thick_ratio",
            "upright",
            "steepest",
            "blunt",
            "away",
            "clear",
            "reach_height",
            "tall",
            "high",
        )
        require_ratios(
            self, "length_ratio", "width_ratio", "depth_ratio", "uneven", "margin_ratio", "shown", "end_ratio", "full"
        )
        own = (*(self.size or ()), *(() if self.depth is None else (self.depth,)))
        if not all(length > 0 for length in own):
            raise ValueError(f"a grip's own size and depth must be above 0: got {self.size} and {self.depth}")

    @property
    def kinds(self) -> tuple[GripKind, ...]:
        """What is tried, in order."""
        return (GripKind.EDGE, GripKind.HOLE, GripKind.GROOVE) if self.kind == "auto" else (self.kind,)

    def wanted(self, kind: GripKind) -> GripSize:
        """Returns the size that a kind should have where there is room."""
        plain = self.sizes.of(kind)
        length, width = self.size or (plain.length, plain.width)
        if self.turned and kind is not GripKind.EDGE:
            length, width = width, length
        return GripSize(length, width, self.depth or plain.depth)
