"""What counts as a window, and how its leaves move."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_ratios


@final
@dataclass(frozen=True)
class WindowConfig:
    """What counts as a window: all are fractions of its own sides.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    around: float = 0.8
    """What of the width and the height of the whole the frame spans at least (fraction); a sill may be wider."""
    shallow: float = 0.45
    """Greatest depth of the frame (fraction of the shorter of its other sides)."""
    rim: float = 0.01
    """How far within its own outline a frame is looked at all around (fraction of each side)."""
    closed: float = 0.95
    """What of that a frame covers at least, on each of its four sides (fraction)."""
    middle: float = 0.6
    """The middle of a leaf's frame is this wide and high (fraction of each side) ..."""
    bars: float = 0.5
    """... and at most this much of it is covered by bars (fraction)."""
    pane: float = 0.6
    """What of that middle the panes cover at least (fraction)."""
    hidden: float = 0.3
    """What of a leaf the frame covers at most, seen from before it (fraction): it may lie in a rebate."""
    leaf: float = 0.04
    """Least area of a leaf (fraction of the frame's, seen from before it)."""
    thin: float = 0.3
    """Greatest thickness of a leaf (fraction of its shorter other side)."""
    within: float = 0.02
    """How far what is on a leaf reaches beyond its outline at most (fraction of its side) ..."""
    before: float = 0.4
    """... and before and behind it (fraction of its shorter side)."""
    small: float = 0.35
    """Greatest side of a handle (fraction of its leaf's longer side)."""
    aside: float = 0.2
    """A handle is this far to one side of its leaf's middle at least (fraction of the leaf's side)."""
    wide: float = 0.55
    """A leaf without a handle that is lower than this over its width hangs from its upper edge (fraction)."""
    lap: float = 0.02
    """Two leaves that lap by more than this in two planes slide past one another (fraction of the leaf's side)."""
    beside: float = 0.15
    """... and so do two in two planes that are no farther apart than this (fraction of the leaf's side) ..."""
    level: float = 0.8
    """... and stand side by side along this much of the leaf's other side (fraction): casements have one plane."""
    flush: float = 0.1
    """A leaf is nearer to one face of the frame if the two gaps differ by this much (fraction of the frame's depth)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)
