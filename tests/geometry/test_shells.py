"""One mesh of many bodies gives its shells back, wherever they touch and however the faces are drawn."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.geometry import shells
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.shells import _given_to_most, shell_numbers
from strategies import cabinet_specs, made

UNIT = Box(np.zeros(3), np.ones(3))


def boxes_of(meshes):
    rows = [np.round([*mesh.box.low, *mesh.box.high], 6) + 0.0 for mesh in meshes]
    return sorted(map(tuple, rows))


def shells_of(mesh):
    numbers = shell_numbers(mesh)
    return [mesh.with_faces(numbers == k) for k in range(int(numbers.max()) + 1)]


def soup(mesh):
    """The mesh as an STL holds it: each face with three vertices of its own."""
    return TriangleMesh(mesh.triangles.reshape(-1, 3), np.arange(3 * len(mesh.faces)).reshape(-1, 3))


def cube(x, y=0.0, z=0.0):
    return TriangleMesh.box_mesh(UNIT).translated(np.array([x, y, z], dtype=float))


@pytest.mark.parametrize(
    "bodies",
    [
        [cube(0)],
        [cube(0), cube(3)],
        [cube(0), cube(1, 1)],  # an edge in common
        [cube(0), cube(1, 1, 1)],  # a corner
        [cube(0), cube(1)],  # a face
        [cube(0), cube(1), cube(2), cube(1, 0, 1)],
        [cube(0), TriangleMesh(cube(1).vertices, cube(1).faces[:, [1, 2, 0]])],
    ],
)
def test_bodies_that_touch_are_shells_of_their_own(bodies):
    assert boxes_of(shells_of(soup(merge_meshes(bodies)))) == boxes_of(bodies)


def test_the_diagonals_of_a_face_in_common_need_not_agree():
    turned = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    for base in (np.eye(3), turned, turned @ turned):
        other = TriangleMesh((cube(0).vertices - 0.5) @ base.T + [1.5, 0.5, 0.5], cube(0).faces)
        assert boxes_of(shells_of(soup(merge_meshes([cube(0), other])))) == boxes_of([cube(0), other])


def test_faces_drawn_twice_count_once_and_sheets_stay_sheets():
    doubled = merge_meshes([cube(0), TriangleMesh(cube(0).vertices, cube(0).faces[:, ::-1])])
    sheet = TriangleMesh(np.array([[5.0, 0, 0], [6, 0, 0], [6, 1, 0], [5, 1, 0]]), np.array([[0, 1, 2], [0, 2, 3]]))

    assert len(shells_of(doubled)) == 1
    assert len(shells_of(soup(merge_meshes([sheet, doubled])))) == 2


def test_shells_of_several_meshes_are_those_of_each():
    """Meshes of any size, one without faces, two in the same place: none has a shell in common with another."""
    empty = TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64))
    tiny = TriangleMesh(1e-4 * merge_meshes([cube(0), cube(1)]).vertices, merge_meshes([cube(0), cube(1)]).faces)
    meshes = [cube(0), empty, soup(merge_meshes([cube(0), cube(0.5, 1)])), tiny, cube(0)]
    expected, count = [], 0
    for mesh in meshes:
        expected.append(shell_numbers(mesh) + count)
        count += int(shell_numbers(mesh).max(initial=-1)) + 1

    assert count == 6
    np.testing.assert_array_equal(shell_numbers(*meshes), np.concatenate(expected))


def test_nothing_has_no_shells():
    assert len(shell_numbers(TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64)))) == 0


@settings(max_examples=15, deadline=None)
@given(cabinet_specs, st.sampled_from([1e-3, 1.0, 1e3]), st.randoms(use_true_random=False))
def test_made_furniture_falls_into_what_it_was_welded_from(spec, unit, random):
    parts = [soup(part.mesh.transformed(np.diag([unit, unit, unit, 1.0]))) for part in made(spec).parts]
    random.shuffle(parts)
    welded = merge_meshes(parts)
    faces = list(range(len(welded.faces)))
    random.shuffle(faces)
    found = shells_of(TriangleMesh(welded.vertices, welded.faces[faces]))
    expected = [shell for part in parts for shell in shells_of(part)]

    def scaled(meshes):
        return [mesh.transformed(np.diag([1 / unit, 1 / unit, 1 / unit, 1.0])) for mesh in meshes]

    assert boxes_of(scaled(found)) == boxes_of(scaled(expected))


def test_equal_meshes_are_sorted_into_shells_once():
    """Stage after stage asks for the shells of the same mesh, read or turned anew."""
    mesh = merge_meshes([cube(0), cube(1, 1)])
    again = TriangleMesh(mesh.vertices.copy(), mesh.faces.copy())
    assert shell_numbers(mesh) is shell_numbers(again)
    moved = TriangleMesh(mesh.vertices + [0.0, 0.0, 1e-3] * (np.arange(16)[:, None] >= 8), mesh.faces)
    assert shell_numbers(moved) is not shell_numbers(mesh)
    assert shell_numbers(mesh, cube(4)).max() == 2


def given_plainly(at: np.ndarray, edge: np.ndarray, is_cap: np.ndarray) -> np.ndarray:
    """One cap after the other, as `_given_to_most` states it."""
    given = np.arange(len(is_cap))
    for cap in np.flatnonzero(is_cap):
        around = at[np.isin(edge, edge[at == cap]) & ~is_cap[at]]
        given[cap] = np.bincount(around).argmax() if len(around) else cap
    return given


@given(st.data())
def test_caps_go_where_one_after_the_other_would(data):
    shells = data.draw(st.lists(st.booleans(), min_size=1, max_size=8))
    sides = data.draw(st.lists(st.tuples(st.integers(0, len(shells) - 1), st.integers(0, 9)), max_size=40))
    at, edge = np.array(sides, dtype=np.int64).reshape(-1, 2).T
    is_cap = np.array(shells)
    assert np.array_equal(_given_to_most(at, edge, is_cap), given_plainly(at, edge, is_cap))


def several_bodies(count: int) -> list[TriangleMesh]:
    """Meshes of one to three boxes each, some of which touch, one without faces among them."""
    rng = np.random.default_rng(count)
    bodies = []
    for _ in range(count):
        corners = rng.integers(0, 3, (int(rng.integers(1, 4)), 3)).astype(float)
        bodies.append(merge_meshes([TriangleMesh.box_mesh(Box(low, low + 1.0)) for low in corners]))
    return [*bodies, TriangleMesh(np.zeros((1, 3)), np.zeros((0, 3), np.int64)), *bodies[:1]]


@pytest.mark.parametrize("count", [1, 2, 5, 9])
def test_numbers_are_the_same_whether_large_meshes_are_numbered_by_themselves_or_not(count, monkeypatch):
    monkeypatch.setattr(shells, "_LARGE", 20)
    meshes = several_bodies(count)
    assert np.array_equal(shell_numbers(*meshes), shells._numbers_of(meshes))


def test_a_large_mesh_is_numbered_once_whatever_is_beside_it(monkeypatch):
    large = merge_meshes([TriangleMesh.box_mesh(Box(np.full(3, 1.0 * k), np.full(3, k + 0.5))) for k in range(200)])
    small = TriangleMesh.box_mesh(Box(np.zeros(3), np.full(3, 0.123)))
    asked, number = list[int](), shells._numbers_of

    def noted(meshes):
        asked.extend(len(mesh.faces) for mesh in meshes)
        return number(meshes)

    monkeypatch.setattr(shells, "_numbers_of", noted)
    alone, beside = shell_numbers(large), shell_numbers(small, large)
    assert beside.tolist() == [0] * 12 + (alone + 1).tolist()
    assert shell_numbers(large, small, large).max() == 400
    assert asked == [2400, 12]
