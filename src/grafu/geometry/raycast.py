"""Rays against a mesh (Embree): first hits and robust distances. It knows no parts.

Embree works in single precision: distances hold to about a micrometre on furniture.
"""

from typing import final

import numpy as np
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh as EmbreeMesh

from grafu.geometry.arrays import Points, Scalars, Vec3
from grafu.geometry.budget import require_time
from grafu.geometry.mesh import TriangleMesh


@final
class RayCaster:
    """A mesh prepared for many rays; not a value. An empty mesh is never hit."""

    def __init__(self, mesh: TriangleMesh) -> None:
        self._scene: rtcore_scene.EmbreeScene | None = None
        if len(mesh.faces):
            self._scene = rtcore_scene.EmbreeScene()
            EmbreeMesh(self._scene, np.ascontiguousarray(mesh.triangles, dtype=np.float32))

    def distances(self, origins: Points, directions: Points) -> Scalars:
        """Returns the distance in metres along each unit direction to the first face hit; infinity where none is."""
        if self._scene is None or not len(origins):
            return np.full(len(origins), np.inf)
        require_time()
        found = self._scene.run(
            np.ascontiguousarray(origins, dtype=np.float32),
            np.ascontiguousarray(directions, dtype=np.float32),
            query="DISTANCE",
        )
        distances = np.asarray(found, dtype=np.float64)
        return np.where(distances > 1e30, np.inf, distances)

    def along(self, origins: Points, direction: Vec3) -> Scalars:
        """Returns the distances of many origins along one unit direction."""
        return self.distances(origins, np.broadcast_to(direction, origins.shape))


def robust_median(distances: Scalars, reach: float, share: float = 0.3) -> float:
    """Returns the median of the distances within `reach`; infinity where less than `share` of the rays hit."""
    hits = distances[distances <= reach]
    return float(np.median(hits)) if len(hits) >= max(1.0, share * len(distances)) else float("inf")
