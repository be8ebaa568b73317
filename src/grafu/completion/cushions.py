"""Cushions and backs of seats look like lids and doors, but are thicker than most, and close nothing.

A cushion lies on what is closed, and a back has nothing behind it and nothing before it. Rays are cast on the meshes.
"""

from typing import Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.raycast import RayCaster

_UP: Final = 2
_STEPS: Final = np.linspace(0.06, 0.94, 8)  # where rays leave a face, from side to side ...
_WITHIN: Final = 0.1  # ... and begin so far within the part (fraction of its thickness): what lies on the face counts


@final
@dataclass(frozen=True, slots=True)
class CushionConfig:
    """What is a cushion or the back of a seat.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    thick: float = 0.17
    """From this thickness on a part may be one (fraction of its shorter other side): of 69 real doors whose names were
    hidden few are thicker."""
    near: float = 0.02
    """What is this far below a part at most carries it (fraction of its largest side)."""
    closed: float = 0.8
    """What carries a cushion is closed on this much of it (fraction of rays): a lid has a hollow below it ..."""
    open: float = 0.95
    """... and this much of a back sees nothing behind it, nor before it (fraction of rays): a door has a case."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def is_cushion_sized(box: Box, config: CushionConfig = CushionConfig()) -> bool:
    """Whether a part is as thick as a cushion or the back of a seat, along the axes."""
    sides = np.sort(box.size)
    return bool(sides[0] >= config.thick * sides[1])


def closes_nothing(box: Box, rest: RayCaster, config: CushionConfig = CushionConfig()) -> str:
    """Returns in words why what is so thick is no lid and no door; empty where it may be one.

    `rest` meets all but the part and what is attached to it.
    """
    axis = box.thin_axis
    below = _distances(box, rest, axis, positive=False)
    if axis == _UP:
        is_carried = float((below <= config.near * float(box.size.max())).mean()) >= config.closed
        return "it is a cushion: what it lies on is closed" if is_carried else ""
    both = (below, _distances(box, rest, axis, positive=True))
    is_free = all(float(np.isinf(one).mean()) >= config.open for one in both)
    return "nothing is behind it, as behind the back of a seat" if is_free else ""


def _distances(box: Box, rest: RayCaster, axis: int, positive: bool) -> np.ndarray:
    """Returns how far it is from a face of a box to what rays straight away from it meet, metres."""
    across = np.delete(np.arange(3), axis)
    places = np.meshgrid(*(box.low[k] + _STEPS * box.size[k] for k in across), indexing="ij")
    inside = _WITHIN * float(box.size[axis])
    starts, towards = np.empty((len(_STEPS) ** 2, 3)), np.zeros(3)
    starts[:, across] = np.stack(places, axis=-1).reshape(-1, 2)
    starts[:, axis] = box.high[axis] - inside if positive else box.low[axis] + inside
    towards[axis] = 1.0 if positive else -1.0
    return rest.along(starts, towards) - inside
