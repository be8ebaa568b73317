"""Where a welded surface is parted so that fronts drawn on it appear, and which objects are one front.

Lengths are fractions of an object's largest side, or of that of the whole.
"""

from math import radians
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive


@final
@dataclass(frozen=True, slots=True)
class CreaseConfig:
    """Where a welded surface is parted so that fronts drawn on it appear.

    Raises:
        ValueError: if a number is not above 0.
    """

    corner: float = radians(20.0)
    """Least angle of an inner corner (radians)."""
    rise: float = 0.02
    """How far the next face rises out of the plane of a face at such a corner (of its reach away from their edge)."""
    facing: float = 0.7
    """Cosine between a face's normal and the direction to the viewer from which on it faces the viewer."""
    near: float = 1e-3
    """How far the edge of a front may reach beyond its outline (of its object's largest side)."""
    thick: float = 0.015
    """How thick a front becomes that is drawn as a sheet (of its object's largest side)."""
    main: float = 0.8
    """What a drawer drawn as one body has of its shell at least, all but its handle (of its outline)."""
    most: int = 4000
    """A surface in more patches than this stays whole: its triangles hang together nowhere."""
    stand_out: float = 0.5
    """How far a handle drawn on a front stands out of it at least (of its own shorter side): mouldings are flatter."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class JoiningConfig:
    """Which objects without a name are one front or handle.

    Raises:
        ValueError: if a number is not above 0.
    """

    touch: float = 0.002
    """As near as this, two objects touch (of the whole's largest side)."""
    least: float = 0.025
    """The shorter side of a front at least (of the whole's largest side): desks have drawers as low as this."""
    boards: int = 3
    """How many of a front's objects a board behind it touches at least, where it touches others too ..."""
    beside: int = 2
    """... and what lies beside or on the front."""
    edging: float = 0.1
    """How far behind a front the edging of what it closes ends at most (of the front's largest side)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
