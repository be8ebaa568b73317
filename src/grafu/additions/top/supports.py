"""What a top alone joined: pedestals, end panels, walls and posts that stand apart and end at one height.

Seen from above only, as the coverage test is: supports are what ends at a level, and furniture is one piece where they
stand around most of its footprint with nothing of about their height between them. Labels and
joints are not read: two pieces of one height may have lain under one top, or may be built so.
"""

from typing import final

import numpy as np
import shapely
from shapely.geometry import Polygon, box
from shapely.geometry.base import BaseGeometry

from grafu.additions.top.config import SupportConfig, TopConfig
from grafu.additions.top.height_map import CellMask, Grid, grown, islands, without_narrow
from grafu.additions.top.views import Views
from grafu.dataclass import dataclass
from grafu.geometry.arrays import distinct, median

ALONG_AXES = 1.05
"""Area of the rectangle along the axes, over that of the smallest one, up to which it is taken instead (ratio)."""
CELL_INSET = 0.99
"""Cells by which an outline is drawn in: a cell farther inside is next to its supports, none reaches beyond them."""


@final
@dataclass(frozen=True, eq=False)
class _Supports:
    """The cells in which supports end at `height` metres above what they stand on, and the openings within them."""

    views: Views
    level: float
    ends: CellMask
    opened: CellMask
    config: TopConfig
    metre: float

    @property
    def held(self) -> CellMask:
        """Ends and openings."""
        return self.ends | self.opened


def levels_of(views: Views, config: SupportConfig, metre: float) -> list[float]:
    """Returns the heights at which supports may end, metres, the highest first."""
    rises = views.still[np.isfinite(views.still)]
    above = (rises - views.floor) / metre
    rises = np.sort(rises[(above >= config.lowest) & (above <= config.highest)])[::-1]
    found: list[float] = []
    while len(rises) and len(found) < config.most_levels:
        together = rises >= rises[0] - config.even * metre
        found.append(median(rises[together]))
        rises = rises[~together]
    return found


def spanned_at(views: Views, level: float, opened: CellMask, config: TopConfig, metre: float) -> CellMask:
    """Returns the cells between supports that end at a level, openings at this level included; else the openings alone.

    Openings enclosed by one piece of walls need no more than themselves.
    """
    nothing = np.asarray(opened)
    if not config.supports.lowest * metre <= level - views.floor <= config.supports.highest * metre:
        return nothing
    ends = _ends_at(views, level, config.supports.even * metre)
    supports = _Supports(views, level, ends, opened, config, metre)
    if not _stand_apart(supports):
        return nothing
    outline = _outline(supports)
    if outline is None or not _is_whole(outline, supports):
        return nothing
    inside = _cells_in(outline, views.grid) & ~supports.ends
    return nothing | inside if _is_free(inside & ~opened, supports) else nothing


def _ends_at(views: Views, level: float, even: float) -> CellMask:
    """Returns the cells in which something ends at a level: splayed legs and slopes that go on beside them do not."""
    higher = grown(views.still > level + even, 1, corners=True)
    return (np.abs(views.still - level) <= even) & ~higher


def _stand_apart(supports: _Supports) -> bool:
    """Whether some support is a wall, a post or an open pedestal, and there is more than one opening's own rim."""
    labels, count = islands(supports.held, corners=True)
    if count == 0 or (count == 1 and supports.opened.any()):
        return False
    wide = max(1, round(0.5 * supports.config.supports.widest * supports.metre / supports.views.grid.cell))
    surfaces = without_narrow(supports.ends, wide, corners=True)
    covered = set(distinct(labels[surfaces & ~supports.opened]).tolist())
    covered -= set(distinct(labels[supports.opened]).tolist())
    return bool(set(range(1, count + 1)) - covered)


def _outline(supports: _Supports) -> Polygon | None:
    """Returns the outline of a top over supports, through the middles of their outer cells; None where it is narrow."""
    grid = supports.views.grid
    hull = shapely.convex_hull(shapely.multipoints(grid.centers(supports.held)))
    if not isinstance(hull, Polygon):
        return None
    upright, turned = box(*hull.bounds), hull.minimum_rotated_rectangle
    around = upright if upright.area <= ALONG_AXES * turned.area else turned
    corners = np.asarray(around.exterior.coords)
    sides = np.linalg.norm(np.diff(corners[:3], axis=0), axis=1)
    if sides.min() < supports.config.supports.narrowest_top * supports.metre:
        return None
    notch = _free_corner(upright, supports)
    if notch is not None:
        cut = upright.difference(notch)
        return cut if isinstance(cut, Polygon) else hull
    return around if hull.area >= supports.config.supports.full * around.area else hull


