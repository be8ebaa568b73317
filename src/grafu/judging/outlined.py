"""Panels whose outline is no rectangle, for the judge of panels: thinner by a skin all around, and carried or not.

It shares nothing with what makes panels. A panel is read as a prism: its two largest parallel faces and its edge.
"""

from typing import Any, final

import numpy as np
import shapely
import trimesh

from grafu.geometry.arrays import Points, Vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.unions import united
from grafu.shapes import Float

ALIKE = 0.999  # cosine between normals of one face
CARRIED = 0.3  # fraction of an edge that must rest on something
SAMPLES = 200  # points along an edge
SPECK = 1e-6  # metres: half the side of a point
CORNERS = 8  # of a plain panel


@final
class PrismPanel:
    """A panel as a prism: the plane of its faces, its outline in it, its ends across; not a value."""

    def __init__(self, mesh: TriangleMesh) -> None:
        shape = mesh.to_trimesh()
        normals, areas = shape.face_normals, shape.area_faces
        totals = [float(areas[normals @ n > ALIKE].sum()) for n in normals]
        self.normal: Vec3 = normals[int(np.argmax(totals))]
        first = np.eye(3)[int(np.argmin(np.abs(self.normal)))]
        u = np.cross(first, self.normal)
        u /= np.linalg.norm(u)
        self.axes = np.stack([u, np.cross(self.normal, u)])
        cap = shape.triangles[normals @ self.normal > ALIKE] @ self.axes.T
        self.outline = united(shapely.polygons(cap)).buffer(0)
        across = mesh.vertices @ self.normal
        self.low, self.high = float(across.min()), float(across.max())

    def shrunk(self, skin: float) -> trimesh.Trimesh:
        """Returns the panel with all its faces `skin` metres farther inside."""
        inner = self.outline.buffer(-skin, join_style="mitre")
        inner = max(getattr(inner, "geoms", [inner]), key=lambda p: float(p.area))
        edge = min(skin, 0.45 * (self.high - self.low))
        found: Any = trimesh.creation.extrude_polygon(inner, self.high - self.low - 2 * edge, engine="manifold")
        local = found.vertices + np.array([0.0, 0.0, self.low + edge])
        found.vertices = local @ np.vstack([self.axes, self.normal])
        return found

    def is_carried(self, manager: Any, reach: float) -> bool:
        """Whether enough of the edge lies within `reach` metres of something, on all sides of the panel's middle."""
        ring = self.outline.exterior if hasattr(self.outline, "exterior") else self.outline.convex_hull.exterior
        steps = np.linspace(0.0, 1.0, SAMPLES, endpoint=False)
        flat = shapely.get_coordinates(shapely.line_interpolate_point(ring, steps, normalized=True))
        touches = np.array([_is_near(manager, point, reach) for point in self._middles(flat)])
        if touches.mean() < CARRIED:
            return False
        held = shapely.convex_hull(shapely.multipoints(flat[touches]))
        return bool(held.buffer(reach).contains(self.outline.centroid))

    def _middles(self, flat: Float[np.ndarray, "n 2"]) -> Points:
        points: Points = flat @ self.axes + 0.5 * (self.low + self.high) * self.normal
        return points


def _is_near(manager: Any, point: Vec3, reach: float) -> bool:
    speck = trimesh.creation.box(bounds=np.stack([point - SPECK, point + SPECK]))
    return bool(manager.min_distance_single(speck) <= reach)


def is_plain(mesh: TriangleMesh) -> bool:
    """Whether a panel has the corners of a box along the axes: its ends are two pairs of sides, whatever else it is."""
    return len(mesh.vertices) == CORNERS == len(np.unique(mesh.vertices > mesh.box.center, axis=0))
