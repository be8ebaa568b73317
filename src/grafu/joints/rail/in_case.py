"""Whether a drawer stands in its case, by rays from within it: what fills a place in furniture is no case itself."""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.raycast import RayCaster
from grafu.joints.rail.body_region import DrawerFrame


@final
@dataclass(frozen=True, slots=True)
class InCaseConfig:
    """When what slides stands in a case.

    Raises:
        ValueError: if a fraction is not between 0 and 1, or `rays` not above 0.
    """

    margin: float = 0.3
    """What is left out at each edge of a side (fraction of half the side): a front may stand out of its case ..."""
    rays: int = 7
    """... and how many rays go through it in each of two directions."""
    near: float = 0.2
    """A wall is no farther from a side than this, and reaches no deeper into it, as a front is wider than what is
    behind it (fraction of half the drawer's size in that direction): what is deeper inside is a divider ..."""
    met: float = 0.7
    """... where as many of the rays meet it (fraction)."""

    sheet: float = 0.05
    """What is lower than this is a sheet, which fills no case (fraction of the smaller of its width and depth)."""

    def __post_init__(self) -> None:
        require_positive(self, "rays")
        require_ratios(self, "margin", "near", "met", "sheet")


def is_in_case(frame: DrawerFrame, walls: RayCaster, config: InCaseConfig = InCaseConfig()) -> bool:
    """Whether walls stand close to both flanks of a drawer, and close behind, below or above it.

    Rays start in the middle of the drawer, as that may be drawn into its walls.

    Args:
        frame: that of the drawer without its handle.
        walls: what stays, prepared for rays.
        config: how close, and on how much of a side.
    """
    if frame.height < config.sheet * min(frame.width, frame.depth):
        return False
    half = np.array([frame.width, frame.depth, frame.height]) / 2
    middle = np.array([0.0, frame.depth / 2, 0.0])
    steps = np.linspace(-1.0, 1.0, config.rays) * (1.0 - config.margin)

    def is_met(side: int, sign: float) -> bool:
        starts = np.zeros((len(steps) ** 2, 3))
        starts[:, np.arange(3) != side] = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
        found = walls.along(frame.to_object(middle + starts * half), sign * frame.rotation[:, side])
        return bool(np.mean(np.abs(found / half[side] - 1.0) <= config.near) >= config.met)

    if not (is_met(0, -1.0) and is_met(0, 1.0)):
        return False
    return is_met(1, 1.0) or is_met(2, -1.0) or is_met(2, 1.0)
