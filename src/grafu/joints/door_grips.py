"""At which edge the leaf of a building's door hangs: away from what it is grasped by.

A pull may be as long as its leaf is high: a slim upright bar that stands out of it.
"""

from collections.abc import Sequence
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_ratios
from grafu.joints.motion_choice import Side
from grafu.joints.plan import JointRequest
from grafu.vocabulary import PartLabel

_WIDTH, _DEPTH, _UP = 0, 1, 2
_GRIPS = (PartLabel.HANDLE, PartLabel.UNKNOWN)


@final
@dataclass(frozen=True, slots=True)
class DoorGripConfig:
    """What a leaf is grasped by, and where.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    small: float = 0.3
    """Greatest side of a handle or lock (fraction of its leaf's height); the bar of a pull is longer, ..."""
    slim: float = 0.12
    """... no wider than this (fraction of its leaf's width) ..."""
    out: float = 0.01
    """... and stands out of it by this much at least (fraction of its leaf's height)."""
    aside: float = 0.2
    """A handle or lock is this far to one side of its leaf's middle at least (fraction of the leaf's width)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def hinged_side(
    leaf: Part,
    leaves: Sequence[Part],
    on_it: Sequence[Part],
    predicted: JointRequest | None = None,
    config: DoorGripConfig = DoorGripConfig(),
) -> Side:
    """Returns the edge away from handles and locks; without these the outer edge of several leaves.

    A single one hangs at the edge that was predicted, else at the left.
    """
    aside = grasped_side(leaf, on_it, config)
    if not aside:
        middle = float(np.mean([one.box.center[_WIDTH] for one in leaves]))
        aside = middle - float(leaf.box.center[_WIDTH])
    if not aside and predicted is not None and abs(predicted.axis.direction[_UP]) > 0.5:
        aside = float(leaf.box.center[_WIDTH] - predicted.axis.point[_WIDTH])
    return Side.RIGHT if aside < 0 else Side.LEFT


def grasped_side(leaf: Part, on_it: Sequence[Part], config: DoorGripConfig = DoorGripConfig()) -> float:
    """Returns on which side of a leaf's middle its handles and locks are: below 0 at its left; 0 where none tells."""
    box = leaf.box
    offsets = (float(p.box.center[_WIDTH] - box.center[_WIDTH]) for p in on_it if _is_grip(p, leaf, config))
    return float(sum(np.sign(offset) for offset in offsets if abs(offset) >= config.aside * box.size[_WIDTH]))


def _is_grip(part: Part, leaf: Part, config: DoorGripConfig) -> bool:
    """Whether a part is of the size of a handle or lock, or a pull: a long bar that stands out of the leaf."""
    box, own = leaf.box, part.box
    if own.size.max() <= config.small * box.size[_UP]:
        return True
    is_slim = own.size[_WIDTH] <= config.slim * box.size[_WIDTH]
    stands_out = max(box.low[_DEPTH] - own.low[_DEPTH], own.high[_DEPTH] - box.high[_DEPTH])
    return bool(part.label in _GRIPS and is_slim and stands_out >= config.out * box.size[_UP])
