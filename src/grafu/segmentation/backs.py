"""The back of a front that was cut out of a surface: a sheet becomes a board."""

import numpy as np

from grafu.geometry.arrays import Faces, Vec3
from grafu.geometry.components import welded
from grafu.geometry.mesh import TriangleMesh
from grafu.segmentation.surface_config import CreaseConfig
from grafu.shapes import Int

Edges = Int[np.ndarray, " edges"]


def back_of(mesh: TriangleMesh, towards: Vec3, thickness: float, facing: float = CreaseConfig().facing) -> TriangleMesh:
    """Returns the back of a front that was cut out of a surface, and the rim that joins it to the front.

    A front with edges of its own ends where these do; a sheet becomes a board. The faces ahead are copied onto the
    plane of the back.

    Args:
        mesh: the front, in one piece.
        towards: the unit direction that it looks in.
        thickness: of a sheet, in the unit of the mesh.
        facing: cosine between that direction and a normal from which on a face is one ahead.
    """
    used, faces = np.unique(welded(mesh.vertices)[mesh.faces], return_inverse=True)
    faces = faces.reshape(-1, 3)
    points = np.zeros((len(used), 3))
    points[faces] = mesh.triangles
    depth = points @ towards
    back = min(float(depth.min()), float(depth.max()) - thickness)
    flat = points + np.outer(back - depth, towards)
    ahead = faces[mesh.face_normals @ towards > facing]
    start, end = _border(faces)
    count = len(points)
    rim = [np.column_stack([end, start, start + count]), np.column_stack([end, start + count, end + count])]
    whole = TriangleMesh(np.vstack([points, flat]), np.vstack([ahead[:, ::-1] + count, *rim]))
    return whole.with_faces(np.flatnonzero(whole.face_areas > 0))


def _border(faces: Faces) -> tuple[Edges, Edges]:
    """Returns start and end of the edges that one face alone has, as that face runs along them."""
    start, end = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    low, high = np.minimum(start, end), np.maximum(start, end)
    key = low * (int(high.max()) + 1) + high
    _, number, counts = np.unique(key, return_inverse=True, return_counts=True)
    alone = counts[number.reshape(-1)] == 1
    return start[alone], end[alone]
