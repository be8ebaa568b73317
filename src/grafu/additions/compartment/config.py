"""What counts as solid behind a front, and the compartment that is cut into it."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True)
class SolidBodyConfig(ShortRepr):
    """Lengths are metres on furniture of usual size; see `at_scale` for models in another scale.

    Raises:
        ValueError: if a length is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("near", "flat", "start", "least_depth", "least_side", "wall")
    near: float = 0.03
    """How far behind a front the face of a body lies at most that is solid behind it."""
    flat: float = 0.005
    """How far that face is from level at most."""
    faced: float = 0.9
    """Fraction of a front that has this face behind it at least: an open carcass shows its rim alone."""
    middle: float = 0.84
    """Fraction of a front's width and height that is looked at: its edges lap onto what carries it."""
    start: float = 0.002
    """How far within the face the next one is looked for."""
    least_depth: float = 0.1
    """How far behind the face nothing of the body comes at least: else it is a panel, or too shallow for a room."""
    least_side: float = 0.06
    """Width and height of a compartment at least."""
    wall: float = 0.018
    """Thickness of the walls that are left: the common 18 mm board ..."""
    wall_ratio: float = 0.08
    """... and the most of a front's smaller side that it takes."""

    def __post_init__(self) -> None:
        require_positive(self, *self.LENGTHS)
        require_ratios(self, "faced", "middle", "wall_ratio")
