"""Panels on a wall look like doors: nothing is behind them but a plate that is larger than they are and closed.

What a door closes is deeper than a wall is thick. Rays are cast on the meshes.
"""

from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.raycast import RayCaster
from grafu.graph.functional_graph import FunctionalGraph, PartNode

_STEPS = np.linspace(0.06, 0.94, 8)  # where rays leave the back of a panel, from side to side


@final
@dataclass(frozen=True, slots=True)
class WallPanelConfig:
    """When a plate is a panel on a wall.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    wall: float = 0.08
    """How thick a wall is at most (fraction of the shorter of its other sides): cases are deeper."""
    near: float = 0.02
    """How far before a wall a panel on it ends at most (fraction of the panel's largest side)."""
    closed: float = 0.95
    """What of the outline of a panel the wall closes at least (fraction of rays): there is no opening behind it."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def wall_behind(
    node: PartNode, asset: Asset, graph: FunctionalGraph, config: WallPanelConfig = WallPanelConfig()
) -> str:
    """Returns the static part that is a wall right behind an upright plate, or before it; empty for none."""
    axis = node.box.thin_axis
    if axis == 2:
        return ""
    static = (part for part in asset.parts if part.id != node.id and part.id not in graph.moving)
    return next((part.id for part in static if _is_wall_of(part, node.box, axis, config)), "")


def _is_wall_of(part: Part, panel: Box, axis: int, config: WallPanelConfig) -> bool:
    wall, across = part.box, np.delete(np.arange(3), axis)
    near = config.near * float(panel.size.max())
    is_plate = float(wall.size[axis]) <= config.wall * float(wall.size[across].min())
    gap = max(float(wall.low[axis] - panel.high[axis]), float(panel.low[axis] - wall.high[axis]))
    is_smaller = np.prod(wall.size[across]) < np.prod(panel.size[across])  # a pane or a mirror on a door
    if not is_plate or is_smaller or not -near <= gap <= near:
        return False
    places = np.meshgrid(*(panel.low[k] + _STEPS * panel.size[k] for k in across), indexing="ij")
    starts, towards = np.empty((len(_STEPS) ** 2, 3)), np.zeros(3)
    starts[:, across] = np.stack(places, axis=-1).reshape(-1, 2)
    starts[:, axis] = panel.center[axis]
    towards[axis] = np.sign(wall.center[axis] - panel.center[axis])
    depths = RayCaster(part.mesh).along(starts, towards) - float(panel.half[axis])
    return float((depths <= near).mean()) >= config.closed
