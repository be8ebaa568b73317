"""Which shells are drawn hinges. Lengths are metres on furniture of usual size, in its scale on others (`at_scale`)."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True)
class DrawnConfig:
    """Which shells near a door's border are the barrels of drawn hinges; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("reach", "line", "bearing", "radii", "board", "flush")
    reach: float = 0.06
    """How far from the border a barrel lies at most (metres)."""
    line: float = 0.0015
    """Barrels nearer to one line than this turn about one pin (metres)."""
    spread: float = 0.3
    """Fraction of the border's length over which the barrels that carry a door are spread at least."""
    rod: float = 0.85
    """Least length of a rod along a whole border; no rod is longer than the border over this (fraction of it)."""
    bearing: float = 0.02
    """How far from the end of such a rod what holds it may be (metres)."""
    radii: tuple[float, float] = (0.0015, 0.02)
    """Smallest and largest radius of a barrel (metres)."""
    board: float = 0.05
    """A board is at most so thick: a barrel that lies in static boards all along is a dowel, no hinge (metres)."""
    flush: float = 0.0005
    """How far such a dowel may stand out of its boards (metres)."""
    round: float = 0.9
    """Fraction of a barrel's vertices on its rim or in a cap's middle, and of its radius at which the rim begins."""
    corners: int = 12
    """Vertices that a rim has at least."""
    thinned: tuple[float, ...] = (1.0, 0.8, 0.6, 0.5)
    """What is left of the radius of a pin that turns with its door, where it cuts into what carries it, in turn."""
    blocked: float = 0.5
    """Fraction of poses in which parts other than its drawn hinges may block a door for which something is cut."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "spread", "rod", "round", "blocked")
