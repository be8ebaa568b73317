"""Distances of points from loose triangles, all at once, and from a surface where it is near. It builds no tree.

It is for tens of points and hundreds of faces: most questions concern a small region.
"""

import numpy as np
from jaxtyping import Float

from grafu.geometry.arrays import Points, Scalars
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh

Triangles = Float[np.ndarray, "m 3 3"]
Distances = Float[np.ndarray, "n m"]


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


_MOST_PAIRS = 500_000  # of a point and a triangle at once: some tens of megabytes


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
