"""Closed surfaces as solids, and with fewer faces: generative models and scans draw boards in tens of thousands."""

from typing import Any

import manifold3d
import numpy as np

from grafu.geometry.components import welded
from grafu.geometry.mesh import TriangleMesh


def solid_of(mesh: TriangleMesh) -> Any:
    """Returns a watertight mesh, turned one way, as a `manifold3d.Manifold`; None where manifold3d sees no solid."""
    position = welded(mesh.vertices)
    first = np.unique(position, return_index=True)[1]
    made = manifold3d.Mesh(mesh.vertices[first].astype(np.float32), position[mesh.faces].astype(np.uint32))
    solid = manifold3d.Manifold(made)
    return solid if solid.status() == manifold3d.Error.NoError and solid.volume() > 0 else None


def mesh_of(solid: Any) -> TriangleMesh:
    """Returns the surface of a `manifold3d.Manifold`."""
    made = solid.to_mesh()
    vertices = np.asarray(made.vert_properties, dtype=np.float64)[:, :3].reshape(-1, 3)
    return TriangleMesh(vertices, np.asarray(made.tri_verts, dtype=np.int64).reshape(-1, 3))


def simplified(mesh: TriangleMesh, tolerance: float) -> TriangleMesh:
    """Returns a watertight mesh of fewer faces, within about `tolerance` metres of where they were; others as they are.

    Its vertices are some of the mesh's own, in single precision: it reaches nowhere beyond their hull.
    """
    solid = solid_of(mesh)
    coarse = mesh_of(solid.simplify(tolerance)) if solid is not None else mesh
    return coarse if 0 < len(coarse.faces) < len(mesh.faces) else mesh
