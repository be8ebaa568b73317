"""What is left of triangles, slim ones too, from which convex pieces go: what shapely says, and no triangle twice."""

import numpy as np
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.geometry.arrays import vec3
from grafu.geometry.remainder import remainder
from grafu.geometry.transform import rotation_matrix


def _pieces(random: np.random.Generator, whole: shapely.Polygon, count: int) -> list[np.ndarray]:
    """Returns the points of convex pieces within a triangle in the plane, some only just thicker than nothing."""
    low, high = np.array(whole.bounds[:2]), np.array(whole.bounds[2:])
    found = []
    for _ in range(count):
        size = 10.0 ** random.uniform(-4, 0, 2) * (high - low)
        points = random.uniform(low, high) + random.normal(size=(random.integers(3, 9), 2)) * size
        piece = shapely.intersection(shapely.MultiPoint(points).convex_hull, whole)
        if piece.area > 1e-9:
            found.append(np.array(piece.exterior.coords))
    return found


@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.sampled_from([1.0, 1e-2, 2e-4]))
@settings(max_examples=60, deadline=None)
def test_what_is_left_is_the_triangle_less_all_pieces(seed, count, height):
    random = np.random.default_rng(seed)
    flat = np.array([[0.0, 0.0], [1.0, 0.0], [random.uniform(-0.2, 1.2), height]])
    whole = shapely.Polygon(flat)
    pieces = _pieces(random, whole, count)
    turn = rotation_matrix(np.asarray(vec3(0.6, 0.0, 0.8)), random.uniform(0.0, 6.0))
    corners = np.column_stack([flat, np.zeros(3)]) @ turn.T
    left = remainder(corners, [np.column_stack([p, np.zeros(len(p))]) @ turn.T for p in pieces])
    assert np.all(np.abs(left.sum(axis=2) - 1.0) < 1e-9)
    first, second, third = np.moveaxis(left @ flat, 1, 0)
    doubled = (second - first)[:, 0] * (third - first)[:, 1] - (second - first)[:, 1] * (third - first)[:, 0]
    expected = whole.difference(shapely.union_all([shapely.Polygon(p) for p in pieces])).area
    assert abs(float(doubled.sum()) / 2 - expected) < 1e-6
    assert abs(float(np.abs(doubled).sum()) / 2 - expected) < 1e-6  # none lies over others


def test_nothing_is_left_where_a_piece_covers_all():
    corners = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]])
    assert len(remainder(corners, [corners])) == 0
