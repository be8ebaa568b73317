"""A top over a rim that slopes: the walls end in one tilted plane, and nothing lies in it. No level top is put there.

What leans and moves, such as the flap of a secretaire, closes such a rim itself. So does any board in the plane.
"""

from math import cos, degrees
from typing import final

import numpy as np
import shapely
from shapely.geometry import Polygon

from grafu.additions.top.config import TopConfig
from grafu.additions.top.outline import overhanging
from grafu.additions.top.roles import Roles, triangles_of
from grafu.additions.top.section import polygons_in, section, slab_mesh, with_corners
from grafu.additions.top.slope_config import SlopeConfig
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3, Vec3
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.swept_body import SweptBody
from grafu.shapes import Float

TOUCH = 1e-5
"""Depth to which a top may touch what moves, metres on furniture of usual size."""

Triangles = Float[np.ndarray, "n 3 3"]


@final
@dataclass(frozen=True, eq=False)
class SlopingRim:
    """The plane in which walls end: `normal` (upwards), its distance from the origin, and the rim seen from above."""

    normal: Vec3
    distance: float
    outline: Polygon

    @property
    def angle(self) -> float:
        """Between the plane and the floor, radians."""
        return float(np.arccos(np.clip(self.normal[2], -1.0, 1.0)))

    def heights(self, points: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, " n"]:
        """Returns the heights of the plane over points of the floor."""
        found: Float[np.ndarray, " n"] = (self.distance - points @ self.normal[:2]) / self.normal[2]
        return found


def sloping_rim(roles: Roles, config: SlopeConfig, metre: float) -> SlopingRim | None:
    """Returns the tilted plane in which the walls of furniture end and that nothing closes; None: there is none."""
    still = triangles_of(part.mesh for part in roles.still)
    moving = triangles_of(body.mesh for body in roles.moving)
    plane = _plane_of(still, config, metre)
    if plane is None:
        return None
    normal, distance = plane
    frame = _frame(normal)
    whole = np.concatenate([still, moving]) @ frame.T
    if float(whole[:, :, 2].max()) > distance + config.above * metre:
        return None
    corners = still.reshape(-1, 3)
    at_rim = corners[distance - corners @ normal <= config.touch * metre]
    plan = shapely.convex_hull(shapely.multipoints(at_rim[:, :2]))
    tilted = shapely.convex_hull(shapely.multipoints((at_rim @ frame.T)[:, :2]))
    if not (isinstance(plan, Polygon) and isinstance(tilted, Polygon)):
        return None
    rim = SlopingRim(normal, distance, plan)
    foot = roles.box.size[0] * roles.box.size[1]
    is_large = plan.area >= config.least * foot
    is_walled = _walled(whole, tilted, distance, config, metre) >= config.closed
    return rim if is_large and is_walled and _is_open(rim, whole @ frame, config, metre) else None


def sloping_slab(rim: SlopingRim, roles: Roles, config: TopConfig, metre: float) -> TriangleMesh | None:
    """Returns the slab on a sloping rim; None where something that moves is in its way.

    Its edges are upright. In front it ends flush where an overhang would meet a door.
    """
    moving = [body.mesh for body in roles.moving if len(body.mesh.faces)]
    collider = MeshCollider(merge_meshes(moving)) if moving else None
    thick = config.thickness * metre / cos(rim.angle)
    for front in (config.front, 0.0):
        plan = overhanging(rim.outline, front * metre, config.side * metre, config.back * metre)
        plan = with_corners(plan, config.shape, config.corner * metre)
        polygons = polygons_in(plan)
        if len(polygons) != 1:
            return None
        level = slab_mesh(polygons[0], 0.0, thick, config.shape, config.edge)
        lift = np.column_stack([np.zeros((len(level.vertices), 2)), rim.heights(level.vertices[:, :2])])
        air = np.array([0.0, 0.0, config.gap * metre])
        if collider is None or not _cuts(TriangleMesh(level.vertices + lift - air, level.faces), collider, metre):
            return TriangleMesh(level.vertices + lift, level.faces)
    return None


