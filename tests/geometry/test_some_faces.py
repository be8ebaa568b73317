"""Some faces of a surface, and what is left of one that is cut: all that it is called and looks like goes with them."""

import numpy as np
import pytest

from grafu.geometry.appearance import Material, Surface, joined, selected
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, mesh_near
from grafu.geometry.solids import ConvexSolid, subtract
from grafu.geometry.transform import translation

MESH = TriangleMesh.box_mesh(Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 1.0)))
COLORS = np.arange(32).reshape(8, 4).astype(np.uint8)
WHOLE = Surface(MESH, Material("oak"), MESH.vertices[:, :2], MESH.vertices, COLORS, "hinge-12")
CORNER = ConvexSolid.around(Box(vec3(0.5, 0.5, 0.5), vec3(2.0, 2.0, 2.0)).corners())


@pytest.mark.parametrize(
    "changed",
    [
        lambda: selected(WHOLE, np.array([3, 7])),
        lambda: joined(WHOLE, [selected(WHOLE, np.array([0])), selected(WHOLE, np.array([1, 5]))]),
        lambda: subtract(WHOLE, [CORNER]),
    ],
    ids=["selected", "joined", "cut"],
)
def test_name_and_looks_stay(changed) -> None:
    found = changed()

    assert 0 < len(found.mesh.faces) != len(MESH.faces)
    assert (found.name, found.material) == (WHOLE.name, WHOLE.material)
    assert len(found.uv) == len(found.normals) == len(found.colors) == len(found.mesh.vertices)


def test_vertices_that_no_face_uses_are_dropped() -> None:
    found = selected(WHOLE, np.array([3]))

    assert len(found.mesh.vertices) == 3
    np.testing.assert_array_equal(found.mesh.triangles, MESH.triangles[[3]])
    np.testing.assert_array_equal(found.colors[found.mesh.faces[0]], COLORS[MESH.faces[3]])


def test_the_mesh_near_a_box_has_the_faces_whose_boxes_meet_it_in_order() -> None:
    far = MESH.transformed(translation(vec3(5.0, 0.0, 0.0)))
    low = Box(vec3(-1.0, -1.0, -1.0), vec3(2.0, 2.0, -0.0))
    found = mesh_near([far, MESH, TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64))], low)
    reaches_down = MESH.triangles[:, :, 2].min(axis=1) <= 0.0

    np.testing.assert_array_equal(found.triangles, MESH.triangles[reaches_down])
    assert mesh_near([MESH], low.grown(1.0)) is MESH
    assert not len(mesh_near([far], low).faces)
