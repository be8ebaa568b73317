"""Point clouds, and seeded points on a surface. It knows no parts."""

from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.geometry.arrays import ArrayValue, Points, frozen_array
from grafu.geometry.mesh import TriangleMesh


@final
@dataclass(frozen=True, eq=False, slots=True)
class PointCloud(ArrayValue):
    """Points in metres, in the frame of what they were taken from.

    Raises:
        ValueError: if there is no point, or a number is not finite.
    """

    points: Points

    def __post_init__(self) -> None:
        points = frozen_array(self.points)
        if not len(points) or not np.all(np.isfinite(points)):
            raise ValueError(f"`PointCloud.points` must be finite and at least one: got {len(points)} points")
        object.__setattr__(self, "points", points)


def sample_surface(mesh: TriangleMesh, count: int, seed: int = 0) -> PointCloud:
    """Returns `count` points spread evenly by area over the faces, the same for the same seed.

    Where the faces have no area, the points are drawn from the vertices.
    """
    rng = np.random.default_rng(seed)
    areas = mesh.face_areas
    if not areas.sum() > 0:
        return PointCloud(mesh.vertices[rng.integers(0, len(mesh.vertices), count)])
    picked = mesh.triangles[rng.choice(len(areas), count, p=areas / areas.sum())]
    u, v = np.sort(rng.random((2, count)), axis=0)
    weights = np.stack([u, v - u, 1 - v], axis=1)
    return PointCloud(np.einsum("nk,nkd->nd", weights, picked))
