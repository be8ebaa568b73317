"""The coverage test: everything against what is near the top, both seen from above (paper, Adding Countertops).

"Near the top" is no fixed band under the greatest height, since backs and mirrors stand higher than tops and sides a
little higher than inset ones. A cell is open if one looks past its rim into the depth: the rim is as high as the walls
that enclose the cell, on all four sides, or on three where the front is open. What lies between supports of one height
that nothing else joins is open too. Nothing here knows of labels.
"""

from typing import final

import numpy as np

from grafu.additions.top.config import OpeningConfig, TopConfig
from grafu.additions.top.height_map import CellMask, Grid, Heights, islands, without_narrow
from grafu.additions.top.supports import levels_of, spanned_at
from grafu.additions.top.views import Views
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, distinct, frozen_array, median
from grafu.shapes import Float

Opening = tuple[float, CellMask]
"""The height of a rim, metres, and the cells that one looks into past it."""


@final
@dataclass(frozen=True, eq=False)
class Coverage(ArrayValue):
    """What one sees from above. `everything` and `near_top` are the paper's two maps, at the level of one rim.

    `level` is the height of that rim, None where nothing is enclosed: then both maps are of the whole footprint.
    `opened` are the cells that one looks into.
    """

    grid: Grid
    everything: CellMask
    near_top: CellMask
    level: float | None = None

    def __post_init__(self) -> None:
        for name in ("everything", "near_top"):
            mask = getattr(self, name)
            if mask.shape != self.grid.shape:
                raise ValueError(f"`Coverage.{name}` must have the grid's shape {self.grid.shape}: got {mask.shape}")
            object.__setattr__(self, name, frozen_array(mask, np.bool_))

    @property
    def opened(self) -> CellMask:
        """The cells that nothing near the top covers."""
        return self.everything & ~self.near_top

    @property
    def ratio(self) -> float:
        """The fraction of everything that is covered near the top; 1 where there is nothing to cover."""
        area = int(self.everything.sum())
        return float((self.everything & self.near_top).sum()) / area if area else 1.0


