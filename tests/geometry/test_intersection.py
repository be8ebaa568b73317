"""Posed meshes against one another: what intersects, how far apart, and what is more than a touch."""

import gc

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry import bvh
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.bvh import share_shape
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.remembered import RememberedByContent
from grafu.geometry.swept_body import SweptBody, shrunk
from grafu.geometry.transform import from_rotation, rotation_matrix, translation

DEPTH = 0.01
HOME = np.eye(4)


def box_mesh(low: tuple[float, float, float], high: tuple[float, float, float]) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(vec3(*low), vec3(*high)))


CUBE = box_mesh((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
WALL_MESH = box_mesh((1.0, -5.0, -5.0), (2.0, 5.0, 5.0))
WALL = MeshCollider(WALL_MESH)


def cube_body(reach: float, depth: float = DEPTH) -> SweptBody:
    """A cube whose +X face lies `reach` metres inside the wall."""
    body = SweptBody(box_mesh((0.0, 0.0, 0.0), (1.0 + reach, 1.0, 1.0)), depth)
    body.place(HOME)
    return body


@given(st.floats(0.001, 3.0))
def test_the_distance_of_boxes_is_the_gap_between_them(gap):
    cube = MeshCollider(CUBE)
    cube.place(translation(vec3(-gap, 0.0, 0.0)))
    assert not cube.intersects(WALL)
    assert cube.distance(WALL) == pytest.approx(gap, rel=1e-6)


@given(st.floats(-1.9, -0.001))
def test_boxes_that_cut_one_another_intersect_at_distance_0(gap):
    cube = MeshCollider(CUBE)
    cube.place(translation(vec3(-gap, 0.0, 0.0)))
    assert cube.intersects(WALL)
    assert cube.distance(WALL) == 0.0


def test_a_pose_counts_from_rest_not_from_the_last_pose():
    cube = MeshCollider(CUBE)
    for _ in range(3):
        cube.place(translation(vec3(-0.5, 0.0, 0.0)))
        assert cube.distance(WALL) == pytest.approx(0.5)
        cube.place(from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), np.pi / 2)))  # now -1 <= x <= 0
        assert cube.distance(WALL) == pytest.approx(1.0)


def test_a_mesh_wholly_within_another_does_not_intersect_it():
    inner = MeshCollider(box_mesh((0.4, 0.4, 0.4), (0.6, 0.6, 0.6)))
    assert not inner.intersects(MeshCollider(CUBE))
    assert inner.distance(MeshCollider(CUBE)) == pytest.approx(0.4)


def test_a_dead_mesh_leaves_no_tree_behind():
    def use() -> None:
        mesh = box_mesh((0.0, 0.0, 0.0), (3.0, 1.0, 1.0))
        assert MeshCollider(mesh).intersects(WALL)

    gc.collect()
    before = len(bvh._models)
    use()
    gc.collect()
    assert len(bvh._models) == before


@given(st.floats(0.0, 0.2), st.floats(-1.5, 1.5))
def test_shrinking_moves_each_side_of_its_own_box_in_by_the_depth(depth, yaw):
    R = rotation_matrix(vec3(0.0, 0.0, 1.0), yaw)
    mesh = box_mesh((-0.5, -1.0, -1.5), (0.5, 1.0, 1.5)).transformed(from_rotation(R, vec3(3.0, 2.0, 1.0)))
    local = Box.around(shrunk(mesh, depth, R).vertices @ R)
    np.testing.assert_allclose(local.size, np.array([1.0, 2.0, 3.0]) - 2 * depth, atol=1e-9)
    np.testing.assert_allclose(R @ local.center, [3.0, 2.0, 1.0], atol=1e-9)


def test_thin_sides_keep_a_fifth():
    sheet = shrunk(box_mesh((0.0, 0.0, 0.0), (1.0, 0.001, 1.0)), 0.01)
    np.testing.assert_allclose(sheet.box.size, [0.98, 0.0002, 0.98])


