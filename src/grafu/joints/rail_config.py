"""What counts as a drawer, and sizes of rails; lengths are metres on furniture of usual size (`at_scale`)."""

from math import radians
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.joints.rack_guide_config import RackGuideConfig
from grafu.joints.rail_footing_config import RailFootingConfig
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True)
class BodyConfig:
    """What of a drawer, where it is met by rays from both sides, belongs to its container.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("outside", "even")
    outside: float = 0.01
    """How far beside the drawer rays start (metres)."""
    even: float = 2e-3
    """How far a flank may be from its median, where the tolerance for the width is less (metres)."""
    met: float = 2.0
    """How many rays of a column must meet the body, where `met_ratio` asks for fewer."""
    met_ratio: float = 0.2
    """The same as a fraction of what the rays of the best column meet."""
    long: float = 0.6
    """Fraction of the body's length over which a height of the flanks belongs to it."""
    gap: float = 0.1
    """A gap in the flanks, as between two bins one behind another, is bridged up to this (fraction of the depth) ..."""
    beside_gap: float = 0.25
    """... where the flanks before and behind it are as long as this at least (the same)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "met_ratio", "long", "gap", "beside_gap")


@final
@dataclass(frozen=True)
class ClosingConfig:
    """When a drawer counts as drawn open, and where it is closed.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = (
        "least",
        "beside",
        "front_thickness",
        "shallowest",
        "flush",
        "plane",
        "plainly",
        "proud",
        "offsets",
        "behind",
    )
    least: float = 0.015
    """What is less open is closed (metres)."""
    least_ratio: float = 0.02
    """What is less open is closed (fraction of the drawer's depth)."""
    widest: float = 0.9
    """How far open a drawer is drawn at most (fraction of its depth)."""
    alike: float = 0.03
    """By how much the sides of drawers of one size differ at most (fraction of each side)."""
    parallel: float = 0.99
    """Least cosine between the directions of drawers that open alike."""
    faces_front: float = 0.7
    """Least cosine between the opening direction and the normal of a face that looks ahead."""
    front_area: float = 0.25
    """Least area of a front's face (fraction of the drawer's outline)."""
    beside: float = 0.03
    """How far beyond a drawer's outline a drawn runner reaches at most (metres)."""
    runner: float = 0.6
    """Height of a drawn runner at most (fraction of the drawer's height)."""
    front_thickness: tuple[float, float] = (0.003, 0.06)
    """Thinnest and thickest front that lies on what stands around it (metres)."""
    sides: int = 2
    """On how many sides of a front something stands at least, to close it level with that."""
    shallowest: float = 0.1
    """What is less deep is no drawer (metres)."""
    flush: float = 0.003
    """How far a front stands ahead of what is beside it at most, to be level with it (metres)."""
    plane: float = 0.0005
    """How near to one plane the faces of fronts lie that are drawn alike (metres)."""
    plainly: float = 0.05
    """How far ahead of its case a front stands at most, to be drawn so by design where others are in its plane
    (metres)."""
    proud: float = 0.02
    """How far a front that could be pushed in stands ahead of what is around it at least, to count as open (metres)."""
    offsets: tuple[float, ...] = (0.004, 0.012, 0.024)
    """How far beside a front it is looked for what stands around it (metres)."""
    behind: float = 0.012
    """How far behind the back of a closed door what it lies on stands at most (metres)."""
    door_sides: int = 3
    """On how many sides of a closed door something stands or lies behind it at least."""
    least_turn: float = radians(4)
    """How far a door is turned at least, to count as open (radians) ..."""
    widest_turn: float = radians(135)
    """... and at most (radians)."""

    def __post_init__(self) -> None:
        require_positive(self, "least", "beside", "proud", "flush", "plane", "plainly", "shallowest", "sides", "behind")
        require_positive(self, "door_sides", "least_turn", "widest_turn")
        require_ratios(self, "least_ratio", "widest", "alike", "parallel", "faces_front", "front_area", "runner")
        if not 0 < self.front_thickness[0] < self.front_thickness[1] or min(self.offsets) <= 0:
            raise ValueError("`front_thickness` must rise and `offsets` be above 0")


@final
@dataclass(frozen=True)
class DrawerConfig:
    """What counts as a drawer, as a front without a container, and as a sliding door.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("thickest_board", "stands_out")
    shallow: float = 0.15
    """What is less deep than this fraction of its smaller side is a front without a container."""
    thickest_board: float = 0.03
    """What is less deep than this is a board, however low it is (metres)."""
    slat: float = 0.1
    """Depth of such a board, at most this fraction of its longer side: low fronts are thick for their height."""
    shortest: float = 0.3
    """A body shorter than this fraction of the drawer's depth is no container."""
    flat: float = 0.2
    """A sliding door is thinner than this fraction of its smaller side, and slides nearly along its plane."""
    stands_out: float = 1e-3
    """How far an attached part may stand out and still count as behind a drawer's front side (metres)."""
    outline: float = 0.9
    """A board before an open rack takes this much of the drawer's width and height at least (fraction)."""
    level: float = 0.5
    """Largest vertical part of a direction along which a drawer slides; more is up or down."""
    body: BodyConfig = BodyConfig()
    """Of its container."""

    def __post_init__(self) -> None:
        require_positive(self, "thickest_board", "stands_out")
        require_ratios(self, "shallow", "slat", "shortest", "flat", "outline", "level")


