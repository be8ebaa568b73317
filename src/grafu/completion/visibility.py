"""What of each part is seen along each axis, and what lies behind it: from points, by depth maps. No torch.

A front and a shelf may have one shape; a front is seen from the front, and has a hollow behind it.
"""

from typing import NamedTuple

import numpy as np

from grafu.shapes import Bool, Float32, Int64

DIRECTIONS = 6  # the viewer stands at -X, +X, -Y, +Y, -Z, +Z
FROM_THE_FRONT = 2  # -Y
VISIBILITY_NUMBERS = 3 * DIRECTIONS
_CELLS = 32  # of a depth map, along the object's largest side
_NEAR = 0.02  # of the object's size: what lies so little in front hides nothing
_FINE = 0.004  # of the object's size, as for face terms


class _Maps(NamedTuple):
    """Depth maps of n parts along one axis: the lowest and highest coordinate in each cell, and where there is one."""

    low: Float32[np.ndarray, "n c"]
    high: Float32[np.ndarray, "n c"]
    filled: Bool[np.ndarray, "n c"]


def visibility_of(
    anchors: Float32[np.ndarray, "n g 3"], groups: Float32[np.ndarray, "n g s 3"]
) -> Float32[np.ndarray, "n 18"]:
    """Returns three numbers for each of six directions: all visible fractions, then all distances, then all depths.

    The points are those of `GraphFeatures`. A part fills the cells of a depth map that its points lie in. The visible
    fraction (0..1) is that of its cells in which no other part lies in front. Over those cells, the distance is the
    mean from its surface to the next part behind (1 where there is none), the depth that of the part itself; both as
    fractions of the object's size d, as asinh(d / 0.004) / 5; 0 where nothing is visible.
    """
    count = len(anchors)
    points = (anchors[:, :, None] + groups).reshape(count, groups.shape[1] * groups.shape[2], 3)
    cells = np.clip((points + np.array([0.5, 0.5, 0.0], np.float32)) * _CELLS, 0, _CELLS - 1).astype(np.int64)
    found = np.zeros((3, count, DIRECTIONS), dtype=np.float32)
    for axis in range(3):
        u, v = (other for other in range(3) if other != axis)
        maps = _depth_maps(points[:, :, axis], cells[:, :, u] * _CELLS + cells[:, :, v])
        found[:, :, 2 * axis] = _seen_from_below(maps)
        found[:, :, 2 * axis + 1] = _seen_from_below(_Maps(-maps.high, -maps.low, maps.filled))
    found[1:] = np.arcsinh(found[1:] / _FINE) / 5.0
    return found.transpose(1, 0, 2).reshape(count, VISIBILITY_NUMBERS)


def _depth_maps(depths: Float32[np.ndarray, "n p"], cells: Int64[np.ndarray, "n p"]) -> _Maps:
    count = len(depths)
    places = (cells + (np.arange(count) * _CELLS**2)[:, None]).ravel()
    low = np.full(count * _CELLS**2, np.inf, dtype=np.float32)
    high = np.full_like(low, -np.inf)
    np.minimum.at(low, places, depths.ravel())
    np.maximum.at(high, places, depths.ravel())
    shape = (count, _CELLS**2)
    return _Maps(low.reshape(shape), high.reshape(shape), np.isfinite(low).reshape(shape))


def _seen_from_below(maps: _Maps) -> Float32[np.ndarray, "3 n"]:
    """Returns the visible fraction, the mean distance to what is behind and the mean depth, seen along the axis."""
    low, high = _grown(maps.low), -_grown(-maps.high)
    others = _lowest_of_others(low)
    seen = maps.filled & (maps.low <= others + _NEAR)
    cells = np.maximum(seen.sum(axis=1), 1)
    with np.errstate(invalid="ignore"):  # infinite less infinite, where there is nothing
        behind = np.where(seen, np.clip(others - maps.low, 0.0, 1.0), 0.0).sum(axis=1) / cells
        deep = np.where(seen, high - low, 0.0).sum(axis=1) / cells
    return np.stack([seen.sum(axis=1) / np.maximum(maps.filled.sum(axis=1), 1), behind, deep]).astype(np.float32)


def _grown(low: Float32[np.ndarray, "n c"]) -> Float32[np.ndarray, "n c"]:
    """Returns depth maps grown by a cell on each side: points are too few to fill all cells of a large part."""
    if not len(low):
        return low
    grid = np.pad(low.reshape(-1, _CELLS, _CELLS), ((0, 0), (1, 1), (1, 1)), constant_values=np.inf)
    grid = np.minimum(np.minimum(grid[:, :-2], grid[:, 1:-1]), grid[:, 2:])
    grid = np.minimum(np.minimum(grid[:, :, :-2], grid[:, :, 1:-1]), grid[:, :, 2:])
    return grid.reshape(len(low), -1)


def _lowest_of_others(low: Float32[np.ndarray, "n c"]) -> Float32[np.ndarray, "n c"]:
    """Returns for each part and cell the lowest of all other parts; infinite where there is none."""
    if len(low) < 2:
        return np.full_like(low, np.inf)
    first = low.argmin(axis=0)
    cells = np.arange(low.shape[1])
    lowest = low[first, cells]
    without = low.copy()
    without[first, cells] = np.inf
    found = np.broadcast_to(lowest, low.shape).copy()
    found[first, cells] = without.min(axis=0)
    return found
