from time import process_time

import numpy as np
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.components import (
    clustered,
    connected_parts,
    drawn_once,
    part_boxes,
    patches_of,
    repeated_faces,
    tidy_parts,
    welded,
)
from grafu.geometry.mesh import TriangleMesh, merge_meshes

CUBE = TriangleMesh.box_mesh(Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 1.0)))


def soup(mesh: TriangleMesh) -> TriangleMesh:
    """The same faces, no vertex shared."""
    return TriangleMesh(mesh.triangles.reshape(-1, 3), np.arange(3 * len(mesh.faces)).reshape(-1, 3))


def volume(mesh: TriangleMesh, faces: np.ndarray) -> float:
    return float(np.linalg.det(mesh.vertices[faces]).sum() / 6)


@given(st.lists(st.tuples(*[st.integers(-50, 50)] * 3), min_size=1, max_size=30))
def test_points_are_welded_by_position_alone(cells):
    points = np.array(cells, dtype=float) / 7

    number = welded(points)

    same = np.all(points[:, None] == points[None], axis=2)
    assert np.array_equal(number[:, None] == number[None], same)


@given(st.lists(st.booleans(), min_size=12, max_size=12))
def test_a_cube_with_faces_turned_at_random_is_closed_and_faces_outwards(turned):
    faces = np.where(np.array(turned)[:, None], CUBE.faces[:, ::-1], CUBE.faces)

    patches = patches_of(soup(TriangleMesh(CUBE.vertices, faces)))

    assert patches.closed.tolist() == [True]
    assert np.isclose(volume(soup(TriangleMesh(CUBE.vertices, faces)), patches.faces), 1)


@given(st.lists(st.booleans(), min_size=10, max_size=10))
def test_an_open_surface_drawn_from_both_sides_is_turned_outwards_once(turned):
    """A tub: a cube without two triangles of its top, some faces of which come first from inside."""
    tub = CUBE.with_faces(np.arange(10))
    one = np.where(np.array(turned)[:, None], tub.faces[:, ::-1], tub.faces)
    no_area = [[one[0, 0], one[0, 0], one[0, 1]]]
    mesh = soup(TriangleMesh(tub.vertices, np.vstack([one, one[:, ::-1], no_area])))

    once, repeats = drawn_once(mesh)

    outwards = np.einsum("ij,ij->i", once.face_normals, once.triangles.mean(axis=1) - tub.box.center)
    assert (len(once.faces), bool((outwards > 0).all())) == (10, True)
    assert repeats[-1] == -1
    assert np.allclose(once.triangles[repeats[:-1]].mean(axis=1), mesh.triangles[:-1].mean(axis=1))


def test_a_face_drawn_twice_counts_once():
    doubled = merge_meshes([CUBE, TriangleMesh(CUBE.vertices, CUBE.faces[:, ::-1])])

    patches = patches_of(doubled)

    assert len(patches.faces) == 12
    assert patches.closed.tolist() == [True]


def test_a_cube_without_a_side_is_open():
    assert patches_of(CUBE.with_faces(np.arange(10))).closed.tolist() == [False]


def test_cubes_that_share_an_edge_are_two_solids():
    both = merge_meshes([CUBE, CUBE.translated(vec3(1.0, 1.0, 0.0))])

    assert patches_of(both).closed.tolist() == [True, True]


def test_cubes_that_share_a_side_are_two_solids_still():
    patches = patches_of(merge_meshes([CUBE, CUBE.translated(vec3(1.0, 0.0, 0.0))]))

    assert len(patches.faces) == 22  # the common side is the same faces drawn twice


def test_a_moebius_strip_bounds_nothing():
    t = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    rim = [
        np.c_[(2 + s * np.cos(t / 2)) * np.cos(t), (2 + s * np.cos(t / 2)) * np.sin(t), s * np.sin(t / 2)]
        for s in (1, -1)
    ]
    k, after = np.arange(12), (np.arange(12) + 1) % 12
    a, b = np.where(after == 0, 12, after), np.where(after == 0, 0, after + 12)
    band = TriangleMesh(np.vstack(rim), np.vstack([np.c_[k, a, k + 12], np.c_[a, b, k + 12]]))

    assert patches_of(band).closed.tolist() == [False]


def test_faces_without_three_corners_are_left_out():
    flat = TriangleMesh(np.zeros((3, 3)), np.array([[0, 1, 2], [0, 0, 1]]))

    assert len(patches_of(flat).faces) == 0


