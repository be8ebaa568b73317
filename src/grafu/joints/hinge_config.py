"""Sizes of hinges and pivots. Lengths are metres on furniture of usual size, in its scale on others (`at_scale`)."""

from math import radians
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_finite, require_positive, require_ratios
from grafu.joints.concealed_config import ConcealedConfig
from grafu.joints.drawn_config import DrawnConfig
from grafu.visible import ShortRepr

_NO_NUMBERS = frozenset(("survey", "footing", "pin", "pivot", "drawn", "concealed", "preferred"))


@final
@dataclass(frozen=True)
class SurveyConfig(ShortRepr):
    """Where rays are cast around a hinge border, and what of it counts as one face.

    Thickness, width and length are the door's. A board is its thickness, or that of a thin board where it has none.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("even", "rounding", "overhang")
    front: float = 0.1
    """How much of what is seen of a door from in front its front is at least; less is a handle (fraction)."""
    heights: int = 7
    """Number of heights along the border at which rays are cast."""
    met_at: int = 2
    """At how many of them a face must be met: a flap may have stiles behind its ends alone."""
    ends: float = 0.475
    """Where the outermost heights lie (fraction of the length from the middle): often there are only top and bottom."""
    start: float = 0.3
    """How far inside the door rays start (fraction of the thickness)."""
    start_width: float = 0.25
    """The same at most, of rays to the side (fraction of the width)."""
    beside: tuple[float, ...] = (0.15, 0.5, 0.85)
    """Depths behind the front at which the gap beside the door is measured (fractions of the thickness)."""
    in_front: tuple[float, ...] = (0.1, 0.25, 0.4)
    """Distances beyond that gap at which the neighbour's front is measured (in boards)."""
    shallowest: float = 0.05
    """Least depth behind the front to which the face beside the door is followed (fraction of the thickness)."""
    deepest: float = 1.5
    """Largest depth behind the front to which it is followed (fraction of the thickness)."""
    depths: int = 12
    """Number of depths between the two."""
    even: float = 0.003
    """Gaps that differ by less are those of one face (metres; of doors wider than 1 m a fraction of the width)."""
    behind: tuple[float, ...] = (0.05, 0.2, 0.4, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0)
    """Distances from the border inwards at which the gap behind the door is measured, ascending (in boards)."""
    on_border: int = 5
    """The first so many of these distances lie on the border itself."""
    even_behind: float = 0.1
    """Gaps behind the door that differ by less than this and `rounding` are those of one face (in boards)."""
    rounding: float = 1e-4
    """What is added to that for doors without thickness, and by how much a front must stand out to count (metres)."""
    edge: tuple[float, ...] = (0.02, 0.1, 0.3, 0.6)
    """Distances behind the door at which a panel that stands edge-on is sought (in boards)."""
    edge_inwards: float = 3.0
    """How far from the border inwards the edge of such a panel lies at most (in boards)."""
    reach: float = 4.0
    """How wide a gap around the door is looked across (in widest seams)."""
    aside: tuple[float, ...] = (0.1, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0)
    """Distances from the border outwards to which the face behind the door is followed, ascending (in boards)."""
    outside: tuple[float, ...] = (0.25, 0.6, 1.0)
    """Depths in what stands behind the door at which its outer side is measured (in boards)."""
    overhang: float = 0.15
    """How far a lid stands out behind the case that it lies on at most (metres)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "front", "ends", "start", "start_width")


@final
@dataclass(frozen=True)
class PivotConfig:
    """Sizes of the discs and plates that carry a door at its ends, and where they are sought.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("disc_inset", "start", "plate", "plate_play", "plate_least", "plate_reach", "plate_end")
    disc_inset: float = 0.0015
    """How deep a pivot's disc is inset into its own part (metres)."""
    sides: int = 24
    """Number of sides of a disc."""
    reach: float = 0.2
    """How far beyond a door's end the static body may stand (fraction of the border's length)."""
    start: float = 0.01
    """How far beyond the border's end rays to the door start (metres)."""
    ring: float = 0.7
    """Where rays about the pin start (fraction of its radius)."""
    rays: int = 6
    """Number of rays about the pin, besides the one on it."""
    met: float = 0.6
    """Fraction of these rays that must meet a part."""
    inside: float = 0.4
    """How far inside the door's end rays to the static body start (fraction of the border's length)."""
    tubes: tuple[float, ...] = (1.5, 3.0, 5.0, 8.0)
    """Radii within which corners of tubes and sockets are sought, which rays pass through (in radii of the pin)."""
    widest: float = 2.0
    """Widest disc at the end of a door, as long as anything else carries the door (in radii of the pin)."""
    tube_reach: float = 0.25
    """How far apart such corners may be along the axis, where `reach` is less (fraction of the border's length)."""
    plate: float = 0.002
    """Thickness of a plate beside a door's end (metres)."""
    plate_play: float = 0.001
    """Distance between the door's end and the plate (metres)."""
    plate_least: float = 0.0005
    """Least room between a leaf's lower end and the floor that a thinner plate takes (metres)."""
    plate_reach: float = 0.025
    """How far the plate reaches behind the door's back, and how far inwards the case may stand there (metres)."""
    plate_end: float = 0.02
    """How far from the border's end, outside of which rays start, the door's end may lie (metres)."""
    foot: float = 0.4
    """Where the middle of the plate's foot lies, from its rear end (fraction of `plate_reach`)."""
    foot_depth: float = 0.36
    """Half the depth of the foot (fraction of `plate_reach`)."""
    foot_width: float = 0.9
    """Half the width of the foot (fraction of the pin's radius)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "reach", "ring", "met", "inside", "tube_reach", "foot", "foot_depth", "foot_width")


@final
@dataclass(frozen=True)
class PinConfig:
    """Which surroundings of a border allow which pin; radii are the barrel's, widths the door's, boards as above.

    Raises:
        ValueError: if a number is not above 0, a fraction not between 0 and 1, or a place not finite.
    """

    proud: float = 0.6
    """How far what is beside an inset door may stand out before it, with the leaves in the seam (in radii)."""
    edge_leaf: float = 0.95
    """Width of a leaf that lies on an edge or in a seam (fraction of their depth)."""
    front_leaf: float = 0.3
    """Largest width of a leaf that lies on a door's front (fraction of the width)."""
    widest_seam: float = 3.0
    """Widest seam with leaves in it (in radii)."""
    widest_strip: float = 4.0
    """Widest strip of the frame beside an overlay door that has its leaves behind it (in radii)."""
    corner_strip: float = 3.0
    """Narrowest such strip that has room for a hinge in the corner between door and frame (in radii)."""
    pivot: float = 0.06
    """Radius of a pivot, where that is more than a barrel's (fraction of the door's thickness or width)."""
    pivot_inset: float = 1.2
    """How far inside the border's corner a pivot lies (in its own radii)."""
    inner_across: tuple[float, ...] = (1.2, 2.4, 2.4, 4.8, 4.8)
    """How far from the border pivots lie that keep the door's edge from what is beside it (in their own radii) ..."""
    inner_deep: tuple[float, ...] = (0.0, 0.0, 1.2, 1.2, 2.4)
    """... and how far behind the door's front each of them (in radii)."""
    step: float = 0.25
    """Step between makeshift pins, where that is more than a radius (in boards)."""
    inwards: tuple[float, ...] = (0.0, 1.0, -1.0, 2.0, 4.0, -2.0)
    """How far inwards from the border they are tried in turn (in steps)."""
    before: tuple[float, ...] = (0.0, 1.0, 2.0)
    """How far before the front, besides a radius (in steps)."""
    makeshift_leaf: float = 0.1
    """Largest width of their leaves (fraction of the width)."""
    narrowest: float = 4.0
    """The same at least, of narrow doors (in radii)."""
    widest: float = 8.0
    """The same at most, of wide doors (in radii)."""

    def __post_init__(self) -> None:
        require_positive(self, *(set(self.__dataclass_fields__) - {"inwards", "before", "inner_deep"}))
        require_finite(self, "inwards", "before", "inner_deep")
        require_ratios(self, "edge_leaf", "front_leaf", "pivot", "makeshift_leaf")


