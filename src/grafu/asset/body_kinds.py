"""What a moving body is where no name tells: a sliding door or a drawer, a lever, a rotor or a door."""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios


@final
@dataclass(frozen=True, slots=True)
class BodyKindConfig:
    """What a moving body counts as where no name tells.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    flat: float = 0.35
    """Largest thickness of an upright plate that slides along itself (fraction of its next larger side)."""
    lever: float = 0.25
    """Largest side of a handle that turns by itself (fraction of the largest side of what it turns on)."""

    middle: float = 0.1
    """How far from its middle the axis of what turns without end passes at most (fraction of its largest side)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def is_lever(size: Vec3, whole: Vec3, config: BodyKindConfig = BodyKindConfig()) -> bool:
    """Whether what turns on a moving body is small against that: the lever or knob of a building's door.

    Args:
        size: its extents.
        whole: those of what it turns on.
        config: what is small.
    """
    return float(size.max()) <= config.lever * float(whole.max())


def is_rotor(box: Box, axis: Axis, config: BodyKindConfig = BodyKindConfig()) -> bool:
    """Whether an axis passes through the middle of what turns about it without end: a turntable, a fan, no door.

    Args:
        box: the box around it.
        axis: that about which it turns.
        config: how near to the middle.
    """
    off = np.cross(box.center - axis.point, axis.direction)
    return float(np.linalg.norm(off)) <= config.middle * float(box.size.max())


def slides_in_its_plane(size: Vec3, direction: Vec3, up: int, config: BodyKindConfig = BodyKindConfig()) -> bool:
    """Whether the motion shifts an upright plate along itself: a sliding door, not a drawer or a tray.

    Args:
        size: its extents.
        direction: that in which it slides.
        up: the index of the vertical axis.
        config: what is a plate.
    """
    along, thin = int(np.argmax(np.abs(direction))), int(np.argmin(size))
    return along != up and thin not in (up, along) and bool(size[thin] < config.flat * np.delete(size, thin).min())