def test_pieces_come_apart_where_no_position_is_shared():
    apart = merge_meshes([soup(CUBE), CUBE.translated(vec3(3.0, 0.0, 0.0))])

    first, second = connected_parts(apart)

    assert np.allclose(first.box.high, [1, 1, 1])
    assert np.allclose(second.box.low, [3, 0, 0])


def test_a_mesh_in_one_piece_is_itself():
    assert connected_parts(CUBE) == [CUBE]
    assert connected_parts(merge_meshes([])) == []


def ball(radius: float, segments: int) -> TriangleMesh:
    return TriangleMesh.from_trimesh(trimesh.creation.uv_sphere(radius, (segments, segments)))


def test_clustering_keeps_the_box_and_the_shape_of_dense_meshes():
    mesh = ball(0.05, 120)

    few = clustered(mesh, 0.004)

    assert len(few.faces) < len(mesh.faces) / 8
    assert few.box == mesh.box
    assert np.abs(np.linalg.norm(few.vertices, axis=1) - 0.05).max() < 1e-6
    assert patches_of(few).closed.all()


def test_clustering_keeps_pieces_apart_and_forgets_doubled_faces():
    gap = CUBE.translated(np.array([1.001, 0.0, 0.0]))
    doubled = merge_meshes([CUBE, gap, TriangleMesh(CUBE.vertices, CUBE.faces[:, ::-1])])

    few = clustered(doubled, 0.01)

    assert len(few.faces) == 24
    assert len(connected_parts(few)) == 2


def test_clustering_leaves_boards_as_they_are_and_nothing_of_specks():
    assert np.allclose(np.sort(clustered(soup(CUBE), 0.001).vertices, axis=0), np.sort(CUBE.vertices, axis=0))
    assert not len(clustered(CUBE.transformed(np.diag([1e-4, 1e-4, 1e-4, 1.0])), 0.01).faces)
    assert clustered(merge_meshes([]), 0.01) == merge_meshes([])


def test_tidy_parts_tell_which_bound_a_solid():
    sheet = CUBE.with_faces(CUBE.face_normals[:, 2] > 0.5).translated(np.array([0.0, 0.0, 3.0]))
    inverted = TriangleMesh(CUBE.vertices, CUBE.faces[:, ::-1])

    (cube, closed), (lid, lid_closed) = tidy_parts(merge_meshes([inverted, sheet, CUBE]))

    assert (closed, lid_closed) == (True, False)
    assert (len(cube.faces), len(lid.faces)) == (12, 2)
    assert volume(cube, cube.faces) > 0
    assert tidy_parts(merge_meshes([])) == []


def test_a_repeated_face_names_the_first_with_its_corners():
    doubled = merge_meshes([soup(CUBE), TriangleMesh(CUBE.vertices, CUBE.faces[::-1, ::-1])])

    assert repeated_faces(CUBE).tolist() == list(range(12))
    assert repeated_faces(doubled).tolist() == [*range(12), *reversed(range(12))]
    assert repeated_faces(merge_meshes([])).tolist() == []


@given(st.lists(st.tuples(*[st.integers(-9, 9)] * 3), min_size=1, max_size=12), st.integers(0, 2))
def test_boxes_of_pieces_are_those_of_the_meshes_of_the_pieces(places, turn):
    axes = np.roll(np.eye(3), turn, axis=0)
    mesh = merge_meshes([CUBE.translated(0.7 * np.array(place, dtype=float)) for place in places])
    order = np.random.default_rng(len(places)).permutation(len(mesh.faces))
    mixed = TriangleMesh(mesh.vertices, mesh.faces[order])

    boxes = [Box.around(piece.vertices @ axes) for piece in connected_parts(mixed)]

    assert np.array_equal(part_boxes(mixed, axes), np.array([[box.low, box.high] for box in boxes]))


def test_a_mesh_of_many_pieces_is_sorted_in_time_that_grows_with_its_faces():
    def seconds(count: int) -> float:
        cubes = merge_meshes([CUBE.translated(vec3(2.0 * k, 0.0, 0.0)) for k in range(count)])
        start = process_time()
        assert len(connected_parts(cubes)) == count
        return process_time() - start

    seconds(50)  # what is loaded once
    assert seconds(4000) < 30 * seconds(400)
