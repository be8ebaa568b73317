"""Furniture from above: how high it stands, covers and encloses, on one grid. It judges nothing."""

from dataclasses import dataclass
from typing import final

import numpy as np
from scipy import ndimage

from grafu.realization.top.height_map import CellMask, Grid, Heights, heights_of
from grafu.realization.top.roles import Roles, triangles_of

RESOLUTION = 160  # cells along the longer side: a panel of 18 mm is two cells of a sideboard wide
_FRONTS = 0.06  # metres before the still parts up to which a closed front belongs to the footprint


@final
@dataclass(frozen=True, eq=False)
class Views:
    """Heights from above: of what stands, of what covers (still or turning) and of all, drawers included."""

    grid: Grid
    still: Heights
    cover: Heights
    wall: Heights
    region: CellMask
    floor: float


def views_of(roles: Roles, metre: float, resolution: int = RESOLUTION) -> Views:
    """Returns the heights of furniture from above, and the region that it stands on, kneeholes counted in."""
    grid = Grid.over(roles.box.grown(_FRONTS * metre), resolution)
    still = heights_of(triangles_of(p.mesh for p in roles.still), grid)
    turning = heights_of(triangles_of(m.mesh for m in roles.turning), grid)
    sliding = heights_of(triangles_of(m.mesh for m in roles.sliding), grid)
    cover = np.maximum(still, turning)
    wall = np.maximum(cover, sliding)
    stands = np.isfinite(still if roles.still else wall)
    near = ndimage.binary_dilation(_between(stands), iterations=grid.cells(_FRONTS * metre))
    return Views(grid, still, cover, wall, _between(stands) | (near & np.isfinite(wall)), float(roles.box.low[2]))


def _between(stands: CellMask) -> CellMask:
    """Returns the cells with something on both sides along X or along Y, or on themselves."""
    found = stands.copy()
    for axis in (0, 1):
        before = np.logical_or.accumulate(stands, axis=axis)
        found |= before & np.flip(np.logical_or.accumulate(np.flip(stands, axis), axis=axis), axis)
    return found