def _cuts(mesh: TriangleMesh, moving: MeshCollider, metre: float) -> bool:
    body = SweptBody(mesh, TOUCH * metre)
    body.place(np.eye(4))
    return body.penetrates(moving)


def why_sloping(rim: SlopingRim) -> str:
    """Returns in words why a top is missing."""
    return f"the rim slopes by {degrees(rim.angle):.0f} degrees and is open"


def _plane_of(triangles: Triangles, config: SlopeConfig, metre: float) -> tuple[Vec3, float] | None:
    """Returns the normal and distance of the tilted plane that holds most of the upper edges; None: there is none."""
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(cross, axis=1)
    flat = length > 0
    normals, areas, own = cross[flat] / length[flat, None], length[flat] / 2, triangles[flat]
    tilted = (normals[:, 2] <= np.cos(config.least_angle)) & (normals[:, 2] >= np.cos(config.most_angle))
    normals, areas, own = normals[tilted], areas[tilted], own[tilted]
    best: tuple[Vec3, float] | None = None
    most = 0.0
    for k in np.argsort(-areas)[: config.tried]:
        distance = float(own[k, 0] @ normals[k])
        alike = (normals @ normals[k] >= np.cos(config.alike)) & (
            np.abs(own @ normals[k] - distance).max(axis=1) <= config.touch * metre
        )
        if (total := float(areas[alike].sum())) > most:
            best, most = (normals[k], distance), total
    return best


def _frame(normal: Vec3) -> Mat3:
    """Returns the axes of a tilted plane as rows: level, up the slope, its normal."""
    level = np.cross(np.array([0.0, 0.0, 1.0]), normal)
    level /= np.linalg.norm(level)
    return np.stack([level, np.cross(normal, level), normal])


def _walled(whole: Triangles, rim: Polygon, distance: float, config: SlopeConfig, metre: float) -> float:
    """Returns the fraction of a rim's edge at which something ends in the plane; `whole` and `rim` are tilted."""
    levels = [distance - depth * metre for depth in config.depths]
    walls = section(whole, levels, config.line * metre, metre)
    near = rim.exterior.intersection(walls.buffer(config.beside * metre))
    return float(near.length / rim.exterior.length)


def _is_open(rim: SlopingRim, whole: Triangles, config: SlopeConfig, metre: float) -> bool:
    """Whether one looks down through most of a rim, near its lower edge too."""
    low_x, low_y, high_x, high_y = rim.outline.bounds
    steps = np.linspace(0.0, 1.0, config.rays)
    x, y = (a.ravel() for a in np.meshgrid(low_x + steps * (high_x - low_x), low_y + steps * (high_y - low_y)))
    inner = rim.outline.buffer(-config.beside * metre)
    inside = shapely.contains_xy(inner, x, y)
    points = np.column_stack([x, y])[inside]
    if not len(points):
        return False
    heights = rim.heights(points)
    origins = np.column_stack([points, heights + config.above * metre])
    faces = np.arange(whole.size // 3).reshape(-1, 3)
    caster = RayCaster(TriangleMesh(whole.reshape(-1, 3), faces))
    depths = caster.along(origins, np.array([0.0, 0.0, -1.0])) - config.above * metre
    is_deep = depths >= config.deep * metre
    lower = heights <= np.quantile(heights, config.lower)
    return bool(min(is_deep.mean(), is_deep[lower].mean()) >= config.opened)


def rim_and_slab(roles: Roles, config: TopConfig, metre: float) -> tuple[str, TriangleMesh] | None:
    """Returns why a sloping top is missing, and its mesh; None where none is, or none can be put."""
    rim = sloping_rim(roles, config.slope, metre)
    mesh = None if rim is None else sloping_slab(rim, roles, config, metre)
    return None if rim is None or mesh is None else (why_sloping(rim), mesh)
