"""The widest gap over a motion is the same, however little is looked at."""

import numpy as np
import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import translation
from grafu.joints.gaps import gap_between, widest_gap

CUBE = TriangleMesh.box_mesh(Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 1.0)))


@pytest.mark.parametrize("gaps", [[0.0, 1.0, 2.0, 3.0, 4.0], [0.0, 5.0, 1.0, 0.0, 2.0], [3.0, 1.0, 1.0, 1.0, 1.0]])
@pytest.mark.parametrize("as_drawn", [0, 1, 2])
def test_the_widest_gap_needs_the_exact_width_of_none_that_is_narrower(gaps, as_drawn):
    def gap_at(value: float, enough: float) -> float:
        gap = gaps[round(value)]
        return gap if gap > enough else min(gap + 0.5, enough)

    assert widest_gap(gap_at, 4.0, as_drawn) == max(gaps) - max(gaps[:as_drawn], default=0.0)


def test_pieces_are_measured_until_a_gap_is_narrow_enough(monkeypatch):
    ends = [MeshCollider(CUBE)]
    held = [MeshCollider(CUBE.translated(vec3(x, 0.0, 0.0))) for x in (-1.02, 1.3, 1.01)]
    asked = []
    distance = MeshCollider.distance
    monkeypatch.setattr(MeshCollider, "distance", lambda one, other: asked.append(1) or distance(one, other))
    assert gap_between(ends, held, np.eye(4)) == pytest.approx(0.01)
    T = translation(vec3(0.0, 0.0, 1.5))
    assert gap_between(ends, held, T) == pytest.approx(np.hypot(0.5, 0.01))
    before = len(asked)
    assert gap_between(ends, held, T, enough=0.6) <= 0.6
    assert len(asked) == before + 1
