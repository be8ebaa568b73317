"""Unions of polygons: what nearly meets does not end in an error, and all else is as GEOS unites it."""

import numpy as np
import pytest
import shapely

from grafu.geometry.unions import united

WIDTH, LOW, RISE, HIGH = 0.2154, 0.5313, 0.0215, 0.5888  # metres: an arched apron below the rail of a table


def arched_board(seed: int) -> list[shapely.Polygon]:
    """Both faces of an arched board that was turned by half a turn: corners differ by the rounding of a sine."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(20, 60))
    at = np.linspace(-1, 1, n)
    arc = np.c_[WIDTH * at, LOW + RISE * np.cos(1.2 * at)].astype(np.float32).astype(float)
    faces = []
    for _ in range(2):
        turned = arc.copy()
        turned[:, 0] += rng.uniform(-1, 1, n) * 10.0 ** -rng.integers(15, 19)
        corners = np.r_[turned, [[WIDTH, HIGH], [-WIDTH, HIGH]]]
        triangles = [(k, k + 1, k + 2) for k in range(n - 2)]
        triangles += [(k, k + 2, int(rng.integers(0, 2)) + n) for k in range(0, n - 3, 2)]
        triangles += [(k, k + 3, k + 1) for k in range(0, n - 4, 3)]
        faces += list(shapely.polygons(corners[np.array(triangles)]))
    return [face for face in faces if face.area > 0]


@pytest.mark.parametrize("seed", [493, 2202, 2925])
def test_corners_that_nearly_meet_are_united_all_the_same(seed: int) -> None:
    faces = arched_board(seed)
    found = united(faces)
    assert found.is_valid
    assert max(face.area for face in faces) <= found.area <= shapely.convex_hull(found).area
    assert max(face.difference(found.buffer(1e-6)).area for face in faces) < 1e-12


def test_all_else_is_united_as_it_stands() -> None:
    boxes = [shapely.box(0, 0, 1, 1), shapely.box(0.3, 0.1, 2, 0.7)]
    assert united(iter(boxes)).equals_exact(shapely.union_all(boxes))
    assert united([]).is_empty
