"""What is called a door and sits on the inner side of one is no handle of it."""

import numpy as np
import pytest

from grafu.asset.part import Part, PartSource
from grafu.asset.pieces import with_joined_pieces
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel

DOOR, HANDLE, MISC = PartLabel.DOOR, PartLabel.HANDLE, PartLabel.MISC


def part(name, low, high, label=DOOR):
    mesh = TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))
    return Part(name, label, (Surface(mesh),), PartSource(name))


SIDE = part("side", (0, 0, 0), (0.02, 0.3, 0.7), PartLabel.SIDE_PANEL)
BACK = part("back", (0.02, 0.29, 0), (0.5, 0.3, 0.7), PartLabel.BACK_PANEL)
LEAF = part("door", (0.0, -0.02, 0.0), (0.5, 0.0, 0.7))
ARM = part("door_arm", (0.024, 0.0, 0.1), (0.036, 0.06, 0.12))
PLATE = part("door_arm_plate", (0.02, 0.03, 0.09), (0.024, 0.08, 0.13))  # on the side, at the arm
BIN = part("door_bin", (0.1, 0.0, 0.2), (0.4, 0.08, 0.22))
PULL = part("door_pull", (0.45, -0.05, 0.3), (0.46, -0.02, 0.45))


def settled(*parts, case=(SIDE, BACK)):
    given = (*case, LEAF, *parts)
    made, _ = with_joined_pieces(given, Box.enclosing([p.box for p in given]))
    return {p.id: (p.label, p.carried_by) for p in made if p.id not in {"side", "back", "door"}}


def test_the_arms_of_hinges_behind_a_door_are_no_handles_and_ride_on_nothing():
    assert settled(ARM, PLATE) == {"door_arm": (MISC, None), "door_arm_plate": (MISC, None)}


def test_what_is_held_by_the_door_alone_rides_on_it():
    assert settled(BIN) == {"door_bin": (MISC, "door")}


def test_what_is_before_the_door_is_its_handle_beside_what_is_behind_it():
    assert settled(PULL, BIN) == {"door_pull": (HANDLE, "door"), "door_bin": (MISC, "door")}


def test_a_leaf_without_a_case_has_handles_on_both_sides():
    behind = part("door_pull_2", (0.45, 0.0, 0.3), (0.46, 0.03, 0.45))
    assert settled(PULL, behind, case=()) == dict.fromkeys(("door_pull", "door_pull_2"), (HANDLE, "door"))


@pytest.mark.parametrize(("gap", "rides"), [(0.001, None), (0.02, "door")])
def test_a_piece_that_stands_off_what_stays_rides_on_its_door(gap, rides):
    assert settled(part("door_arm", (0.02 + gap, 0.0, 0.1), (0.06, 0.06, 0.12))) == {"door_arm": (MISC, rides)}
