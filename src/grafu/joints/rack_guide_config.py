"""Sizes of the guides that are added for a rack that nothing holds; lengths are metres on furniture of usual size."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True)
class RackGuideConfig:
    """Where a guide runs beside a rack, and its size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("clear", "beside", "low", "high")
    clear: float = 8e-4
    """How far a guide stands off the rack (metres)."""
    beside: float = 2e-3
    """What of a rack lies within this of its outermost point at a side runs in the guide there (metres)."""
    low: float = 6e-3
    """Least height of a guide (metres)."""
    high: float = 0.02
    """Greatest height of a guide (metres)."""
    kept: float = 0.1
    """How much of its length a rack that is open keeps in its guides at least (fraction)."""
    travel: float = 0.8
    """Guides that let a rack slide less than this fraction of what is free are none."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "kept", "travel")
