"""Bays: the spaces behind doors and drawers, with the walls that enclose them, found by rays on real meshes.

All is measured in a view: x to the right as seen from the side to which the fronts open, y into the furniture, z up. No
label is asked: a wall is what a ray to the side meets.
"""

from typing import final

import numpy as np

from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.closed_scene import ClosedScene
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Mat3, Points, Scalars, Vec3, median, vec3
from grafu.geometry.box import Box
from grafu.geometry.components import clustered
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster, stands_between_walls, wall_distances
from grafu.joints.plan import JointRequest
from grafu.scene.border import part_axes
from grafu.scene.scene import Scene

FRONT_HEIGHTS = np.linspace(0.15, 0.85, 7)
"""Heights of rays, as fractions of a front's height: its edges lap onto the case."""
DEPTHS = 24
"""Places along the depth at which walls are looked for."""
FINE_DEPTHS = 17
"""Places between two of those at which the walls' edges are looked for."""


@final
@dataclass(frozen=True, eq=False)
class FrontsView:
    """One side to which fronts open: its axes as columns, its moving bodies, the still body's box in it.

    `others` are the moving bodies that open to other sides: a back door closes a body, too.
    """

    rotation: Mat3
    moving_bodies: tuple[str, ...]
    body: Box
    rays: RayCaster
    others: RayCaster

    def local(self, points: Points) -> Points:
        """Returns points of the object frame in the view."""
        return np.asarray(points @ self.rotation)

    def cast(self, origins: Points, direction: Vec3) -> Scalars:
        """Returns the distances to the still body of rays in the view, metres."""
        return self.rays.along(origins @ self.rotation.T, self.rotation @ direction)

    def cast_through(self, origins: Points, direction: Vec3) -> Scalars:
        """Returns the distances of rays in the view to the still body and to what opens to other sides."""
        along = self.rotation @ direction
        return np.minimum(self.cast(origins, direction), self.others.along(origins @ self.rotation.T, along))


@final
@dataclass(frozen=True, eq=False, slots=True)
class Bay(ArrayValue):
    """A space behind fronts: its low and high corner in the view, from the walls' front edges to their rear ones.

    `outline` is what the fronts themselves cover: x and z from and to. `walled` is the fraction of the depth at which
    walls stand on both sides; `has_door` whether one of the fronts is a door, `inset` whether they lie between them,
    `lowest` how high the lowest of them is.
    """

    moving_bodies: tuple[str, ...]
    low: Vec3
    high: Vec3
    outline: np.ndarray
    walled: float
    has_door: bool
    inset: bool
    lowest: float

    def joined(self, other: "Bay") -> "Bay":
        """Returns both as one."""
        a, b = self.outline, other.outline
        outline = np.array([min(a[0], b[0]), max(a[1], b[1]), min(a[2], b[2]), max(a[3], b[3])])
        return Bay(
            (*self.moving_bodies, *other.moving_bodies),
            np.minimum(self.low, other.low),
            np.maximum(self.high, other.high),
            outline,
            min(self.walled, other.walled),
            self.has_door or other.has_door,
            self.inset and other.inset,
            self.lowest if a[2] < b[2] else other.lowest,
        )


def find_views(closed: ClosedScene, config: CarcassConfig) -> tuple[FrontsView, ...]:
    """Returns the sides to which upright doors and drawers open, each with its moving bodies."""
    scene = closed.scene
    found = ((r.moving, _outward(closed, r, config)) for r in closed.requests)
    directions = {moving: outward for moving, outward in found if outward is not None}
    groups: list[tuple[Vec3, list[str]]] = []
    for moving, outward in directions.items():
        group = next((g for g in groups if float(g[0] @ outward) > config.same_way), None)
        if group is None:
            groups.append((outward, [moving]))
        else:
            group[1].append(moving)
    still = merge_meshes([_coarse(p.mesh, config) for p in scene.static_parts])
    if not groups or not len(still.faces):
        return ()
    rays = RayCaster(still)
    return tuple(
        _view(scene, still, rays, (outward, tuple(moving_bodies)), config) for outward, moving_bodies in groups
    )


def _coarse(mesh: TriangleMesh, config: CarcassConfig) -> TriangleMesh:
    """Returns a mesh of many faces with fewer: things on shelves and carvings cost more rays than they are worth."""
    return clustered(mesh, config.coarse) if len(mesh.faces) > config.many_faces else mesh


