"""Where triangles lie in a box, cell by cell: they are split until none is larger than a cell.

What is left of a triangle is represented by the box around each of its pieces. They cover it wholly, so what no piece
reaches is free; a slanted triangle counts as a little more than it is, one that lies across an axis exactly.
"""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Points, freeze_arrays
from grafu.geometry.box import Box
from grafu.shapes import Float, Int

_MOST_SPLITS = 40  # halvings: a triangle of 1 km comes down to less than a micrometre in each of its sides


@final
@dataclass(frozen=True, eq=False, slots=True)
class Pieces(ArrayValue):
    """The boxes around the pieces of triangles, clipped to the box that they were sought in, metres."""

    low: Points
    high: Points

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float64)

    def of(self, keep: np.ndarray) -> "Pieces":
        """Returns some of the pieces."""
        return Pieces(self.low[keep], self.high[keep])

    def within(self, box: Box) -> np.ndarray:
        """Returns for each piece whether it shares more than a border with a box, or lies in it as a sheet."""
        low, high = np.asarray(box.low), np.asarray(box.high)
        return _all((self.low < high) & (self.high > low))


def pieces_in(triangles: Float[np.ndarray, "n 3 3"], box: Box, cells: tuple[int, int, int]) -> Pieces:
    """Returns what lies in a box of some triangles, in pieces no larger than one of its cells along any axis.

    Raises:
        ValueError: if there is not at least one cell along each axis.
    """
    if min(cells) < 1:
        raise ValueError(f"`cells` must be at least 1 along each axis: got {cells}")
    cell = np.maximum(box.size, 1e-12) / np.asarray(cells)
    low, high = np.asarray(box.low), np.asarray(box.high)
    done: list[np.ndarray] = []
    left = np.asarray(triangles, dtype=np.float64)
    for _ in range(_MOST_SPLITS):
        lows, highs = spans_of(left)
        meets = _all((lows <= high) & (highs >= low))
        left, lows, highs = left[meets], lows[meets], highs[meets]
        if not len(left):
            break
        small = _all(highs - lows <= cell * (1.0 + 1e-9))
        done.append(np.stack([lows[small], highs[small]]))
        left = _halved(left[~small], cell)
    found = np.concatenate(done, axis=1) if done else np.zeros((2, 0, 3))
    return Pieces(np.maximum(found[0], low), np.minimum(found[1], high))


def spans_of(triangles: Float[np.ndarray, "n 3 3"]) -> tuple[Points, Points]:
    """Returns the low and the high corner of the box around each triangle."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]  # far quicker than a reduction over three
    return np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)


def meeting(triangles: Float[np.ndarray, "n 3 3"], box: Box) -> Float[np.ndarray, "m 3 3"]:
    """Returns the triangles whose own boxes meet a box."""
    low, high = spans_of(triangles)
    return triangles[_all((low <= box.high) & (high >= box.low))]


def _all(flags: np.ndarray) -> np.ndarray:
    return np.asarray(flags[:, 0] & flags[:, 1] & flags[:, 2])


def _halved(triangles: np.ndarray, cell: np.ndarray) -> np.ndarray:
    """Returns the two halves of each triangle, cut across the edge that passes through most cells."""
    if not len(triangles):
        return triangles
    edges = np.roll(triangles, -1, axis=1) - triangles
    crossed = np.abs(edges / cell)
    longest = np.argmax(np.maximum(np.maximum(crossed[..., 0], crossed[..., 1]), crossed[..., 2]), axis=1)
    rows = np.arange(len(triangles))
    a, b, c = (triangles[rows, (longest + k) % 3] for k in range(3))
    middle = (a + b) / 2
    return np.concatenate([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])


def nearest_depths(
    pieces: Pieces, box: Box, columns: tuple[int, int], axes: tuple[int, int, int], none: float
) -> Float[np.ndarray, "u v"]:
    """Returns for each column of cells the least coordinate along the third axis at which a piece begins.

    `axes` are those across the columns and the one along them; `none` stands where a column is empty. The pieces must
    be no larger than the columns are wide.
    """
    u, v, along = axes
    depths = np.full(columns, none)
    first, last = (_cell_numbers(corner, box, columns, (u, v)) for corner in (pieces.low, pieces.high))
    for i in (first[:, 0], last[:, 0]):
        for j in (first[:, 1], last[:, 1]):
            np.minimum.at(depths, (i, j), pieces.low[:, along])
    return depths


def _cell_numbers(
    points: np.ndarray, box: Box, columns: tuple[int, int], axes: tuple[int, int]
) -> Int[np.ndarray, "n 2"]:
    picked = list(axes)
    ratio = (points[:, picked] - box.low[picked]) / np.maximum(box.size[picked], 1e-12)
    numbers = np.floor(ratio * np.asarray(columns)).astype(np.int64)
    return np.clip(numbers, 0, np.asarray(columns) - 1)


def largest_rectangles(free: np.ndarray) -> tuple[Int[np.ndarray, "k 4"], np.ndarray]:
    """Returns for each run of rows (second axis) the longest run of columns that is free in all of them.

    Each row holds first and last column, first and last row; the second value tells which runs have a column at all.
    """
    columns, rows = free.shape
    starts, ends = np.triu_indices(rows)
    counts = np.concatenate([np.zeros((columns, 1)), np.cumsum(free, axis=1)], axis=1)
    whole = (counts[:, ends + 1] - counts[:, starts]) == (ends - starts + 1)
    run, best = np.zeros(len(starts), np.int64), np.zeros(len(starts), np.int64)
    last = np.zeros(len(starts), np.int64)
    for k in range(columns):
        run = np.where(whole[k], run + 1, 0)
        better = run > best
        best, last = np.where(better, run, best), np.where(better, k, last)
    return np.stack([last - best + 1, last, starts, ends], axis=1), best > 0
