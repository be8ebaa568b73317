"""What counts as a support of a table's drop leaf, as one configuration."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True)
class DropSupportConfig:
    """What counts as a support of a drop leaf; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("gap", "near", "touching", "reach")
    gap: float = 0.005
    """How far it reaches into the top, the leaf or what it swings past, by careless modelling, at most (metres)."""
    near: float = 0.03
    """How far below the top, and a loper behind the leaf, it ends at most, where no name shows it (metres)."""
    beside: float = 0.4
    """How far behind the hanging leaf it stands at most: an overhang lies between (fraction of the leaf's height)."""
    touching: float = 0.002
    """Pieces that are called supports, and are this near to one another, are one support (metres)."""
    slim: float = 0.35
    """Greatest thickness of what swings, and width of what slides (fraction of its length)."""
    long: tuple[float, float] = (0.3, 1.05)
    """Least and greatest length of what swings (fraction of the leaf's height): the raised leaf covers it."""
    low: float = 0.6
    """Greatest height of a plank that no name shows (fraction of its length); doors in the frame are higher."""
    open: float = 0.6
    """What of its outline a frame that no name shows covers at most, seen from the leaf (fraction)."""
    behind: float = 0.5
    """Along so much of a plank that no name shows something static stands right behind it (fraction)."""
    reach: float = 0.01
    """What stands this near behind it is right behind it (metres)."""
    end: float = 0.25
    """The ends of what swings are compared over this part of its length: a gate's leg, a bracket's root (fraction)."""
    differ: float = 0.15
    """From this difference on one end reaches lower than the other (fraction of the height)."""
    aligned: float = 0.95
    """From this cosine on an axis that is stated is upright, or points to the leaf."""
    travel: float = 0.6
    """How far a loper slides out, where that is not stated (fraction of its length)."""
    covered: float = 0.9
    """... and at most so far below the raised leaf, which hides it (fraction of the leaf's height)."""

    def __post_init__(self) -> None:
        require_positive(self, "gap", "near", "touching", "reach")
        require_ratios(self, "beside", "slim", "low", "open", "behind", "end", "differ", "travel", "aligned", "covered")
        if not 0 < self.long[0] < self.long[1]:
            raise ValueError(f"`DropSupportConfig.long` must be two rising fractions: got {self.long}")
