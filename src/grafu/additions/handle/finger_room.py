"""Where fingers find something to pull at on a front: edges that they reach round, hollows, things to pinch.

It measures on the relief of a front and decides nothing about the front as a whole.
"""

from typing import final

import numpy as np

from grafu.additions.handle.grasp_config import FingerRoomConfig, GraspConfig
from grafu.additions.handle.relief import Grid, Relief
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mask, Points, Vec3, vec3
from grafu.shapes import Bool, Float, Int

Cells = Bool[np.ndarray, "n m"]
Step = tuple[int, int]

OPPOSITE_STEPS: tuple[tuple[Step, Step], ...] = (((-1, 0), (1, 0)), ((0, -1), (0, 1)))
STEPS: tuple[Step, ...] = ((1, 0), (-1, 0), (0, 1), (0, -1))
EDGE_CELLS = 1.7
"""Cells within which an edge lies before the cell that looks at it."""


@final
@dataclass(frozen=True, eq=False)
class Hooks:
    """Cells from which fingers reach round an edge towards `step`; all arrays have one row per cell.

    `lip` is the depth of the edge's face, `behind` where the room behind it begins, metres from the foremost plane.
    """

    step: Step
    cells: Int[np.ndarray, "k 2"]
    lip: Float[np.ndarray, " k"]
    behind: Float[np.ndarray, " k"]


def find_hooks(relief: Relief, config: GraspConfig, where: Cells) -> list[Hooks]:
    """Returns the cells from which fingers reach round an edge of the moving body, one of the four steps at a time."""
    return [_hooks_towards(relief, config, where, step) for step in STEPS]


def _hooks_towards(relief: Relief, config: GraspConfig, where: Cells, step: Step) -> Hooks:
    s, fingers = relief.factor, config.fingers
    lip = _shifted(relief.face, step)
    seen = lip <= _shifted(relief.first, step) + 1e-6
    able = where & np.isfinite(lip) & seen & (relief.first - lip >= s * config.reach)
    cells = np.argwhere(able)
    lip = lip[able]
    if not len(cells):
        return Hooks(step, cells, lip, lip)
    direction = vec3(float(step[0]), 0.0, float(step[1]))
    levels = np.arange(int((config.thickest + config.gap) / fingers.level) + 2)
    depths = lip[:, None] + s * (fingers.edge + fingers.level * levels)
    reached = _reaches(relief, cells, depths, direction)
    reached[depths > relief.first[able][:, None] - s * fingers.edge] = 0.0
    edge = np.where(reached < EDGE_CELLS * relief.cell, reached, np.inf)
    edge[depths - lip[:, None] > s * config.thickest] = np.inf
    edge = np.where(reached <= 0, np.inf, edge).min(axis=1)
    free = reached >= edge[:, None] + s * config.hook
    first, found = _first_run(free, int(np.ceil(config.gap / fingers.level)) + 1)
    rows = np.flatnonzero(found & np.isfinite(edge))
    start = depths[rows, first[rows]]
    good = _pulls(relief, cells[rows], start, edge[rows], direction, config, lip[rows])
    back = _reaches(relief, cells[rows], depths[rows], -direction)
    back[np.arange(depths.shape[1]) > first[rows][:, None]] = np.inf
    good &= back.min(axis=1) + edge[rows] >= s * config.gap
    kept = rows[good]
    return Hooks(step, cells[kept], lip[kept], start[good])


def _reaches(relief: Relief, cells: Int[np.ndarray, "k 2"], depths: Float[np.ndarray, "k d"], step: Vec3) -> np.ndarray:
    """Returns how far each cell sees along the front at each depth before it meets anything."""
    points = np.stack([*np.broadcast_arrays(relief.u[cells[:, :1]], depths, relief.v[cells[:, 1:]])], axis=-1)
    moving, others = relief.cast(points.reshape(-1, 3), step)
    return np.minimum(moving, others).reshape(depths.shape)


