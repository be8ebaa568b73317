"""Stacks of boxes: how deep pairs cut into one another, and which meshes are boxes."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box, OrientedBox
from grafu.geometry.box_stack import BoxStack, box_frames, overlapping, penetrations, stacked
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation, rotation_about, rotation_matrix, translation

UNIT = BoxStack.aligned(np.zeros((1, 3)), np.ones((1, 3)))
MESH = TriangleMesh.box_mesh(Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 1.0)))
turns = st.tuples(*[st.floats(-1.0, 1.0)] * 3, st.floats(-3.0, 3.0)).filter(lambda t: np.linalg.norm(t[:3]) > 0.1)


def pose(turn, offset):
    x, y, z, angle = turn
    direction = np.array([x, y, z]) / np.linalg.norm([x, y, z])
    return from_rotation(rotation_matrix(direction, angle), np.array(offset, float))


@pytest.mark.parametrize("shift", [-0.5, -0.1, 0.0, 0.1, 0.5])
def test_aligned_boxes_cut_by_their_least_overlap(shift):
    other = BoxStack.aligned(np.array([[1 + shift, -3.0, -3.0]]), np.array([[9.0, 9.0, 9.0]]))
    assert penetrations(UNIT, other) == pytest.approx([-shift])


def test_a_box_within_another_is_as_deep_as_the_way_out():
    inner = BoxStack.aligned(np.array([[0.1, 0.4, 0.4]]), np.array([[0.2, 0.6, 0.6]]))
    assert penetrations(UNIT, inner) == pytest.approx([0.2])


def test_edge_against_edge_needs_the_crossed_axes():
    """Two cubes turned about different axes, edge towards edge: no face parts them, an edge does."""
    centred = UNIT.moved(translation(vec3(-0.5, -0.5, -0.5)))
    first, second = (centred.moved(from_rotation(rotation_matrix(axis, np.pi / 4))) for axis in np.eye(3)[[2, 1]])
    for gap in (0.01, -0.01):
        apart = second.moved(translation(vec3(np.sqrt(2.0) + gap, 0.0, 0.0)))
        assert penetrations(first, apart) == pytest.approx([-gap])


@given(turns, st.tuples(*[st.floats(-1.5, 1.5)] * 3))
def test_boxes_cut_as_their_meshes_do(turn, offset):
    T = pose(turn, offset)
    depth = float(penetrations(UNIT, UNIT.moved(T))[0])
    a, b = MeshCollider(MESH), MeshCollider(MESH)
    b.place(T)
    if abs(depth) > 1e-6:  # equal boxes have no room for one within the other
        assert a.intersects(b) is (depth > 0)


@given(turns, st.tuples(*[st.floats(-2.0, 2.0)] * 3), st.tuples(*[st.floats(0.01, 2.0)] * 3))
def test_a_box_mesh_is_told_in_any_pose(turn, offset, size):
    box = OrientedBox(np.array(offset), np.array(size) / 2, pose(turn, (0, 0, 0))[:3, :3])
    faces = np.array(MESH.faces)
    is_box, found = box_frames(box.corners()[faces][None])
    assert is_box.tolist() == [True]
    assert found.centers[0] == pytest.approx(box.center, abs=1e-9)
    assert sorted(found.halves[0]) == pytest.approx(sorted(box.half), rel=1e-6)
    assert found.reaches[0] == pytest.approx(np.ptp(box.corners(), axis=0) / 2, rel=1e-6)


def test_a_mesh_of_twelve_other_faces_is_no_box():
    bent = np.array(MESH.vertices)
    bent[7] += 0.1
    doubled = np.vstack([MESH.triangles[:6], MESH.triangles[:6]])
    flat = MESH.triangles * np.array([1.0, 1.0, 0.0])
    is_box, found = box_frames(np.stack([bent[MESH.faces], doubled, flat, MESH.triangles]))
    assert is_box.tolist() == [False, False, False, True]
    assert found.reaches[0] == pytest.approx([0.55, 0.55, 0.55])


@given(st.integers(0, 10_000), st.floats(0.0, 0.3))
def test_overlapping_pairs_are_those_whose_boxes_share_more_than_the_depth(seed, depth):
    rng = np.random.default_rng(seed)
    low = rng.random((2, 6, 3)) * 2
    high = low + rng.random((2, 6, 3))
    a, b = BoxStack.aligned(low[0], high[0]), BoxStack.aligned(low[1], high[1])
    found = set(zip(*map(np.ndarray.tolist, overlapping(a, b, depth)), strict=True))
    shared = np.minimum(high[0][:, None], high[1][None]) - np.maximum(low[0][:, None], low[1][None])
    inside = np.minimum(high[0][:, None] - low[1][None], high[1][None] - low[0][:, None])
    assert {tuple(p) for p in np.argwhere((shared > depth + 1e-12).all(axis=2)).tolist()} <= found
    assert found <= {tuple(p) for p in np.argwhere((inside > depth - 1e-12).all(axis=2)).tolist()}


def test_stacks_can_be_moved_chosen_and_joined():
    T = rotation_about(vec3(1.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0), np.pi / 2)
    both = stacked([UNIT, UNIT.moved(T)])
    assert len(both) == 2
    assert both[1:].centers == pytest.approx(np.array([[0.5, -0.5, 0.5]]))
    assert both == stacked([both[:1], both[1:]])
