"""What a top alone joined: pedestals, end panels, walls and posts that stand apart and end at one height.

Seen from above only, as the coverage test is: supports are what ends at a level, and furniture is one piece where they
stand around most of its footprint with nothing of about their height between them. Labels and
joints are not read: two pieces of one height may have lain under one top, or may be built so.
"""

from dataclasses import dataclass
from typing import final

import numpy as np
import shapely
from scipy import ndimage
from shapely.geometry import Polygon, box
from shapely.geometry.base import BaseGeometry

from grafu.additions.top.config import TopConfig
from grafu.additions.top.height_map import CellMask, Grid
from grafu.additions.top.views import Views

_EVEN = 0.01  # metres by which supports of one top differ in height
_HEIGHTS = (0.25, 1.25)  # metres: of benches and bar tables; higher posts belong to racks and beds
_LEVELS = 10  # heights looked at, from above: furniture with more visible ends has no bare supports
_WIDEST = 0.12  # metres: of posts and walls; what is wider both ways is a surface
_NARROWEST = 0.25  # metres: of a top
_BELOW = 0.6  # of the supports' height: a surface above that between them is what they stand around
_ABOVE = 0.06  # metres: what stands higher than that belongs to something else
_FILLED = 0.25  # of what lies between supports: less is a mirror, an apron, a cable tray
_FOOTPRINT = 0.6  # of all that stands no higher
_FULL = 0.7  # of its bounding rectangle: an outline that takes less is none, but a triangle or a diamond
_DIVIDER = 0.06  # metres: thicker is no board
_PARTS = 0.6  # of the depth: so far a divider reaches
_INNER = 0.99  # of a cell: farther inside of an outline a cell is next to its supports and does not reach beyond them
_NOTCH = 0.25  # metres: both sides of the free corner of an L
_ARM = 0.3  # metres: the width of either arm of an L
_CORNER = 0.2  # of the bounding rectangle: a free corner of less is a recess


@final
@dataclass(frozen=True, eq=False)
class _Supports:
    """The cells in which supports end at `height` metres above what they stand on, and the openings within them."""

    views: Views
    level: float
    ends: CellMask
    opened: CellMask
    metre: float

    @property
    def held(self) -> CellMask:
        """Ends and openings."""
        return self.ends | self.opened


def levels_of(views: Views, metre: float) -> list[float]:
    """Returns the heights at which supports may end, metres, the highest first."""
    rises = views.still[np.isfinite(views.still)]
    above = (rises - views.floor) / metre
    rises = np.sort(rises[(above >= _HEIGHTS[0]) & (above <= _HEIGHTS[1])])[::-1]
    found: list[float] = []
    while len(rises) and len(found) < _LEVELS:
        together = rises >= rises[0] - _EVEN * metre
        found.append(float(np.median(rises[together])))
        rises = rises[~together]
    return found


def spanned_at(views: Views, level: float, opened: CellMask, config: TopConfig, metre: float) -> CellMask:
    """Returns the cells between supports that end at a level, openings at this level included; else the openings alone.

    Openings enclosed by one piece of walls need no more than themselves.
    """
    nothing = np.asarray(opened)
    if not _HEIGHTS[0] * metre <= level - views.floor <= _HEIGHTS[1] * metre:
        return nothing
    supports = _Supports(views, level, _ends_at(views, level, metre), opened, metre)
    if not _stand_apart(supports):
        return nothing
    outline = _outline(supports)
    if outline is None or not _is_whole(outline, supports):
        return nothing
    inside = _cells_in(outline, views.grid) & ~supports.ends
    return nothing | inside if _is_free(inside & ~opened, supports, config) else nothing


def _ends_at(views: Views, level: float, metre: float) -> CellMask:
    """Returns the cells in which something ends at a level: splayed legs and slopes that go on beside them do not."""
    higher = ndimage.binary_dilation(views.still > level + _EVEN * metre, structure=np.ones((3, 3)))
    return (np.abs(views.still - level) <= _EVEN * metre) & ~higher


def _stand_apart(supports: _Supports) -> bool:
    """Whether some support is a wall, a post or an open pedestal, and there is more than one opening's own rim."""
    labels, count = ndimage.label(supports.held, structure=np.ones((3, 3)))
    if count == 0 or (count == 1 and supports.opened.any()):
        return False
    wide = max(1, round(0.5 * _WIDEST * supports.metre / supports.views.grid.cell))
    surfaces = ndimage.binary_opening(supports.ends, structure=np.ones((3, 3)), iterations=wide)
    covered = set(np.unique(labels[surfaces & ~supports.opened]).tolist())
    covered -= set(np.unique(labels[supports.opened]).tolist())
    return bool(set(range(1, count + 1)) - covered)


