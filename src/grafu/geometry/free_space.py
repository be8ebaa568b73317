"""Empty axis-aligned boxes among occupied ones, and grids of cells as boxes. Numbers only.

A stack of boxes is an array: for each box its low corner, then its high corner.
"""

import numpy as np

from grafu.geometry.arrays import Indices, Points, Vec3
from grafu.shapes import Bool, Float, Int

Bounds = Float[np.ndarray, "_ 2 3"]
CellBounds = Int[np.ndarray, "_ 2 3"]
OneBox = Float[np.ndarray, "2 3"]
SomePoints = Float[np.ndarray, "_ 3"]
Grid = Bool[np.ndarray, "x y z"]


def maximal_empty_boxes(container: OneBox, occupied: Bounds, least: Vec3) -> Bounds:
    """Returns all boxes in a container that meet no occupied box and that no side can leave without meeting one.

    Boxes may share faces with occupied ones. Those with a side shorter than `least` (or without any extent) are left
    out. The boxes overlap one another, as maximal boxes do; their order is not defined.
    """
    empty = container[None].astype(np.float64)
    empty = empty[_is_large(empty, least)]
    sizes = np.prod(np.maximum(occupied[:, 1] - occupied[:, 0], 0.0), axis=1)
    for box in occupied[np.argsort(-sizes, kind="stable")]:  # large ones first: they leave fewer boxes to split
        empty = without(empty, box, least)
    return empty


def without(empty: Bounds, taken: OneBox, least: Vec3) -> Bounds:
    """Returns the maximal empty boxes that are left of maximal empty boxes when one more box is taken.

    A taken box without extent along some axis takes nothing.
    """
    if not (taken[1] > taken[0]).all():
        return empty
    met = ((empty[:, 0] < taken[1]) & (empty[:, 1] > taken[0])).all(axis=1)
    if not met.any():
        return empty
    pieces = [_beside(empty[met], taken, axis, side) for axis in range(3) for side in (0, 1)]
    new = np.concatenate(pieces)
    new = new[_is_large(new, least)]
    kept = empty[~met]
    new = new[~_within(new, kept).any(axis=1)]
    return np.concatenate([kept, _maximal(new)])


def cell_boxes(cells: Grid) -> CellBounds:
    """Returns disjoint boxes of whole cells that together are exactly the true cells of a grid (high ends exclusive).

    Runs along the last axis are joined along the middle, then along the first axis where they are alike.
    """
    padded = np.pad(cells, ((0, 0), (0, 0), (1, 1))).astype(np.int8)
    steps = np.diff(padded, axis=2)
    low, high = np.argwhere(steps == 1), np.argwhere(steps == -1)
    boxes = np.stack([low, high + np.array([1, 1, 0])], axis=1)
    for axis in (1, 0):
        boxes = _joined(boxes, axis)
    return boxes


def _beside(boxes: Bounds, taken: OneBox, axis: int, side: int) -> Bounds:
    """Returns what is left of boxes before (0) or behind (1) a taken box along an axis."""
    pieces = boxes.copy()
    pieces[:, 1 - side, axis] = taken[side, axis]
    return pieces


def _is_large(boxes: Bounds, least: Vec3) -> Bool[np.ndarray, " _"]:
    sizes = boxes[:, 1] - boxes[:, 0]
    large: Bool[np.ndarray, " _"] = ((sizes >= least) & (sizes > 0)).all(axis=1)
    return large


def _within(inner: Bounds, outer: Bounds) -> Bool[np.ndarray, "_ _"]:
    """Whether each of some boxes lies in each of others."""
    low = (inner[:, None, 0] >= outer[None, :, 0]).all(axis=2)
    high = (inner[:, None, 1] <= outer[None, :, 1]).all(axis=2)
    return np.logical_and(low, high)


def _maximal(boxes: Bounds) -> Bounds:
    """Returns the boxes that lie in no other; of equal ones the first."""
    inside = _within(boxes, boxes)
    earlier = np.tri(len(boxes), k=-1, dtype=bool)
    return boxes[~(inside & (~inside.T | earlier)).any(axis=1)]


