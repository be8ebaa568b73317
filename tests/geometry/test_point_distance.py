"""Distances of points from triangles, against trimesh's."""

import numpy as np
import pytest
import trimesh

from grafu.geometry.sampling import point_triangle_distances


def test_distances_agree_with_those_of_trimesh() -> None:
    rng = np.random.default_rng(1)
    points, triangles = rng.normal(size=(40, 3)), rng.normal(size=(25, 3, 3))

    found = point_triangle_distances(points, triangles)

    for k, triangle in enumerate(triangles):
        nearest = trimesh.triangles.closest_point(np.repeat(triangle[None], len(points), axis=0), points)
        assert np.allclose(found[:, k], np.linalg.norm(points - nearest, axis=1))


@pytest.mark.parametrize("corners", [[[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 0, 0], [0, 0, 0], [2, 0, 0]]])
def test_a_triangle_without_area_counts_as_its_segment(corners: list[list[int]]) -> None:
    found = point_triangle_distances(np.array([[1.5, 0.5, 0.0]]), np.array([corners], dtype=np.float64))

    assert found[0, 0] == pytest.approx(0.5)


def test_no_triangle_is_no_distance() -> None:
    assert point_triangle_distances(np.zeros((2, 3)), np.zeros((0, 3, 3))).shape == (2, 0)
