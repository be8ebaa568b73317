"""Large meshes are asked block by block: the answers are those of one BVH, and far blocks are never built."""

import gc
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grafu.geometry import blocks, intersection
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.blocks import LARGE, blocks_of
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.swept_body import SweptBody
from grafu.geometry.transform import from_rotation, rotation_matrix, translation

SIDE = 60  # quads along each side of a board: 7200 faces


def rough_board(seed: int) -> TriangleMesh:
    """A board of 1 m x 1 m across Z whose surface is uneven by some millimetres, as a scan or a generator draws it."""
    steps = np.linspace(0.0, 1.0, SIDE + 1)
    x, y = (grid.ravel() for grid in np.meshgrid(steps, steps, indexing="ij"))
    z = np.random.default_rng(seed).uniform(-0.003, 0.003, x.size)
    first = (np.arange(SIDE)[:, None] * (SIDE + 1) + np.arange(SIDE)).ravel()
    corners = np.stack([first, first + SIDE + 1, first + SIDE + 2, first + 1], axis=1)
    return TriangleMesh(np.stack([x, y, z], axis=1), np.vstack([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]))


BOARD, OTHER = rough_board(1), rough_board(2)
SMALL = TriangleMesh(vec3(0.4, 0.4, -0.2) + 0.2 * np.vstack([np.zeros((1, 3)), np.eye(3)]), np.array([[0, 1, 3]]))


@pytest.fixture
def undivided(monkeypatch: pytest.MonkeyPatch) -> Iterator[pytest.MonkeyPatch]:
    """Gives what turns division off."""
    yield monkeypatch
    blocks.forget_large_shapes()


@st.composite
def poses(draw: st.DrawFn) -> Mat4:
    """A pose in which the boards touch, cut or miss one another."""
    axis = vec3(*(draw(st.floats(-1.0, 1.0)) for _ in range(3)))
    axis = axis / np.linalg.norm(axis) if np.linalg.norm(axis) > 0.1 else vec3(0.0, 0.0, 1.0)
    R = rotation_matrix(axis, draw(st.floats(-0.6, 0.6)))
    return from_rotation(R, vec3(draw(st.floats(-0.5, 0.5)), draw(st.floats(-0.5, 0.5)), draw(st.floats(-0.1, 0.1))))


def answers(mesh: TriangleMesh, other: TriangleMesh, T: Mat4) -> tuple[bool, float, set[int]]:
    one, obstacle = MeshCollider(mesh), MeshCollider(other)
    one.place(T)
    return one.intersects(obstacle), one.distance(obstacle), one.faces_in_contact(obstacle)


@pytest.mark.parametrize("other", [OTHER, SMALL], ids=["large", "small"])
@given(T=poses())
@settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_blocks_answer_as_one_tree_does(other: TriangleMesh, undivided: pytest.MonkeyPatch, T: Mat4) -> None:
    with undivided.context() as patch:
        patch.setattr(intersection, "_MOST_CONTACTS", 10**6)
        found = answers(BOARD, other, T)
        assert blocks_of(BOARD) is not None
        patch.setattr(blocks, "LARGE", 10**9)
        meets, distance, faces = answers(BOARD, other, T)
    assert found == (meets, pytest.approx(distance, abs=1e-9), faces)


def test_only_blocks_near_the_other_mesh_get_a_tree() -> None:
    mesh = rough_board(3)
    edge = MeshCollider(SMALL.translated(vec3(-0.45, 0.0, 0.2)))
    assert MeshCollider(mesh).intersects(edge)
    divided = blocks_of(mesh)
    assert divided is not None
    assert 0 < len(divided._made) < len(divided.faces) / 2


def test_the_blocks_hold_each_face_once() -> None:
    divided = blocks_of(BOARD)
    assert divided is not None
    np.testing.assert_array_equal(np.sort(np.concatenate(divided.faces)), np.arange(len(BOARD.faces)))
    assert max(map(len, divided.faces)) <= blocks.BLOCK


def test_a_dead_mesh_leaves_no_blocks_behind() -> None:
    mesh = rough_board(4)
    assert MeshCollider(mesh).distance(MeshCollider(SMALL)) == 0.0
    gc.collect()
    before = len(blocks._divided_meshes)
    del mesh
    gc.collect()
    assert len(blocks._divided_meshes) == before - 1


def test_a_mesh_that_is_not_large_is_not_divided() -> None:
    assert len(SMALL.faces) <= LARGE
    assert blocks_of(SMALL) is None


def test_a_large_body_that_only_touches_does_not_penetrate() -> None:
    """A swept body of blocks tells a touch from a cut, as a small one does."""
    floor = MeshCollider(BOARD)
    body = SweptBody(OTHER, 0.002)
    body.place(translation(vec3(0.0, 0.0, 0.02)))
    assert not body.penetrates(floor)
    body.place(from_rotation(rotation_matrix(vec3(1.0, 0.0, 0.0), 0.3), vec3(0.0, 0.1, -0.1)))
    assert body.penetrates(floor)
