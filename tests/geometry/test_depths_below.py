"""A grid of rays from above a face: depths on what it meets, infinity beside it."""

import numpy as np
import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster, depths_below


@pytest.mark.parametrize("along", range(3))
def test_depths_below_a_face_are_those_of_the_mesh_and_infinite_beside_it(along):
    low, high = np.zeros(3), np.full(3, 2.0)
    high[along], low[along] = 0.5, 0.25
    half = np.array(high)
    half[(along + 1) % 3] = 1.0
    rays = RayCaster(TriangleMesh.box_mesh(Box(low, half)))
    face = Box(np.zeros(3), np.full(3, 2.0))
    depths = depths_below(rays, face, along, 8, 3.0)
    assert len(depths) == 64
    assert np.isfinite(depths).mean() == 0.5
    assert depths[np.isfinite(depths)] == pytest.approx(1.5, abs=1e-5)


def test_a_mesh_above_the_face_is_met_too():
    rays = RayCaster(TriangleMesh.box_mesh(Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 1.0))))
    depths = depths_below(rays, Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 0.5)), 2, 3, 2.0)
    assert depths == pytest.approx(-0.5, abs=1e-5)
