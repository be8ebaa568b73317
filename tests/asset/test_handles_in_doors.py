"""A handle drawn in the mesh of its door is a part of its own, which tells on which side the door hangs."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from grafu.asset.handles_in_doors import with_handles_of_doors
from grafu.asset.options import LoadOptions
from grafu.asset.part import Part
from grafu.asset.reading import Convention, Reading
from grafu.asset.settling import settled
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.vocabulary import PartLabel
from small_scenes import BASE_CASE, box

BOARD = ((0.0, -0.02, 0.1), (0.6, 0.0, 0.8))
KNOB = ((0.53, -0.045, 0.45), (0.56, -0.02, 0.48))
POSTS = [((0.54, -0.044, z), (0.552, -0.02, z + 0.01)) for z in (0.41, 0.53)]
BAR = (((0.54, -0.055, 0.4), (0.552, -0.043, 0.55)), *POSTS)
OTHERS = {
    "a moulding": [((0.05, -0.035, 0.15), (0.55, -0.02, 0.17)), ((0.05, -0.035, 0.17), (0.07, -0.02, 0.75))],
    "a raised panel": [((0.06, -0.05, 0.16), (0.54, -0.02, 0.74))],
    "a hinge at its border": [((-0.004, -0.04, 0.2), (0.012, -0.02, 0.26))],
    "a flat plate": [((0.5, -0.023, 0.4), (0.55, -0.02, 0.5))],
    "what is behind it": [((0.5, 0.0, 0.4), (0.53, 0.03, 0.43))],
    "a batten across it": [((0.02, -0.05, 0.4), (0.58, -0.02, 0.44))],
    "studs": [((x, -0.04, 0.4), (x + 0.02, -0.02, 0.42)) for x in (0.1, 0.2, 0.3, 0.4)],
}


def door(*boxes, label=PartLabel.DOOR) -> Part:
    mesh = merge_meshes([TriangleMesh.box_mesh(Box(np.array(low), np.array(high))) for low, high in (BOARD, *boxes)])
    return replace(box("door", *BOARD), surfaces=(Surface(mesh),), label=label, labelled_by="name")


def parted(part: Part, *others: Part, labelled=True) -> list[Part]:
    found = with_handles_of_doors((*BASE_CASE, part, *others), np.eye(4), labelled)
    return list(found[len(BASE_CASE) : len(found) - len(others)])


@pytest.mark.parametrize("boxes", [(KNOB,), BAR], ids=["a knob", "a bar on posts"])
def test_a_handle_in_a_door_is_a_part_that_its_door_carries(boxes):
    board, handle = parted(door(*boxes))

    assert (handle.label, handle.labelled_by, handle.carried_by) == (PartLabel.HANDLE, "shape", "door")
    ends = np.array(boxes)
    np.testing.assert_allclose((handle.box.low, handle.box.high), (ends[:, 0].min(axis=0), ends[:, 1].max(axis=0)))
    np.testing.assert_allclose((board.box.low, board.box.high), BOARD)
    assert board.label is PartLabel.DOOR


@pytest.mark.parametrize("other", OTHERS)
def test_what_else_is_in_it_stays_in_it(other):
    whole = door(*OTHERS[other])
    assert parted(whole) == [whole]


@pytest.mark.parametrize(("out", "count"), [(0.004, 1), (0.03, 2)])
def test_a_letter_on_a_bent_door_is_no_handle(out, count):
    """Most of such a door lies behind where it stands out farthest."""
    roof = [(x, y, z) for z in (0.1, 0.8) for x, y in ((0.0, 0.0), (0.6, 0.0), (0.3, -0.03))]
    sides = [(0, 1, 4), (0, 4, 3), (1, 2, 5), (1, 5, 4), (2, 0, 3), (2, 3, 5), (0, 2, 1), (3, 4, 5)]
    letter = TriangleMesh.box_mesh(Box(np.array([0.29, -0.03 - out, 0.4]), np.array([0.31, -0.03, 0.42])))
    mesh = merge_meshes([TriangleMesh(np.array(roof), np.array(sides)), letter])
    assert len(parted(replace(door(), surfaces=(Surface(mesh),)))) == count


def test_a_door_with_a_handle_of_its_own_stays_as_it_is():
    whole = door(KNOB)
    assert parted(whole, box("handle", (0.5, -0.05, 0.3), (0.515, -0.02, 0.4))) == [whole]
    grip = box("handle", (0.0, -0.03, 0.78), (0.6, -0.02, 0.8), carried_by="door")
    assert parted(whole, grip) == [whole]


def test_a_panel_that_is_called_so_keeps_its_knob_unless_labels_are_hidden():
    panel = door(KNOB, label=PartLabel.SIDE_PANEL)
    assert parted(panel) == [panel]
    assert len(parted(panel, labelled=False)) == 2


def test_ids_that_are_taken_are_passed_over():
    other = box("door_handle", (0.0, 0.2, 0.2), (0.1, 0.3, 0.3))
    assert [part.id for part in parted(door(KNOB), other)] == ["door", "door_handle_2"]


@pytest.mark.parametrize("labels", ["input", "none"])
def test_it_is_found_in_a_model_that_was_divided_by_hand_also_where_labels_are_hidden(labels):
    convention = Convention("made", up="+Z", front="-Y", unit=1.0)
    reading = Reading("partnet-mobility", (*BASE_CASE, door(KNOB)), convention)
    handle = settled(reading, "cupboard", Path("cupboard"), LoadOptions(labels=labels)).part("door_handle")

    assert handle.carried_by == "door"
    assert handle.label is (PartLabel.HANDLE if labels == "input" else PartLabel.UNKNOWN)
