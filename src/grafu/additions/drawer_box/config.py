"""What counts as a drawer's box, and how the boards that are added are sized."""

from dataclasses import dataclass
from typing import final

from grafu.scene.checks import require_positive


@final
@dataclass(frozen=True)
class DrawerBoxConfig:
    """Lengths are metres and hold for furniture of real size; fractions of the front keep them sensible in any other.

    Raises:
        ValueError: if a length or a fraction is not above 0.
    """

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
    highest: float = 0.25
    """Height of a box's walls above which ..."""
    high_ratio: float = 0.8
    """... they end at this fraction of the room's height: high fronts stand above their box."""
    least_width: float = 0.4
    """Fraction of the front's width below which a box behind it would be none."""
    least_depth: float = 0.3
    """Fraction of the front's smaller side below which the space behind it is too shallow for a box."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
