"""How high furniture reaches above each cell of the floor, from triangles alone. It judges nothing."""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Indices, Scalars, Vec2, frozen_array
from grafu.geometry.box import Box
from grafu.geometry.components import linked
from grafu.shapes import Bool, Float, Int

Heights = Float[np.ndarray, "x y"]
"""The highest surface above each cell, metres; minus infinity where there is none."""
Corners = Float[np.ndarray, "t 3 2"]
"""The corners of triangles seen from above, in cells."""
Rises = Float[np.ndarray, "t 3"]
"""How high those corners are, metres."""
Numbers = Int[np.ndarray, " s"]
CellMask = Bool[np.ndarray, "x y"]

LEAST_UPRIGHT_PART = 0.02
"""Upright part of a triangle's unit normal below which its height over a point is not solved for (ratio)."""
BORDER_TOLERANCE = 1e-6
"""Cells: what ends on a cell's border does not reach into the next."""
CELLS_AT_ONCE = 1_000_000
"""Cells that triangles are spread over at once: bounds the memory of many large triangles to some 100 MB."""


@final
@dataclass(frozen=True, eq=False, slots=True)
class Grid(ArrayValue):
    """Square cells on the floor: `low` is the outer corner of cell (0, 0), `cell` a side in metres."""

    low: Vec2
    cell: float
    columns: int
    rows: int

    def __post_init__(self) -> None:
        object.__setattr__(self, "low", frozen_array(self.low))
        if not (self.cell > 0 and self.columns > 0 and self.rows > 0):
            raise ValueError(f"`Grid` needs cells: got {self.columns} x {self.rows} of {self.cell} m")

    @classmethod
    def over(cls, box: Box, resolution: int) -> "Grid":
        """Returns a grid with `resolution` cells along the longer side of a box, and a free cell around."""
        sides = box.size[:2]
        cell = max(float(sides.max()) / resolution, 1e-9)
        columns, rows = (int(n) for n in np.ceil(sides / cell - BORDER_TOLERANCE).astype(np.int64) + 2)
        return cls(box.center[:2] - 0.5 * cell * np.array([columns, rows], dtype=np.float64), cell, columns, rows)

    @property
    def shape(self) -> tuple[int, int]:
        """The number of cells along X and Y."""
        return self.columns, self.rows

    def centers(self, mask: CellMask) -> Float[np.ndarray, "n 2"]:
        """Returns the middles of the marked cells, metres."""
        return np.asarray(self.low) + (np.argwhere(mask) + 0.5) * self.cell

    def boxes(self, mask: CellMask) -> Float[np.ndarray, "n 4"]:
        """Returns rectangles (least x and y, greatest x and y, metres) that make up the marked cells, row by row."""
        edges = np.diff(np.pad(mask.astype(np.int8), ((1, 1), (0, 0))), axis=0)
        row, first = np.argwhere(edges.T == 1).T
        last = np.argwhere(edges.T == -1)[:, 1]
        at = np.column_stack([first, row, last, row + 1]).astype(np.float64)
        return np.tile(np.asarray(self.low), 2) + at * self.cell

    def cells(self, length: float) -> int:
        """Returns how many cells a length covers, at least one."""
        return max(1, round(length / self.cell))


def grown(mask: CellMask, times: int, *, corners: bool = False) -> CellMask:
    """Returns the marked cells with their neighbours (`corners`: the eight around, else four), so many times over."""
    for _ in range(times):
        found = mask.copy()
        found[1:] |= mask[:-1]
        found[:-1] |= mask[1:]
        beside = found.copy() if corners else mask
        found[:, 1:] |= beside[:, :-1]
        found[:, :-1] |= beside[:, 1:]
        mask = found
    return mask


def without_narrow(mask: CellMask, times: int, *, corners: bool = False) -> CellMask:
    """Returns the marked cells without what is narrower than twice as many cells; the outside counts as unmarked."""
    outside = grown(np.pad(~mask, times, constant_values=True), times, corners=corners)
    return grown(~outside[times:-times, times:-times], times, corners=corners)