def coverage_of(views: Views, config: TopConfig, metre: float, spared: CellMask | None = None) -> Coverage:
    """Returns both maps at the rim with the largest opening, or of the whole footprint where nothing is open.

    `spared` are cells that count in neither map: a basin is neither a top nor a missing one.
    """
    depth = metre * np.array([config.recess, config.gallery])
    openings = config.openings
    narrow = min(openings.narrow * metre, openings.narrow_ratio * views.grid.cell * min(views.grid.shape))
    most = _height(views) * np.array([config.recess_ratio, config.gallery_ratio])
    deep = min(depth[0], most[0]), min(depth[1], most[1])
    rim, opened = _openings(views, *deep, narrow, openings)
    free = np.ones(views.grid.shape, dtype=bool) if spared is None else ~spared
    opened = free & without_narrow(opened, max(1, views.grid.cells(openings.crack * metre) // 2))
    groups = _by_level(opened, rim, openings.rim_step * metre)
    least = openings.least * float(views.region.sum())
    spans = [(level, spanned_at(views, level, hole, config, metre) & free) for level, hole in groups]
    best = _higher(_largest(spans, least), _bare(views, config, metre, least), openings.over)
    if best is None:
        return Coverage(views.grid, views.region & free, views.region & free)
    level, hole = best
    near = (views.wall >= level - depth[0]) & (views.wall <= level + openings.above_rim * metre) & views.region
    area = _touching(near | hole, hole) & free
    return Coverage(views.grid, area, area & ~hole, level)


def _height(views: Views) -> float:
    return float(views.wall[np.isfinite(views.wall)].max(initial=views.floor)) - views.floor


def _openings(
    views: Views, recess: float, gallery: float, narrow: float, config: OpeningConfig
) -> tuple[Heights, CellMask]:
    """Returns for each cell the height of its rim, and whether what covers it lies too far below that.

    What is open in front, too, must be wider than `narrow` metres.
    """
    around, fixed = _around(views.wall, views.floor), _around(views.cover, views.floor)
    covered = np.where(np.isfinite(views.cover), views.cover, views.floor)
    hidden = np.where(_closed_in_front(views.wall, around[1] - recess), recess, gallery)
    enclosed, niche = around[0] - covered > recess, around[1] - covered > hidden
    niche &= around[1] - views.floor >= config.niche * _height(views)
    niche &= without_narrow(niche | enclosed, max(1, views.grid.cells(narrow) // 2))
    rim = np.where(niche, around[1], around[0])
    held = fixed[2] >= rim - recess  # by two sides at least: the four walls of an open drawer are no rim
    return rim, views.region & (enclosed | niche) & held & ~_slants(rim, views.grid, config)


def _closed_in_front(wall: Heights, rim: Heights) -> CellMask:
    """Whether what stands before a cell reaches its rim: what is open elsewhere only is no gallery."""
    return np.asarray(np.maximum.accumulate(wall, axis=1) >= rim)


def _slants(rim: Heights, grid: Grid, config: OpeningConfig) -> CellMask:
    """Whether a rim rises steadily at a cell, along X or along Y."""
    low, high = config.least_slant * grid.cell, config.most_slant * grid.cell
    found = np.zeros(rim.shape, dtype=bool)
    for axis in (0, 1):
        for sign in (1.0, -1.0):
            rises = sign * np.diff(rim, axis=axis)
            steady = (rises >= low) & (rises <= high)
            ends = [(0, 0), (0, 0)]
            ends[axis] = (1, 1)
            sides = np.pad(steady, ends)
            found |= np.take(sides, range(rim.shape[axis]), axis) & np.take(sides, range(1, rim.shape[axis] + 1), axis)
    return found


def _around(heights: Heights, floor: float) -> Float[np.ndarray, "4 x y"]:
    """Returns the greatest heights that one meets from each cell in the four directions, the least first."""
    ahead = [np.maximum.accumulate(heights, axis=a) for a in (0, 1)]
    behind = [np.flip(np.maximum.accumulate(np.flip(heights, a), axis=a), a) for a in (0, 1)]
    return np.maximum(np.sort(np.stack([*ahead, *behind]), axis=0), floor)


def _by_level(opened: CellMask, rim: Heights, step: float) -> list[Opening]:
    """Returns the openings, those whose rims are about equally high as one, each with the height of its rim."""
    labels, count = islands(opened)
    groups: list[Opening] = []
    levels = [median(rim[labels == k]) for k in range(1, count + 1)]
    for k in np.argsort(levels)[::-1]:
        mask = labels == k + 1
        if groups and groups[-1][0] - levels[k] <= step:
            groups[-1] = (groups[-1][0], groups[-1][1] | mask)
        else:
            groups.append((levels[k], mask))
    return groups


def _largest(groups: list[Opening], least: float) -> Opening | None:
    """Returns the largest opening of at least so many cells, with the height of its rim."""
    best = max(groups, key=lambda group: int(group[1].sum()), default=None)
    return best if best is not None and best[1].sum() >= least else None


def _bare(views: Views, config: TopConfig, metre: float, least: float) -> Opening | None:
    """Returns what the highest supports that enclose nothing span, legs without an apron for one, and their height."""
    nothing = np.zeros(views.grid.shape, dtype=bool)
    for level in levels_of(views, config.supports, metre):
        spanned = spanned_at(views, level, nothing, config, metre)
        if spanned.sum() >= max(least, 1.0):
            return level, spanned
    return None


def _higher(opening: Opening | None, bare: Opening | None, ratio: float) -> Opening | None:
    """Returns what supports span where it lies over this fraction of the opening: that one is a ring of stretchers."""
    if opening is None or bare is None:
        return opening or bare
    over = float((opening[1] & bare[1]).sum())
    return bare if bare[0] > opening[0] and over >= ratio * float(opening[1].sum()) else opening


def _touching(cells: CellMask, seed: CellMask) -> CellMask:
    """Returns those connected cells that hold a seed."""
    labels, _ = islands(cells, corners=True)
    return np.isin(labels, distinct(labels[seed & (labels > 0)]))
