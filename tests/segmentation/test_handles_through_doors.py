"""Handles on both sides of doors, in one object, are parted by these; what is behind a door alone is no handle."""

import numpy as np
import pytest

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.division import divided


def board(low, high) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


LEAVES = [board((x, 0.0, 0.0), (x + 0.6, 0.04, 2.0)) for x in (0.0, 0.61)]
WALL = board((-0.1, 0.5, 0.0), (1.31, 0.52, 2.1))
AHEAD = [board((x, -0.06, 1.0), (x + 0.1, -0.02, 1.02)) for x in (0.48, 0.63)]
BEHIND = [board((x, 0.06, 1.0), (x + 0.1, 0.1, 1.02)) for x in (0.48, 0.63)]


def groups(*pieces: TriangleMesh):
    """The boxes of what lies on each leaf, and of the rest, of an object of pieces."""
    meshes = [merge_meshes(LEAVES), WALL, merge_meshes(pieces)]
    found = divided(meshes, [True, False, True], [True, False, False]).get(2, [])
    cut = [(piece.role, meshes[2].with_faces(piece.faces).box) for piece in found]
    return sorted((role, *np.round([b.low[0], b.high[0], b.low[1], b.high[1]], 3).tolist()) for role, b in cut)


def test_both_halves_of_a_handle_go_with_their_leaf():
    expected = [("on front", x, x + 0.1, -0.06, 0.1) for x in (0.48, 0.63)]
    assert groups(*AHEAD, *BEHIND) == [
        tuple(np.round(row, 3) if k else row for k, row in enumerate(e)) for e in expected
    ]


@pytest.mark.parametrize(
    "behind",
    [
        board((0.1, 0.06, 0.3), (0.2, 0.1, 0.32)),  # elsewhere behind the leaf
        board((0.48, 0.3, 1.0), (0.58, 0.34, 1.02)),  # far behind the handle
        board((0.2, 0.06, 0.9), (0.58, 0.1, 1.2)),  # far larger than it
    ],
    ids=["elsewhere", "far", "large"],
)
def test_what_is_no_half_of_a_handle_stays(behind):
    found = groups(*AHEAD, behind)
    assert [role for role, *_ in found] == ["on front", "on front", "rest"]
