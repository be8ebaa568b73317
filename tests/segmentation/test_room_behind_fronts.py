"""Behind fronts is room: before the back of their case, also where that is a wall of planks."""

from itertools import pairwise

import numpy as np
import pytest

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.division import divided


def board(low, high):
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def planks(y, count=8):
    """Boards side by side, each of which covers a quarter of a front."""
    ends = np.linspace(0.0, 0.9, count + 1)
    return merge_meshes([board((a, y, 0), (b, y + 0.015, 0.8)) for a, b in pairwise(ends)])


FRONTS = merge_meshes([board((x, -0.02, 0.05), (x + 0.44, 0.0, 0.78)) for x in (0.005, 0.455)])
SIDES = [board((x, 0.0, 0.0), (x + 0.015, 0.6, 0.8)) for x in (-0.015, 0.9)]


def count_fronts(*others):
    meshes = [FRONTS, *SIDES, *others]
    found = divided(meshes, [True] + [False] * (len(meshes) - 1), [False] * len(meshes))
    return [piece.role for piece in found.get(0, [])].count("front")


@pytest.mark.parametrize(
    ("back", "count"),
    [(planks(0.585), 2), (board((0, 0.585, 0), (0.9, 0.6, 0.8)), 2), (planks(0.0), 0), (planks(0.585, 40), 2)],
    ids=["planks", "one board", "planks right behind", "narrow planks"],
)
def test_fronts_before_a_wall_have_room(back, count):
    assert count_fronts(back) == count


def test_posts_here_and_there_are_no_wall():
    posts = merge_meshes([board((x, 0.5, 0), (x + 0.05, 0.55, 0.8)) for x in (0.0, 0.425, 0.85)])
    assert count_fronts(posts) == 0
