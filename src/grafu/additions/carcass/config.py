"""What counts as a carcass that lacks its back or bottom, and how the boards that close it are sized."""

from math import cos, radians
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True)
class CarcassConfig(ShortRepr):
    """Lengths are metres on furniture of usual size; see `at_scale` for models in another scale.

    Raises:
        ValueError: if a length or a fraction is not above 0.
    """

    LENGTHS = (
        *(
            "back",
            "bottom",
            "gap",
            "on_edge",
            "front_thickness",
            "inset",
            "held",
            "touch",
            "least_height",
            "least_depth",
        ),
        *("alike", "apart", "side_by_side", "coarse", "bottom_above_most"),
    )
    weighed: float = 0.05
    """Probability that one is missing from which on a back or bottom is built where rays find none."""
    covered: float = 0.5
    """Fraction of a back or bottom that must be there for it to count as there."""
    walled: float = 0.6
    """Fraction of the depth at which walls must stand on both sides: else it is a table, a rack, or a front alone."""
    filled: float = 0.35
    """Fraction of the height under them that drawers must fill where there is no door: fewer hang in a table ..."""
    least_height: float = 0.12
    """... which counts as this high at least."""
    behind_frame: float = 0.3
    """Fraction of a bay's depth behind which its back is looked for: past whatever frames the opening."""
    least_depth: float = 0.1
    """Depth below which a body is too shallow to be one."""
    back: float = 0.006
    """Thickness of a back: the common 6 mm board."""
    bottom: float = 0.016
    """Thickness of a bottom: the common 16 mm board."""
    thickness_ratio: float = 0.03
    """Most of a bay's smaller side that either takes."""
    gap: float = 0.002
    """Room between a bottom and a door or drawer above it ..."""
    gap_ratio: float = 0.2
    """... and the most of the bottom's thickness that this takes."""
    thinner: float = 0.4
    """Where drawers run low, a bottom of this fraction of its thickness is tried, too."""
    on_edge: float = 0.008
    """How far a back that is planted on the rear edges laps onto them."""
    rear_edges: float = 0.02
    """Fraction of a bay's width: edges that end so far before its rear count as rear edges."""
    upright: float = 0.3
    """Most of a front's outward unit direction that may point up or down for the front to stand upright (ratio)."""
    same_way: float = 0.97
    """Cosine between the directions of two fronts from which on they are seen from one side."""
    front_thickness: float = 0.02
    """Thickness of fronts, where a drawer is drawn with its box (metres)."""
    alike: float = 0.05
    """How far apart the same walls of two bays of one space may lie."""
    apart: float = 0.1
    """Largest gap between drawers above each other: a rail between them."""
    wall_reach: float = 0.1
    """Fraction of a bay's side before its end from which a wall is looked for, and beyond it."""
    inset: float = 2e-4
    """How deep a board is inset into the walls that hold it (metres)."""
    held: float = 2e-3
    """Distance within which a board is held (metres)."""
    side_by_side: float = 0.08
    """Bays nearer than this get one common back."""
    wasted: float = 0.15
    """Fraction of a common back that may cover what lacks none."""
    closed_ratio: float = 0.7
    """Fraction of a bay's sides that a board must close."""
    frame_depth: float = 0.2
    """Fraction of the depth in which a face frame or a front may stand before a bottom."""
    touch: float = 5e-4
    """Depth below which a board and its neighbour merely touch (metres) ..."""
    core: float = 0.1
    """... where this fraction of the board's thickness is left, which must be free."""
    square: float = cos(radians(8.0))
    """Cosine between a front's direction and an axis of the object from which on the front looks along the axis."""
    many_faces: int = 4000
    """Faces from which on a part is coarsened ..."""
    coarse: float = 0.01
    """... to cells of this side."""
    bottom_above: float = 0.2
    """A bottom is looked for from this fraction of the lowest front's height on ..."""
    bottom_above_most: float = 0.2
    """... and from at most this height."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
