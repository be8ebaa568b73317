"""The pixels of a picture around what it shows: which of them lie on a border, and what is smoothed over them.

A pixel that lies on none shows one plain surface: one sample stands for all of it.
"""

from collections.abc import Iterator, Sequence
from itertools import product
from typing import final

import numpy as np
from PIL import Image

from grafu.dataclass import dataclass
from grafu.render.ray_scene import Hits, Rays
from grafu.shapes import Bool, Float32, Int

Grid = np.ndarray  # values of the pixels of a window, in rows and columns
Vectors = Float32[np.ndarray, "*_ 3"]
_NOTHING = -1
_MARGIN = 2  # pixels around what is shown: those beside it, which may lie on a border, and their neighbours
_BEND = float(np.cos(np.radians(14.0)))  # neighbours whose normals differ by more lie on a border
_STEP, _SHADE = 0.004, 0.04  # of the reach, of linear white: neighbours that differ by more lie on a border
_OPAQUE = 0.99
_DOWN = (slice(None, -1), slice(None)), (slice(1, None), slice(None))
_ASIDE = (slice(None), slice(None, -1)), (slice(None), slice(1, None))
_NEAREST = sorted(product((-1, 0, 1), repeat=2), key=lambda step: abs(step[0]) + abs(step[1]))


def surfaces_of(hits: Hits) -> Int[np.ndarray, " n"]:
    """Returns for each hit a number that is the same for one visual seen from one of six directions."""
    facing = np.argmax(np.abs(hits.flat_normal), axis=1) * 2 + (hits.flat_normal.sum(axis=1) > 0)
    return np.asarray(hits.visual.astype(np.int64) * 8 + facing)


def bend_and_step(normal: Vectors, other: Vectors, apart: Vectors) -> tuple[np.ndarray, np.ndarray]:
    """Returns the cosine between two unit normals, and how far one point lies off the other's face, twice, in metres.

    `apart` is the way from one point to the other.
    """
    return np.einsum("...k,...k->...", normal, other), np.abs(np.einsum("...k,...k->...", apart, normal + other))


@final
@dataclass(frozen=True, slots=True)
class PixelWindow:
    """The pixels around those of a picture that show something; some may lie beyond the picture.

    `place` is where each pixel that shows something stands in the window, `first` the row and column of the window's
    first pixel in the picture, `size` the picture's width and height.
    """

    size: tuple[int, int]
    first: tuple[int, int]
    shape: tuple[int, int]
    place: Int[np.ndarray, " n"]

    @classmethod
    def around(cls, pixels: Int[np.ndarray, " n"], size: tuple[int, int]) -> "PixelWindow":
        """Returns the window around the pixels of a picture that show something, given by number, row by row."""
        rows, columns = np.divmod(pixels, size[0])
        top, left = (int(at.min()) - _MARGIN if len(at) else 0 for at in (rows, columns))
        height, width = (int(at.max(initial=0)) + 1 + _MARGIN - at0 for at, at0 in ((rows, top), (columns, left)))
        return cls(size, (top, left), (height, width), (rows - top) * width + columns - left)

    def grid(self, values: np.ndarray, empty: float | int) -> Grid:
        """Returns the values of the pixels that show something in rows and columns."""
        grid = np.full((self.shape[0] * self.shape[1], *values.shape[1:]), empty, values.dtype)
        grid[self.place] = values
        return grid.reshape(*self.shape, *values.shape[1:])

    def on_borders(self, hits: Hits, points: Rays, reach: float) -> Bool[np.ndarray, "_ _"]:
        """Returns which pixels of the window differ from one above, below or beside them, or show glass.

        `points` are those of the hits; `reach` is that of the light, in metres.
        """
        visual, color = self.grid(hits.visual, _NOTHING), self.grid(hits.color, 0.0)
        normal, point = self.grid(hits.normal, 0.0), self.grid(points, 0.0)
        found = self.grid(hits.alpha < _OPAQUE, False)
        for a, b in (_DOWN, _ASIDE):
            bend, step = bend_and_step(normal[a], normal[b], point[b] - point[a])
            differ = (visual[a] >= 0) & ((bend < _BEND) | (step > _STEP * reach))
            differ |= (visual[a] != visual[b]) | (np.abs(color[a] - color[b]) > _SHADE).any(axis=2)
            found[a] |= differ
            found[b] |= differ
        return np.asarray(found)

    def pixels(self, chosen: Bool[np.ndarray, "_ _"]) -> Int[np.ndarray, " k"]:
        """Returns the numbers in the picture of chosen pixels of the window, without those beyond the picture."""
        rows, columns = (at + first for at, first in zip(np.nonzero(chosen), self.first, strict=True))
        within = (rows >= 0) & (rows < self.size[1]) & (columns >= 0) & (columns < self.size[0])
        return np.asarray(rows[within] * self.size[0] + columns[within])

    def nearest(
        self, surface: Grid, pixels: Int[np.ndarray, " k"], wanted: Int[np.ndarray, " k"]
    ) -> Int[np.ndarray, " k"]:
        """Returns which pixel of the window shows a wanted surface, of a pixel of the picture and the eight around it.

        It is a place as in `place`; -1 where none of the nine shows it.
        """
        rows, columns = np.divmod(pixels, self.size[0])
        place = (rows - self.first[0]) * self.shape[1] + columns - self.first[1]
        found, left, flat = np.full(len(pixels), _NOTHING), np.arange(len(pixels)), surface.reshape(-1)
        for down, aside in _NEAREST:
            at = place[left] + down * self.shape[1] + aside
            same = flat[at] == wanted[left]
            found[left[same]] = at[same]
            left = left[~same]
        return found


