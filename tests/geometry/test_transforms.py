"""Rotations as URDF's angles: they give the same rotation back, also where roll and yaw turn about one axis."""

from itertools import permutations, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import quaternion_matrix, reflection, roll_pitch_yaw, rotation_about, rotation_matrix

X, Y, Z = np.eye(3)
PERMUTED = [np.diag(signs)[list(order)] for order in permutations(range(3)) for signs in product((1.0, -1.0), repeat=3)]
TURNS = [R for R in PERMUTED if np.linalg.det(R) > 0]

parts = st.floats(-1, 1)


def of_angles(angles: np.ndarray) -> np.ndarray:
    roll, pitch, yaw = angles
    return rotation_matrix(Z, yaw) @ rotation_matrix(Y, pitch) @ rotation_matrix(X, roll)


@pytest.mark.parametrize("R", TURNS, ids=lambda R: str((R @ [1, 2, 3]).astype(int)))
def test_quarter_turns_come_back(R: np.ndarray) -> None:
    np.testing.assert_allclose(of_angles(roll_pitch_yaw(R)), R, atol=1e-9)


@given(st.tuples(parts, parts, parts, parts).filter(lambda q: sum(x * x for x in q) > 0.01))
def test_every_rotation_comes_back(quaternion: tuple[float, float, float, float]) -> None:
    R = quaternion_matrix(*quaternion)

    np.testing.assert_allclose(of_angles(roll_pitch_yaw(R)), R, atol=1e-6)


@given(st.floats(-7.0, 7.0))
def test_a_rotation_about_an_axis_is_remembered_as_it_is(angle):
    axis = Axis(vec3(0.3, -0.2, 1.0), vec3(0.0, 0.6, 0.8))
    expected = rotation_about(axis.point, axis.direction, angle)
    assert axis.rotation(angle) is axis.rotation(angle)
    np.testing.assert_array_equal(axis.rotation(angle), expected)
    with pytest.raises(ValueError, match="read-only"):
        axis.rotation(angle)[0, 3] = 1.0


def test_a_mesh_that_is_moved_keeps_its_faces_and_copies_nothing_else():
    mesh = TriangleMesh(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]]))
    moved = mesh.transformed(rotation_about(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0), np.pi / 2))
    np.testing.assert_allclose(moved.vertices, [[0.0, 0, 0], [0, 1, 0], [-1, 0, 0]], atol=1e-12)
    assert moved.faces is mesh.faces
    assert not moved.vertices.flags.writeable
    assert moved == TriangleMesh(moved.vertices, moved.faces)
    mirrored = mesh.transformed(reflection(vec3(0.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0)))
    assert mirrored.faces.tolist() == [[2, 1, 0]]
    with pytest.raises(ValueError, match="finite"):
        mesh.translated(vec3(np.inf, 0.0, 0.0))