@given(st.floats(-np.pi, np.pi), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0), st.floats(-np.pi, np.pi))
def test_a_copy_that_shares_its_shape_stands_where_it_was_moved_to(angle, x, y, turn):
    T = from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), angle), vec3(x, y, 0.3))
    own, shared, twice = CUBE.transformed(T), CUBE.transformed(T), CUBE.transformed(T @ T)
    share_shape(shared, CUBE, T)
    share_shape(twice, shared, T)
    pairs = [(MeshCollider(own), MeshCollider(shared)), (MeshCollider(CUBE.transformed(T @ T)), MeshCollider(twice))]
    pose = from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), turn), vec3(-0.5, 0.1, 0.0))
    for one, other in pairs:
        assert other.distance(WALL) == pytest.approx(one.distance(WALL), abs=1e-9)
        one.place(pose)
        other.place(pose)
        assert other.distance(WALL) == pytest.approx(one.distance(WALL), abs=1e-9)


@given(st.floats(0.01, 3.0), st.floats(0.0, 3.0))
def test_within_reach_is_what_is_no_farther(gap, reach):
    cube = MeshCollider(CUBE)
    cube.place(translation(vec3(-gap, 0.0, 0.0)))
    if abs(gap - reach) > 1e-9:
        assert cube.is_within(reach, WALL) == (gap < reach)


@given(st.floats(-0.05, 0.05))
def test_a_body_of_pieces_is_what_it_is_as_one(reach):
    pieces = [box_mesh((0.0, 0.0, 0.0), (0.4, 1.0, 1.0)), box_mesh((0.3, 0.0, 0.0), (1.0 + reach, 1.0, 1.0))]
    whole = merge_meshes(pieces)
    bodies = [SweptBody(whole, DEPTH), SweptBody(whole, DEPTH, pieces=pieces)]
    for body in bodies:
        body.place(HOME)
    assert bodies[0].touches(WALL) == bodies[1].touches(WALL)
    assert bodies[0].penetrated([WALL]) == bodies[1].penetrated([WALL])
    assert bodies[0].distance(WALL) == pytest.approx(bodies[1].distance(WALL))


@pytest.mark.parametrize(("reach", "cuts"), [(-0.5, False), (0.0, False), (0.9, False), (2.1, True), (5.0, True)])
def test_a_cut_deeper_than_the_depth_is_more_than_a_touch(reach, cuts):
    body = cube_body(reach * DEPTH)
    assert body.penetrates(WALL) is cuts
    assert body.touches(WALL) is (reach >= 0)


def test_gliding_along_a_wall_is_a_touch_all_the_way():
    body = SweptBody(CUBE, DEPTH)
    for shift in np.linspace(0.0, 3.0, 13):
        body.place(translation(vec3(0.0, shift, 0.0)))
        assert body.touches(WALL)
        assert not body.penetrates(WALL)


def test_a_body_wedged_between_two_walls_penetrates_though_each_alone_would_let_it_out():
    body = cube_body(0.5 * DEPTH)
    near, far = MeshCollider(box_mesh((-1.0, -5.0, -5.0), (0.15, 5.0, 5.0))), WALL
    assert not body.penetrates(far)
    assert body.penetrated([far, near]) == [1]  # the near wall is cut deep
    tight = SweptBody(box_mesh((-1.5 * DEPTH, 0.0, 0.0), (1.0 + 1.5 * DEPTH, 1.0, 1.0)), DEPTH)
    tight.place(HOME)
    left = MeshCollider(box_mesh((-1.0, -5.0, -5.0), (0.0, 5.0, 5.0)))
    assert not tight.penetrates(left)
    assert not tight.penetrates(far)
    assert tight.penetrated([left, far]) == [0, 1]


