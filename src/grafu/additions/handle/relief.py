"""What lies before a hand at a front: depth maps of the front and of all that surrounds it at rest, by rays.

The moving body's own handles and what stands before the front (a closed door before a drawer) are left out; its
hardware and the floor belong to the surroundings.
"""

from collections.abc import Sequence
from functools import cached_property
from math import sqrt
from typing import final

import numpy as np

from grafu.additions.handle.grasp_config import ReliefConfig
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, Scalars, Vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.scene.front import Front, body_members, front_of
from grafu.scene.scene import Scene
from grafu.shapes import Float

Grid = Float[np.ndarray, "n m"]

MOST_CELLS = 12_000
"""Cells of a relief that a front with cells of the least side may have."""
ALL_CELLS = 48_000
"""Cells that any relief may have."""
UNSEEN = 1e3
"""Depth of what no ray meets, metres."""


@final
@dataclass(frozen=True, eq=False)
class Relief:
    """Depths inwards from the front's foremost plane on a grid, metres.

    `u` and `v` are the cells' middles; `face` is the moving body's first surface (infinite where there is none),
    `first` that of anything (a kilometre). `plane` is where the front's face mainly lies; `factor` what hands are
    scaled by, `floor` the height of the floor in the object frame.
    """

    front: Front
    factor: float
    cell: float
    u: Float[np.ndarray, " n"]
    v: Float[np.ndarray, " m"]
    face: Grid
    first: Grid
    plane: float
    floor: float
    moving: RayCaster
    others: RayCaster
    config: ReliefConfig

    @cached_property
    def outline(self) -> Box:
        """The front's own rectangle, (u, b, v): without what lies far behind its plane, such as a drawer's box."""
        body = self.face < self.plane + self.config.body * self.factor
        if not body.any():
            return Box(np.zeros(3), np.array([self.front.width, self.front.depth, self.front.height]))
        half = self.cell / 2
        i, j = np.flatnonzero(body.any(axis=1)), np.flatnonzero(body.any(axis=0))
        low = np.array([self.u[i[0]] - half, self.plane, self.v[j[0]] - half])
        high = np.array([self.u[i[-1]] + half, self.plane + self.front.depth, self.v[j[-1]] + half])
        edge = np.array([self.front.width, np.inf, self.front.height])
        return Box(np.maximum(low, (0.0, -np.inf, 0.0)), np.maximum(np.minimum(high, edge), low))

    def cast(self, points: Points, direction: Vec3) -> tuple[Scalars, Scalars]:
        """Returns the distances from points (u, b, v) along a unit direction (u, b, v) to the body and to others."""
        origins, along = self.front.to_object(points), self.front.rotation @ direction
        return self.moving.along(origins, along), self.others.along(origins, along)


@final
class Reliefs:
    """The reliefs of a scene's fronts, each made when first asked for; not a value."""

    def __init__(self, scene: Scene, config: ReliefConfig) -> None:
        self.scene = scene
        self.config = config
        self._found: dict[str, Relief] = {}
        self._extents: dict[int, tuple[TriangleMesh, Points, Points]] = {}

    def of(self, moving_id: str) -> Relief:
        """Returns the relief of a moving body's front.

        Raises:
            KeyError: if the scene has no such moving body, or no motion for it.
        """
        if moving_id not in self._found:
            self._found[moving_id] = self._made(moving_id)
        return self._found[moving_id]

    def _made(self, moving_id: str) -> Relief:
        scene = self.scene
        front, factor = front_of(scene, moving_id), scene.metre
        region = _around(front, factor, self.config)
        bodies = [scene.parts[m].mesh for m in body_members(scene, moving_id)]
        others = _others(scene, moving_id, front, self.config.before)
        moving, around = (RayCaster(self._near(meshes, region)) for meshes in (bodies, others))
        return _looked_at(front, scene, moving, around, self.config)

    def _near(self, meshes: Sequence[TriangleMesh], region: Box) -> TriangleMesh:
        """Returns the triangles whose own boxes meet a box of the object frame."""
        found = [np.zeros((0, 3, 3))]
        for mesh in meshes:
            if len(mesh.faces) and mesh.box.overlaps(region):
                low, high = self._extent(mesh)
                found.append(mesh.triangles[np.all((low <= region.high) & (high >= region.low), axis=1)])
        corners = np.concatenate(found)
        return TriangleMesh(corners.reshape(-1, 3), np.arange(corners.shape[0] * corners.shape[1]).reshape(-1, 3))

    def _extent(self, mesh: TriangleMesh) -> tuple[Points, Points]:
        if id(mesh) not in self._extents:
            a, b, c = mesh.triangles.transpose(1, 0, 2)
            low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
            self._extents[id(mesh)] = (mesh, low, high)
        return self._extents[id(mesh)][1:]


