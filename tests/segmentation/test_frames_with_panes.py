"""Framed leaves whose panes are another object: each frame is a front, and takes its pane."""

import numpy as np
import pytest

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.division import divided

BAR = 0.06


def board(low, high):
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def case():
    """A bookcase, 0.9 wide, 0.3 deep and 1.4 high, open at y = 0."""
    sides = [board((x, 0, 0), (x + 0.02, 0.3, 1.4)) for x in (0.0, 0.88)]
    boards = [board((0.02, 0, z), (0.88, 0.3, z + 0.02)) for z in (0.0, 0.7, 1.38)]
    return merge_meshes([*sides, *boards, board((0.02, 0.29, 0.02), (0.88, 0.3, 1.38))])


def bars(x0, x1, y=-0.02):
    """Stiles and rails of one leaf."""
    thick = (y, y + 0.02)
    stiles = [board((x, thick[0], 0), (x + BAR, thick[1], 1.4)) for x in (x0, x1 - BAR)]
    rails = [board((x0 + BAR, thick[0], z), (x1 - BAR, thick[1], z + BAR)) for z in (0.0, 1.4 - BAR)]
    return [*stiles, *rails]


def pane(x0, x1, y=-0.011, reach=0.01):
    return board((x0 + BAR - reach, y, BAR - reach), (x1 - BAR + reach, y + 0.002, 1.4 - BAR + reach))


def roles(meshes):
    found = divided(meshes, [True] * len(meshes), [False] * len(meshes))
    return {k: [piece.role for piece in pieces] for k, pieces in found.items()}


LEAVES = ((0.0, 0.449), (0.451, 0.9))


def test_two_frames_in_one_object_are_two_fronts_and_part_the_panes_of_another():
    frames = merge_meshes([*bars(*LEAVES[0]), *bars(*LEAVES[1])])
    panes = merge_meshes([pane(*ends) for ends in LEAVES])
    found = divided([case(), frames, panes], [True] * 3, [False] * 3)
    assert {k: [piece.role for piece in pieces] for k, pieces in found.items()} == {
        1: ["front", "front"],
        2: ["on front", "on front"],
    }
    for k, meshes in ((1, frames), (2, panes)):
        middles = sorted(float(meshes.with_faces(piece.faces).box.center[0]) for piece in found[k])
        assert middles == pytest.approx([0.2245, 0.6755])


def test_a_frame_that_nothing_fills_is_no_front():
    """What is seen through it stands behind it: the back of the case is no pane."""
    frames = merge_meshes([*bars(*LEAVES[0]), *bars(*LEAVES[1])])
    assert roles([case(), frames]) == {}


def test_a_face_frame_around_doors_that_are_inset_with_gaps_stays_whole():
    """The doors are thinner than the frame and set back in it as a pane is, but leave a gap all around."""
    middle = board((0.42, -0.02, BAR), (0.48, 0, 1.4 - BAR))
    frame = merge_meshes([*bars(0.0, 0.9), middle])
    doors = [board((x, -0.018, BAR + 0.003), (x + 0.354, -0.001, 1.4 - BAR - 0.003)) for x in (0.063, 0.483)]
    assert 1 not in roles([case(), frame, *doors])


def test_a_pane_in_one_of_two_frames_makes_no_pair():
    """One leaf is closed by its pane, the other is a ring: they may not be told apart as two fronts."""
    frames = merge_meshes([*bars(*LEAVES[0]), *bars(*LEAVES[1])])
    assert 1 not in roles([case(), frames, pane(*LEAVES[0])])
