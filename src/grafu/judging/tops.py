"""Whether furniture is open from above, and whether new tops replace those that were taken away.

By rays, which share nothing with what makes tops. The measure of a new top is the plan that the piece's own top lay
over: of all that one saw of it from above, what lies over the body. Near its upper end the body's plan is all that
reaches there, and what lies between, so kneeholes and rooms belong to it and overhangs do not: they are not known
from the body alone. What stands up through a top is no part of it.
"""

from collections.abc import Sequence
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import median
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.shapes import Bool, Float, Int

Field = Float[np.ndarray, "x y"]
Mask = Bool[np.ndarray, "x y"]
Counts = Int[np.ndarray, "x y"]

_DIRECTIONS = ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0))
_CELLS = 160  # along the longer side


@final
@dataclass(frozen=True, slots=True)
class TopMeasureConfig:
    """What counts as open from above, and as covered.

    Raises:
        ValueError: if a number is not a fraction.
    """

    near: float = 0.1
    """What ends farther below a top does not stand under it (fraction of the piece's height)."""
    level: float = 0.1
    """Tops that differ by less are one, stepped at most (fraction of the height)."""
    opened: float = 0.06
    """What lies so far below a top does not cover in its place (fraction of the height)."""
    least: float = 0.15
    """Smaller tops lie in niches (fraction of the whole plan)."""
    hollow: float = 0.5
    """Less of the plan under a top is no loss: other boards cover the rest (fraction)."""
    rim: float = 0.98
    """So much of what one sees from above lies lower than the rim: mirrors and posts stand higher (fraction)."""
    deep: float = 0.5
    """A room that is not walled is open where it is this deep (fraction of the rim's height)."""
    skin: float = 0.001
    """How deep a top may be inset (fraction of the largest side)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__slots__)


DEFAULT_TOP_MEASURE_CONFIG = TopMeasureConfig()
_SIDES = 3  # walls around a room


@final
@dataclass(frozen=True)
class LostTop:
    """What becomes of a top that was taken away: `level` is the height of its face, metres.

    `hollow` is the fraction of the plan under it that lies open without it, `covered` the fraction of that plan that
    new tops lie over at about its height. `is_missed` states that most of what it lay over is open without it.
    """

    level: float
    hollow: float
    covered: float
    is_missed: bool


def lost_tops(
    taken: Sequence[TriangleMesh],
    still: Sequence[TriangleMesh],
    moving: Sequence[TriangleMesh],
    added: Sequence[TriangleMesh],
    config: TopMeasureConfig = DEFAULT_TOP_MEASURE_CONFIG,
) -> tuple[LostTop, ...]:
    """Returns what becomes of tops that were taken away, those of one height as one, the highest first.

    `still` and `moving` are what is left, closed, without handles; `added` are the new tops. Small tops
    (`TopMeasureConfig.least`) are left out.

    Raises:
        ValueError: if nothing was taken away, or nothing is left.
    """
    if not taken or not still:
        raise ValueError(f"`taken` and `still` must be meshes: got {len(taken)} and {len(still)}")
    grid = _Grid([*taken, *still, *moving])
    rest, covers, new = grid.heights([*still, *moving]), grid.heights(still), [grid.heights([top]) for top in added]
    everything = np.isfinite(np.maximum(rest, grid.heights(taken)))
    found = []
    for group in _by_level(taken, config.level * grid.height):
        own, under = grid.heights(group), grid.undersides(group)
        near = min(float(mesh.box.low[2]) for mesh in group) - config.near * grid.height
        plan = (own > rest) & grid.between(rest >= near, [*still, *moving], near)
        if plan.sum() < max(config.least * everything.sum(), 1.0):
            continue
        hollow = covers[plan] < under[plan] - config.opened * grid.height
        least = np.maximum(rest - config.skin * grid.extent, own - config.near * grid.height)[plan]
        covered = [(top[plan] > least) & (top[plan] <= own[plan] + config.near * grid.height) for top in new]
        ratio = float(np.logical_or.reduce(covered).mean()) if covered else 0.0
        is_missed = float(hollow.mean()) >= config.hollow
        found.append(LostTop(median(own[plan]), float(hollow.mean()), ratio, is_missed))
    return tuple(found)


def open_ratio(meshes: Sequence[TriangleMesh], config: TopMeasureConfig = DEFAULT_TOP_MEASURE_CONFIG) -> float:
    """Returns the fraction of the plan of furniture, closed, without handles, that lies open from above.

    There one looks past the rim into a room that is walled on three sides, or far down (`TopMeasureConfig.deep`), as
    between legs. What lies lower but is neither is the desk before its hutch, or the uppermost shelf of a rack.

    Raises:
        ValueError: if there is no mesh.
    """
    if not meshes:
        raise ValueError("`meshes` must be furniture: got none")
    grid = _Grid(meshes)
    rises = grid.heights(meshes) - grid.floor
    plan = grid.between(np.isfinite(rises), meshes, grid.floor)
    if not np.isfinite(rises).any():
        return 0.0
    rim = float(np.quantile(rises[np.isfinite(rises)], config.rim))
    walled = grid.walls(meshes, grid.floor + (1 - 0.5 * config.opened) * rim) >= _SIDES
    is_open = (rises < (1 - config.opened) * rim) & (walled | (rises < config.deep * rim))
    return float(is_open[plan].mean())


class _Grid:
    """Rays straight down over the plan of some meshes."""

    def __init__(self, meshes: Sequence[TriangleMesh]) -> None:
        whole = Box.enclosing(mesh.box for mesh in meshes)
        low, high = whole.low, whole.high
        self.extent, self.height, self.floor = float((high - low).max()), float(high[2] - low[2]), float(low[2])
        self.low, self.cell = low[:2], float((high - low)[:2].max()) / _CELLS
        x, y = (np.arange(low[k] + self.cell / 2, high[k], self.cell) for k in (0, 1))
        self.shape = len(x), len(y)
        plan = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
        self.starts = np.column_stack([plan, np.full(len(plan), high[2] + self.extent)])

    def heights(self, meshes: Sequence[TriangleMesh]) -> Field:
        """Returns the z of what is met first in each cell; minus infinity where nothing is."""
        if not meshes:
            return np.full(self.shape, -np.inf)
        found = self.starts[:, 2] - RayCaster(merge_meshes(meshes)).along(self.starts, np.array([0.0, 0.0, -1.0]))
        return np.asarray(found).reshape(self.shape)

    def undersides(self, meshes: Sequence[TriangleMesh]) -> Field:
        """Returns the z of what is met first from below in each cell; infinity where nothing is."""
        starts = self.starts - np.array([0.0, 0.0, self.height + 2 * self.extent])
        found = starts[:, 2] + RayCaster(merge_meshes(meshes)).along(starts, np.array([0.0, 0.0, 1.0]))
        return np.asarray(found).reshape(self.shape)

    def walls(self, meshes: Sequence[TriangleMesh], height: float) -> Counts:
        """Returns towards how many sides of four one meets something from each cell at a height."""
        starts = np.column_stack([self.starts[:, :2], np.full(len(self.starts), height)])
        caster = RayCaster(merge_meshes(meshes))
        met = [np.isfinite(caster.along(starts, np.array([*direction, 0.0]))) for direction in _DIRECTIONS]
        return np.sum(met, axis=0).reshape(self.shape)

    def between(self, stands: Mask, meshes: Sequence[TriangleMesh], least: float) -> Mask:
        """Returns what lies between marked cells and corners of meshes from a height on: rays pass by thin sheets."""
        points = np.concatenate([m.vertices[np.unique(m.faces)] for m in meshes])
        points = points[points[:, 2] >= least][:, :2]
        if not len(points):
            return stands
        found, at = stands.copy(), np.floor((points - self.low) / self.cell).astype(np.int64)
        found[tuple(np.clip(at, 0, np.array(self.shape) - 1).T)] = True
        middles = self.starts[:, :2]
        within = np.all((middles >= points.min(axis=0)) & (middles <= points.max(axis=0)), axis=1)
        return stands | (_between(_between(found)) & within.reshape(self.shape))


def _by_level(tops: Sequence[TriangleMesh], step: float) -> list[list[TriangleMesh]]:
    """Returns tops in groups of one height, the highest first."""
    groups: list[list[TriangleMesh]] = []
    for mesh in sorted(tops, key=lambda mesh: -float(mesh.box.high[2])):
        if groups and float(groups[-1][-1].box.high[2] - mesh.box.high[2]) <= step:
            groups[-1].append(mesh)
        else:
            groups.append([mesh])
    return groups


def _between(stands: Mask) -> Mask:
    """Returns the cells with something on both sides along X or along Y, or on themselves."""
    found = stands.copy()
    for axis in (0, 1):
        before = np.logical_or.accumulate(stands, axis=axis)
        found |= before & np.flip(np.logical_or.accumulate(np.flip(stands, axis), axis=axis), axis)
    return found
