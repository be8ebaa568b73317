"""Where the meshes bound a box of free cells: its six faces, what stands and moves there, whose walls they are.

It decides nothing: what makes such a box a compartment is asked elsewhere.
"""

from typing import final

import numpy as np

from grafu.additions.interior.config import RoomConfig
from grafu.additions.interior.occupied import is_drawer
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, Vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import mesh_near
from grafu.geometry.raycast import RayCaster, stands_between_walls
from grafu.scene.scene import Scene

RAYS_PER_SIDE = 9
"""Rays along each side of a face."""
RAY_SPAN = 0.94
"""Fraction of a face over which rays are spread: they keep off its rim, where neighbours meet."""
FACE_CELLS = 1.05
"""Cells beyond a box of cells: what bounds it lies in the next one."""
RIM_STEPS = np.linspace(-2.5, 2.0, 37)
"""Cells beyond an open side of a box of cells at which the walls beside it are looked for, from inside outwards."""
RIM_LEVELS = np.linspace(-0.8, 0.8, 7)
"""Places of these rays across, as fractions of half the box's side."""
RIM_REACH = 1.5
"""Cells beyond its other sides within which these walls must be."""
PART_CELLS = 0.05
"""Cells around a part's box in which a hit is still on the part."""


@final
@dataclass(frozen=True)
class Face:
    """One side of an empty box: its place along its axis, fractions of static and moving surface, its walls."""

    at: float
    still: float
    moving: float
    walls: tuple[str, ...]


@final
class FaceFinder:
    """Finds the faces that bound boxes of free cells, by rays to the meshes in and around a box, at rest; not a value.

    `cell` is the side of a cell, metres.
    """

    def __init__(self, scene: Scene, near: Box, cell: float, config: RoomConfig) -> None:
        self._cell, self._config = cell, config
        reach = near.grown((config.wall_cells + 2) * cell)
        self._still = RayCaster(mesh_near([part.mesh for part in scene.static_parts], reach))
        self._moving = RayCaster(mesh_near([scene.moving_mesh(moving) for moving in scene.moving_bodies], reach))
        own = [part for part in scene.static_parts if part.box.overlaps(reach)]
        self._names = np.array([part.id for part in own], dtype=object)
        self._lows = np.array([part.box.low for part in own]).reshape(-1, 3) - PART_CELLS * cell
        self._highs = np.array([part.box.high for part in own]).reshape(-1, 3) + PART_CELLS * cell
        self._moving_bodies = [(moving, scene.moving_mesh(moving).box) for moving in scene.moving_bodies]
        self._drawers = [
            box for moving, box in self._moving_bodies if is_drawer(scene, scene.moving_bodies[moving], config.thin)
        ]

    def faces_of(self, box: Box) -> tuple[Face, ...]:
        """Returns the six faces (-X, +X, -Y, +Y, -Z, +Z) where the meshes bound a box of free cells."""
        return tuple(self._face(box, face) for face in range(6))

    def _face(self, box: Box, face: int) -> Face:
        axis, is_high = divmod(face, 2)
        sign = 1.0 if is_high else -1.0
        direction = np.zeros(3)
        direction[axis] = sign
        origins = _rays_from(box, axis)
        half = float(box.half[axis])
        still, moving = (caster.along(origins, direction) for caster in (self._still, self._moving))
        nearest = np.minimum(still, moving)
        hits = nearest <= half + FACE_CELLS * self._cell
        reach = max(float(nearest[hits].min()), half - self._cell) if hits.any() else half
        near = max(reach, half) + self._config.wall_cells * self._cell
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
        return tuple(self._names[k] for k in order if counts[k] >= self._config.wall_part * len(points))

    def within_walls(self, box: Box, opening: int) -> Box:
        """Returns an open box drawn back, or let out by up to two cells, to where the walls beside it begin."""
        axis, is_high = divmod(opening, 2)
        sign = 1.0 if is_high else -1.0
        side = 1 - axis if axis < 2 else 0
        end = float(box.high[axis] if is_high else box.low[axis])
        steps = end + sign * self._cell * RIM_STEPS
        up = 3 - axis - side
        levels = box.center[up] + box.half[up] * RIM_LEVELS
        reach = float(box.half[side]) + RIM_REACH * self._cell
        rows = stands_between_walls(self._still.along, box.center, (axis, steps), (up, levels), reach)
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
            is_most = (sides > 0).all() and np.prod(sides) >= self._config.drawer * np.prod(box.size[across])
            if is_most and abs(float(gap)) <= self._config.drawer_cells * self._cell:
                return True
        return False

    def bodies_before(self, box: Box, opening: int) -> tuple[str, ...]:
        """Returns the moving bodies whose boxes lie before a box, seen from its opening, and overlap it across."""
        axis, is_high = divmod(opening, 2)
        found = []
        for moving, own in self._moving_bodies:
            gaps = own.axis_gaps(box)
            before = own.high[axis] > box.high[axis] if is_high else own.low[axis] < box.low[axis]
            if before and all(gaps[k] < -self._config.before * box.size[k] for k in range(3) if k != axis):
                found.append(moving)
        return tuple(found)


def _rays_from(box: Box, axis: int) -> Points:
    """Returns points in a grid on the middle plane of a box across an axis."""
    steps = np.linspace(-RAY_SPAN, RAY_SPAN, RAYS_PER_SIDE)
    grid = np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1).reshape(-1, 2)
    across = [k for k in range(3) if k != axis]
    points: Vec3 = np.tile(box.center, (len(grid), 1))
    points[:, across] += grid * box.half[across]
    return points
