"""Large meshes keep nothing that can be worked out again: the room for it is several times that of the mesh."""

import tracemalloc

import numpy as np

from grafu.geometry import bvh
from grafu.geometry.arrays import vec3
from grafu.geometry.blocks import forget_large_shapes
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh


def sheet(count: int) -> TriangleMesh:
    """A square of 2 x count x count faces."""
    x, y = (grid.ravel() for grid in np.meshgrid(np.arange(count + 1.0), np.arange(count + 1.0), indexing="ij"))
    first = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    corners = np.stack([first, first + count + 1, first + count + 2, first + 1], axis=1)
    return TriangleMesh(np.stack([x, y, 0 * x], axis=1), np.vstack([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]))


def test_what_is_asked_of_a_large_mesh_leaves_nothing_behind() -> None:
    mesh = sheet(150)
    own = mesh.vertices.nbytes + mesh.faces.nbytes
    tracemalloc.start()
    assert mesh.triangles.shape == (45_000, 3, 3)
    assert mesh.face_areas.sum() == 150.0**2
    np.testing.assert_array_equal(mesh.face_normals[0], [0.0, 0.0, 1.0])
    left = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    assert left < 0.2 * own


def test_what_is_asked_of_a_small_mesh_is_kept() -> None:
    mesh = sheet(4)
    assert mesh.triangles is mesh.triangles
    assert mesh.face_normals is mesh.face_normals


def test_shapes_of_large_meshes_are_forgotten_and_built_again() -> None:
    large, small = sheet(60), sheet(4)
    other = small.translated(vec3(0.0, 0.0, 1.0))
    assert MeshCollider(large).distance(MeshCollider(other)) == 1.0
    forget_large_shapes()
    assert id(large) not in bvh._models
    assert id(other) in bvh._models
    assert MeshCollider(large).distance(MeshCollider(other)) == 1.0
