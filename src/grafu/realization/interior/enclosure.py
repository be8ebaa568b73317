"""Which free cells lie inside storage furniture, by what closes them along the six directions. It makes no boxes.

A cell is inside when walls stand on both sides, and what is below and above closes it as far as its kind of opening
needs. So the space under a table is not inside (no floor, no door), nor that between legs (no walls).
"""

from typing import NamedTuple

import numpy as np

from grafu.geometry.free_space import Grid
from grafu.realization.interior.occupied import Taken

# Faces as in `Box.face_center`: -X, +X, -Y, +Y, -Z, +Z.
FRONTS = (2, 3, 0, 1)  # openings that shelves and dividers may face, the usual one first
LID = 5


class _Closed(NamedTuple):
    """For each of the six directions the cells from which something is met that way."""

    still: tuple[Grid, ...]
    moving: tuple[Grid, ...]


def enclosed_cells(taken: Taken) -> dict[str, Grid]:
    """Returns the cells inside furniture that opens upwards under a lid, along y, and along x."""
    still = tuple(_met(taken.walls, face) for face in range(6))
    if not taken.doors.any():  # nothing but a door opens a lid or a side
        return {"y": taken.free & _opens_along(_Closed(still, (taken.doors,) * 6), 1)}
    moving = tuple(_met(taken.doors, face) for face in range(6))
    closed = _Closed(still, moving)
    return {
        "z": taken.free & _opens_up(closed),
        "y": taken.free & _opens_along(closed, 1),
        "x": taken.free & _opens_along(closed, 0),
    }


def _opens_along(closed: _Closed, axis: int) -> Grid:
    """Returns the cells with walls to both sides of an opening along a level axis, and closed below and above.

    Either floor or ceiling may be missing where there is a wall behind and something in front: then it is a cabinet
    that lacks its top or bottom.
    """
    side, front, back = 2 * (1 - axis), 2 * axis, 2 * axis + 1
    between = closed.still[side] & closed.still[side + 1]
    below, above = closed.still[4], closed.still[5]
    fronted = _backed(closed, front, back) | _backed(closed, back, front)
    if axis == 0:  # nothing but a door makes a side of furniture its front
        between = between & (closed.moving[front] | closed.moving[back])
    return between & ((below & above) | ((below | above) & fronted))


def _backed(closed: _Closed, front: int, back: int) -> Grid:
    return closed.still[back] & (closed.moving[front] | closed.still[front])


def _opens_up(closed: _Closed) -> Grid:
    around = closed.still[0] & closed.still[1] & closed.still[2] & closed.still[3]
    return around & closed.still[4] & closed.moving[LID]


def _met(cells: Grid, face: int) -> Grid:
    """Returns the cells from which some cell is met in the direction of a face."""
    axis, is_high = divmod(face, 2)
    ordered = np.flip(cells, axis) if is_high else cells
    met = np.logical_or.accumulate(ordered, axis=axis)
    return np.flip(met, axis) if is_high else met


def opened(cells: Grid, least: tuple[int, int, int]) -> Grid:
    """Returns the cells that some box of `least` cells holds, all of it true: slits and corners go."""
    low = cells
    for axis, length in enumerate(least):
        low = _windows(low, axis, length) == length
    for axis, length in enumerate(least):
        pad = [(0, 0)] * 3
        pad[axis] = (length - 1, length - 1)
        low = _windows(np.pad(low, pad), axis, length) > 0
    return low


def _windows(cells: Grid, axis: int, length: int) -> np.ndarray:
    """Returns how many of each `length` cells in a row along an axis are true, by the first of them."""
    pad = [(0, 0)] * 3
    pad[axis] = (1, 0)
    total = np.pad(np.cumsum(cells, axis=axis, dtype=np.int32), pad)
    count = max(cells.shape[axis] - length + 1, 0)
    later = np.take(total, np.arange(length, length + count), axis=axis) if count else total.take([], axis=axis)
    return later - np.take(total, np.arange(count), axis=axis)
