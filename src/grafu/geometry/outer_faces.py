"""Which faces of a mesh can be seen from outside it. It knows neither parts nor what stands around them."""

from itertools import product

import numpy as np
from jaxtyping import Bool

from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster

_OFF = 1e-4  # of the largest side: how far before a face a ray begins
_DIRECTIONS = np.array([d for d in product((-1.0, 0.0, 1.0), repeat=3) if any(d)])
_PLACES = np.array([[1, 1, 1], [8, 1, 1], [1, 8, 1], [1, 1, 8]])  # weights of the corners: the middle, near each corner


def outer_faces(mesh: TriangleMesh) -> Bool[np.ndarray, " n"]:
    """Returns for each face whether it can be seen from far away: from either side of it, past all other faces.

    Four points of a face are looked from, along the 26 directions to the faces, edges and corners of a cube. The walls
    of a cavity without an opening are not seen, nor are faces where two boards touch.
    """
    seen = np.zeros(len(mesh.faces), dtype=np.bool_)
    if not len(seen):
        return seen
    caster, off = RayCaster(mesh), _OFF * float(mesh.box.size.max())
    for direction, weights in product(_DIRECTIONS / np.linalg.norm(_DIRECTIONS, axis=1)[:, None], _PLACES):
        left = np.flatnonzero(~seen)
        points = np.einsum("k,nkd->nd", weights / weights.sum(), mesh.triangles[left])
        normals = mesh.face_normals[left]
        side = np.sign(normals @ direction)
        origins = points + off * side[:, None] * normals
        seen[left] = (side != 0) & np.isinf(caster.along(origins, direction))
    return seen
