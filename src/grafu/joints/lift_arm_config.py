"""The arms of parallel lifts: where they are tried, how large they are. Lengths: metres on furniture of usual size."""

from math import radians
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True)
class LiftArmConfig:
    """Which arms are tried for a flap that rises upright, two at each end of it.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("behind", "spacing", "width", "thick", "plate", "clear")
    angles: tuple[float, ...] = (radians(70), radians(60), radians(50), radians(80), radians(85), radians(88))
    """How far below the horizontal an arm points at rest: a steep one moves the flap straight out (radians)."""
    steepest: float = radians(70)
    """How far above the horizontal it ends at most, and no further than it began below (radians)."""
    rises: tuple[float, ...] = (0.9, 0.8, 0.7, 0.6, 0.5, 0.43)
    """How far the flap is to rise (fractions of its height)."""
    least: float = 0.4
    """A flap that rises by less than this turns about its upper edge instead (fraction of its height)."""
    enough: float = 0.85
    """Where it rises as far as this no other arms are tried (fraction of its height)."""
    lows: tuple[float, ...] = (0.06, 0.3, 0.53)
    """How far above the flap's lower edge its lower pivots lie (fractions of its height): higher ones over shelves."""
    spare: float = radians(3.0)
    """How far short of that it ends (radians)."""
    behind: float = 0.016
    """How far behind the flap's inner face its pivots lie (metres)."""
    spacing: float = 0.04
    """Distance between the pivots of the two arms of one end (metres)."""
    width: float = 0.01
    """Width of an arm (metres)."""
    thick: float = 0.003
    """Thickness of an arm, and of the plates at its ends (metres)."""
    plate: float = 0.03
    """How far the plate on the case reaches behind its pivots (metres)."""
    clear: float = 0.0005
    """What lies between plates and arms (metres)."""
    poses: int = 25
    """In how many poses arms and flap are swept."""

    def __post_init__(self) -> None:
        require_positive(self, *(name for name in self.__dataclass_fields__ if name not in ("angles", "rises", "lows")))
        require_ratios(self, "least", "enough")
        if not (self.angles and self.rises and self.lows):
            raise ValueError("`LiftArmConfig.angles`, `rises` and `lows` must not be empty")


DEFAULT_LIFT_ARM_CONFIG = LiftArmConfig()
