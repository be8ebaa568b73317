"""Where stays hold lids and flaps. Lengths are metres on furniture of usual size, in its scale on others."""

from math import radians
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True)
class StayConfig(ShortRepr):
    """Which lids and flaps get stays, and which places are tried for them.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("narrowest", "shortest", "off_wall", "off_leaf", "plate", "farthest", "even", "room", "end")
    level: float = 0.2
    """An axis counts as level up to this upright component of its direction (cosine)."""
    opening: float = radians(50)
    """Narrowest opening of a joint with stays (radians)."""
    narrowest: float = 0.2
    """Least width of a lid or flap across its hinges (metres)."""
    shortest: float = 0.25
    """Least length of a lid or flap along its hinges (metres)."""
    on_leaf: tuple[float, ...] = (0.3, 0.4, 0.22, 0.5, 0.15)
    """Where the rod is held in turn, from the hinges across the leaf (fractions of its width)."""
    across: tuple[float, ...] = (0.3, 0.45, 0.6, 0.15, 0.75)
    """Where the tube is held in turn, from the hinges across the opening (fractions of the leaf's width)."""
    behind: tuple[float, ...] = (0.35, 0.5, 0.65, 0.25, 0.8)
    """How far behind the leaf it is held in turn (fractions of the leaf's width)."""
    off_wall: float = 0.016
    """From the wall to the middle of the stay (metres)."""
    off_leaf: float = 0.016
    """From the leaf to the rod's pivot (metres)."""
    plate: float = 0.013
    """Half the side of what must be flat below a bracket (metres)."""
    farthest: float = 0.05
    """How far the leaf's inner face may be from the rod's pivot (metres)."""
    even: float = 0.001
    """How far points of wall or leaf below a bracket may be from one plane (metres)."""
    start: float = 0.3
    """How far from the leaf's middle rays to the walls start (fraction of its length)."""
    room: float = 0.02
    """How much shorter than a closed stay its tube and its rod are (metres)."""
    lap: float = 0.12
    """How much of the rod remains in the tube of an open stay at least (fraction of the open length)."""
    lever: float = 0.12
    """Least distance of the stay from the hinges, closed and open (fraction of the leaf's width)."""
    end: float = 0.0115
    """How far from the leaf's end the rod is held at least (metres)."""
    tries: int = 12
    """How many places are tried on either side."""
    poses: int = 15
    """At how many openings a stay is tested for collisions, and its turn is tabled."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "level", "start", "lap", "lever")
