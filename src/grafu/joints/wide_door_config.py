"""How far doors open that what slides out behind them would hit at the usual opening."""

import itertools
from math import pi, radians
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True)
class WideDoorConfig(ShortRepr):
    """Which openings are tried, and what must be gained.

    Raises:
        ValueError: if the openings do not rise within (0, pi), or a fraction is not between 0 and 1.
    """

    openings: tuple[float, ...] = (radians(120), radians(135), radians(150), radians(165))
    """The openings that are tried, the least first (radians): doors of refrigerators stop at 115 to 170 degrees, and no
    wider than what is behind them needs, since walls and worktops stand beside them."""
    step: float = radians(3)
    """From one pose to the next in which such a door is tried (radians): a few centimetres at its far edge."""
    gain: float = 0.05
    """How much more of what was asked for everything must open, together, for a wider door (fraction of one joint)."""
    time: float = 0.3
    """What trying them may take (fraction of the time that is left)."""

    def __post_init__(self) -> None:
        require_positive(self, "step")
        require_ratios(self, "gain", "time")
        rising = (0.0, *self.openings, pi)
        if any(one >= other for one, other in itertools.pairwise(rising)):
            raise ValueError(f"`WideDoorConfig.openings` must rise within (0, pi): got {self.openings}")
