"""A door in two panels with a mid rail is one door; two doors, one above the other, are two."""

from itertools import pairwise

import numpy as np
import pytest

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.division import divided
from grafu.segmentation.joining import joined_objects

WIDE, HIGH, BAR = 0.4, 1.6, 0.05
KNOB_AT = 0.35


def board(low, high):
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def case(high=HIGH):
    """A narrow cupboard, 0.3 deep, open at y = 0."""
    sides = [board((x, 0, 0), (x + 0.02, 0.3, high)) for x in (0.0, WIDE - 0.02)]
    shelves = [board((0.02, 0, z), (WIDE - 0.02, 0.3, z + 0.02)) for z in np.linspace(0.0, high - 0.02, 5)]
    return [*sides, *shelves, board((0.02, 0.29, 0.02), (WIDE - 0.02, 0.3, high - 0.02))]


def knob(z, x=KNOB_AT):
    return board((x, -0.05, z), (x + 0.012, -0.024, z + 0.012))


def rails(heights, lap):
    """Rails between the stiles, or lapped over them, with each lower edge at one of some heights."""
    ends = (0.0, WIDE) if lap else (BAR, WIDE - BAR)
    return [board((ends[0], -0.024, z), (ends[1], -0.001, z + BAR)) for z in heights]


def stiles(low, high):
    return [board((x, -0.024, low), (x + BAR, -0.001, high)) for x in (0.0, WIDE - BAR)]


def panels(heights, reach):
    """Panels from one height to the next, that reach so far below the bars beside them."""
    x0, x1 = BAR - reach, WIDE - BAR + reach
    return [board((x0, -0.018, a), (x1, -0.007, b)) for a, b in pairwise(heights)]


def framed_door(middles, lap):
    """A door with stiles, rails at both ends and at some heights, and a panel between each two."""
    at = (0.0, *middles, HIGH - BAR)
    if lap:
        spans = [0.0, *(z + BAR / 2 for z in middles), HIGH]
        return [*stiles(0.0, HIGH), *rails(at, lap), *panels(spans, BAR)]
    inner = [
        board((BAR - 0.01, -0.018, a + BAR - 0.01), (WIDE - BAR + 0.01, -0.007, b + 0.01)) for a, b in pairwise(at)
    ]
    return [*stiles(0.0, HIGH), *rails(at, lap), *inner]


def fronts(meshes):
    whole = merge_meshes(meshes)
    found = divided([whole], [True], [False])
    return sorted(
        whole.with_faces(piece.faces).box.low[2].round(3)
        for pieces in found.values()
        for piece in pieces
        if piece.role == "front"
    )


@pytest.mark.parametrize("lap", [True, False], ids=["rails lapped over stiles", "rails between stiles"])
@pytest.mark.parametrize("middles", [(), (0.78,), (0.5, 1.05)], ids=["no mid rail", "one", "two"])
def test_a_door_in_panels_is_one_front(middles, lap):
    assert fronts([*case(), *framed_door(middles, lap), knob(0.9)]) == [0.0]


def test_its_pieces_as_objects_of_their_own_are_joined_to_one():
    pieces = framed_door((0.78,), lap=True)
    meshes = [merge_meshes(case()), *pieces, knob(0.9)]
    groups = joined_objects(meshes, [True] * len(meshes))
    assert [set(group) for group in groups] == [{*range(1, len(pieces) + 1)}]


def test_two_framed_doors_one_above_the_other_are_two():
    lower, upper = (0.0, 0.798), (0.802, HIGH)
    doors = [
        piece
        for low, high in (lower, upper)
        for piece in (*stiles(low, high), *rails((low, high - BAR), True), *panels((low, high), BAR))
    ]
    assert fronts([*case(), *doors, knob(0.5), knob(1.1)]) == [0.0, 0.802]


def test_two_doors_before_a_frame_of_the_case_with_a_mid_rail_are_two():
    """Its rails lap over its stiles, too, but what closes it stands before it."""
    frame = [*stiles(0.0, HIGH), *rails((0.0, 0.78, HIGH - BAR), True)]
    doors = [board((0.02, -0.044, z), (WIDE - 0.02, -0.025, z + 0.75)) for z in (0.03, 0.83)]
    knobs = [knob(z).translated(np.array([0, -0.02, 0])) for z in (0.5, 1.1)]
    assert fronts([*case(), *frame, *doors, *knobs]) == [0.03, 0.83]