def _outward(closed: ClosedScene, request: JointRequest, config: CarcassConfig) -> Vec3 | None:
    """Returns the level unit direction to which a front looks; None where it is a lid, or slides up."""
    scene = closed.scene
    mesh = scene.parts[request.moving].mesh
    direction = np.asarray(request.axis.direction)
    if request.kind.slides and not closed.slides_in_its_plane(request):
        outward = direction
    else:
        axes = part_axes(mesh)
        thin = axes[:, int(np.argmin(np.ptp(mesh.vertices @ axes, axis=0)))]
        if request.kind.turns:
            towards = np.cross(direction, mesh.box.center - request.axis.point)
        else:
            towards = mesh.box.center - np.mean([p.box.center for p in scene.parts.values()], axis=0)
        outward = thin * (1.0 if float(thin @ towards) >= 0 else -1.0)
    if abs(float(outward[2])) > config.upright:
        return None
    level = vec3(float(outward[0]), float(outward[1]), 0.0)
    level = level / np.linalg.norm(level)
    nearest = int(np.argmax(np.abs(level)))  # carved leaves lie a little crooked in their boxes
    square = np.sign(level[nearest]) * np.eye(3)[nearest]
    return square if float(square @ level) > config.square else level


def _view(
    scene: Scene,
    still: TriangleMesh,
    rays: RayCaster,
    group: tuple[Vec3, tuple[str, ...]],
    config: CarcassConfig,
) -> FrontsView:
    outward, moving_bodies = group
    y = -outward
    rotation = np.column_stack([np.cross(y, vec3(0.0, 0.0, 1.0)), y, vec3(0.0, 0.0, 1.0)])
    own = {member for moving in moving_bodies for member in scene.moving_bodies[moving].members}
    others = merge_meshes([_coarse(scene.parts[i].mesh, config) for i in sorted(scene.moving_ids - own)])
    return FrontsView(rotation, moving_bodies, Box.around(still.vertices @ rotation), rays, RayCaster(others))


def find_bays(view: FrontsView, closed: ClosedScene, config: CarcassConfig) -> tuple[Bay, ...]:
    """Returns the bays behind the fronts of a view, those that open into one another as one."""
    scene = closed.scene
    doors = {r.moving for r in closed.requests if r.kind.turns}
    bays = [
        bay for moving in view.moving_bodies if (bay := _bay(view, scene, moving, moving in doors, config)) is not None
    ]
    merged = True
    while merged:
        merged = False
        for i, one in enumerate(bays):
            k = next((k for k in range(i + 1, len(bays)) if _one_space(one, bays[k], config)), None)
            if k is not None:
                bays[i], merged = one.joined(bays.pop(k)), True
                break
    return tuple(bays)


def _one_space(a: Bay, b: Bay, config: CarcassConfig) -> bool:
    """Whether two bays have the same walls and lie above, below or within one another."""
    alike = max(abs(a.low[0] - b.low[0]), abs(a.high[0] - b.high[0])) < config.alike
    return bool(alike and max(a.low[2], b.low[2]) - min(a.high[2], b.high[2]) < config.apart)


def _bay(view: FrontsView, scene: Scene, moving: str, is_door: bool, config: CarcassConfig) -> Bay | None:
    """Returns the space behind one front; None where no walls stand on both sides of it."""
    front = view.local(scene.parts[moving].mesh.vertices)
    low, high = front.min(axis=0), front.max(axis=0)
    depth = float(view.body.high[1] - low[1])
    if depth < config.least_depth:
        return None
    x, z = float(low[0] + high[0]) / 2, low[2] + FRONT_HEIGHTS * (high[2] - low[2])
    depths = float(low[1]) + np.linspace(0.0, 1.0, DEPTHS) * depth
    both = stands_between_walls(view.cast, vec3(x, 0.0, 0.0), (1, depths), (2, z))
    if not both.any():
        return None
    first, last = int(np.argmax(both)), DEPTHS - 1 - int(np.argmax(both[::-1]))
    start = _refined(view, x, z, (float(depths[max(first - 1, 0)]), float(depths[first])))
    end = _refined(view, x, z, (float(depths[min(last + 1, DEPTHS - 1)]), float(depths[last])))
    if end - start < config.least_depth:
        return None
    places = (1, depths[both]), (2, z)
    sides = [wall_distances(view.cast, vec3(x, 0.0, 0.0), *places, sign) for sign in (-1.0, 1.0)]
    x0, x1 = (x + sign * median(found[np.isfinite(found)]) for sign, found in zip((-1.0, 1.0), sides, strict=True))
    walled = float(both[first : last + 1].mean()) * (end - start) / depth
    outline = np.array([low[0], high[0], low[2], high[2]])
    inset = start < float(low[1]) + 0.5 * min(float(high[1] - low[1]), config.front_thickness)
    return Bay(
        (moving,),
        vec3(x0, start, outline[2]),
        vec3(x1, end, outline[3]),
        outline,
        walled,
        is_door,
        inset,
        float(high[2] - low[2]),
    )


def _refined(view: FrontsView, x: float, z: np.ndarray, span: tuple[float, float]) -> float:
    """Returns where walls end between a depth without and one with them (or the latter, if both have them)."""
    depths = np.linspace(*span, FINE_DEPTHS)
    both = stands_between_walls(view.cast, vec3(x, 0.0, 0.0), (1, depths), (2, z))
    return float(depths[int(np.argmax(both))]) if both.any() else span[1]
