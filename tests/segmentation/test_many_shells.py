"""Furniture of thousands of shells, each near hundreds of others: burners, racks and knobs drawn bolt by bolt."""

import numpy as np

from grafu.geometry.box import Box
from grafu.geometry.budget import Budget
from grafu.geometry.mesh import TriangleMesh
from grafu.segmentation.furniture_pieces import SceneShells
from grafu.segmentation.standing_apart import standing_apart

SIDE = 12


def crowd(x: float) -> list[TriangleMesh]:
    """12 x 12 x 12 bolts of 4 mm, 8 mm apart."""
    steps = np.stack(np.meshgrid(*[np.arange(SIDE) * 0.012] * 3), axis=-1).reshape(-1, 3)
    return [TriangleMesh.box_mesh(Box(low, low + 0.004)) for low in steps + np.array([x, 0.0, 0.3])]


def case(x: float) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(np.array([x, 0.0, 0.0]), np.array([x + 0.6, 0.6, 0.29])))


def test_a_crowd_of_shells_is_one_group_with_its_case_in_little_room():
    """Each bolt is within 5 cm of some five hundred: as pairs of parts they would take 260 MB."""
    scene = SceneShells.of([case(0.0), *crowd(0.1), case(2.0)])
    with Budget(room=60_000_000).in_force():
        found = standing_apart(scene)
    assert [sorted(np.concatenate(group).tolist()) for group in found.groups] == [
        list(range(SIDE**3 + 1)),
        [SIDE**3 + 1],
    ]
