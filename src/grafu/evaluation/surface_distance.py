"""How far points lie from a surface, where it is near. It builds no tree: most questions concern a small region."""

import numpy as np

from grafu.geometry.arrays import Points, Scalars
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.point_distance import point_triangle_distances

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