@final
@dataclass(frozen=True)
class FootingConfig:
    """Sizes of the blocks between a hinge and what carries it, and how far they reach.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("thinnest", "thickest", "resting")
    snap: float = 0.9
    """Side of a block that stands on the back of a leaf (fraction of the leaf's)."""
    side: float = 0.8
    """Side of a block that stands on another side of the leaf (fraction of that side's)."""
    thinnest: float = 5e-4
    """Half the side of a block at least, on the edge of a leaf (metres)."""
    door_reach: float = 0.5
    """Longest block between a hinge and its door (fraction of the door's width)."""
    tongue: float = 0.4
    """Half the height of an inset leaf's tongue, and half its thickness (fraction of the leaf's)."""
    thickest: float = 0.005
    """Thickest block below a leaf, as long as anything else carries the door (metres)."""
    resting: float = 0.001
    """How far below a leaf what it rests on lies at most (metres)."""
    rests: float = 0.8
    """How much of a leaf rests on its part at least, as long as anything else carries the door (fraction)."""
    first: float = 0.1
    """How much of a leaf may lie nearer to its part than the plane that it rests on (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, "thinnest", "thickest", "resting")
        require_ratios(self, "snap", "side", "door_reach", "tongue", "rests", "first")


@final
@dataclass(frozen=True)
class HingeConfig(ShortRepr):
    """Sizes of hinges that are not templates, what is tried where usual ones do not fit, and where it is measured.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("two_up_to", "one_more_per", "radius", "smallest", "leaf_margin", "tongue", "lap")
    slim: float = 0.5
    """Barrel radius of a slim hinge, a fraction of what suits the door."""
    looser: float = 4.0
    """Seams and steps for a class that is forced, over the usual ones (ratio): support blocks bridge what remains."""
    two_up_to: float = 0.9
    """Longest door that hangs on two hinges (metres): cabinet makers put 2 up to 0.9 m, 3 up to 1.5, 4 up to 2.1."""
    one_more_per: float = 0.6
    """Length beyond that for each further hinge (metres)."""
    length_ratio: float = 0.12
    """Longest hinge, a fraction of its door's length along the axis."""
    radius_ratio: float = 0.22
    """Largest barrel radius, a fraction of the door's thickness."""
    radius: float = 0.0036
    """Barrel radius of a common 60 mm butt hinge (metres): none is larger."""
    smallest: float = 0.001
    """Smallest barrel radius (metres)."""
    spacing: float = 0.8
    """Longest hinge of several, a fraction of the distance from one to the next."""
    leaf_thickness: float = 0.6
    """Thickest leaf, a fraction of the barrel's radius."""
    narrowest_leaf: float = 1.5
    """How far a leaf reaches from the pin at least, over the barrel's radius (ratio)."""
    leaf_margin: float = 2e-4
    """How far beyond that it reaches at least (metres)."""
    tongue: float = 0.02
    """How deep the tongue of an inset leaf reaches into what stands behind the door (metres)."""
    lap: float = 0.002
    """How far the tongue overlaps the leaf that it extends (metres)."""
    inside: float = 0.1
    """An axis nearer to a side than this fraction of the part runs along its border."""
    chunky: float = 0.45
    """A part thicker than this fraction of its width is no door panel."""
    nearly: float = 0.05
    """A pin that leaves this fraction of the wanted opening blocked is still as good as free."""
    survey: SurveyConfig = SurveyConfig()
    """Of what lies around a border."""
    carriers: float = 0.25
    """How far from a door what may carry it stands at most (fraction of the door's largest side)."""
    around: float = 0.2
    """How far from a door what may be in its hinges' way stands at most (extent)."""
    usual_opening: float = radians(90)
    """How far a door is to open where nothing states it (radians)."""
    least_opening: float = radians(30)
    """How far a door is to open at least, whatever is stated (radians)."""
    footing: FootingConfig = FootingConfig()
    """Of what holds hinges."""
    pin: PinConfig = PinConfig()
    """Of what pins need."""
    pivot: PivotConfig = PivotConfig()
    """Of discs at a door's ends."""
    drawn: DrawnConfig = DrawnConfig()
    """Of hinges that the input has."""
    concealed: ConcealedConfig = ConcealedConfig()
    """Of cup hinges."""
    preferred: str = ""
    """The template that is tried before all others of its class; `cup`: before all."""

    def __post_init__(self) -> None:
        require_positive(self, *(set(self.__dataclass_fields__) - _NO_NUMBERS))
        require_ratios(self, "slim", "length_ratio", "radius_ratio", "inside", "chunky", "nearly")
        require_ratios(self, "spacing", "leaf_thickness", "carriers", "around")
