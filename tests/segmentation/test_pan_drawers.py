"""The low box of a deep drawer for pans belongs to its front; runners and cleats behind a front stay."""

import numpy as np
import pytest

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.division import divided

WIDE, DEEP = 0.6, 0.5


def board(low, high):
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


CASE = [
    *(board((x, 0, 0), (x + 0.02, DEEP, 0.76)) for x in (0.0, WIDE - 0.02)),
    *(board((0.02, 0, z), (WIDE - 0.02, DEEP, z + 0.02)) for z in (0.0, 0.37, 0.74)),
    board((0.02, DEEP - 0.01, 0.02), (WIDE - 0.02, DEEP, 0.74)),
]


def front(z):
    """A front between the boards of the case, 0.35 m high, with a knob."""
    plate = board((0.021, 0.0, z), (WIDE - 0.021, 0.012, z + 0.349))
    return [plate, board((0.29, -0.03, z + 0.18), (0.31, 0.0, z + 0.2))]


def sides(z, high):
    return [board((x, 0.012, z), (x + 0.012, 0.44, z + high)) for x in (0.03, WIDE - 0.042)]


def bottom(z):
    return board((0.03, 0.012, z - 0.005), (WIDE - 0.03, 0.44, z + 0.005))


def depths(pieces):
    whole = merge_meshes([*CASE, *pieces])
    found = divided([whole], [True], [False]).get(0, [])
    return [float(whole.with_faces(p.faces).box.high[1].round(3)) for p in found if p.role == "front"]


@pytest.mark.parametrize("high", [0.06, 0.084, 0.2])
def test_low_sides_that_a_bottom_joins_slide_out_with_their_front(high):
    pieces = [piece for z in (0.021, 0.391) for piece in (*front(z), *sides(z + 0.01, high), bottom(z + 0.01))]
    assert depths(pieces) == [0.44, 0.44]


def test_runners_that_nothing_joins_stay_in_the_case():
    pieces = [piece for z in (0.021, 0.391) for piece in (*front(z), *sides(z + 0.05, 0.06))]
    assert depths(pieces) == [0.012, 0.012]


def test_cleats_with_a_shelf_on_them_stay_in_the_case():
    pieces = [piece for z in (0.021, 0.391) for piece in (*front(z), *sides(z + 0.1, 0.05), bottom(z + 0.155))]
    assert depths(pieces) == [0.012, 0.012]
