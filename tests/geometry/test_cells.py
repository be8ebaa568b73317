"""Triangles in cells: what is said to be free is free, and what is occupied is not far from a triangle."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.cells import largest_rectangles, meeting, nearest_depths, pieces_in
from grafu.geometry.mesh import TriangleMesh

UNIT = Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 1.0))
TRIANGLES = arrays(np.float64, (4, 3, 3), elements=st.floats(-1.0, 2.0, width=32))


@given(TRIANGLES, st.tuples(*[st.integers(1, 6)] * 3))
def test_pieces_cover_the_triangles_within_the_box(triangles, cells):
    pieces = pieces_in(triangles, UNIT, cells)
    rng = np.random.default_rng(0)
    weights = rng.dirichlet([1.0, 1.0, 1.0], 50)
    points = (weights @ triangles).reshape(-1, 3)
    inside = points[UNIT.grown(-1e-6).contains(points)]
    covered = [((pieces.low <= p + 1e-9) & (pieces.high >= p - 1e-9)).all(axis=1).any() for p in inside]
    assert all(covered)


@given(TRIANGLES, st.tuples(*[st.integers(1, 6)] * 3))
def test_no_piece_is_larger_than_a_cell_or_outside(triangles, cells):
    pieces = pieces_in(triangles, UNIT, cells)
    assert np.all(pieces.high - pieces.low <= 1.0 / np.array(cells) + 1e-6)
    assert np.all(pieces.low >= 0.0)
    assert np.all(pieces.high <= 1.0)


def test_a_wall_across_an_axis_is_found_where_it_stands():
    wall = TriangleMesh.box_mesh(Box(vec3(0.31, -5.0, -5.0), vec3(0.34, 5.0, 5.0)))
    pieces = pieces_in(wall.triangles, UNIT, (10, 10, 10))
    assert pieces.low[:, 0].min() == pytest.approx(0.31)
    assert pieces.high[:, 0].max() == pytest.approx(0.34)


def test_depths_are_those_of_the_nearest_thing_in_each_column():
    back = TriangleMesh.box_mesh(Box(vec3(0.0, 0.8, 0.0), vec3(1.0, 0.9, 1.0)))
    post = TriangleMesh.box_mesh(Box(vec3(0.05, 0.3, 0.0), vec3(0.15, 0.4, 1.0)))
    triangles = np.concatenate([back.triangles, post.triangles])
    depths = nearest_depths(pieces_in(triangles, UNIT, (5, 5, 5)), UNIT, (5, 5), (0, 2, 1), 1.0)
    np.testing.assert_allclose(depths[0], 0.3)
    np.testing.assert_allclose(depths[1:], 0.8)


@given(arrays(np.bool_, (6, 5)))
def test_the_largest_rectangle_of_each_run_of_rows_is_that_of_brute_force(free):
    rows, found = largest_rectangles(free)
    for (x0, x1, z0, z1), has in zip(rows, found, strict=True):
        spans = [(a, b) for a in range(6) for b in range(a, 6) if free[a : b + 1, z0 : z1 + 1].all()]
        assert has == bool(spans)
        if has:
            assert free[x0 : x1 + 1, z0 : z1 + 1].all()
            assert x1 - x0 == max(b - a for a, b in spans)


def test_only_triangles_near_the_box_meet_it():
    mesh = TriangleMesh.box_mesh(Box(vec3(2.0, 2.0, 2.0), vec3(3.0, 3.0, 3.0)))
    assert len(meeting(mesh.triangles, UNIT)) == 0
    assert len(meeting(mesh.triangles, UNIT.grown(1.1))) > 0


@pytest.mark.parametrize("cells", [(0, 1, 1), (1, 1, -2)])
def test_cells_are_counted_from_one(cells):
    with pytest.raises(ValueError, match="`cells` must be at least 1 along each axis: got"):
        pieces_in(np.zeros((0, 3, 3)), UNIT, cells)


def test_nothing_is_in_an_empty_box():
    assert len(pieces_in(np.zeros((0, 3, 3)), UNIT, (3, 3, 3)).low) == 0
