"""Grips of any size at any spot of boards of any size: sound, within the board, or refused."""

from dataclasses import replace

import numpy as np
from grip_judge import assert_sound, least_wall
from hypothesis import given, settings
from hypothesis import strategies as st
from test_recessed_grips import DRAWER_MOTION, scene_of

from grafu.additions.grip.carve import Carved, carve_grip
from grafu.additions.grip.config import GripConfig, GripKind
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import rotation_matrix
from grafu.refusal import Reason
from small_scenes import box

SIZES = st.tuples(st.floats(0.03, 2.0), st.floats(0.004, 0.06), st.floats(0.03, 2.0))
GRIPS = st.tuples(st.floats(0.005, 0.5), st.floats(0.005, 0.3))
SPOTS = st.tuples(st.floats(-0.2, 1.2), st.floats(-0.2, 1.2))


@settings(max_examples=80, deadline=None)
@given(SIZES, GRIPS, st.floats(0.001, 0.05), SPOTS, st.sampled_from(GripKind), st.sampled_from(["sharp", "rounded"]))
def test_a_grip_is_sound_and_keeps_its_margins_or_is_refused(size, grip, depth, spot, kind, profile):
    board = box("drawer", (0.0, 0.0, 0.0), size)
    config = GripConfig(kind=kind, profile=profile, size=grip, depth=depth)
    wish = vec3(spot[0] * size[0], 0.0, spot[1] * size[2])
    result = carve_grip(scene_of(board, DRAWER_MOTION), "drawer", config, wish)
    if not isinstance(result, Carved):
        assert result.reason in (Reason.TOO_SMALL, Reason.TOO_THIN, Reason.TOO_THICK)
        return
    assert_sound(board, result)
    assert result.part.mesh.is_watertight
    assert np.all(result.size[:2] <= np.array(sorted(grip, reverse=True)) + 1e-9)
    half = np.array([result.size[0], result.size[1]]) / 2
    if abs(result.direction[2]) > 0.5:
        half = half[::-1]
    room = np.minimum(result.centre[[0, 2]], np.array(size)[[0, 2]] - result.centre[[0, 2]]) - half
    assert room[0] > 0
    assert room[1] > 0 or (kind is GripKind.EDGE and room[1] > -1e-9)
    wall = least_wall(result.part, result)
    if kind is GripKind.GROOVE:
        assert abs(wall - (size[1] - result.size[2])) < 1e-4
        assert wall >= 0.003 - 1e-4
    elif kind is GripKind.HOLE:
        assert wall < 1e-6


@settings(max_examples=40, deadline=None)
@given(st.floats(-np.pi, np.pi), st.floats(0.001, 0.3), st.sampled_from(GripKind))
def test_fronts_that_look_anywhere_and_slope_a_little_are_carved(turn, slope, kind):
    """A front turned about Z, whose face leans: one end is thicker than the other."""
    plain = box("drawer", (-0.2, -0.02, 0.0), (0.2, 0.0, 0.15)).mesh
    leaning = np.array(plain.vertices)
    leaning[leaning[:, 1] < -0.01, 1] -= slope * (0.15 - leaning[leaning[:, 1] < -0.01, 2]) * 0.3
    R = rotation_matrix(vec3(0.0, 0.0, 1.0), float(turn))
    board = box("drawer", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    surface = replace(board.surfaces[0], mesh=TriangleMesh(leaning @ R.T, plain.faces))
    board = replace(board, surfaces=(surface,))
    joint_motion = replace(DRAWER_MOTION, axis=replace(DRAWER_MOTION.axis, direction=R @ vec3(0.0, -1.0, 0.0)))
    result = carve_grip(scene_of(board, joint_motion), "drawer", GripConfig(kind=kind))
    assert isinstance(result, Carved), result
    assert_sound(board, result)
    assert result.part.mesh.is_watertight
    assert float(result.outward @ (R @ vec3(0.0, -1.0, 0.0))) > 0.99


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from(GripKind))
def test_however_a_board_is_cut_into_triangles_the_same_is_taken(seed, kind):
    rng = np.random.default_rng(seed)
    board = box("drawer", (-0.2, -0.02, 0.0), (0.2, 0.0, 0.15))
    mesh = board.mesh.to_trimesh().subdivide()
    loose = np.asarray(mesh.triangles[rng.permutation(len(mesh.faces))]).reshape(-1, 3)
    faces = np.arange(len(loose)).reshape(-1, 3)
    turned = rng.random(len(faces)) < 0.5 * (seed % 2)
    faces[turned] = faces[turned][:, ::-1]
    noisy = replace(board, surfaces=(replace(board.surfaces[0], mesh=TriangleMesh(loose, faces)),))
    plain, other = (carve_grip(scene_of(b, DRAWER_MOTION), "drawer", GripConfig(kind=kind)) for b in (board, noisy))
    assert isinstance(plain, Carved)
    assert isinstance(other, Carved)
    assert abs(plain.volume - other.volume) < 1e-9 * plain.volume + 1e-12
    assert np.allclose(plain.centre, other.centre)
    assert other.part.mesh.is_watertight
