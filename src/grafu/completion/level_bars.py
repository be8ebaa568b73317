"""Handles that are level bars in the middle of a door: they are pulled down or up, and show no side to hang on."""

from collections.abc import Sequence
from typing import Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.graph.motion import level_axis

_UP: Final = 2


@final
@dataclass(frozen=True, slots=True)
class LevelBarConfig:
    """Which handles are level bars in the middle.

    Raises:
        ValueError: if a number is not above 0.
    """

    level: float = 2.0
    """A handle this many times as wide as it is high is a level bar ..."""
    centred: float = 0.15
    """... in the middle where it is no farther off (fraction of the door's width)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


def are_level_bars(handles: Sequence[Box], door: Box, config: LevelBarConfig = LevelBarConfig()) -> bool:
    """Whether all handles of an upright door are level bars, and together in the middle of its width."""
    level = level_axis(door.thin_axis)
    off = float(np.mean([handle.center[level] for handle in handles]) - door.center[level])
    are_level = all(handle.size[level] >= config.level * handle.size[_UP] for handle in handles)
    return bool(are_level and abs(off) <= config.centred * door.size[level])
