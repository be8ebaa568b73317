"""What counts as the lever of a door."""

from math import radians
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True)
class LeverConfig:
    """What counts as the lever of a door; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("long", "off", "coaxial", "bolt", "out")
    long: tuple[float, float] = (0.06, 0.26)
    """Least and greatest length of a lever (metres)."""
    high: float = 0.6
    """Greatest height of a lever (fraction of its length)."""
    off: float = 0.02
    """How far a lever stands off the door at least (metres)."""
    near: float = 0.3
    """What of that, from the door on, is its stem (fraction)."""
    stem: float = 0.55
    """Greatest width of the stem (fraction of the length): what is held along more of it does not turn."""
    aside: float = 0.2
    """How far the stem lies from the middle of the lever at least (fraction of the length)."""
    free: float = 0.2
    """How far the stem lies from the middle of the door at least, towards its free edge (fraction of the width)."""
    coaxial: float = 0.01
    """How far the stems of two levers lie apart at most that turn together, one on each face (metres)."""
    upright: float = 0.9
    """Least vertical part of the direction of a door's axis."""
    turn: float = radians(45)
    """How far a lever turns (radians)."""
    bolt: tuple[float, float] = (0.005, 0.08)
    """Least and greatest side of a bolt (metres)."""
    beside: float = 0.15
    """How far above or below the stem a bolt lies at most (fraction of the door's height)."""
    out: float = 0.001
    """How far a bolt stands out of the door's free edge at least (metres); so far it moves in, too."""

    def __post_init__(self) -> None:
        require_positive(self, "long", "off", "coaxial", "turn", "bolt", "out")
        require_ratios(self, "high", "near", "stem", "aside", "free", "beside", "upright")
