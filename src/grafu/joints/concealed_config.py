"""Where concealed hinges stand. Lengths are metres on furniture of usual size, in its scale on others (`at_scale`)."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True)
class ConcealedConfig(ShortRepr):
    """What doors take concealed hinges, and about which axes the one joint of simulators may turn.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("axis", "thinnest", "narrowest", "shortest", "start", "reach", "depths", "heights", "even")
    axis: tuple[float, float] = (0.006, 0.0032)
    """The axis that fits the linkage best: how far from a door's edge, and behind its front, it lies (metres)."""
    nearer: tuple[float, ...] = (1.0, 0.67, 0.33, 0.001)
    """At which fractions of these it is tried in turn: at the front edge itself a door cuts into nothing."""
    thinnest: float = 0.012
    """Thinnest door that takes a cup (metres)."""
    narrowest: float = 0.1
    """Narrowest such door (metres)."""
    shortest: float = 0.15
    """Shortest edge for two such hinges (metres)."""
    sunk: float = 0.85
    """How deep a cup is sunk at most (fraction of the door's thickness)."""
    start: float = 0.035
    """How far from the door's edge rays to the case's side start (metres)."""
    reach: float = 0.045
    """How far from there the side's inner face may be (metres)."""
    depths: tuple[float, ...] = (0.022, 0.038, 0.054)
    """Depths behind the door at which the side must be met (metres)."""
    heights: tuple[float, ...] = (-0.022, 0.0, 0.022)
    """Heights from the hinge's middle at which it must be met (metres)."""
    even: float = 0.001
    """How far these points of the side may be from one plane (metres)."""
    poses: int = 22
    """At how many openings the true path of the door is tested."""

    def __post_init__(self) -> None:
        require_positive(self, *(set(self.__dataclass_fields__) - {"heights"}))
        require_ratios(self, "sunk")