def _pulls(
    relief: Relief,
    cells: Int[np.ndarray, "k 2"],
    start: Float[np.ndarray, " k"],
    edge: Float[np.ndarray, " k"],
    step: Vec3,
    config: GraspConfig,
    lip: Float[np.ndarray, " k"],
) -> Mask:
    """Whether a fingertip behind the edge meets the moving body, and nothing else, when it is pulled back."""
    hook, tip = relief.factor * config.hook, config.fingers.tip * relief.factor
    tips = _points(relief, cells, start) + (edge + config.pull * hook)[:, None] * step
    moving, others = relief.cast(tips, vec3(0.0, -1.0, 0.0))
    return (moving <= others) & (moving <= start - lip + tip)


def _points(relief: Relief, cells: Int[np.ndarray, "k 2"], depth: Float[np.ndarray, " k"]) -> Points:
    return np.column_stack([relief.u[cells[:, 0]], depth, relief.v[cells[:, 1]]])


def _first_run(free: Bool[np.ndarray, "k d"], length: int) -> tuple[Int[np.ndarray, " k"], Mask]:
    """Returns for each row where its first run of so many true values begins, and whether it has one."""
    sums = np.cumsum(np.pad(free, ((0, 0), (1, 0))), axis=1)
    if sums.shape[1] <= length:
        return np.zeros(len(free), np.int64), np.zeros(len(free), bool)
    full = sums[:, length:] - sums[:, :-length] == length
    return np.argmax(full, axis=1), full.any(axis=1)


def _shifted(grid: Grid, step: Step, fill: float = np.inf) -> Grid:
    """Returns for each cell the value of its neighbour towards `step`."""
    n, m = grid.shape
    di, dj = step
    out = np.full_like(grid, fill)
    i, j = slice(max(-di, 0), n - max(di, 0)), slice(max(-dj, 0), m - max(dj, 0))
    out[i, j] = grid[max(di, 0) : n + min(di, 0), max(dj, 0) : m + min(dj, 0)]
    return out


def find_hollows(
    relief: Relief, deep: float, narrow: float, wide: float, where: Cells, config: FingerRoomConfig
) -> Cells:
    """Returns the cells of hollows in the face between steep walls, at least `deep` metres deep.

    They are between `narrow` and `wide` metres across.
    """
    return _walled(relief, (deep, narrow, wide), where, config, at_border=False)


def find_channels(
    relief: Relief, deep: float, narrow: float, wide: float, where: Cells, config: FingerRoomConfig
) -> Cells:
    """Returns the cells of hollows between one steep wall and the border of the outline; see `find_hollows`."""
    return _walled(relief, (deep, narrow, wide), where, config, at_border=True)


def _walled(
    relief: Relief, sizes: tuple[float, float, float], where: Cells, config: FingerRoomConfig, *, at_border: bool
) -> Cells:
    inside, found = _inside(relief), np.zeros(relief.face.shape, bool)
    shown = (relief.face <= relief.first + 1e-6) & np.isfinite(relief.face)
    seen = np.where(shown & inside, relief.face, np.nan)
    # What is seen through a hole or past a cut-out is its floor; beyond a finger's reach all is equally deep.
    past = inside & (relief.first >= relief.plane + sizes[0])
    seen = np.where(past, np.minimum(relief.first, relief.plane + config.through * relief.factor), seen)
    deep, least, most = sizes[0], *(max(round(width / relief.cell), 1) for width in sizes[1:])
    for steps in OPPOSITE_STEPS:
        wall = [_distance_to_wall(relief, seen, step, most, deep, config) for step in steps]
        pairs = [(wall[0], wall[1])]
        if at_border:
            border = [_distance_to_border(inside, step, most) for step in steps]
            pairs = [(wall[0], border[1]), (border[0], wall[1])]
        for a, b in pairs:
            found |= (a + b - 1 >= least) & (a + b - 1 <= most) & (a <= most) & (b <= most)
    return found & where & np.isfinite(seen)


