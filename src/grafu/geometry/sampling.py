"""Point clouds, and seeded points on a surface."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.geometry.arrays import ArrayValue, Points, Scalars, frozen_array
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
    return sample_surfaces([mesh], count, seed)[0]


def sample_surfaces(meshes: Sequence[TriangleMesh], count: int, seed: int = 0) -> list[PointCloud]:
    """Returns for each mesh the points that `sample_surface` gives for it, all at once."""
    rng = np.random.default_rng(seed)
    where, (u, v) = rng.random(count), np.sort(rng.random((2, count)), axis=0)
    weights = np.stack([u, v - u, 1 - v], axis=1)
    triangles = [mesh.triangles for mesh in meshes]
    ends = np.cumsum([len(t) for t in triangles])
    corners = np.concatenate([np.zeros((0, 3, 3)), *triangles])
    areas = _areas(corners)
    clouds = []
    for mesh, start, end in zip(meshes, [0, *ends.tolist()], ends.tolist(), strict=False):
        ratios = np.cumsum(areas[start:end])
        if not len(ratios) or not ratios[-1] > 0:
            clouds.append(_vertices(mesh, count, seed))
            continue
        picked = start + (ratios / ratios[-1]).searchsorted(where, side="right")
        clouds.append(PointCloud(np.einsum("nk,nkd->nd", weights, corners[picked])))
    return clouds


def _areas(corners: np.ndarray) -> Scalars:
    """Returns twice the area of each triangle, (faces, 3, 3); numpy's own cross product costs three times as much."""
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    cross = u[:, [1, 2, 0]] * v[:, [2, 0, 1]] - u[:, [2, 0, 1]] * v[:, [1, 2, 0]]
    return np.sqrt((cross * cross).sum(axis=1))


def _vertices(mesh: TriangleMesh, count: int, seed: int) -> PointCloud:
    return PointCloud(mesh.vertices[np.random.default_rng(seed).integers(0, len(mesh.vertices), count)])