def test_the_axes_of_a_turned_body_decide_what_is_flush():
    R = rotation_matrix(vec3(0.0, 0.0, 1.0), np.radians(30))
    T = from_rotation(R)
    wall = MeshCollider(box_mesh((1.0, -5.0, -5.0), (2.0, 5.0, 5.0)).transformed(T))
    turned = box_mesh((0.0, 0.0, 0.0), (1.0 + 1e-4, 1.0, 1.0)).transformed(T)
    body = SweptBody(turned, DEPTH, R)
    body.place(HOME)
    assert body.touches(wall)
    assert not body.penetrates(wall)


def test_what_is_known_of_one_pose_or_obstacle_is_not_said_of_another():
    body, far = cube_body(0.2), translation(vec3(-2.0, 0.0, 0.0))
    posed = MeshCollider(CUBE)
    for _ in range(2):
        body.place(HOME)
        assert body.penetrated([WALL, posed]) == [0, 1]
        posed.place(far)
        assert body.penetrated([WALL, posed]) == [0]
        body.place(far)
        assert body.penetrated([WALL, posed]) == [1]
        posed.place(translation(vec3(0.5, 0.5, 0.5)))
        assert body.penetrated([WALL, posed]) == []


def test_an_obstacle_at_rest_is_asked_once_per_pose(monkeypatch):
    asked = []
    hits = MeshCollider.hits
    monkeypatch.setattr(MeshCollider, "hits", lambda *pair: asked.append(pair) or hits(*pair))
    body = cube_body(0.2)
    first = body.penetrated([WALL])
    count = len(asked)
    assert count > 0
    body.place(translation(vec3(0.001, 0.0, 0.0)))
    assert body.penetrated([WALL]) == first
    assert len(asked) == 2 * count
    body.place(HOME)
    assert body.penetrated([MeshCollider(WALL_MESH)]) == first  # another collider of the same mesh
    assert len(asked) == 2 * count


def test_cutting_faces_are_those_that_cut():
    body = cube_body(0.2)
    faces = body.cutting_faces([WALL], [True])
    mesh = box_mesh((0.0, 0.0, 0.0), (1.2, 1.0, 1.0))
    assert faces
    assert not any(mesh.face_normals[k][0] < -0.5 for k in faces)  # the far side is a metre away
    assert cube_body(0.0).cutting_faces([WALL], [True]) == set()
    assert body.cutting_faces([WALL], [False]) == set()


def test_a_wedged_body_cuts_into_what_it_comes_free_of_alone():
    """It comes free of the left wall by a shift to the right, where the other wall stands."""
    mesh = box_mesh((-1.5 * DEPTH, 0.0, 0.0), (1.0 + 0.5 * DEPTH, 1.0, 1.0))
    body, left = SweptBody(mesh, DEPTH), MeshCollider(box_mesh((-1.0, -5.0, -5.0), (0.0, 5.0, 5.0)))
    body.place(HOME)
    assert body.penetrated([left, WALL]) == [0]
    assert body.cutting_faces([left], [True]) == set()
    faces = body.cutting_faces([left, WALL], [True, False])
    assert faces
    assert not any(mesh.face_normals[k][0] > 0.5 for k in faces)


def test_a_body_is_at_no_distance_from_what_it_touches():
    body = cube_body(-0.3)
    assert body.distance(WALL) == pytest.approx(0.3)
    body.place(translation(vec3(0.4, 0.0, 0.0)))
    assert body.distance(WALL) == 0.0


def test_faces_drawn_twice_are_named_both():
    fine = TriangleMesh.from_trimesh(box_mesh((0.0, 0.0, 0.0), (1.2, 1.0, 1.0)).to_trimesh().subdivide().subdivide())
    twice = merge_meshes([fine, TriangleMesh(fine.vertices, fine.faces[:, ::-1])])
    once, count = MeshCollider(fine).faces_in_contact(WALL), len(fine.faces)
    assert once
    assert MeshCollider(twice).faces_in_contact(WALL) == once | {face + count for face in once}


