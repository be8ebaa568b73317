"""What counts as a drawer's box, and how the boards that are added are sized."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True)
class BoxProbeConfig:
    """Where the boards of a drawer's box are looked for, and what a new board may touch. Lengths are metres.

    Raises:
        ValueError: if a length or a fraction is not above 0.
    """

    LENGTHS = ("front", "thinnest", "back", "touch")
    middle: float = 0.6
    """Fraction of a front's width and height in which its inner face is looked for."""
    front: float = 0.02
    """Thickness of a front whose inner face is not seen ..."""
    front_ratio: float = 0.1
    """... and the most of the drawer's depth that it takes."""
    thinnest: float = 1e-4
    """Thickness up to which what is seen of a front is the outer face of a solid block."""
    ends: float = 0.1
    """Fraction of the room behind a front at either end in which no wall and no bottom is looked for ..."""
    back: float = 0.02
    """... at the back at least this length, where the back itself stands ..."""
    back_ratio: float = 0.3
    """... and of this at most this fraction of the room."""
    touch: float = 5e-4
    """Depth to which a new board may reach into what is there ..."""
    touch_ratio: float = 0.1
    """... and the most of the board's thickness that this takes."""
    length: float = 0.25
    """Fraction of the room behind a front: boards that are there show how long the box is by what lies behind it ..."""
    corners: int = 3
    """... in so many vertices at least."""
    behind_middle: float = 0.2
    """Fraction of a shallow part's smaller side: what lies so near to its middle ends the space behind it."""
    rear_middle: float = 0.25
    """Fraction of a front's sides: what lies so near to its middle and behind it closes the furniture's rear."""
    carrier: float = 0.3
    """Fraction of a front's smaller side that what may carry it reaches behind it at least."""
    apart: float = 0.1
    """Fraction of the gap across which loose boards hang together: nearer ones touch the case."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True)
class DrawerBoxConfig(ShortRepr):
    """Lengths are metres on furniture of usual size, on small fronts less; see `at_scale` for models in another scale.

    Raises:
        ValueError: if a length or a fraction is not above 0.
    """

    LENGTHS = (
        *("side_gap", "under", "over", "behind", "wall", "bottom", "highest", "inset", "to_front"),
        *("rim", "drawn_in", "touch", "sticks_out"),
    )
    covered: float = 0.5
    """Fraction of a side that must be there for the side to count as there: below, half is open."""
    deeper: float = 3.0
    """A shallow part before a space so many times as deep is a front with its pull, not a container."""
    side_gap: float = 0.0125
    """Room beside the box for a rail: what ball-bearing slides need, 12.7 mm with 0.2 mm to be pressed in."""
    side_ratio: float = 0.06
    """Most of the front's width that such a gap takes: narrow drawers get thinner rails."""
    under: float = 0.01
    """Room below the box, as real slides have."""
    over: float = 0.02
    """Room above the box's walls, as real slides have: the box must be hung in."""
    height_ratio: float = 0.1
    """Most of the room's height that either of the two takes."""
    behind: float = 0.01
    """Room behind the box: a back that lies a little crooked must not hold the drawer open."""
    behind_ratio: float = 0.05
    """Most of the room's depth that this takes."""
    wall: float = 0.012
    """Thickness of sides and back: the common 12 mm board."""
    bottom: float = 0.006
    """Thickness of the bottom: the common 6 mm plywood."""
    wall_ratio: float = 0.05
    """Most of the front's smaller side that a wall takes (a bottom half of it)."""
    narrowest: float = 2.5
    """Least width, depth and height of a box, in thicknesses of its walls (ratio)."""
    highest_bottom: float = 0.7
    """A bottom above this fraction of the box's height leaves no room for walls."""
    highest: float = 0.25
    """Height of a box's walls above which ..."""
    high_ratio: float = 0.8
    """... they end at this fraction of the room's height: high fronts stand above their box."""
    least_width: float = 0.4
    """Fraction of the front's width below which a box behind it would be none."""
    least_depth: float = 0.3
    """Fraction of the front's smaller side below which the space behind it is too shallow for a box."""
    inner_ratio: float = 0.8
    """Fraction of the width in which the bottom and the back are looked for: walls and overhangs lie outside."""
    outer_ratio: float = 0.35
    """Fraction of the half width from which on a board is the one on that side."""
    rim: float = 0.006
    """What stands higher than this above a bottom is a wall (metres) ..."""
    rim_ratio: float = 0.04
    """... or higher than this fraction of the drawer's height, whichever is more ..."""
    most_rim: float = 0.3
    """... up to this fraction of it."""
    wall_height: float = 0.35
    """Fraction of the height that makes a wall where there is no bottom: a slider's bar is lower."""
    block: float = 0.9
    """Fraction of the height from which on an upper side is that of a solid block, which has walls below it."""
    tray: float = 0.12
    """Fraction of its smaller level side below which a part is as low as a board or a tray."""
    crooked: float = 0.02
    """Fraction of the depth by which a back may lie crooked before its columns differ in depth."""
    drawn_in: float = 5e-4
    """How far the front's outline is drawn in: what merely touches it is not in the way (metres) ..."""
    drawn_in_ratio: float = 0.01
    """... and the most of the front's height that this takes."""
    open_depth: float = 0.85
    """Fraction of the depth that a box takes where nothing but the furniture's rear edge ends it."""
    inset: float = 2e-4
    """How deep a board is inset into what it is fixed to, so that the two hold together (metres)."""
    to_front: float = 0.05
    """Most that a board is lengthened to meet a front that is hollow (metres)."""
    touch: float = 0.004
    """Gap across which loose boards hang together (metres) ..."""
    touch_ratio: float = 0.02
    """... and the most of the front's width that it takes."""
    sticks_out: float = 1e-3
    """How far boards that are drawn with the case may stick out of the drawer's outline (metres)."""
    opposite: float = 0.9
    """Negative cosine between the directions of two drawers from which on they face away from each other (ratio)."""
    probe: BoxProbeConfig = BoxProbeConfig()
    """Where boards are looked for, and what a new one may touch."""

    def __post_init__(self) -> None:
        require_positive(self, *(name for name in self.__dataclass_fields__ if name != "probe"))
