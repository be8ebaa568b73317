"""Point clouds, seeded points on a surface, and distances of points from loose triangles or from a near surface.

Distances are taken all at once, without a tree: they are for tens of points and hundreds of faces.
"""

from collections.abc import Sequence
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Points, Scalars, frozen_array
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.shapes import Float

Triangles = Float[np.ndarray, "m 3 3"]
Distances = Float[np.ndarray, "n m"]
_MOST_PAIRS = 500_000  # of a point and a triangle at once: some tens of megabytes


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


def point_triangle_distances(points: Points, triangles: Triangles) -> Distances:
    """Returns the distance in metres of every point from every triangle; flat and pointlike triangles count too."""
    a = triangles[:, 0]
    e0, e1 = triangles[:, 1] - a, triangles[:, 2] - a
    from_a = points[:, None] - a[None]
    d00, d01, d11 = _dot(e0, e0), _dot(e0, e1), _dot(e1, e1)
    d20, d21 = np.einsum("nmk,mk->nm", from_a, e0), np.einsum("nmk,mk->nm", from_a, e1)
    area = d00 * d11 - d01 * d01
    flat = area <= 1e-12 * d00 * d11
    safe = np.where(flat, 1.0, area)
    v, w = (d11 * d20 - d01 * d21) / safe, (d00 * d21 - d01 * d20) / safe
    inside = (v >= 0) & (w >= 0) & (v + w <= 1) & ~flat
    squared = _dot(from_a, from_a)
    above = squared - v * d20 - w * d21  # the foot of the perpendicular lies at v e0 + w e1
    borders = np.minimum(_segment(squared, d20, d00), _segment(squared, d21, d11))
    e2 = e1 - e0
    from_b = from_a - e0[None]
    borders = np.minimum(borders, _segment(_dot(from_b, from_b), np.einsum("nmk,mk->nm", from_b, e2), _dot(e2, e2)))
    return np.sqrt(np.maximum(np.where(inside, above, borders), 0.0))


def _segment(squared: Distances, along: Distances, length: np.ndarray) -> Distances:
    """Returns squared distances from segments, given those from their start and the products with their vector."""
    ratio = np.clip(along / np.maximum(length, 1e-30), 0.0, 1.0)
    return squared - ratio * (2 * along - ratio * length)


def _dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.asarray(np.einsum("...k,...k->...", a, b))


def distances_up_to(points: Points, mesh: TriangleMesh, near: float) -> Scalars:
    """Returns the distance in metres of each point from a mesh; farther than `near`, infinity may stand for it."""
    if not len(points):
        return np.zeros(0)
    around = Box.around(points).grown(near)
    corners = mesh.triangles
    keep = np.all((corners.min(axis=1) <= around.high) & (corners.max(axis=1) >= around.low), axis=1)
    triangles = corners[keep]
    found = np.full(len(points), np.inf)
    for chunk in np.array_split(triangles, max(1, len(points) * len(triangles) // _MOST_PAIRS)):
        if len(chunk):
            found = np.minimum(found, point_triangle_distances(points, chunk).min(axis=1))
    return found
