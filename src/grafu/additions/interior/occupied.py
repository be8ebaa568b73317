"""The space taken at rest and by motions, as cells and as boxes: walls, moving bodies, and the paths of drawers.

Doors take only the place where they hang closed: that they swing free is checked panel by panel. A drawer takes its
whole travel, its rails, and all behind it, which can be reached only through it.
"""

from functools import cached_property
from typing import final

import numpy as np

from grafu.additions.interior.config import RoomConfig, Sizes
from grafu.articulation.articulated_object import Visual
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Vec3, freeze_arrays, median
from grafu.geometry.box import Box
from grafu.geometry.free_space import Grid, cells_met, points_on
from grafu.geometry.mesh import TriangleMesh
from grafu.scene.scene import MovingBody, Scene
from grafu.shapes import Bool, Float
from grafu.vocabulary import PartLabel

POINT_SPACING = 0.9
"""Cells between points on a surface: a board along the axes has a point in each of its cells."""
ASKEW_SPACING = 0.45
"""Cells between points on a triangle of which fewer than two sides run along the axes."""
ALONG = 0.9999
"""Cosine between a side and an axis from which on it runs along it."""


@final
@dataclass(frozen=True, eq=False)
class Taken(ArrayValue):
    """Cells of one object (`origin`: the low corner of the first, `cell`: the side, metres).

    `still` holds a surface that stands, `moving` one that moves, `drawers` is the space that drawers take; in `walls`
    the frames of sides are filled as if they were boards.
    """

    origin: Vec3
    cell: float
    still: Grid
    moving: Grid
    drawers: Grid
    walls: Grid

    def __post_init__(self) -> None:
        freeze_arrays(self)

    @cached_property
    def doors(self) -> Grid:
        """The cells with a surface that moves and is no drawer's."""
        return self.moving & ~self.drawers

    @cached_property
    def free(self) -> Grid:
        """The cells that nothing takes."""
        return ~(self.still | self.moving | self.drawers)


def taken_cells(scene: Scene, sizes: Sizes, config: RoomConfig) -> Taken:
    """Returns what is taken of an object's space, a layer of free cells around it."""
    box = Box.enclosing([part.box for part in scene.parts.values()])
    origin = box.low - sizes.cell
    n = np.ceil((box.size + 2 * sizes.cell) / sizes.cell).astype(int)
    shape = (int(n[0]), int(n[1]), int(n[2]))
    still = _cells([part.mesh for part in scene.static_parts], origin, sizes.cell, shape)
    moving = _cells([scene.moving_mesh(moving) for moving in scene.moving_bodies], origin, sizes.cell, shape)
    drawers = np.zeros(shape, dtype=bool)
    for body in scene.moving_bodies.values():
        if is_drawer(scene, body, config.thin):
            drawers[_zone(scene, body, still, origin, sizes.cell)] = True
    walls = still.copy()
    for part in scene.static_parts:
        if _is_open_wall(part, still, origin, sizes.cell, config):
            walls[_slices(part.box, origin, sizes.cell)] = True
    return Taken(origin, sizes.cell, still, moving, drawers, walls)


def is_drawer(scene: Scene, moving: MovingBody, thin_ratio: float) -> bool:
    """Whether a moving body slides out of the body: neither a hinged nor a sliding door.

    What is thinner than `thin_ratio` of its next longer side is a leaf.
    """
    joint_motion, part = scene.joint_motions.get(moving.id), scene.parts[moving.id]
    if joint_motion is None:
        return part.label is PartLabel.DRAWER
    if not joint_motion.kind.slides or part.label is PartLabel.DOOR:
        return False
    size = scene.moving_mesh(moving.id).box.size
    thin, middle = np.sort(size)[:2]
    along = int(np.abs(joint_motion.axis.direction).argmax())
    is_leaf = thin < thin_ratio * middle and int(np.argmin(size)) != 2
    return part.label is PartLabel.DRAWER or not is_leaf or int(np.argmin(size)) == along