def _joined(boxes: CellBounds, axis: int) -> CellBounds:
    """Returns boxes with those joined that follow one another along an axis and are alike along the others."""
    if not len(boxes):
        return boxes
    a, b = (k for k in range(3) if k != axis)
    order = np.lexsort((boxes[:, 0, axis], boxes[:, 1, b], boxes[:, 0, b], boxes[:, 1, a], boxes[:, 0, a]))
    boxes = boxes[order]
    alike = (boxes[1:][:, :, [a, b]] == boxes[:-1][:, :, [a, b]]).all(axis=(1, 2))
    starts = np.flatnonzero(np.append(True, ~(alike & (boxes[1:, 0, axis] == boxes[:-1, 1, axis]))))
    joined = boxes[starts].copy()
    joined[:, 1, axis] = boxes[np.append(starts[1:] - 1, len(boxes) - 1), 1, axis]
    return joined


def cells_met(points: Points, origin: Vec3, cell: float, shape: tuple[int, int, int]) -> Grid:
    """Returns the grid in which the cells that hold a point are true; points outside the grid are left out.

    `origin` is the low corner of the first cell, `cell` the side of each, both in metres.
    """
    grid = np.zeros(shape, dtype=bool)
    index = np.floor((points - origin) / cell).astype(np.int32)
    if not ((index.min(axis=0, initial=0) >= 0) & (index.max(axis=0, initial=0) < shape)).all():
        index = index[((index >= 0) & (index < shape)).all(axis=1)]
    grid.reshape(-1)[(index[:, 0] * shape[1] + index[:, 1]) * shape[2] + index[:, 2]] = True
    return grid


def points_on(triangles: Float[np.ndarray, "_ 3 3"], spacing: float) -> SomePoints:
    """Returns points on triangles, the corners among them; none of the surface is farther than 1.2 x `spacing`.

    They lie in rows from the corner before the longest side: on the two halves of a rectangle, along its longer sides.
    """
    sides = np.linalg.norm(np.roll(triangles, -1, axis=1) - triangles, axis=2)
    large = sides.max(axis=1) > spacing
    longest = sides[large].argmax(axis=1)
    rows = np.arange(len(longest))
    a, b, c = (triangles[large][rows, (longest + 2 + k) % 3] for k in range(3))
    legs = np.linalg.norm(b - a, axis=1), np.linalg.norm(c - a, axis=1)
    swap = (legs[1] > legs[0] * (1 + 1e-9))[:, None]
    b, c = np.where(swap, c, b), np.where(swap, b, c)  # the same side in both halves of a rectangle
    height = np.linalg.norm(np.cross(b - a, c - a), axis=1) / np.maximum(np.maximum(*legs), 1e-300)
    blunt = ((b - a) * (c - a)).sum(axis=1) < 0.0  # the last corner lies beyond the rows' ends, however low
    reach = np.where(blunt, np.minimum(*legs), height)
    lines = np.maximum(np.ceil(reach / spacing - 1e-9), 1.0).astype(np.int64)
    return np.concatenate([triangles.reshape(-1, 3), _in_rows(a, b - a, c - a, lines, spacing)])


def _in_rows(corner: SomePoints, along: SomePoints, up: SomePoints, lines: Indices, spacing: float) -> SomePoints:
    """Returns points in so many rows on triangles that two sides span from a corner; the last corner is no row."""
    owner = np.repeat(np.arange(len(corner)), lines)
    ratio = _counted(lines) / lines[owner]
    starts = corner[owner] + ratio[:, None] * up[owner]
    rows = (1 - ratio)[:, None] * along[owner]
    counts = np.ceil(np.linalg.norm(rows, axis=1) / spacing - 1e-9).astype(np.int64) + 1
    step = _counted(counts) / np.repeat(np.maximum(counts - 1, 1), counts)
    points = np.repeat(starts, counts, axis=0)
    points += step[:, None] * np.repeat(rows, counts, axis=0)
    return points


def _counted(counts: Indices) -> Int[np.ndarray, " _"]:
    """Returns 0, 1, ... up to each count, one after another."""
    return np.arange(int(counts.sum())) - np.repeat(np.cumsum(counts) - counts, counts)
