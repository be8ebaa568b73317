"""What bounds a box of free space: rays from its middle to the still and the moving meshes around it."""

from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.additions.interior.occupied import is_drawer
from grafu.geometry.arrays import Points, Vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes, triangle_bounds
from grafu.geometry.raycast import RayCaster
from grafu.scene.scene import Scene

_RAYS = 9  # along each side of a face
_MARGIN = 0.94  # of a face: rays keep off its rim, where neighbours meet
_REACH = 1.05  # cells beyond a box of cells: what bounds it lies in the next one
_NEAR = 10.0  # cells behind the nearest hit at which a wall still counts: brackets stand before it, or it runs askew
_SKIN = 0.05  # cells around a part's box in which a hit is still on the part
_MOSTLY = 0.5  # of a face that one drawer takes to close it
_BEYOND = 3.0  # cells between a box of free cells and such a drawer: what a drawer takes is counted in whole cells
_WALL = 0.1  # fraction of the hits on a face that makes a part one of its walls


@final
@dataclass(frozen=True)
class Face:
    """One side of an empty box: its place along its axis, fractions of static and moving surface, its walls."""

    at: float
    still: float
    moving: float
    walls: tuple[str, ...]


@final
class Surroundings:
    """The meshes in and around a box prepared for rays, at rest; not a value. `cell` is the side of a cell, metres."""

    def __init__(self, scene: Scene, near: Box, cell: float) -> None:
        self._cell = cell
        reach = near.grown((_NEAR + 2) * cell)
        self._still = RayCaster(_within([part.mesh for part in scene.static_parts], reach))
        self._moving = RayCaster(_within([scene.moving_mesh(moving) for moving in scene.moving_bodies], reach))
        own = [part for part in scene.static_parts if part.box.overlaps(reach)]
        self._names = np.array([part.id for part in own], dtype=object)
        self._lows = np.array([part.box.low for part in own]).reshape(-1, 3) - _SKIN * cell
        self._highs = np.array([part.box.high for part in own]).reshape(-1, 3) + _SKIN * cell
        self._moving_bodies = [(moving, scene.moving_mesh(moving).box) for moving in scene.moving_bodies]
        self._drawers = [box for moving, box in self._moving_bodies if is_drawer(scene, scene.moving_bodies[moving])]

    def faces_of(self, box: Box) -> tuple[Face, ...]:
        """Returns the six faces (-X, +X, -Y, +Y, -Z, +Z) where the meshes bound a box of free cells."""
        return tuple(self._face(box, face) for face in range(6))

    def _face(self, box: Box, face: int) -> Face:
        axis, is_high = divmod(face, 2)
        sign = 1.0 if is_high else -1.0
        direction = np.zeros(3)
        direction[axis] = sign
        origins = rays_from(box, axis)
        half = float(box.half[axis])
        still, moving = (caster.along(origins, direction) for caster in (self._still, self._moving))
        nearest = np.minimum(still, moving)
        hits = nearest <= half + _REACH * self._cell
        reach = max(float(nearest[hits].min()), half - self._cell) if hits.any() else half
        near = max(reach, half) + _NEAR * self._cell
        on_still = (still <= near) & (still <= moving)
        on_moving = (moving <= near) & (moving < still)
        points = origins[on_still] + still[on_still, None] * direction
        at = float(box.center[axis]) + sign * reach
        return Face(at, float(on_still.mean()), float(on_moving.mean()), self._owners(points))

    def _owners(self, points: Points) -> tuple[str, ...]:
        """Returns the ids of the still parts on which points lie, by their boxes, the most frequent first."""
        if not len(points):
            return ()
        inside = (points[:, None] >= self._lows).all(axis=2) & (points[:, None] <= self._highs).all(axis=2)
        counts = inside.sum(axis=0)
        order = np.argsort(-counts, kind="stable")
        return tuple(self._names[k] for k in order if counts[k] >= _WALL * len(points))

    def within_walls(self, box: Box, opening: int) -> Box:
        """Returns an open box drawn back, or let out by up to two cells, to where the walls beside it begin."""
        axis, is_high = divmod(opening, 2)
        sign = 1.0 if is_high else -1.0
        side = 1 - axis if axis < 2 else 0
        end = float(box.high[axis] if is_high else box.low[axis])
        steps = end + sign * self._cell * np.linspace(-2.5, 2.0, 37)  # from inside outwards
        up = 3 - axis - side
        levels = box.center[up] + box.half[up] * np.linspace(-0.8, 0.8, 7)
        grid = np.stack(np.meshgrid(steps, levels, indexing="ij"), axis=-1).reshape(-1, 2)
        origins = np.tile(box.center, (len(grid), 1))
        origins[:, axis], origins[:, up] = grid[:, 0], grid[:, 1]
        reach = float(box.half[side]) + 1.5 * self._cell
        walled = np.ones(len(grid), dtype=bool)
        for sense in (-1.0, 1.0):
            direction = np.zeros(3)
            direction[side] = sense
            walled &= self._still.along(origins, direction) <= reach
        rows = walled.reshape(len(steps), len(levels)).mean(axis=1) >= 0.5
        inside = np.flatnonzero(~rows)
        last = len(steps) - 1 if not len(inside) else max(int(inside[0]) - 1, 0)
        low, high = box.low.copy(), box.high.copy()
        (high if is_high else low)[axis] = steps[last]
        return Box(low, high)

    def meets_a_drawer(self, box: Box, face: int) -> bool:
        """Whether a box ends, at a face, where a drawer begins that takes most of it across: no board parts the two."""
        axis, is_high = divmod(face, 2)
        across = [k for k in range(3) if k != axis]
        for own in self._drawers:
            gap = own.low[axis] - box.high[axis] if is_high else box.low[axis] - own.high[axis]
            sides = np.minimum(own.high, box.high)[across] - np.maximum(own.low, box.low)[across]
            is_most = (sides > 0).all() and np.prod(sides) >= _MOSTLY * np.prod(box.size[across])
            if is_most and abs(float(gap)) <= _BEYOND * self._cell:
                return True
        return False

    def bodies_before(self, box: Box, opening: int) -> tuple[str, ...]:
        """Returns the moving bodies whose boxes lie before a box, seen from its opening, and overlap it across."""
        axis, is_high = divmod(opening, 2)
        found = []
        for moving, own in self._moving_bodies:
            gaps = own.axis_gaps(box)
            before = own.high[axis] > box.high[axis] if is_high else own.low[axis] < box.low[axis]
            if before and all(gaps[k] < -0.05 * box.size[k] for k in range(3) if k != axis):
                found.append(moving)
        return tuple(found)


def _within(meshes: list[TriangleMesh], box: Box) -> TriangleMesh:
    """Returns the triangles whose own boxes meet a box."""
    near = []
    for mesh in meshes:
        if len(mesh.faces) and mesh.box.overlaps(box):
            low, high = triangle_bounds(mesh.triangles)
            keep = np.all((low <= box.high) & (high >= box.low), axis=1)
            near.append(mesh if keep.all() else mesh.with_faces(keep))
    return merge_meshes(near)


def rays_from(box: Box, axis: int) -> Points:
    """Returns points in a grid on the middle plane of a box across an axis."""
    steps = np.linspace(-_MARGIN, _MARGIN, _RAYS)
    grid = np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1).reshape(-1, 2)
    across = [k for k in range(3) if k != axis]
    points: Vec3 = np.tile(box.center, (len(grid), 1))
    points[:, across] += grid * box.half[across]
    return points
