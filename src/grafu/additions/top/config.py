"""When furniture counts as topless, and the slab that it is given. Lengths are metres on furniture of usual size."""

from dataclasses import dataclass
from typing import Literal, final

from grafu.scene.checks import require_not_negative, require_positive, require_ratios

TopShape = Literal["rectangle", "rounded", "chamfered"]


@final
@dataclass(frozen=True)
class TopConfig:
    """What counts as a top, and how an added one looks.

    Raises:
        ValueError: if a fraction is not between 0 and 1, or a length is negative.
    """

    coverage: float = 0.6
    """Fraction of what stands at the rim that must be covered for a top to count as there (official 7.6)."""
    doubt: float = 0.2
    """Distance of the covered fraction from `coverage` within which labels, bars and predictions are asked too."""
    recess: float = 0.05
    """How far below its rim a surface still is the top: fillets and let-in tops are deeper than 1 % of the height."""
    gallery: float = 0.15
    """How far the sides and the back may stand above a top that is open in front: galleries, splashbacks."""
    front: float = 0.02
    """Overhang of an added top beyond the fronts: that of usual worktops."""
    side: float = 0.01
    """Overhang on both sides."""
    back: float = 0.0
    """Overhang behind: furniture stands against walls."""
    thickness: float = 0.025
    """Thickness of an added top; worktops have 20 to 40 mm, official: 20 mm."""
    shape: TopShape = "rectangle"
    """Whether the upper edge and the corners of an added top are sharp, rounded or chamfered."""
    gap: float = 0.001
    """Air between an added top and what moves below or before it."""
    seat: float = 0.0003
    """How deep a top may reach into what carries it or stands in it, as a fraction of the largest side."""

    def __post_init__(self) -> None:
        require_ratios(self, "coverage")
        require_positive(self, "thickness")
        require_not_negative(self, "doubt", "recess", "gallery", "front", "side", "back", "gap", "seat")


DEFAULT_TOP = TopConfig()
