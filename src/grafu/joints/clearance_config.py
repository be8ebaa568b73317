"""How much play is given where material is taken away."""

from dataclasses import dataclass
from typing import final

from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True)
class ClearanceConfig:
    """How much play is given where material is taken away.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("beside", "lapped")
    play: float = 2.5
    """Distance to what a path is freed from (in tolerated penetrations)."""
    touching: float = 0.9
    """What is nearer than this touches, where what touches is pressed back as well (fraction of `play`)."""
    enclosed: float = 2.0
    """How far what lies enclosed in a moving part may stand out of it (in tolerated penetrations)."""
    beside: float = 0.001
    """Static parts whose boxes are nearer to a drawer's than this are walls that it may touch (metres)."""
    lapped: float = 0.02
    """How far the edges of a leaf reach into the frame around it at most, where they are cut off (metres)."""
    through: float = 0.5
    """Along how much of a leaf's thickness its frame reaches at least (fraction): less where it lies on its frame."""

    def __post_init__(self) -> None:
        require_positive(self, "play", "enclosed", "beside", "lapped")
        require_ratios(self, "touching", "through")