def _free_corner(around: Polygon, supports: _Supports) -> Polygon | None:
    """Returns the largest corner of a rectangle in which nothing stands, where what is left is an L."""
    grid, config = supports.views.grid, supports.config.supports
    inside = _cells_in(around, grid) | supports.held
    x, y = (np.flatnonzero(inside.any(axis=a)) for a in (1, 0))
    taken = np.isfinite(supports.views.wall) | supports.opened
    taken = taken[x[0] : x[-1] + 1, y[0] : y[-1] + 1]
    sides = np.indices(taken.shape) + 1.0
    notch, arm = config.notch * supports.metre / grid.cell, config.arm * supports.metre / grid.cell
    fits = np.ones(taken.shape, dtype=bool)
    for side, count in zip(sides, taken.shape, strict=True):
        fits &= (side >= notch) & (side <= count - arm)
    best, found = config.corner * taken.size, None
    low_x, low_y, high_x, high_y = around.bounds
    for flips in ((), (0,), (1,), (0, 1)):
        seen = np.flip(taken, flips)
        free = fits & ~np.logical_or.accumulate(np.logical_or.accumulate(seen, axis=0), axis=1)
        area = np.where(free, sides[0] * sides[1], 0.0)
        if area.max(initial=0.0) > best:
            best = float(area.max())
            wide, deep = (float(s[np.unravel_index(area.argmax(), area.shape)]) * grid.cell for s in sides)
            left = high_x - wide if 0 in flips else low_x
            lower = high_y - deep if 1 in flips else low_y
            found = box(left, lower, left + wide, lower + deep)
    return found


def _is_whole(outline: Polygon, supports: _Supports) -> bool:
    """Whether an outline holds most of what stands no higher than its supports."""
    still, config = supports.views.still, supports.config.supports
    lower = np.isfinite(still) & (still <= supports.level + config.above * supports.metre)
    footprint = shapely.convex_hull(shapely.multipoints(supports.views.grid.centers(lower)))
    return bool(outline.area >= config.footprint * footprint.area)


def _is_free(between: CellMask, supports: _Supports) -> bool:
    """Whether what lies between supports is open far down, and nothing of another height stands there.

    Between dividers that reach the level a top belongs, however near below it a shelf lies.
    """
    area, config = int(between.sum()), supports.config
    cover, floor = supports.views.cover, supports.views.floor
    below = floor + config.supports.open_below * (supports.level - floor)
    parted = _is_parted(between | supports.ends, supports)
    surface = supports.level - config.recess * supports.metre if parted else below
    high = between & (cover > surface)
    around = area + int(supports.ends.sum()) + int(supports.opened.sum())
    is_open = area > 0 and int(high.sum()) <= config.supports.filled * area
    return is_open and int(supports.ends.sum()) < config.coverage * around


def _is_parted(around: CellMask, supports: _Supports) -> bool:
    """Whether a divider ends near a level well within an outline: what lies beside it is a bay, not a tray or rack."""
    grid, level, metre = supports.views.grid, supports.level, supports.metre
    still, config = supports.views.still, supports.config
    walls = around & (still >= level - config.recess * metre) & (still <= level + config.supports.even * metre)
    width, inset = (grid.cells(length * metre) for length in (config.supports.divider, config.supports.widest))
    for axis in (0, 1):
        deep = np.flatnonzero(around.any(axis=axis))
        along = np.flatnonzero(around.any(axis=1 - axis))
        full = walls.sum(axis=1 - axis) >= config.supports.divider_depth * len(deep)
        inner = full[along[0] + inset : along[-1] + 1 - inset] if len(along) else full[:0]
        _, count = islands(inner[None])
        if count and inner.sum() <= count * width:
            return True
    return False


def _cells_in(outline: BaseGeometry, grid: Grid) -> CellMask:
    """Returns the cells whose middles lie well within an outline: what ends on it does not reach beyond it."""
    every = np.ones(grid.shape, dtype=bool)
    x, y = grid.centers(every).T
    return np.asarray(shapely.contains_xy(outline.buffer(-CELL_INSET * grid.cell), x, y)).reshape(grid.shape)
