"""Whether furniture is open from above, and whether new tops replace those that were taken away.

By rays, which share nothing with what makes tops. The measure of a new top is the plan that the piece's own top lay
over: of all that one saw of it from above, what lies over the body. Near its upper end the body's plan is all that
reaches there, and what lies between, so kneeholes and rooms belong to it and overhangs do not: they are not known
from the body alone. What stands up through a top is no part of it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

import numpy as np
from jaxtyping import Bool, Float, Int

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster

Field = Float[np.ndarray, "x y"]
Mask = Bool[np.ndarray, "x y"]
Counts = Int[np.ndarray, "x y"]

_DIRECTIONS = ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0))
_CELLS = 160  # along the longer side
_NEAR = 0.1  # of the piece's height: what ends farther below a top does not stand under it
_LEVEL = 0.1  # of the height: tops that differ by less are one, stepped at most
_OPEN = 0.06  # of the height: what lies so far below a top does not cover in its place
_LEAST = 0.15  # of the whole plan: smaller tops lie in niches
_HOLLOW = 0.5  # of the plan under a top: less is no loss, other boards cover the rest
_RIM = 0.98  # of what one sees from above lies lower than the rim: mirrors, posts and finials stand higher
_SIDES = 3  # walls around a room
_DEEP = 0.5  # of the rim's height
_SKIN = 0.001  # of the largest side: a top may be inset so deep


@final
@dataclass(frozen=True)
class LostTop:
    """What becomes of a top that was taken away: `level` is the height of its face, metres.

    `hollow` is the fraction of the plan under it that lies open without it, `covered` the fraction of that plan that
    new tops lie over at about its height.
    """

    level: float
    hollow: float
    covered: float

    @property
    def is_missed(self) -> bool:
        """Whether most of what it lay over is open without it."""
        return self.hollow >= _HOLLOW


def lost_tops(
    taken: Sequence[TriangleMesh],
    still: Sequence[TriangleMesh],
    moving: Sequence[TriangleMesh],
    added: Sequence[TriangleMesh],
) -> tuple[LostTop, ...]:
    """Returns what becomes of tops that were taken away, those of one height as one, the highest first.

    `still` and `moving` are what is left, closed, without handles; `added` are the new tops. Tops over less than 15 %
    of the piece's plan are left out.

    Raises:
        ValueError: if nothing was taken away, or nothing is left.
    """
    if not taken or not still:
        raise ValueError(f"`taken` and `still` must be meshes: got {len(taken)} and {len(still)}")
    grid = _Grid([*taken, *still, *moving])
    rest, covers, new = grid.heights([*still, *moving]), grid.heights(still), [grid.heights([top]) for top in added]
    everything = np.isfinite(np.maximum(rest, grid.heights(taken)))
    found = []
    for group in _by_level(taken, _LEVEL * grid.height):
        own, under = grid.heights(group), grid.undersides(group)
        near = min(float(mesh.box.low[2]) for mesh in group) - _NEAR * grid.height
        plan = (own > rest) & grid.between(rest >= near, [*still, *moving], near)
        if plan.sum() < max(_LEAST * everything.sum(), 1.0):
            continue
        hollow = covers[plan] < under[plan] - _OPEN * grid.height
        least = np.maximum(rest - _SKIN * grid.extent, own - _NEAR * grid.height)[plan]
        covered = [(top[plan] > least) & (top[plan] <= own[plan] + _NEAR * grid.height) for top in new]
        ratio = float(np.logical_or.reduce(covered).mean()) if covered else 0.0
        found.append(LostTop(float(np.median(own[plan])), float(hollow.mean()), ratio))
    return tuple(found)


def open_ratio(meshes: Sequence[TriangleMesh]) -> float:
    """Returns the fraction of the plan of furniture, closed, without handles, that lies open from above.

    There one looks past the rim into a room that is walled on three sides, or down by more than half the height, as
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
    rim = float(np.quantile(rises[np.isfinite(rises)], _RIM))
    walled = grid.walls(meshes, grid.floor + (1 - 0.5 * _OPEN) * rim) >= _SIDES
    is_open = (rises < (1 - _OPEN) * rim) & (walled | (rises < _DEEP * rim))
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