def islands(mask: CellMask, *, corners: bool = False) -> tuple[Int[np.ndarray, "x y"], int]:
    """Returns for each cell the number, from 1, of the marked cells that it is connected with (0: none), and the last.

    Cells are connected across sides, or across `corners`, too. Numbers rise with the first cell, row by row.
    """
    number = np.arange(mask.size).reshape(mask.shape)
    first, second = [], []
    for here, there in _NEIGHBOURS if corners else _NEIGHBOURS[:2]:
        both = mask[here] & mask[there]
        first.append(number[here][both])
        second.append(number[there][both])
    group = linked(mask.size, np.concatenate(first), np.concatenate(second)).reshape(mask.shape)
    found, label = np.unique(group[mask], return_inverse=True)
    labels = np.zeros(mask.shape, np.int64)
    labels[mask] = label.reshape(-1) + 1
    return labels, len(found)


# A cell and the next along X, along Y, and along both diagonals.
_ALL, _FIRST, _LAST = slice(None), slice(None, -1), slice(1, None)
_NEIGHBOURS = (
    ((_FIRST, _ALL), (_LAST, _ALL)),
    ((_ALL, _FIRST), (_ALL, _LAST)),
    ((_FIRST, _FIRST), (_LAST, _LAST)),
    ((_FIRST, _LAST), (_LAST, _FIRST)),
)


def heights_of(triangles: Float[np.ndarray, "n 3 3"], grid: Grid) -> Heights:
    """Returns the highest surface in each cell that a triangle so much as grazes: thin sheets and walls count."""
    field = np.full(grid.columns * grid.rows, -np.inf)
    if not len(triangles):
        return field.reshape(grid.shape)
    flat = (triangles[:, :, :2] - grid.low) / grid.cell
    low, high = _least(flat), -_least(-flat)
    size = high - low
    inside = (high > 0).all(axis=1) & (low < grid.shape).all(axis=1)
    tiny, tall = (size < 1.0).all(axis=1), size[:, 1] > size[:, 0]
    _mark_tiny(field, flat[inside & tiny], triangles[inside & tiny, :, 2], grid)
    covered = np.prod(np.minimum(np.ceil(size) + 1, grid.shape), axis=1)
    for turned in (False, True):  # along the axis on which fewer lines of cells are crossed
        chosen = np.flatnonzero(inside & ~tiny & (tall == turned))
        for batch in _batches(chosen, covered[chosen]):
            _mark_large(field, flat[batch], triangles[batch, :, 2], grid, turned)
    return field.reshape(grid.shape)


def _batches(chosen: Indices, covered: Scalars) -> list[Int[np.ndarray, " _"]]:
    """Returns triangles in batches whose bounding boxes cover at most some `CELLS_AT_ONCE` cells together."""
    number = np.cumsum(covered) // CELLS_AT_ONCE
    return np.split(chosen, np.flatnonzero(np.diff(number)) + 1) if len(chosen) else []


def _least(corners: Float[np.ndarray, "n 3 ..."]) -> Float[np.ndarray, "n ..."]:
    """Returns the least of each triangle's three corners."""
    return np.minimum(np.minimum(corners[:, 0], corners[:, 1]), corners[:, 2])


def _mark_tiny(field: Scalars, flat: Corners, z: Rises, grid: Grid) -> None:
    """Raises a field to triangles smaller than a cell, in the cells of their corners."""
    at = np.clip(np.floor(flat - BORDER_TOLERANCE).astype(np.int64), 0, np.array(grid.shape) - 1)
    np.maximum.at(field, (at[..., 0] * grid.rows + at[..., 1]).ravel(), z.ravel())


def _mark_large(field: Scalars, flat: Corners, z: Rises, grid: Grid, turned: bool) -> None:
    """Raises a field to triangles, line by line of cells: rows along X, or, `turned`, columns along Y."""
    lines, cells = (grid.columns, grid.rows) if turned else (grid.rows, grid.columns)
    flat = flat[:, :, ::-1] if turned else flat
    which, line = _spread(*_span(_least(flat[:, :, 1]), -_least(-flat[:, :, 1]), lines))
    first, last = _reach(flat[which], line.astype(np.float64))
    span, cell = _spread(*_span(first, last, cells))
    line = line[span]
    at = _height_at(flat, z, which[span], cell + 0.5, line + 0.5)
    np.maximum.at(field, line * grid.rows + cell if turned else cell * grid.rows + line, at)


def _span(low: Scalars, high: Scalars, count: int) -> tuple[Indices, Indices]:
    """Returns the first and last cell from `low` to `high`, of `count`."""
    first = np.clip(np.floor(low + BORDER_TOLERANCE), 0, count - 1).astype(np.int64)
    last = np.clip(np.floor(high - BORDER_TOLERANCE), 0, count - 1).astype(np.int64)
    return first, np.maximum(last, first)


