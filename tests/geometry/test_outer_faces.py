"""What is seen of a mesh: outer skins, not the walls of a closed cavity, nor faces where boards touch."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.outer_faces import outer_faces


def box(low, high) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def test_of_a_box_around_a_box_the_outer_one_is_seen():
    seen = outer_faces(merge_meshes([box((0, 0, 0), (1, 1, 1)), box((0.1, 0.1, 0.1), (0.9, 0.9, 0.9))]))

    assert seen.tolist() == [True] * 12 + [False] * 12


def test_of_an_open_cavity_the_walls_are_seen():
    inner = box((0.1, -0.5, 0.1), (0.9, 0.9, 0.9))  # it comes out of the front of the outer one
    faces = inner.face_normals[:, 1] > -0.5
    shell = box((0, 0, 0), (1, 1, 1))
    mesh = merge_meshes([shell.with_faces(shell.face_normals[:, 1] > -0.5), inner.with_faces(faces)])

    assert outer_faces(mesh).all()


def test_faces_where_two_boards_touch_are_hidden():
    mesh = merge_meshes([box((0, 0, 0), (1, 0.1, 1)), box((0, 0.1, 0), (1, 0.2, 1))])
    hidden = mesh.face_areas[~outer_faces(mesh)].sum()

    assert np.isclose(hidden, 2.0)


@given(st.floats(1e-3, 1e3), st.tuples(*[st.floats(-2, 2)] * 3))
def test_neither_size_nor_place_matters(scale, place):
    mesh = merge_meshes([box((0, 0, 0), (2, 1, 1)), box((0.1, 0.1, 0.1), (0.9, 0.9, 0.9))])
    moved = TriangleMesh(scale * (mesh.vertices + np.array(place)), mesh.faces)

    assert outer_faces(moved).tolist() == [True] * 12 + [False] * 12


def test_a_sheet_is_seen_from_either_side_and_nothing_of_nothing():
    assert outer_faces(TriangleMesh(np.eye(3), np.array([[0, 1, 2]]))).tolist() == [True]
    assert outer_faces(merge_meshes([])).tolist() == []