def test_the_box_of_a_pose_is_the_same_whatever_was_posed_before() -> None:
    rng = np.random.default_rng(4)
    moved = MeshCollider(CUBE)
    turns = [rotation_matrix(vec3(0.0, 0.0, 1.0), angle) for angle in (0.0, 0.3, 0.3, 0.7)]
    for turn in [turn for turn in turns for _ in range(3)]:
        T, shift = from_rotation(turn, rng.normal(size=3)), rng.normal(size=3)
        moved.place(T, shift)
        fresh = MeshCollider(CUBE)
        fresh.place(T, shift)
        around = Box.around(CUBE.box.corners() @ turn.T + (T[:3, 3] + shift))

        assert moved.box_gap(fresh) == 0.0
        assert (moved._low, moved._high) == (fresh._low, fresh._high) == (around.low.tolist(), around.high.tolist())


TORUS = TriangleMesh.from_trimesh(trimesh.creation.torus(0.5, 0.2))


@pytest.fixture
def built(monkeypatch: pytest.MonkeyPatch) -> list[TriangleMesh]:
    """The meshes of which a tree is built, from now on."""
    meshes: list[TriangleMesh] = []
    build = bvh._built
    monkeypatch.setattr(bvh, "_by_content", RememberedByContent(bvh._REMEMBERED))
    monkeypatch.setattr(bvh, "_built", lambda mesh: meshes.append(mesh) or build(mesh))
    return meshes


@given(st.floats(-0.3, 0.3), st.floats(-1.5, 1.5))
def test_an_equal_mesh_elsewhere_is_asked_with_one_tree(x, angle):
    turned = from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), angle), vec3(0.1, 0.0, 0.0))

    def distances() -> list[float]:
        ring = MeshCollider(TORUS.translated(vec3(x, 1.0, 2.0)))
        found = [ring.distance(MeshCollider(CUBE)), MeshCollider(CUBE).distance(ring)]
        ring.place(turned)
        return [*found, ring.distance(MeshCollider(CUBE)), ring.distance(WALL)]

    MeshCollider(TORUS).distance(WALL)  # from now on there is a tree, of a mesh that stands elsewhere
    shared = distances()
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(bvh, "_by_content", RememberedByContent(0))
        anew = distances()
    assert shared == pytest.approx(anew, abs=1e-12)


def test_only_an_equal_mesh_shares_a_tree(built):
    first, copy = MeshCollider(TORUS.translated(vec3(0.0, 0.0, 0.0))), TORUS.translated(vec3(0.0, 3.0, 0.0))
    bent = TriangleMesh(TORUS.vertices * [1.0, 1.0, 1.0 + 1e-8], TORUS.faces)
    for mesh in (copy, bent):
        first.distance(MeshCollider(mesh))

    assert len(built) == 2
    assert MeshCollider(copy).number != first.number


def test_what_was_touched_last_is_asked_first(monkeypatch):
    asked: list[MeshCollider] = []
    hits = MeshCollider.hits

    def counted(own: MeshCollider, other: MeshCollider) -> bool:
        asked.append(other)
        return hits(own, other)

    beside = MeshCollider(TORUS.transformed(translation(vec3(0.5, 0.5, 0.5))))  # around the cube's middle: no touch
    small = SweptBody(box_mesh((0.45, 0.45, 0.45), (0.55, 0.55, 0.55)), 0.001)
    floor = MeshCollider(box_mesh((0.0, 0.0, 0.0), (1.0, 1.0, 0.5)))
    monkeypatch.setattr(MeshCollider, "hits", counted)
    for x in (0.0, 0.001, 0.002):
        small.place(translation(vec3(x, 0.0, 0.0)))
        assert small.penetrated([beside, floor]) == [1]

    # at the first pose one after the other, then the floor first; shrunk, all are asked, and then the floor alone
    assert [asked.count(beside), asked.count(floor)] == [1 + 3, 3 * (1 + 1 + 6)]