def _spread(first: Indices, last: Indices) -> tuple[Numbers, Numbers]:
    """Returns every number from each first to its last, and which it belongs to."""
    counts = last - first + 1
    which = np.repeat(np.arange(len(first)), counts)
    return which, first[which] + np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)


def _reach(flat: Float[np.ndarray, "n 3 2"], row: Scalars) -> tuple[Scalars, Scalars]:
    """Returns how far each triangle reaches along X within a row of cells."""
    low, high = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    for k in range(3):
        a, b = flat[:, k], flat[:, (k + 1) % 3]
        rise = b[:, 1] - a[:, 1]
        level = np.abs(rise) < 1e-12
        steep = np.where(level, 1.0, rise)
        enters, leaves = (row - a[:, 1]) / steep, (row + 1 - a[:, 1]) / steep
        begin = np.where(level, 0.0, np.maximum(np.minimum(enters, leaves), 0.0))
        end = np.where(level, 1.0, np.minimum(np.maximum(enters, leaves), 1.0))
        met = np.where(
            level, (a[:, 1] >= row - BORDER_TOLERANCE) & (a[:, 1] <= row + 1 + BORDER_TOLERANCE), begin <= end
        )
        x0, x1 = a[:, 0] + begin * (b[:, 0] - a[:, 0]), a[:, 0] + end * (b[:, 0] - a[:, 0])
        low = np.minimum(low, np.where(met, np.minimum(x0, x1), np.inf))
        high = np.maximum(high, np.where(met, np.maximum(x0, x1), -np.inf))
    lost = low > high  # grazed within rounding
    return np.where(lost, _least(flat[:, :, 0]), low), np.where(lost, -_least(-flat[:, :, 0]), high)


def _height_at(flat: Corners, z: Rises, which: Indices, x: Scalars, y: Scalars) -> Scalars:
    """Returns the height of triangles at points (in cells), within what each triangle reaches."""
    u, v = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    p, q = z[:, 1] - z[:, 0], z[:, 2] - z[:, 0]
    twice = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    upright = np.abs(twice) <= LEAST_UPRIGHT_PART * (np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1) + 1e-12)
    area = np.where(upright, 1.0, twice)
    along_x = np.where(upright, 0.0, (p * v[:, 1] - q * u[:, 1]) / area)
    along_y = np.where(upright, 0.0, (q * u[:, 0] - p * v[:, 0]) / area)
    lowest, highest = _least(z), -_least(-z)
    found = z[which, 0] + along_x[which] * (x - flat[which, 0, 0]) + along_y[which] * (y - flat[which, 0, 1])
    stands = upright[which]
    number = np.cumsum(upright) - 1
    at = np.column_stack([x, y])[stands]
    found[stands] = _rise_of_uprights(flat[upright], z[upright], number[which[stands]], at)
    return np.minimum(np.maximum(found, lowest[which]), highest[which])


def _rise_of_uprights(flat: Corners, z: Rises, which: Indices, at: Float[np.ndarray, "n 2"]) -> Scalars:
    """Returns the greatest height of upright triangles within half a cell of points: the sides of a bureau slant."""
    reach = np.linalg.norm(flat - np.roll(flat, 1, axis=1), axis=2)
    longest = reach.argmax(axis=1)[:, None, None]
    ends = [np.take_along_axis(np.roll(flat, shift, axis=1), longest, axis=1)[:, 0] for shift in (0, 1)]
    direction = (ends[1] - ends[0]) / np.maximum(reach.max(axis=1), 1e-12)[:, None]
    along = np.einsum("tkd,td->tk", flat, direction)
    middle = (at * direction[which]).sum(axis=1)
    along, z = along[which], z[which]
    found = np.full(len(which), -np.inf)
    t = np.clip(middle + np.array([[-0.5], [0.0], [0.5]]), _least(along), -_least(-along))
    for k in range(3):
        a, b, low, high = along[:, k], along[:, (k + 1) % 3], z[:, k], z[:, (k + 1) % 3]
        level = np.abs(b - a) < 1e-9
        ratio = np.clip((t - a) / np.where(level, 1.0, b - a), 0.0, 1.0)
        rise = np.where(level, np.maximum(low, high), low + ratio * (high - low))
        met = (t >= np.minimum(a, b) - 1e-9) & (t <= np.maximum(a, b) + 1e-9)
        found = np.maximum(found, np.where(met, rise, -np.inf).max(axis=0))
    return np.where(np.isfinite(found), found, -_least(-z))
