"""The quick road to contacts against the plain one: the distance of all triangles."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.geometry.box import Box
from grafu.geometry.budget import Budget
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.touching import batches, near_pairs, touching_pairs
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.synth.samples import KINDS

TOLERANCE = 0.05
grid = st.tuples(*[st.integers(0, 8)] * 3).map(lambda p: np.array(p) / 10.0)
sides = st.tuples(*[st.sampled_from([0.05, 0.1, 0.3, 0.9])] * 3).map(np.array)
UP = np.array([0.0, 0.0, 1.0])


def box(corner, size) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(corner, corner + size))


def sheet(mesh: TriangleMesh, side: int) -> TriangleMesh:
    """One side of a box."""
    return mesh.with_faces(np.array([2 * side, 2 * side + 1]))


def shell(mesh: TriangleMesh) -> TriangleMesh:
    """A box without its back and top."""
    return mesh.with_faces(np.array([0, 1, 4, 5, 8, 9, 10, 11]))


def turned(mesh: TriangleMesh, angle: float) -> TriangleMesh:
    return mesh.transformed(from_rotation(rotation_matrix(UP, angle)))


def halved(mesh: TriangleMesh) -> TriangleMesh:
    """A box with one triangle of each pair."""
    return mesh.with_faces(np.arange(0, 12, 2))


def shuffled(mesh: TriangleMesh) -> TriangleMesh:
    return TriangleMesh(mesh.vertices, mesh.faces[np.random.default_rng(0).permutation(len(mesh.faces))])


def doubled(mesh: TriangleMesh) -> TriangleMesh:
    return TriangleMesh(mesh.vertices, np.vstack([mesh.faces, mesh.faces[:, ::-1]]))


boards = st.builds(box, grid, sides)
meshes = st.one_of(
    boards,
    st.builds(sheet, boards, st.integers(0, 5)),
    st.builds(turned, boards, st.sampled_from([0.0, 0.3, np.pi / 4, np.pi / 2])),
    st.builds(lambda *several: merge_meshes(several), boards, boards),
    *(st.builds(edit, boards) for edit in (shell, halved, shuffled, doubled)),
)


def touch_plainly(a: TriangleMesh, b: TriangleMesh, tolerance: float) -> bool:
    return MeshCollider(a).distance(MeshCollider(b)) <= tolerance


def all_pairs(count: int) -> list[tuple[int, int]]:
    return [(a, b) for a in range(count) for b in range(a + 1, count)]


# Distances are multiples of 0.05; the tolerance lies between two of them, where rounding cannot decide.
@settings(max_examples=200)
@given(st.lists(meshes, min_size=2, max_size=4))
def test_the_quick_road_finds_what_the_plain_one_finds(several):
    pairs = all_pairs(len(several))
    tolerance = TOLERANCE + 0.0123
    expected = [(a, b) for a, b in pairs if touch_plainly(several[a], several[b], tolerance)]
    assert touching_pairs(several, pairs, tolerance) == expected


@pytest.mark.parametrize("name", list(KINDS)[::3])
def test_it_finds_the_contacts_of_made_furniture(name):
    asset = KINDS[name]()
    several = [part.mesh for part in asset.parts]
    pairs = all_pairs(len(several))
    tolerance = 0.0051 * asset.extent
    expected = [(a, b) for a, b in pairs if touch_plainly(several[a], several[b], tolerance)]
    assert touching_pairs(several, pairs, tolerance) == expected


def test_a_box_within_another_touches_it_only_where_their_sides_are_near():
    outer = box(np.zeros(3), np.ones(3))
    assert touching_pairs([outer, box(np.full(3, 0.3), np.full(3, 0.4))], [(0, 1)], 0.29) == []
    assert touching_pairs([outer, box(np.full(3, 0.3), np.full(3, 0.4))], [(0, 1)], 0.31) == [(0, 1)]


def test_large_meshes_are_found_by_their_triangles():
    sphere = np.random.default_rng(1).normal(size=(9000, 3))
    sphere /= np.linalg.norm(sphere, axis=1)[:, None]
    cloud = TriangleMesh(sphere, np.arange(9000).reshape(-1, 3))
    wall = box(np.array([1.02, -1.0, -1.0]), np.ones(3) * 2)
    for tolerance in (0.001, 0.1):
        expected = [(0, 1)] if touch_plainly(cloud, wall, tolerance) else []
        assert touching_pairs([cloud, wall], [(0, 1)], tolerance) == expected


def test_no_pairs_and_no_faces_touch_nothing():
    empty = TriangleMesh(np.zeros((1, 3)), np.zeros((0, 3), int))
    assert touching_pairs([], [], 0.1) == []
    assert touching_pairs([empty, empty, box(np.zeros(3), np.ones(3))], [(0, 1), (1, 2)], 0.1) == []


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_boxes_in_a_row_are_swept_along_it_whichever_way_it_runs(axis):
    """Swept along X, all of a stack would be looked at as neighbours of all: more than fits into little room."""
    ends = np.zeros((1000, 2, 3))
    ends[:, 1] = 1.0
    ends[:, :, axis] = np.arange(1000)[:, None] + np.array([0.0, 1.0])
    with Budget(room=5_000_000).in_force():
        found = near_pairs([Box(low, high) for low, high in ends], 0.001)
    assert found == [(k, k + 1) for k in range(999)]


def test_boxes_that_all_overlap_along_each_axis_are_looked_at_in_batches(monkeypatch):
    """Of boxes on a sphere each overlaps hundreds along X, Y and Z: only pairs that are near are kept."""
    monkeypatch.setattr("grafu.geometry.touching._AT_ONCE", 10_000)
    points = np.random.default_rng(2).normal(size=(1500, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    gaps = np.abs(points[:, None] - points[None]).max(axis=2) - 0.02
    expected = [(int(a), int(b)) for a, b in np.argwhere(np.triu(gaps <= 0.001, 1))]
    with Budget(room=3_000_000).in_force():
        found = near_pairs([Box(p - 0.01, p + 0.01) for p in points], 0.001)
    assert found == expected
    assert len(found) > 100


@pytest.mark.parametrize("counts", [(), (0,), (3, 3, 3), (0, 9, 0, 0), (1, 20, 2, 7, 0)])
def test_batches_hold_all_and_no_more_than_fits_but_for_one(counts):
    rows = batches(np.array(counts, dtype=np.int64), 7)
    assert [rows[0][0], rows[-1][1]] == [0, len(counts)]
    assert all(end == start for (_, end), (start, _) in pairwise(rows))
    assert all(sum(counts[a:b]) <= 7 or b == a + 1 for a, b in rows)
