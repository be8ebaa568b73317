"""Sizes of what stands between a rail and what carries it."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_ratios


@final
@dataclass(frozen=True)
class RailFootingConfig:
    """Sizes of the blocks between a rail and what carries it, and how far they reach.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    wall: float = 0.98
    """Side of a block or divider between a rail and the wall (fraction of the rail's)."""
    side: float = 0.9
    """Side of a block towards the drawer, or on a rail's other sides (fraction of that side's)."""
    drawer_reach: float = 0.2
    """Longest block between a rail and its drawer (fraction of the drawer's width)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)
