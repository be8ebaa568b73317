"""Points on surfaces: many meshes at once give what each gives alone, evenly by area."""

import numpy as np
import pytest

from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.sampling import sample_surface, sample_surfaces
from grafu.synth.samples import TIDY

MESHES = [part.mesh for part in TIDY["corner door at 30 degrees"]().parts]
POINT = TriangleMesh(np.array([[1.0, 2.0, 3.0]]), np.array([[0, 0, 0]]))
EMPTY = TriangleMesh(np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]), np.zeros((0, 3), int))


def plainly(mesh: TriangleMesh, count: int, seed: int) -> np.ndarray:
    """As numpy's own weighted choice draws them."""
    rng = np.random.default_rng(seed)
    areas = mesh.face_areas
    picked = mesh.triangles[rng.choice(len(areas), count, p=areas / areas.sum())]
    u, v = np.sort(rng.random((2, count)), axis=0)
    return np.einsum("nk,nkd->nd", np.stack([u, v - u, 1 - v], axis=1), picked)


def test_all_at_once_is_each_alone():
    several = [*MESHES, POINT, EMPTY]
    assert sample_surfaces(several, 64, 3) == [sample_surface(mesh, 64, 3) for mesh in several]
    assert sample_surfaces([], 64) == []


@pytest.mark.parametrize("seed", range(5))
def test_points_are_numpy_s_own_choice_by_area(seed):
    for mesh, cloud in zip(MESHES, sample_surfaces(MESHES, 128, seed), strict=True):
        assert np.allclose(cloud.points, plainly(mesh, 128, seed), atol=1e-12)


def test_a_side_twice_as_large_gets_twice_as_many_points():
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 5], [2, 0, 5], [0, 1, 5]])
    cloud = sample_surface(TriangleMesh(vertices, np.array([[0, 1, 2], [3, 4, 5]])), 20_000)
    assert (cloud.points[:, 2] > 2).mean() == pytest.approx(2 / 3, abs=0.02)
