"""The paper's coverage test by rays: what lies near the greatest height, over all that lies above the floor."""

import numpy as np
import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.judging.coverage import CoverageTestConfig, coverage_ratio


def block(low: tuple[float, float, float], high: tuple[float, float, float]) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(vec3(*low), vec3(*high)))


def case() -> list[TriangleMesh]:
    """A box of 1 x 0.5 x 0.8 m that is open above; walls of 20 mm."""
    return [
        block((0.0, 0.0, 0.0), (0.02, 0.5, 0.8)),
        block((0.98, 0.0, 0.0), (1.0, 0.5, 0.8)),
        block((0.0, 0.48, 0.0), (1.0, 0.5, 0.8)),
        block((0.0, 0.0, 0.0), (1.0, 0.5, 0.02)),
    ]


@pytest.mark.parametrize("scale", [0.01, 1.0, 100.0])
def test_walls_alone_cover_their_own_plan(scale: float) -> None:
    walls = (2 * 0.02 * 0.5 + 0.96 * 0.02) / 0.5
    meshes = [mesh.transformed(np.diag([scale] * 3 + [1.0])) for mesh in case()]
    assert coverage_ratio(meshes) == pytest.approx(walls, abs=0.02)


def test_a_top_covers_all() -> None:
    assert coverage_ratio([*case(), block((0.0, 0.0, 0.8), (1.0, 0.5, 0.82))]) == 1.0


@pytest.mark.parametrize("ratio", [0.25, 0.5, 0.75])
def test_half_a_top_covers_half(ratio: float) -> None:
    assert coverage_ratio([block((0.0, 0.0, 0.0), (1.0, 0.5, 0.1)), block((0.0, 0.0, 0.7), (ratio, 0.5, 0.8))]) == (
        pytest.approx(ratio, abs=0.01)
    )


def test_a_mirror_above_the_top_hides_it_as_in_the_paper() -> None:
    top, mirror = block((0.0, 0.0, 0.8), (1.0, 0.5, 0.82)), block((0.0, 0.48, 0.8), (1.0, 0.5, 1.5))
    assert coverage_ratio([*case(), top, mirror]) < CoverageTestConfig().covered


def test_nothing_covers_nothing() -> None:
    assert coverage_ratio([]) == 0.0
    assert coverage_ratio([TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))]) == 0.0