def _looked_at(front: Front, scene: Scene, moving: RayCaster, others: RayCaster, config: ReliefConfig) -> Relief:
    area, factor = front.width * front.height, scene.metre
    cell = min(max(sqrt(area / MOST_CELLS), factor * config.cell), factor * config.coarse_cell)
    cell = max(cell, sqrt(area / ALL_CELLS))
    u, v = (_cells(side, cell, config.margin * factor) for side in (front.width, front.height))
    lead = config.lead * factor
    grid = np.stack(np.broadcast_arrays(u[:, None], -lead, v[None, :]), axis=-1)
    origins = front.to_object(grid.reshape(-1, 3))
    face = moving.along(origins, front.inwards).reshape(grid.shape[:2]) - lead
    first = np.minimum(others.along(origins, front.inwards).reshape(face.shape) - lead, face)
    first = np.where(origins[:, 2].reshape(face.shape) < scene.floor, -lead, np.minimum(first, UNSEEN))
    plane = _plane(face, config.plane)
    return Relief(front, factor, cell, u, v, face, first, plane, scene.floor, moving, others, config)


def _plane(face: Grid, ratio: float) -> float:
    """Returns the depth that this fraction of the body's visible cells does not exceed; 0 where nothing is hit."""
    hits = face[np.isfinite(face)]
    return float(np.quantile(hits, ratio)) if len(hits) else 0.0


def _cells(side: float, cell: float, margin: float) -> Scalars:
    """Returns the middles of cells over a side and a margin on both ends; they begin at the side's own ends."""
    count, more = max(int(np.ceil(side / cell)), 1), int(np.ceil(margin / cell))
    return side / count * (np.arange(-more, count + more) + 0.5)


def _around(front: Front, factor: float, config: ReliefConfig) -> Box:
    """Returns the space around a front that matters to hands, in the object frame."""
    margin, lead, behind = factor * config.margin, factor * config.lead, factor * config.behind
    low = np.array([-margin, -lead, -margin])
    high = np.array([front.width + margin, min(front.depth, behind) + behind, front.height + margin])
    return Box.around(front.to_object(Box(low, high).corners()))


def _others(scene: Scene, moving_id: str, front: Front, depth: float) -> list[TriangleMesh]:
    """Returns what surrounds a front: all other parts at rest but closed doors before it, and all hardware."""
    own = scene.moving_bodies[moving_id].members
    carried = {member: moving.id for moving in scene.moving_bodies.values() for member in moving.members}
    before = {
        other for other in scene.moving_bodies if other != moving_id and stands_before(scene, other, front, depth)
    }
    parts = [p.mesh for p in scene.parts.values() if p.id not in own and carried.get(p.id, "") not in before]
    return [*parts, *(visual.mesh for owner, visual in scene.hardware if owner not in before)]


def stands_before(scene: Scene, other: str, front: Front, depth: float) -> bool:
    """Whether another moving body stands wholly before a front and hides some of it, as a closed door does a drawer.

    It may end up to `depth` metres behind the front's foremost plane.
    """
    boxes = [scene.parts[m].box.corners() for m in body_members(scene, other) if len(scene.parts[m].mesh.faces)]
    if not boxes:
        return False
    box = front.box_of(np.vstack(boxes))
    beside = box.low[0] > front.width or box.high[0] < 0.0 or box.low[2] > front.height or box.high[2] < 0.0
    return not beside and float(box.high[1]) <= depth
