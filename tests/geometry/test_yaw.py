"""The yaw of a part's own box, seen from above: solids, sheets that are lines, and points without any."""

import numpy as np
import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box, yaw_of
from grafu.geometry.transform import rotation_matrix

BOARD = Box(vec3(-0.4, -0.01, 0.0), vec3(0.4, 0.01, 0.7)).corners()
SHEET = Box(vec3(-0.4, 0.0, 0.0), vec3(0.4, 0.0, 0.7)).corners()


def turned(points: np.ndarray, degrees: float) -> np.ndarray:
    return points @ rotation_matrix(vec3(0.0, 0.0, 1.0), np.radians(degrees)).T + 0.3


@pytest.mark.parametrize("points", [BOARD, SHEET], ids=["board", "sheet"])
@pytest.mark.parametrize("degrees", [-40.0, -10.0, 0.0, 1.0, 30.0, 44.0])
def test_the_yaw_is_that_of_the_parts_own_sides(points, degrees):
    assert np.degrees(yaw_of(turned(points, degrees))) == pytest.approx(degrees, abs=0.01)


@pytest.mark.parametrize("points", [BOARD, SHEET], ids=["board", "sheet"])
@pytest.mark.parametrize("quarter", [90.0, 180.0, 270.0])
def test_quarter_turns_are_no_yaw(points, quarter):
    assert yaw_of(turned(points, quarter)) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("points", [np.zeros((0, 3)), np.ones((1, 3)), np.array([[1.0, 2.0, 0.0], [1.0, 2.0, 5.0]])])
def test_what_is_a_point_from_above_has_no_yaw(points):
    assert yaw_of(points) == 0.0


def test_a_level_square_has_no_yaw():
    assert yaw_of(np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])) == 0.0
