"""Whether a shelf or a divider stands close behind a front, as a part or in one surface with the case; by rays."""

from typing import Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.raycast import RayCaster
from grafu.shapes import Bool

_LEVEL: Final = 0
_DEPTH: Final = 1
_UP: Final = 2
_ACROSS: Final = 81  # rows or columns of rays between both borders of a front ...
_ALONG: Final = 9  # ... and rays in each ...
_ASIDE: Final = 0.2  # ... which begin this far from its other borders (fraction): the case may be narrower


@final
@dataclass(frozen=True, slots=True)
class BoardBehindConfig:
    """What a board behind a front is, seen from there.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    near: float = 0.5
    """How far behind the front its edge is at most (fraction of the depth of the whole)."""
    along: float = 0.7
    """How much of a row of rays meets it, or goes on beyond it (fraction)."""
    thick: float = 0.15
    """Greatest thickness (fraction of the front between the same borders)."""
    inside: float = 0.25
    """How far it is from both borders at least (the same fraction): nearer ones may be the bottom of a drawer."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def is_board_behind(front: Box, whole: Box, rays: RayCaster, config: BoardBehindConfig = BoardBehindConfig()) -> bool:
    """Whether a shelf or a divider stands behind an upright front that faces -Y, with free room on both sides of it.

    `rays` meet all but the front and what is attached to it.
    """
    return any(_has_board(_met(front, whole, rays, across, config), config) for across in (_UP, _LEVEL))


def _met(
    front: Box, whole: Box, rays: RayCaster, across: int, config: BoardBehindConfig
) -> Bool[np.ndarray, "rows along"]:
    """Returns whether something is close behind each place of a front, in rows from one border to the other."""
    along = _LEVEL + _UP - across
    steps, others = (
        (np.arange(_ACROSS) + 0.5) / _ACROSS,
        _ASIDE + (1.0 - 2.0 * _ASIDE) * (np.arange(_ALONG) + 0.5) / _ALONG,
    )
    origins = np.empty((_ACROSS, _ALONG, 3))
    origins[..., across] = (front.low[across] + steps * front.size[across])[:, None]
    origins[..., along] = front.low[along] + others * front.size[along]
    origins[..., _DEPTH] = front.high[_DEPTH] + 1e-4 * float(whole.size[_DEPTH])
    inwards = np.array([0.0, 1.0, 0.0])
    return rays.along(origins.reshape(-1, 3), inwards).reshape(_ACROSS, _ALONG) <= config.near * whole.size[_DEPTH]


def _has_board(met: Bool[np.ndarray, "rows along"], config: BoardBehindConfig) -> bool:
    ratios = met.mean(axis=1)
    closed, free = ratios >= config.along, ratios <= 1.0 - config.along
    starts = np.flatnonzero(closed & ~np.r_[False, closed[:-1]])
    ends = np.flatnonzero(closed & ~np.r_[closed[1:], False])
    margin, most = config.inside * len(met), config.thick * len(met)
    return any(
        bool(start >= margin and end < len(met) - margin and end - start < most and free[start - 1] and free[end + 1])
        for start, end in zip(starts.tolist(), ends.tolist(), strict=True)
    )
