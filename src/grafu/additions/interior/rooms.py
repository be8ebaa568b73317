"""Disjoint boxes of free cells that lie between walls: where compartments may be, to the cell.

Of all maximal empty boxes the largest that has a wall on both sides is taken, then the largest of what is left: so a
vase in a cabinet does not cost it the room above the vase. What is left in front of a vase, open to a room that was
taken, is no room of its own.

Which free cells lie inside storage furniture, by what closes them along the six directions.

A cell is inside when walls stand on both sides, and what is below and above closes it as far as its kind of opening
needs. So the space under a table is not inside (no floor, no door), nor that between legs (no walls).
"""

from collections.abc import Iterator, Sequence
from dataclasses import field
from typing import NamedTuple, final

import numpy as np

from grafu.additions.interior.config import RoomConfig, Sizes
from grafu.additions.interior.occupied import Taken
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.free_space import Bounds, Grid, OneBox, cell_boxes, maximal_empty_boxes, without

# Faces as in `Box.face_center`: -X, +X, -Y, +Y, -Z, +Z.
FRONTS = (2, 3, 0, 1)  # openings that shelves and dividers may face, the usual one first
LID = 5
LEAST_WALLS = 3  # of a wing, beside its floor and ceiling


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


def inside_cells_of(taken: Taken) -> Grid:
    """Returns the free cells inside furniture, whichever way it opens, in rooms of any shape.

    So also before an angled door, and in the wing of a corner piece, which opens to the side: floor and ceiling stand
    there, and three walls, or a door beside a wall.
    """
    still = [_met(taken.walls, face) for face in range(6)]
    doors = [_met(taken.doors, face) for face in range(4)]
    met = [wall | door for wall, door in zip(still[:4], doors, strict=True)]
    walls = np.sum(still[:4], axis=0, dtype=np.int8) >= LEAST_WALLS
    surrounded = np.logical_and.reduce([*met, still[4] | still[5]])
    winged = np.logical_and.reduce([walls, still[4], still[5]])
    return np.logical_or.reduce([taken.free & (surrounded | winged), *enclosed_cells(taken).values()])


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


SIDE_AXES = {"z": (0, 1), "y": (0,), "x": (1,)}  # the axes along which walls must stand on both sides

FRONT_FACES = {"z": ((2, True),), "y": ((1, False), (1, True)), "x": ((0, False), (0, True))}


@final
@dataclass
class _Search:
    """What is taken, and the cells of the rooms found so far; it changes as rooms are found."""

    taken: Taken
    steps: int
    config: RoomConfig
    used: Grid = field(init=False)

    def __post_init__(self) -> None:
        self.used = np.zeros_like(self.taken.still)


def find_rooms(taken: Taken, sizes: Sizes, config: RoomConfig) -> list[tuple[str, Box]]:
    """Returns disjoint boxes of enclosed free cells (metres), each with the axis along which it opens."""
    search = _Search(taken, max(int(sizes.least_side / sizes.cell), 2), config)
    found: list[tuple[str, Box]] = []
    for opens, cells in enclosed_cells(taken).items():
        for box in _rooms_in(cells & ~search.used, opens, search):
            low, high = taken.origin + box * taken.cell
            found.append((opens, Box(low, high)))
    return found


def odd_rooms(taken: Taken, found: Sequence[Box], sizes: Sizes, config: RoomConfig) -> list[tuple[int, Box]]:
    """Returns for each closed space that holds no room yet its largest box (metres), and the face that it opens to.

    Such are rooms under a slope or before a round wall: no box in them has walls on both sides.
    """
    from scipy.ndimage import find_objects, label  # local: most commands need no interiors

    steps = max(int(sizes.least_side / sizes.cell), 2)
    inside = inside_cells_of(taken)
    names, count = label(inside)
    large = opened(inside, (steps,) * 3)
    for box in found:
        ends = np.round((np.stack([box.low, box.high]) - taken.origin) / taken.cell)
        held = np.unique(names[_slices(ends)])
        large &= ~np.isin(names, held[held > 0])
    left = np.unique(names[large])
    rooms = []
    for number, region in enumerate(find_objects(names, count), start=1):
        opening = _odd_opening(names == number, taken.walls, config) if number in left else None
        if opening is None:
            continue
        start = np.array([s.start for s in region], dtype=np.float64)
        own = large[region] & (names[region] == number)
        least = np.full(3, float(steps))
        whole = np.stack([np.zeros(3), np.array(own.shape, dtype=np.float64)])
        empty = maximal_empty_boxes(whole, cell_boxes(~own).astype(np.float64), least)
        if len(empty):
            low, high = (
                taken.origin + (empty[np.argmax(np.prod(empty[:, 1] - empty[:, 0], axis=1))] + start) * taken.cell
            )
            rooms.append((opening, Box(low, high)))
    return rooms