def _zone(scene: Scene, moving: MovingBody, still: Grid, origin: Vec3, cell: float) -> tuple[slice, ...]:
    """Returns the cells that a drawer takes: itself and its rails, its travel, and what lies behind it."""
    box = Box.enclosing([scene.moving_mesh(moving.id).box, *(v.mesh.box for v in _rails(scene, moving))])
    joint_motion = scene.joint_motions.get(moving.id)
    direction, travel = (
        (joint_motion.axis.direction, joint_motion.upper)
        if joint_motion is not None
        else (np.array([0.0, -1.0, 0.0]), 0.0)
    )
    axis = int(np.abs(direction).argmax())
    goes_up = bool(direction[axis] > 0)
    low, high = box.low.copy(), box.high.copy()
    (high if goes_up else low)[axis] += travel if goes_up else -travel
    zone = list(_slices(Box(low, high), origin, cell))
    start, stop = zone[axis].start, zone[axis].stop
    if goes_up:
        behind = still[tuple(slice(0, start) if k == axis else zone[k] for k in range(3))]
        zone[axis] = slice(start - _free_run(np.flip(behind, axis), axis), stop)
    else:
        behind = still[tuple(slice(stop, None) if k == axis else zone[k] for k in range(3))]
        zone[axis] = slice(start, stop + _free_run(behind, axis))
    return tuple(zone)


def _free_run(cells: Grid, axis: int) -> int:
    """Returns how many cells from the start along an axis are free, as the median over all rows of cells."""
    if not cells.size:
        return 0
    first = np.where(cells.any(axis=axis), cells.argmax(axis=axis), cells.shape[axis])
    return int(median(first))


def _rails(scene: Scene, moving: MovingBody) -> list[Visual]:
    """Returns the hardware of a drawer: what moves with it and, by its name, what stands."""
    return [v for owner, v in scene.hardware if owner == moving.id or (not owner and f"_{moving.id}_" in v.name)]


def _is_open_wall(part: Part, still: Grid, origin: Vec3, cell: float, config: RoomConfig) -> bool:
    """Whether a part is a thin upright frame that closes enough of its outline to be a wall with openings."""
    size = part.box.size
    axis = int(np.argmin(size))
    thin, middle = np.sort(size)[:2]
    if axis == 2 or thin > config.thin * middle or part.label is PartLabel.FACE_FRAME:
        return False
    seen = still[_slices(part.box, origin, cell)].any(axis=axis)
    return bool(seen.size and seen.mean() >= config.frame)


def _cells(meshes: list[TriangleMesh], origin: Vec3, cell: float, shape: tuple[int, ...]) -> Grid:
    triangles = [mesh.triangles for mesh in meshes if len(mesh.faces)]
    if not triangles:
        return np.zeros(shape, dtype=bool)
    whole = np.concatenate(triangles)
    askew = _is_askew(whole)
    rows = [points_on(whole[~askew], POINT_SPACING * cell), points_on(whole[askew], ASKEW_SPACING * cell)]
    return cells_met(np.concatenate(rows), origin, cell, (shape[0], shape[1], shape[2]))


def _is_askew(triangles: Float[np.ndarray, "n 3 3"]) -> Bool[np.ndarray, " n"]:
    """Whether fewer than two sides of each triangle run along the axes: its points then miss cells between them."""
    sides = np.abs(np.roll(triangles, -1, axis=1) - triangles)
    along = sides.max(axis=2) >= ALONG * np.linalg.norm(sides, axis=2)
    askew: Bool[np.ndarray, " n"] = along.sum(axis=1) < 2
    return askew


def _slices(box: Box, origin: Vec3, cell: float) -> tuple[slice, ...]:
    low = np.maximum(np.floor((box.low - origin) / cell + 1e-6), 0).astype(int)
    high = np.maximum(np.ceil((box.high - origin) / cell - 1e-6), low + 1).astype(int)
    return tuple(slice(int(a), int(b)) for a, b in zip(low, high, strict=True))
