"""Panes of glass that lap in two planes of one opening are sliding doors, as those of display cases.

Words for glass state what a part is made of, and not that it moves. Panes one right behind the other are double
glazing, and those in one plane are fixed, or hinged as their names tell.
"""

from itertools import permutations
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.joints.framed_leaves import relabelled
from grafu.vocabulary import PartLabel

_WIDTH, _DEPTH, _UP = 0, 1, 2
_PANES = (PartLabel.MISC, PartLabel.UNKNOWN)


@final
@dataclass(frozen=True)
class SlidingPaneConfig:
    """When two panes slide past one another.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    thin: float = 0.05
    """Greatest thickness of a pane (fraction of its shorter other side)."""
    level: float = 0.03
    """How much the two differ in height, and in where they begin and end, at most (fraction of their height)."""
    alike: float = 0.7
    """Least width of the narrower one (fraction of the other's)."""
    lap: float = 0.005
    """How far they lap at least (fraction of the width of the narrower one): panes that meet stand in one plane ..."""
    most: float = 0.4
    """... and at most (the same): others are one pane before another."""
    near: float = 0.15
    """How far one is before the other at most (fraction of the depth of the whole)."""
    front: float = 0.3
    """How far behind the front of the whole the first is at most (fraction of that depth)."""
    covers: float = 0.4
    """Least area of both (fraction of the front of the whole) ..."""
    wide: float = 0.8
    """... and least width of both (fraction of that of the whole)."""
    behind: float = 0.5
    """What is behind them is at least so deep (fraction of the depth of the whole): a window has nothing there."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_pane_labels(asset: Asset, config: SlidingPaneConfig = SlidingPaneConfig()) -> Asset:
    """Returns the asset in which two panes that lap in two planes are doors; an asset without such panes itself.

    Where any part is called a door, that tells which ones are.
    """
    if any(part.label is PartLabel.DOOR for part in asset.parts):
        return asset
    panes = [part for part in asset.parts if part.label in _PANES and _is_pane(part.box, config)]
    rest = [part for part in asset.parts if part not in panes]
    if not rest:
        return asset
    for first, second in permutations(panes, 2):
        if _lap(first, second, asset.box, config):
            return relabelled(asset, {first.id: PartLabel.DOOR, second.id: PartLabel.DOOR})
    return asset


def _is_pane(box: Box, config: SlidingPaneConfig) -> bool:
    return box.thin_axis == _DEPTH and bool(box.size[_DEPTH] <= config.thin * np.delete(box.size, _DEPTH).min())


def _lap(first: Part, second: Part, whole: Box, config: SlidingPaneConfig) -> bool:
    """Whether the first of two panes is before the second, laps it at one end, and both close a front together."""
    a, b = first.box, second.box
    high, narrow = min(a.size[_UP], b.size[_UP]), min(a.size[_WIDTH], b.size[_WIDTH])
    ends = max(abs(a.low[_UP] - b.low[_UP]), abs(a.high[_UP] - b.high[_UP]))
    if ends > config.level * high or narrow < config.alike * max(a.size[_WIDTH], b.size[_WIDTH]):
        return False
    lap = min(a.high[_WIDTH], b.high[_WIDTH]) - max(a.low[_WIDTH], b.low[_WIDTH])
    apart = b.low[_DEPTH] - a.high[_DEPTH]
    deep = whole.size[_DEPTH]
    if not config.lap * narrow <= lap <= config.most * narrow or not 0 <= apart <= config.near * deep:
        return False
    both = Box.enclosing((a, b))
    face = both.size[_WIDTH] * both.size[_UP]
    closes = face >= config.covers * whole.size[_WIDTH] * whole.size[_UP]
    is_wide = both.size[_WIDTH] >= config.wide * whole.size[_WIDTH]
    in_front = a.low[_DEPTH] - whole.low[_DEPTH] <= config.front * deep
    return bool(closes and is_wide and in_front and whole.high[_DEPTH] - b.high[_DEPTH] >= config.behind * deep)
