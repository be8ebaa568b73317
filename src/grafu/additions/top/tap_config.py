"""The thresholds by which wash basins with taps and vessels are known, each with its unit. It decides nothing."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True, slots=True)
class TapConfig:
    """When what is open above is a basin that a tap stands over, or a vessel such as a tub.

    Raises:
        ValueError: if a number is not above 0, or a fraction above 1.
    """

    bottom: float = 0.6
    """Fraction of what one looks into that is the bottom of the part whose rim it is at least."""
    shallowest: float = 0.03
    """Least depth of a basin that a tap stands over, metres on furniture of usual size."""
    rises: float = 0.03
    """Distance that a tap rises above the rim at least, metres on furniture of usual size."""
    size: float = 0.5
    """How long a tap is at most (fraction of the basin's shorter side)."""
    round: float = 0.82
    """A vessel takes less of the rectangle around its plan (fraction): an ellipse takes 0.79, a case all of it ..."""
    convex: float = 0.95
    """... and this much of its hull at least (fraction): an L takes less."""

    def __post_init__(self) -> None:
        require_positive(self, "shallowest", "rises")
        require_ratios(self, "bottom", "size", "round", "convex")
