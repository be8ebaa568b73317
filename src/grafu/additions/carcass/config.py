"""What counts as a carcass that lacks its back or bottom, and how the boards that close it are sized."""

from dataclasses import dataclass
from typing import final

from grafu.scene.checks import require_positive


@final
@dataclass(frozen=True)
class CarcassConfig:
    """Lengths are metres and hold for furniture of real size; fractions keep them sensible in any other.

    Raises:
        ValueError: if a length or a fraction is not above 0.
    """

    covered: float = 0.5
    """Fraction of a back or bottom that must be there for it to count as there."""
    walled: float = 0.6
    """Fraction of the depth at which walls must stand on both sides: else it is a table, a rack, or a front alone."""
    filled: float = 0.35
    """Fraction of the height under them that drawers must fill where there is no door: fewer hang in a table."""
    least_depth: float = 0.08
    """Fraction of the object's largest side below which a body is too shallow to be one."""
    back: float = 0.006
    """Thickness of a back: the common 6 mm board."""
    bottom: float = 0.016
    """Thickness of a bottom: the common 16 mm board."""
    thickness_ratio: float = 0.03
    """Most of a bay's smaller side that either takes."""
    gap: float = 0.002
    """Room between a bottom and a door or drawer above it."""
    on_edge: float = 0.008
    """How far a back that is planted on the rear edges laps onto them."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