def _odd_opening(cells: Grid, walls: Grid, config: RoomConfig) -> int | None:
    """Returns the level face that a space opens to if it is closed on all others."""
    closed = []
    for face in range(6):
        axis, is_high = divmod(face, 2)
        step = 1 if is_high else -1
        last = cells & ~np.roll(cells, -step, axis=axis)
        closed.append(float(np.roll(walls, -step, axis=axis)[last].mean()) if last.any() else 0.0)
    opening = int(np.argmin(closed[:4]))
    others = [ratio for face, ratio in enumerate(closed) if face != opening]
    return opening if min(others) >= config.closed_cells > closed[opening] else None


def _rooms_in(cells: Grid, opens: str, search: _Search) -> Iterator[OneBox]:
    """Yields boxes of cells, no side shorter than the least, one connected space after the other."""
    if not cells.any():
        return
    from scipy.ndimage import find_objects, label  # local: most commands need no interiors

    least = np.full(3, float(search.steps))
    names, _ = label(opened(cells, (search.steps,) * 3))
    for number, region in enumerate(find_objects(names), start=1):
        own = names[region] == number
        start = np.array([s.start for s in region], dtype=np.float64)
        whole = np.stack([np.zeros(3), np.array(own.shape, dtype=np.float64)])
        empty = maximal_empty_boxes(whole, cell_boxes(~own).astype(np.float64), least)
        while (box := _largest_room(empty, start, opens, search)) is not None:
            placed = box + start
            search.used[_slices(placed)] = True
            yield placed
            empty = without(empty, box, least)


def _largest_room(empty: Bounds, start: np.ndarray, opens: str, search: _Search) -> OneBox | None:
    """Returns the largest of some boxes that is a room."""
    order = np.argsort(-np.prod(empty[:, 1] - empty[:, 0], axis=1), kind="stable")
    return next((empty[k] for k in order if _is_room(empty[k] + start, opens, search)), None)


def _is_room(box: OneBox, opens: str, search: _Search) -> bool:
    walls, config = search.taken.walls, search.config
    for axis in SIDE_AXES[opens]:
        for is_high in (False, True):
            beyond = walls[_beyond(box, axis, is_high, config.wall_cells)]
            if not beyond.size or beyond.any(axis=axis).mean() < config.walled:
                return False
    fronts = (
        search.taken.still[_beyond(box, axis, is_high, config.wall_cells)].any(axis=axis)
        for axis, is_high in FRONT_FACES[opens]
    )
    if all(front.size and front.mean() >= config.closed_cells for front in fronts):
        return False
    layers = (search.used[_beyond(box, axis, is_high, 1)] for axis in range(3) for is_high in (False, True))
    return all(not layer.size or layer.mean() < config.taken for layer in layers)


def _beyond(box: OneBox, axis: int, is_high: bool, depth: int) -> tuple[slice, ...]:
    """Returns the cells in so many layers outside one face of a box of cells."""
    found = list(_slices(box))
    low, high = found[axis].start, found[axis].stop
    found[axis] = slice(high, high + depth) if is_high else slice(max(low - depth, 0), low)
    return tuple(found)


def _slices(box: OneBox) -> tuple[slice, ...]:
    return tuple(slice(int(a), int(b)) for a, b in box.T)
