"""How furniture stands turned, from its upright faces."""

from math import pi, radians

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from grafu.asset.edit import yawed
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, heading_of
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.synth.samples import KINDS

BOARD = TriangleMesh.box_mesh(Box(vec3(0.0, 0.0, 0.0), vec3(0.8, 0.02, 0.7)))


def turned(mesh: TriangleMesh, angle: float) -> TriangleMesh:
    return mesh.transformed(from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), angle)))


def apart(one: float, other: float) -> float:
    """The angle between two crosses of axes."""
    return abs((one - other + pi / 4) % (pi / 2) - pi / 4)


@given(st.floats(-3.0, 3.0))
def test_a_board_says_how_it_is_turned(angle):
    found = heading_of([turned(BOARD, angle)])
    assert -pi / 4 < found <= pi / 4 + 1e-9
    assert apart(found, angle) < (1e-6 if apart(angle, 0.0) > radians(1.6) else radians(1.6))


@pytest.mark.parametrize("degrees", [3.0, 30.0, 44.0, 45.0, -20.0, 88.0])
def test_whole_furniture_says_how_it_is_turned(degrees):
    asset = yawed(KINDS["drawers behind a pair"](), radians(degrees))
    found = heading_of(part.mesh for part in asset.parts if part.label.value.endswith("panel"))
    assert apart(found, radians(degrees)) < 1e-3


def test_a_turned_board_among_straight_ones_turns_nothing():
    straight = [BOARD, BOARD.translated(vec3(0.0, 0.5, 0.0))]
    assert heading_of([*straight, turned(BOARD, 0.5)]) == 0.0
    assert heading_of([BOARD, *(turned(BOARD, 0.5) for _ in range(3))]) == pytest.approx(0.5, abs=1e-9)


def rough(mesh: TriangleMesh, height: float, seed: int = 3) -> TriangleMesh:
    """Cut into small faces, the corners of which lie off by up to this height, as a scan or a generator makes it."""
    fine = mesh.to_trimesh().subdivide_to_size(0.03)
    off = np.random.default_rng(seed).uniform(-height, height, fine.vertices.shape)
    return TriangleMesh(np.asarray(fine.vertices) + off, np.asarray(fine.faces, dtype=np.int64))


def test_a_rough_surface_says_how_its_walls_run_as_a_whole():
    """Few of its faces lie along one direction; a round table has no direction, however rough."""
    case = TriangleMesh.box_mesh(Box(vec3(-0.5, -0.25, 0.0), vec3(0.5, 0.25, 1.8)))
    assert apart(heading_of([turned(rough(case, 0.001), radians(7.0))], least=0.5), radians(7.0)) < radians(0.5)
    round_top = TriangleMesh.from_trimesh(trimesh.creation.cylinder(0.5, 0.7, sections=64))
    assert heading_of([turned(rough(round_top, 0.001), radians(7.0))], least=0.5) == 0.0


def test_a_corner_cabinet_stands_as_its_walls_do():
    for kind in ("corner door at 45 degrees", "corner door at 30 degrees"):
        assert heading_of(part.mesh for part in KINDS[kind]().parts) == 0.0


def test_lying_and_missing_faces_say_nothing():
    flat = TriangleMesh(np.array([[0.0, 0, 0], [1, 1, 0], [0, 1, 0]]), np.array([[0, 1, 2]]))
    empty = TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=int))
    assert heading_of([]) == heading_of([flat]) == heading_of([empty]) == 0.0
