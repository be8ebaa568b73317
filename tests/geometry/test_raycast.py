"""Rays against boxes, where every distance is known; misses, empty meshes, and robust medians."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster, robust_median

CUBE = TriangleMesh.box_mesh(Box(vec3(-0.5, -0.5, -0.5), vec3(0.5, 0.5, 0.5)))
CASTER = RayCaster(CUBE)
X = vec3(1.0, 0.0, 0.0)


@given(*[st.floats(-0.45, 0.45)] * 2, st.floats(0.51, 2.0))
def test_rays_meet_the_near_side_of_a_cube_to_a_micrometre(y, z, start):
    found = CASTER.along(np.array([[-start, y, z], [start, y, z]]), X)
    assert found[0] == pytest.approx(start - 0.5, abs=1e-6)
    assert found[1] == np.inf  # it looks away


def test_rays_from_inside_meet_the_far_side_whichever_way_faces_look():
    inverted = RayCaster(TriangleMesh(CUBE.vertices, CUBE.faces[:, ::-1]))
    for caster in (CASTER, inverted):
        assert caster.along(np.zeros((1, 3)), X)[0] == pytest.approx(0.5, abs=1e-6)


def test_each_ray_has_its_own_direction():
    directions = np.vstack([np.eye(3), -np.eye(3)])
    found = CASTER.distances(-2.0 * directions, directions)
    np.testing.assert_allclose(found, 1.5, atol=1e-6)


def test_the_first_of_several_faces_counts():
    row = merge_meshes([CUBE.translated(vec3(x, 0.0, 0.0)) for x in (6.0, 3.0, 9.0)])
    assert RayCaster(row).along(np.zeros((1, 3)), X)[0] == pytest.approx(2.5, abs=1e-6)


def test_a_sheet_is_met_from_both_sides():
    sheet = RayCaster(CUBE.with_faces(np.flatnonzero(CUBE.face_normals[:, 0] > 0.5)))
    found = sheet.distances(np.array([[-1.0, 0.1, 0.2], [2.0, 0.1, 0.2]]), np.array([X, -X]))
    np.testing.assert_allclose(found, [1.5, 1.5], atol=1e-6)


def test_nothing_is_met_where_there_is_nothing():
    empty = RayCaster(TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64)))
    assert np.isinf(empty.along(np.zeros((3, 3)), X)).all()
    assert CASTER.along(np.zeros((0, 3)), X).shape == (0,)


@pytest.mark.parametrize(
    ("distances", "median"),
    [
        ([1.0, 2.0, 3.0], 2.0),
        ([1.0, 2.0, 9.0, np.inf], 1.5),  # 9 is out of reach
        ([1.0, np.inf, np.inf, np.inf], np.inf),  # a quarter of the rays is too few
        ([1.0, 2.0, np.inf, np.inf], 1.5),
        ([np.inf], np.inf),
        ([], np.inf),
    ],
)
def test_the_robust_median_asks_for_enough_hits_in_reach(distances, median):
    assert robust_median(np.array(distances), reach=5.0) == median
