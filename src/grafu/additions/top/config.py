"""When furniture counts as topless, and the slab that it is given. Lengths are metres on furniture of usual size."""

from math import radians
from typing import Literal, final

from grafu.additions.top.slope_config import SLOPE, SlopeConfig
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_not_negative, require_positive, require_ratios
from grafu.visible import ShortRepr

TopShape = Literal["rectangle", "rounded", "chamfered", "oval", "capsule"]


@final
@dataclass(frozen=True)
class OpeningConfig:
    """Which openings, seen from above, speak for a missing top."""

    front: float = 0.06
    """Distance before the still parts up to which a closed front belongs to the footprint, metres."""
    crack: float = 0.02
    """Width up to which a gap between boards or behind a handle is no opening, metres."""
    rim_step: float = 0.03
    """Difference in height between the rims of two openings that one top closes, metres."""
    above_rim: float = 0.06
    """Height above a rim up to which things still stand at it, metres."""
    niche: float = 0.45
    """Fraction of the height below which what is open in front is a niche or an open drawer, no place for a top."""
    narrow: float = 0.12
    """Width up to which what is open in front is none: splayed legs stand so far beyond a table's top, metres ..."""
    narrow_ratio: float = 0.25
    """... and at most this fraction of the plan's smaller side."""
    least_slant: float = 0.1
    """Rise of a rim per length from which on it slants: it is a flap's or a lid's, and no flat top lies on it ..."""
    most_slant: float = 3.0
    """... and up to which it does, metres per metre: what is steeper is a step."""
    over: float = 0.5
    """Fraction of an opening that supports of a higher top must span for the opening to be a ring of stretchers."""
    least: float = 0.15
    """Fraction of the footprint that an opening takes at least: smaller ones are sinks, cable outlets and gaps."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "niche", "narrow_ratio", "over", "least")


@final
@dataclass(frozen=True)
class SupportConfig:
    """What a top alone joined: posts, walls and pedestals that end at one height."""

    even: float = 0.01
    """Difference in height between supports of one top, metres."""
    lowest: float = 0.25
    """Least height of supports: that of benches, metres."""
    highest: float = 1.25
    """Greatest height of supports: that of bar tables; higher posts belong to racks and beds, metres."""
    most_levels: int = 10
    """Heights that are looked at, from above: furniture with more visible ends has no bare supports."""
    widest: float = 0.12
    """Greatest width of posts and walls: what is wider both ways is a surface, metres."""
    narrowest_top: float = 0.25
    """Least width of a top over supports, metres."""
    open_below: float = 0.6
    """Fraction of the supports' height: a surface above that between them is what they stand around."""
    above: float = 0.06
    """Height above the supports from which on something belongs to another piece, metres."""
    filled: float = 0.25
    """Fraction of what lies between supports that may be filled: a mirror, an apron or a cable tray is less."""
    footprint: float = 0.6
    """Fraction of all that stands no higher than the supports that their outline takes at least."""
    full: float = 0.7
    """Fraction of its bounding rectangle that an outline takes at least: a triangle or a diamond takes less."""
    divider: float = 0.06
    """Greatest thickness of a divider, metres."""
    divider_depth: float = 0.6
    """Fraction of the depth that a divider reaches at least."""
    notch: float = 0.25
    """Least length of both sides of the free corner of an L, metres."""
    arm: float = 0.3
    """Least width of either arm of an L, metres."""
    corner: float = 0.2
    """Fraction of the bounding rectangle that the free corner of an L takes at least: less is a recess."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "open_below", "filled", "footprint", "full", "divider_depth", "corner")


@final
@dataclass(frozen=True)
class EvidenceConfig:
    """What parts say beyond the two maps: basins, tops by name, plates with cut-outs."""

    shallowest_basin: float = 0.06
    """Least depth of sinks and wash basins, metres."""
    deepest_basin: float = 0.4
    """Greatest depth of sinks and wash basins, metres."""
    basin_below: float = 0.03
    """Distance that a basin's rim may lie below the cabinet's, metres."""
    basin_above: float = 0.12
    """Distance that a basin's rim may stand above the cabinet's, metres."""
    basin_margin: float = 0.008
    """Width of the cabinet that stands around a basin at least, metres."""
    basin_area: float = 0.05
    """Fraction of what stands at the rim that a basin takes at least."""
    basin_full: float = 0.7
    """Fraction of its own box that a basin covers at least."""
    basin_hollow: float = 0.25
    """Fraction of a basin that lies as deep as a shallow basin at least: a drainer takes much of it."""
    flange: float = 0.015
    """Distance below a basin's rim at which it is as wide as its cut-out, metres."""
    inset: float = 0.2
    """Distance below a rim at which a part that is called top panel still is one, metres."""
    flat: float = 0.09
    """Greatest thickness of a flat part: it is more than a worktop's, metres."""
    spans: float = 0.85
    """Fraction of what stands at the rim that a plate with cut-outs spans at least."""
    plate: float = 0.5
    """Fraction of its own box that a plate covers at least: a frame of bars covers less, a plate with a sink more."""
    named_plate: float = 0.35
    """The same fraction for a part that is called top panel."""
    named: float = 0.5
    """Fraction of what covers at the rim that is called top panel, from which on bars around it are its frame."""
    predicted: float = 0.1
    """Greatest distance between the upper face of a predicted top and the rim that it belongs to, metres."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "basin_area", "basin_full", "basin_hollow", "spans", "plate", "named_plate", "named")


@final
@dataclass(frozen=True)
class OutlineConfig(ShortRepr):
    """What carries a missing top, and the outline that is closed up around it."""

    below_rim: float = 0.03
    """Depth below a rim's height in which what carries the top is looked for, metres."""
    above_rim: float = 0.06
    """Height above a rim's height in which what carries the top is looked for, metres."""
    even: float = 0.001
    """Difference in height up to which parts of a rim carry together, metres."""
    low_point: float = 0.002
    """Height that single points may stand above the rest and lift the top rather than pierce it, metres."""
    posts: float = 0.006
    """Height that posts may stand above the rest and carry the top alone, far enough apart, metres."""
    apart: float = 0.7
    """Fraction of the rim's extent that what carries a top must span."""
    carries: float = 0.15
    """Fraction of the rim that is enough to carry a top."""
    rim: float = 0.12
    """Width around an opening that belongs to its rim: a face frame, a post and a panel, metres."""
    line: float = 5e-4
    """Half the width that a section's lines are given, metres."""
    skin: float = 0.0015
    """Depth of the upper section under the rim: a top board's edge may be rounded, metres."""
    deep_skin: float = 0.02
    """Depth of the lower section under the rim: a back may end lower, metres."""
    span: float = 0.25
    """Width of gaps beside an opening that a top spans, metres."""
    board: float = 0.04
    """Greatest thickness of a board of which a section shows both faces, metres."""
    kneehole: float = 1.3
    """Distance between two pedestals that one top spans, metres."""
    square: float = 0.04
    """Distance between a rectangle's and an outline's corners up to which it was meant as a rectangle, metres ..."""
    empty: float = 0.02
    """... where the outline, grown by twice that, leaves out at most this fraction of the rectangle."""
    front: float = 0.08
    """Distance before the body in which a front belongs under the top, metres."""
    front_below: float = 0.005
    """Depth below a front's upper end, or below the seat, at which the front's outline is taken, metres."""
    reach: float = 0.06
    """Distance that a front may end below the rim and still belong under the top, metres."""
    base: float = 0.08
    """Distance that base mouldings and pedestals may jut out, and the top with them, metres."""
    inset: float = 0.01
    """Height above the rest to which an end panel still carries the top, metres."""
    tray: float = 0.15
    """Distance before the body that a tray under a top may reach, and the top with it, metres."""
    slot: float = 0.008
    """Least height above a seat at which what stands on a top begins: that of a thin top, metres."""
    high_slot: float = 0.06
    """Greatest height above a seat at which what stands on a top begins: that of a thick top, metres."""
    tongue: float = 0.012
    """Width below which a piece of a top is removed, metres."""
    crevice: float = 0.03
    """Width of gaps in what stands up through a top, or hangs in it, that are closed up, metres."""
    detail: float = 2e-4
    """Distance by which a top's outline may be simplified, metres."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "apart", "carries", "empty")


@final
@dataclass(frozen=True)
class CutoutConfig:
    """What a slab leaves free for doors, drawers and flaps."""

    left: float = 0.4
    """Fraction of the thickness that must be left over a groove."""
    upright: float = 0.7
    """Upright part of a unit direction; an axis is level where it has at most 1 less this (ratio)."""
    flap: float = 0.25
    """Fraction of a leaf's height: an axis within that of its upper end lifts it."""
    opening: float = radians(110)
    """Angle by which doors are taken to open: 110 degrees as in `RealizationConfig`, radians."""
    near: float = 0.06
    """Distance below the slab within which a flap's upper end meets it, metres."""
    before: float = 0.15
    """Distance before a flap that stays free, metres."""
    beside: float = 0.05
    """Distance beside a flap that stays free, metres."""
    tray: float = 0.1
    """Fraction of the body's plan: what moves and takes more is no front but a tray or a drawer."""
    thickest: float = 0.05
    """Greatest thickness of a slab that passes over a tray or a drawer, metres."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "left", "upright", "flap", "tray")


@final
@dataclass(frozen=True)
class TopConfig(ShortRepr):
    """What counts as a top, and how an added one looks.

    Raises:
        ValueError: if a fraction is not between 0 and 1, or a length is negative.
    """

    coverage: float = 0.6
    """Fraction of what stands at the rim that must be covered for a top to count as there."""
    doubt: float = 0.2
    """Distance of the covered fraction from `coverage` within which labels, bars and predictions are asked too."""
    recess: float = 0.05
    """How far below its rim a surface still is the top: fillets and inset tops are deeper than 1 % of the height ..."""
    recess_ratio: float = 0.1
    """... and at most this fraction of the height."""
    gallery: float = 0.15
    """How far the sides and the back may stand above a top that is open in front: galleries, splashbacks ..."""
    gallery_ratio: float = 0.25
    """... and at most this fraction of the height."""
    front: float = 0.02
    """Overhang of an added top beyond the fronts: that of usual worktops."""
    side: float = 0.01
    """Overhang on both sides."""
    back: float = 0.0
    """Overhang behind: furniture stands against walls."""
    thickness: float = 0.025
    """Thickness of an added top; worktops have 20 to 40 mm, official: 20 mm ..."""
    thickness_ratio: float = 0.2
    """... and at most this fraction of its height above the floor."""
    shape: TopShape = "rectangle"
    """Corners and upper edge sharp, rounded, chamfered; or the ellipse or capsule around what a rectangle covers."""
    edge: float = 0.35
    """How far the upper edge of a rounded or chamfered top is broken, as a fraction of its thickness."""
    corner: float = 0.02
    """How far the corners of a rounded or chamfered top are broken, seen from above, metres."""
    gap: float = 0.001
    """Air between an added top and what moves below or before it."""
    seat: float = 0.0004
    """How deep a top may reach into what carries it or stands in it, metres."""
    overrun: float = 0.001
    """Length by which grooves run out of a slab's edges, metres."""
    most_tops: int = 3
    """Most tops of one piece: a desk, its pedestal and its hutch."""
    apart: float = 0.05
    """Difference in height between two tops of one piece, as a fraction of the height of the new one."""
    upright: float = 0.7
    """Upright part of a unit direction from which on what slides moves up and down (ratio)."""
    seen_depth: float = 0.012
    """Fraction of the largest side: what lies less far behind the foremost face is seen."""
    seen_facing: float = 0.3
    """Part of a unit normal towards the eye below which a face is an edge (ratio)."""
    seen_body: float = 0.25
    """Fraction of all that is seen: a still body that shows less is a runner, a rail or a cable tray."""
    seen_legs: float = 0.15
    """Fraction of all that is seen: legs that show less are fittings, and a top does not look like them."""
    metal: float = 0.5
    """Metallic fraction of a material from which on it is metal."""
    openings: OpeningConfig = OpeningConfig()
    supports: SupportConfig = SupportConfig()
    """Which openings speak for a missing top; what it alone joined."""
    evidence: EvidenceConfig = EvidenceConfig()
    """What parts say in close calls."""
    outline: OutlineConfig = OutlineConfig()
    slope: SlopeConfig = SLOPE
    cutouts: CutoutConfig = CutoutConfig()
    """What carries a top, and its outline; when a sloping rim lacks one; what a slab leaves free for what moves."""

    def __post_init__(self) -> None:
        require_ratios(self, "recess_ratio", "gallery_ratio", "thickness_ratio", "coverage", "edge", "apart", "upright")
        require_ratios(self, "seen_depth", "seen_facing", "seen_body", "seen_legs", "metal")
        require_positive(self, "thickness", "corner", "overrun", "most_tops")
        require_not_negative(self, "doubt", "recess", "gallery", "front", "side", "back", "gap", "seat")
