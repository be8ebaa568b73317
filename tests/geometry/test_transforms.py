"""Rotations as URDF's angles: they give the same rotation back, also where roll and yaw turn about one axis."""

from itertools import permutations, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry.transform import quaternion_matrix, roll_pitch_yaw, rotation_matrix

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
