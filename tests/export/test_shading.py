import numpy as np
import pytest

from grafu.export import shading
from grafu.export.shading import _kept, corner_normals
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes

CUBE = TriangleMesh.box_mesh(Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 1.0)))


def strip(bend: float) -> TriangleMesh:
    """Two unit squares that meet in an edge, the second bent down by `bend` radians; no vertex is shared."""
    c, s = np.cos(bend), np.sin(bend)
    points = np.array([[-1.0, 0, 0], [0, 0, 0], [0, 1, 0], [-1, 1, 0], [0, 0, 0], [c, 0, -s], [c, 1, -s], [0, 1, 0]])
    return TriangleMesh(points, np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]))


def test_a_cube_is_flat():
    shading = corner_normals(Surface(CUBE))

    assert len(shading.normals) == 24
    assert np.allclose(shading.normals[shading.corners], CUBE.face_normals[:, None, :])


def test_a_gentle_bend_is_smooth_and_a_sharp_one_is_not():
    smooth, sharp = (corner_normals(Surface(strip(np.radians(angle)))) for angle in (20, 40))

    assert np.allclose(smooth.normals[smooth.corners[0, 1]], [np.sin(np.radians(10)), 0, np.cos(np.radians(10))])
    assert np.allclose(sharp.normals[sharp.corners[0, 1]], [0, 0, 1])


def test_both_sides_of_a_doubled_sheet_are_shaded(sheet):
    shading = corner_normals(Surface(sheet.with_faces(np.arange(4))))

    assert np.allclose(shading.normals[shading.corners[:2]], [0, -1, 0])
    assert np.allclose(shading.normals[shading.corners[2:]], [0, 1, 0])


def test_doubled_faces_stay_smooth():
    bent = strip(np.radians(20))
    doubled = merge_meshes([bent, TriangleMesh(bent.vertices, bent.faces[:, ::-1])])

    once, twice = corner_normals(Surface(bent)), corner_normals(Surface(doubled))

    assert np.allclose(twice.normals[twice.corners[:4]], once.normals[once.corners])


def test_own_normals_are_kept_and_mended():
    normals = np.tile([0.0, 0.0, 2.0], (8, 1))
    normals[0], normals[1] = 0.0, np.nan

    shading = corner_normals(Surface(CUBE, normals=normals))

    assert np.array_equal(shading.corners, CUBE.faces)
    assert np.allclose(shading.normals[2:], [0, 0, 1])
    assert np.allclose(np.linalg.norm(shading.normals, axis=1), 1)


def test_faces_without_area_get_a_unit_normal():
    flat = TriangleMesh(np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]), np.array([[0, 1, 2], [0, 0, 1]]))

    assert np.allclose(np.linalg.norm(corner_normals(Surface(flat)).normals, axis=1), 1)


def test_a_sphere_is_smooth():
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 40), np.linspace(0.05, np.pi - 0.05, 20))
    points = np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)], axis=-1).reshape(-1, 3)
    k = np.arange(19 * 40).reshape(19, 40)[:, :-1].ravel()
    ball = TriangleMesh(points, np.vstack([np.c_[k, k + 40, k + 41], np.c_[k, k + 41, k + 1]]))

    shading = corner_normals(Surface(ball))

    directions = ball.triangles / np.linalg.norm(ball.triangles, axis=2, keepdims=True)
    assert np.einsum("fkd,fkd->fk", shading.normals[shading.corners], directions).min() == pytest.approx(1, abs=0.02)


def test_normals_are_found_once_in_the_life_of_a_surface():
    cube = Surface(TriangleMesh.box_mesh(Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 1.0))))
    found = corner_normals(cube)
    assert corner_normals(cube) is found
    assert corner_normals(cube, 2.0) is not found
    other = Surface(cube.mesh)
    assert corner_normals(other) == found
    key = id(cube)
    del cube
    assert not [known for known in _kept if known[0] == key]


def test_normals_are_kept_as_far_as_there_is_room(monkeypatch):
    monkeypatch.setattr(shading, "_ROOM", shading._taken[0] + 12)
    first, second = (Surface(TriangleMesh.box_mesh(Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, k)))) for k in (1.0, 2.0))
    kept = corner_normals(first)
    assert corner_normals(first) is kept
    assert corner_normals(second) is not corner_normals(second)
    del first
    assert corner_normals(second) is corner_normals(second)