@final
@dataclass(frozen=True)
class FlankConfig:
    """Where the walls beside a drawer's flanks are sought, and where on the flanks rails are tried.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("inside", "ahead", "taller", "thinner")
    reach: float = 0.25
    """How far beside a flank a wall stands at most (extent)."""
    along: int = 12
    """Number of rays along a flank."""
    up: int = 5
    """Number of rays over its height."""
    margin: float = 0.05
    """What is left out at its front and back (fraction of the drawer's length)."""
    margin_height: float = 0.2
    """What is left out at its lower and upper edge (fraction of its height)."""
    inside: float = 0.01
    """How far inside a flank rays start (metres)."""
    inside_width: float = 0.2
    """The same at most, of narrow drawers (fraction of half the width)."""
    met: float = 0.2
    """Fraction of the rays that must meet a wall."""
    narrow: int = 10
    """The gap to a wall is that which one of so many rays finds at most: a hinge or a screw stands out of it."""
    ahead: float = 0.02
    """How far before the drawer its path is looked along, besides `ahead_length` (metres)."""
    ahead_length: float = 0.1
    """The same as a fraction of the drawer's length."""
    highest: float = 0.6
    """Largest height of a rail (fraction of the flank's)."""
    slender: float = 4.0
    """Largest height of a rail over its thickness, besides `taller` (ratio)."""
    taller: float = 0.01
    """What its height may be beyond that (metres)."""
    heights: tuple[float, ...] = (0.5, 0.3, 0.7, 0.15, 0.85)
    """Where on the flank a rail is tried in turn (fractions of the height from below)."""
    thinner: tuple[float, ...] = (0.0018, 0.001)
    """Thicknesses that are tried where not even a rail of the thinnest kind passes (metres)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "margin", "margin_height", "inside_width", "met", "ahead_length", "highest")


@final
@dataclass(frozen=True)
class BehindConfig:
    """Where rails may run behind a drawer's front that has no container.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("start", "seam", "air", "near")
    inset: float = 0.02
    """How far inside the front's sides the rails stay (fraction of its width)."""
    reach: float = 1.5
    """How far behind the front, and to its sides, walls are looked for (extent)."""
    start: float = 1e-3
    """How far behind the front rays start (metres)."""
    shallow: float = 0.5
    """A space less deep than this fraction of the front's smaller side holds no drawer."""
    near: tuple[float, ...] = (0.005, 0.015)
    """Depths behind the front at which the walls are sought: a face frame leaves the narrowest passage (metres)."""
    deep: float = 0.4
    """One more such depth (fraction of the space's)."""
    narrow: float = 0.1
    """A space whose half width is less than this fraction of the front's width holds no drawer."""
    seam: float = 5e-4
    """How far behind the front the rails begin (metres): a fixed end right on it would cut into it at rest."""
    span: float = 0.3
    """Where the outermost heights lie at which the depth is measured (fraction of the height, from the middle)."""
    heights: int = 7
    """Number of these heights."""
    as_deep: float = 0.8
    """What is at least this fraction as deep as the middle belongs to the space."""
    air: float = 0.01
    """How far before the space's end the rails end (metres)."""
    covered: float = 1.5
    """How far above the front's middle what covers the space may stand (in heights of the front)."""
    steps: int = 61
    """Number of depths at which it is sought."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "inset", "shallow", "deep", "narrow", "span", "as_deep")


@final
@dataclass(frozen=True)
class RailConfig(ShortRepr):
    """Sizes of rails and of the dividers that carry them.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("thinnest", "lowest", "common", "divider", "thinnest_divider", "divider_air", "least_travel")
    thinnest: float = 0.0025
    """Thickness below which rails are inset into the flank and the wall by what is missing (metres)."""
    lowest: float = 0.004
    """Least height of a rail, where the flank is as high (metres)."""
    common: float = 0.0127
    """Thickness of most ball-bearing slides (metres)."""
    dynamic_reach: float = 0.86
    """Fraction of a rail's thickness that its moving member takes, from the drawer's side."""
    most_inset: float = 0.5
    """Fraction of a rail's thickness that is inset at most: deeper, its static member would cut into the drawer."""
    divider: float = 0.016
    """Thickness of a divider where there is room for it (metres)."""
    thinnest_divider: float = 0.003
    """Thickness below which a divider carries nothing (metres)."""
    divider_air: float = 0.001
    """Distance between a divider and what stands behind it (metres)."""
    deeper: float = 3.0
    """A shallow drawer before a space so many times as deep is a front with its pull, not a container (ratio)."""
    travel: float = 0.77
    """Fraction of the depth that a drawer travels: what rails over 0.9 of a body travel with a lap of 15 %."""
    most_of_rail: float = 0.95
    """Fraction of a rail's length that it gives at most, where more is stated than its template gives."""
    least_travel: float = 1e-3
    """How far a drawer is to travel at least, whatever is stated (metres)."""
    around: float = 0.5
    """How far from a drawer what may carry its rails stands at most (fraction of the drawer's largest side)."""
    poses: int = 12
    """Number of poses along the travel in which rails are checked against what they could cut into."""
    footing: RailFootingConfig = RailFootingConfig()
    """Of what holds rails."""
    flank: FlankConfig = FlankConfig()
    """Of the walls beside a drawer, and of places on its flanks."""
    behind: BehindConfig = BehindConfig()
    """Of the space behind a front without a container."""
    guide: RackGuideConfig = RackGuideConfig()
    """Of the guides of racks."""

    def __post_init__(self) -> None:
        require_positive(self, *(set(self.__dataclass_fields__) - {"footing", "flank", "behind", "guide"}))
        require_ratios(self, "dynamic_reach", "most_inset", "travel", "most_of_rail", "around")