@given(st.floats(-0.9, 0.9), st.floats(0.0, 3.0))
def test_meshes_that_cross_are_no_distance_apart(offset, angle):
    one = TriangleMesh.box_mesh(Box(np.zeros(3), np.ones(3)))
    other = MeshCollider(TriangleMesh.box_mesh(Box(np.array([0.2, 0.3, -1.0]), np.array([0.4, 0.6, 2.0]))))
    T = from_rotation(rotation_matrix(vec3(1.0, 0.0, 0.0), angle), vec3(0.1, offset, 0.0))
    other.place(T)
    collider = MeshCollider(one)
    if collider.intersects(other):
        assert collider.distance(other) <= 1e-12
    else:
        assert collider.distance(other) > 0


def test_what_merely_lies_flush_is_known_by_boxes_alone(monkeypatch):
    """The core of a body, shrunk by the depth, is apart from what the body only touches."""
    body = cube_body(0.0)
    monkeypatch.setattr(MeshCollider, "hits", None)
    assert body.penetrated([WALL]) == []


def test_once_the_core_is_prepared_it_is_asked_first(monkeypatch):
    body = cube_body(3 * DEPTH)
    post = MeshCollider(box_mesh((0.0, 0.0, 1.0 - 1.5 * DEPTH), (1.0, 1.0, 2.0)).transformed(rotation_about_x(0.2)))
    assert body.penetrated([WALL]) == [0]
    asked = []
    hits = MeshCollider.hits
    monkeypatch.setattr(MeshCollider, "hits", lambda own, other: asked.append(own) or hits(own, other))
    body.place(translation(vec3(0.0, 0.0, -2.2 * DEPTH)))
    assert body.penetrated([post]) == []
    assert asked == [body._shrunk]


def rotation_about_x(angle: float) -> np.ndarray:
    return from_rotation(rotation_matrix(vec3(1.0, 0.0, 0.0), angle))


@given(st.integers(0, 10_000))
def test_a_body_answers_alike_whatever_was_asked_before(seed):
    """Which of its meshes is asked first, and what is known of a pose, changes no answer."""
    rng = np.random.default_rng(seed)
    obstacles = [
        MeshCollider(box_mesh(tuple(low), tuple(low + rng.uniform(0.1, 0.8, 3)))) for low in rng.uniform(-1, 1, (4, 3))
    ]
    mesh = CUBE.transformed(from_rotation(0.5 * np.eye(3)))
    poses = [translation(offset) for offset in rng.uniform(-0.6, 0.6, (4, 3))]
    used, found = SweptBody(mesh, DEPTH), []
    for k in rng.integers(0, len(poses), 8):
        chosen = [obstacles[j] for j in rng.permutation(4)[: rng.integers(1, 5)]]
        fresh = SweptBody(mesh, DEPTH)
        for body in (used, fresh):
            body.place(poses[k])
        found.append((used.penetrated(chosen), fresh.penetrated(chosen)))
    assert [one for one, _ in found] == [other for _, other in found]


def test_a_body_that_slides_is_placed_where_it_is():
    """FCL gets its place alone while its rotation stays."""
    turned, other = MeshCollider(CUBE), MeshCollider(box_mesh((3.0, 0.0, 0.0), (4.0, 1.0, 1.0)))
    R = rotation_matrix(vec3(0.0, 0.0, 1.0), 0.4)
    for offset, angle in ((0.5, 0.4), (1.0, 0.4), (1.5, 0.0), (0.0, 0.4)):
        rotation = R if angle else np.eye(3)
        turned.place(from_rotation(rotation, vec3(offset, 0.0, 0.0)))
        alone = MeshCollider(CUBE.transformed(from_rotation(rotation, vec3(offset, 0.0, 0.0))))
        assert turned.distance(other) == pytest.approx(alone.distance(other), abs=1e-9)
