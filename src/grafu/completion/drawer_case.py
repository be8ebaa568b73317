"""Whether what is around a drawer could hold it: something beside it, or above and below.

Rays are cast on the meshes.
"""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.raycast import RayCaster
from grafu.graph.edges import SignedAxis
from grafu.graph.motion import code_to_direction, signed_axis


@final
@dataclass(frozen=True, slots=True)
class CaseConfig:
    """From where on a side of a drawer is open.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    open: float = 0.3
    """A side is open where fewer of the rays to it meet something (fraction)."""
    plate: float = 0.25
    """Largest thickness of a drawer that is only a front (fraction of its width) ..."""
    behind: float = 0.5
    """... for which a box would reach as far as this behind it (fraction of the object)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


_ALONG = np.linspace(0.15, 0.9, 5)  # where rays start: from the front to the back,
_ACROSS = np.linspace(1 / 6, 5 / 6, 5)  # from side to side,
_UP = np.linspace(0.25, 0.75, 3)  # and from below to above


def is_without_case(
    drawer: Box, slide: SignedAxis, rest: RayCaster, whole: Box, config: CaseConfig = CaseConfig()
) -> bool:
    """Whether a drawer that slides level along `slide` has both its sides open, and what is above it.

    `rest` is all but the drawer. One that is only a front needs something below it, too: a box may hang from what is
    above.
    """
    axis, starts = slide // 2, _starts(drawer, slide, whole, config)
    if axis == 2:
        return False

    def is_open(side: int, positive: bool) -> bool:
        clear = rest.is_clear(starts, code_to_direction(signed_axis(side, positive)))
        return bool(1.0 - clear.mean() < config.open)

    if not (is_open(1 - axis, positive=False) and is_open(1 - axis, positive=True)):
        return False
    return is_open(2, positive=True) or (is_front_only(drawer, axis, config) and is_open(2, positive=False))


def is_front_only(box: Box, axis: int, config: CaseConfig = CaseConfig()) -> bool:
    """Whether a drawer that slides along a level axis is only a front: nothing is behind it that could hold things."""
    return bool(box.size[axis] < config.plate * box.size[1 - axis])


def _starts(box: Box, slide: SignedAxis, whole: Box, config: CaseConfig) -> Points:
    """Returns where rays start: inside a drawer, or in the room that its box would take behind a front."""
    axis, low, size = slide // 2, box.low.copy(), box.size.copy()
    if axis != 2 and is_front_only(box, axis, config):
        size[axis] = config.behind * whole.size[axis]
        low[axis] = box.high[axis] - size[axis] if slide % 2 else box.low[axis]
    along = 1.0 - _ALONG if slide % 2 else _ALONG
    steps = (along, _ACROSS) if axis == 0 else (_ACROSS, along)
    return low + size * np.stack(np.meshgrid(*steps, _UP, indexing="ij"), axis=-1).reshape(-1, 3)