def _inside(relief: Relief) -> Cells:
    box = relief.outline
    across = (relief.u > box.low[0]) & (relief.u < box.high[0])
    return across[:, None] & ((relief.v > box.low[2]) & (relief.v < box.high[2]))[None, :]


def _distance_to_wall(
    relief: Relief, seen: Grid, step: Step, most: int, rise: float, config: FingerRoomConfig
) -> Int[np.ndarray, "n m"]:
    """Returns for each cell how many cells on a steep wall rises from its level; `most` + 1: none within reach."""
    s = relief.factor
    run = max(round(s * config.steep / relief.cell), 1)
    steep = seen - _shifted(seen, (run * step[0], run * step[1]), np.nan) >= rise
    foot = np.where(steep, seen, np.nan)
    distance = np.full(seen.shape, most + 1)
    for k in range(most, -1, -1):
        level = _shifted(foot, (k * step[0], k * step[1]), np.nan)
        distance[np.abs(seen - level) <= s * config.flat] = max(k, 1)
    return distance


def _distance_to_border(inside: Cells, step: Step, most: int) -> Int[np.ndarray, "n m"]:
    """Returns for each cell how many cells on the outline ends; `most` + 1: farther."""
    distance = np.full(inside.shape, most + 1)
    grid = inside.astype(np.float64)
    for k in range(most, 0, -1):
        distance[_shifted(grid, (k * step[0], k * step[1]), 0.0) == 0.0] = k
    return distance


def find_ridges(relief: Relief, drop: float, wide: float, gap: float, where: Cells) -> Cells:
    """Returns the foremost cells that fingers can pinch: thin along an axis, and free on both sides.

    Free means that all lies `drop` metres lower for `gap` metres; `wide` is the most that lies between both sides.
    """
    seen = np.where(relief.face <= relief.first + 1e-6, relief.face, np.inf)
    counts, found = _counts(relief, wide, gap), np.zeros(seen.shape, bool)
    for steps in OPPOSITE_STEPS:
        ends = [_distance_to_drop(relief.first, seen, step, counts, drop) for step in steps]
        found |= ends[0] + ends[1] - 1 <= counts[0]
    return found & where & np.isfinite(seen)


def find_lips(relief: Relief, drop: float, wide: float, gap: float, where: Cells) -> Cells:
    """Returns the cells of narrow ledges that stand out along the border of the outline; see `find_ridges`."""
    inside = _inside(relief)
    seen = np.where((relief.face <= relief.first + 1e-6) & inside, relief.face, np.inf)
    beside = np.where(np.isfinite(seen), seen, -np.inf)
    counts, found = _counts(relief, wide, gap), np.zeros(seen.shape, bool)
    for steps in OPPOSITE_STEPS:
        free = [_distance_to_drop(beside, seen, step, counts, drop) for step in steps]
        border = [_distance_to_border(inside, step, counts[0]) for step in steps]
        found |= (free[0] + border[1] - 1 <= counts[0]) | (border[0] + free[1] - 1 <= counts[0])
    return found & where & np.isfinite(seen)


def _counts(relief: Relief, wide: float, gap: float) -> tuple[int, int]:
    return max(int(wide / relief.cell), 1), max(round(gap / relief.cell), 1)


def _distance_to_drop(
    first: Grid, seen: Grid, step: Step, counts: tuple[int, int], drop: float
) -> Int[np.ndarray, "n m"]:
    """Returns for each cell how many cells on all lies lower by `drop`, for some cells; one more than the most: not so.

    `counts` are the most cells to look at, and how many must be free.
    """
    most, clear = counts
    low = first
    for k in range(1, clear):
        low = np.minimum(low, _shifted(first, (k * step[0], k * step[1])))
    distance = np.full(seen.shape, most + 1)
    finite = np.where(np.isfinite(seen), seen, 0.0)
    for k in range(most, 0, -1):
        distance[_shifted(low, (k * step[0], k * step[1])) - finite >= drop] = k
    return distance