def _outline(supports: _Supports) -> Polygon | None:
    """Returns the outline of a top over supports, through the middles of their outer cells; None where it is narrow."""
    grid = supports.views.grid
    hull = shapely.convex_hull(shapely.multipoints(grid.centers(supports.held)))
    if not isinstance(hull, Polygon):
        return None
    upright, turned = box(*hull.bounds), hull.minimum_rotated_rectangle
    around = upright if upright.area <= 1.05 * turned.area else turned
    corners = np.asarray(around.exterior.coords)
    sides = np.linalg.norm(np.diff(corners[:3], axis=0), axis=1)
    if sides.min() < _NARROWEST * supports.metre:
        return None
    notch = _free_corner(upright, supports)
    if notch is not None:
        cut = upright.difference(notch)
        return cut if isinstance(cut, Polygon) else hull
    return around if hull.area >= _FULL * around.area else hull


def _free_corner(around: Polygon, supports: _Supports) -> Polygon | None:
    """Returns the largest corner of a rectangle in which nothing stands, where what is left is an L."""
    grid = supports.views.grid
    inside = _cells_in(around, grid) | supports.held
    x, y = (np.flatnonzero(inside.any(axis=a)) for a in (1, 0))
    taken = np.isfinite(supports.views.wall) | supports.opened
    taken = taken[x[0] : x[-1] + 1, y[0] : y[-1] + 1]
    sides = np.indices(taken.shape) + 1.0
    notch, arm = _NOTCH * supports.metre / grid.cell, _ARM * supports.metre / grid.cell
    fits = np.ones(taken.shape, dtype=bool)
    for side, count in zip(sides, taken.shape, strict=True):
        fits &= (side >= notch) & (side <= count - arm)
    best, found = _CORNER * taken.size, None
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
    still = supports.views.still
    lower = np.isfinite(still) & (still <= supports.level + _ABOVE * supports.metre)
    footprint = shapely.convex_hull(shapely.multipoints(supports.views.grid.centers(lower)))
    return bool(outline.area >= _FOOTPRINT * footprint.area)


def _is_free(between: CellMask, supports: _Supports, config: TopConfig) -> bool:
    """Whether what lies between supports is open far down, and nothing of another height stands there.

    Between dividers that reach the level a top belongs, however near below it a shelf lies.
    """
    area = int(between.sum())
    cover, floor = supports.views.cover, supports.views.floor
    parted = _is_parted(between | supports.ends, supports, config)
    surface = supports.level - config.recess * supports.metre if parted else floor + _BELOW * (supports.level - floor)
    high = between & (cover > surface)
    around = area + int(supports.ends.sum()) + int(supports.opened.sum())
    return area > 0 and int(high.sum()) <= _FILLED * area and int(supports.ends.sum()) < config.coverage * around


def _is_parted(around: CellMask, supports: _Supports, config: TopConfig) -> bool:
    """Whether a divider ends near a level well within an outline: what lies beside it is a bay, not a tray or rack."""
    grid, level, metre = supports.views.grid, supports.level, supports.metre
    still = supports.views.still
    walls = around & (still >= level - config.recess * metre) & (still <= level + _EVEN * metre)
    width, inset = grid.cells(_DIVIDER * metre), grid.cells(_WIDEST * metre)
    for axis in (0, 1):
        deep = np.flatnonzero(around.any(axis=axis))
        along = np.flatnonzero(around.any(axis=1 - axis))
        full = walls.sum(axis=1 - axis) >= _PARTS * len(deep)
        inner = full[along[0] + inset : along[-1] + 1 - inset] if len(along) else full[:0]
        _, count = ndimage.label(inner)
        if count and inner.sum() <= count * width:
            return True
    return False


def _cells_in(outline: BaseGeometry, grid: Grid) -> CellMask:
    """Returns the cells whose middles lie well within an outline: what ends on it does not reach beyond it."""
    every = np.ones(grid.shape, dtype=bool)
    x, y = grid.centers(every).T
    return np.asarray(shapely.contains_xy(outline.buffer(-_INNER * grid.cell), x, y)).reshape(grid.shape)
