"""When walls that end in a tilted plane lack a top. Lengths are metres on furniture of usual size."""

from math import radians
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True)
class SlopeConfig:
    """When walls that end in a tilted plane lack a sloping top.

    Raises:
        ValueError: if a number is not above 0, or a fraction is not between 0 and 1.
    """

    least_angle: float = radians(5)
    """Slope from which on a rim is no level one, radians ..."""
    most_angle: float = radians(50)
    """... and up to which it is closed by a top; what is steeper is a front."""
    alike: float = radians(1)
    """Angle between the normals of edges in one plane, radians."""
    touch: float = 0.006
    """Depth below the plane at which a wall still ends in it, metres."""
    above: float = 0.01
    """Height above the plane that what stands there may have, metres."""
    least: float = 0.25
    """Fraction of the piece's plan that the rim takes at least."""
    closed: float = 0.85
    """Fraction of the rim along which walls, doors or drawers end in the plane."""
    depths: tuple[float, ...] = (0.002, 0.012, 0.025)
    """Depths below the plane at which they are looked for, metres."""
    line: float = 5e-4
    """Half the width that the lines of a section are given, metres."""
    beside: float = 0.03
    """Distance from the rim's edge within which they stand, metres."""
    deep: float = 0.06
    """Depth below the plane from which on it is open, metres."""
    opened: float = 0.7
    """Fraction of the rim that is open at least, ..."""
    lower: float = 0.25
    """... and so of this lowest fraction of it: cheeks that run out on a board carry no top."""
    rays: int = 24
    """Rays along each side."""
    tried: int = 40
    """Faces whose planes are tried, the largest first."""

    def __post_init__(self) -> None:
        require_positive(self, *(name for name in self.__dataclass_fields__ if name != "depths"))
        require_ratios(self, "least", "closed", "opened", "lower")


SLOPE = SlopeConfig()
"""The usual numbers."""