def smoothed(grids: Sequence[Grid], surface: Grid) -> list[Grid]:
    """Returns the means over the 4x4 pixels around each, of those that show the same surface."""
    totals, count = [grid.copy() for grid in grids], np.ones(surface.shape, np.float32)
    for here, there in _neighbours(*surface.shape):
        same = surface[here] == surface[there]
        count[here] += same
        for total, grid in zip(totals, grids, strict=True):
            total[here] += grid[there] * same
    return [total / count for total in totals]


def box_mean(grid: Grid) -> Grid:
    """Returns the mean over the 4x4 pixels around each."""
    padded = np.pad(grid, ((2, 1), (2, 1)), mode="edge")
    h, w = grid.shape
    rows = sum(padded[dy : dy + h] for dy in range(4))
    return np.asarray(sum(rows[:, dx : dx + w] for dx in range(4)) / 16)  # type: ignore[index, misc]


def any_in_blocks(chosen: Bool[np.ndarray, "_ _"], side: int) -> Bool[np.ndarray, "_ _"]:
    """Returns for each square block of a grid whether one of its values is chosen; the last blocks may be smaller."""
    for axis in (0, 1):
        chosen = np.logical_or.reduceat(chosen, np.arange(0, chosen.shape[axis], side), axis=axis)
    return chosen


def enlarged(grid: Grid, factor: int) -> Grid:
    """Returns a grid of 32 bits with so many times as many rows and columns, in between interpolated."""
    rows, columns = grid.shape
    size = (columns * factor, rows * factor)
    return np.asarray(Image.fromarray(grid).resize(size, Image.Resampling.BILINEAR))


def _neighbours(height: int, width: int) -> Iterator[tuple[tuple[slice, slice], tuple[slice, slice]]]:
    """Yields for each other step of a 4x4 pattern the pixels that have a neighbour there, and these neighbours."""
    for dy, dx in product(range(-2, 2), repeat=2):
        if dx or dy:
            here = (slice(max(0, -dy), height - max(0, dy)), slice(max(0, -dx), width - max(0, dx)))
            yield here, (slice(max(0, dy), height - max(0, -dy)), slice(max(0, dx), width - max(0, -dx)))
