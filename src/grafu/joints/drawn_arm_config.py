"""Which parts of the input are arms or stays of a flap. Lengths are metres on furniture of usual size."""

from math import radians
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True)
class DrawnArmConfig:
    """Which parts behind a lid or flap lift it or hold it open.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("near", "within")
    slim: float = 5.0
    """A bar is at least so many times as long as it is wide."""
    least: float = 0.2
    """Least length of a bar, over the leaf's size from its hinge border to its free edge (fraction)."""
    square: float = 0.966
    """A bar nearer to the leaf's normal than this cosine is a rail, no arm; one nearer to the hinge's line a rod."""
    near: float = 0.05
    """How far off the leaf's inner face the nearer end of a bar is at most (metres)."""
    within: float = 0.01
    """How far such a part may reach out of the leaf's outline (metres)."""
    ends: float = 0.15
    """A bar lies so near to one end of the leaf, along the hinge's line (fraction of its length)."""
    alike: float = 0.05
    """Bars at both ends differ in length and place by no more (fraction of the leaf's size)."""
    level: float = 0.1
    """Greatest rise of the direction of a level axis."""
    opposite: float = 0.98
    """The flap's axis on the arms points against theirs by at least this cosine."""
    step: float = 0.05
    """By how much the flap may turn back more or less than the arms turn, and still be upright (fraction)."""
    spare: float = radians(3.0)
    """How far short of the angle at which they began below the horizontal arms end above it (radians)."""
    steepest: float = radians(70)
    """How far above the horizontal arms end at most, where nothing is stated (radians)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "least", "square", "ends", "alike", "level", "opposite", "step")


DEFAULT_DRAWN_ARM_CONFIG = DrawnArmConfig()
