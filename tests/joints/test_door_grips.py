"""A pull as long as a door is high tells its side as a knob does; battens and edge strips do not."""

from dataclasses import replace

import pytest

from building_scenes import knob, leaf
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.door_grips import grasped_side, hinged_side
from grafu.joints.motion_choice import Side
from grafu.joints.plan import JointRequest
from grafu.vocabulary import JointType, PartLabel
from small_scenes import box

DOOR = leaf()  # 0.794 m wide, from Y -0.06 to -0.02


def bar(x, width=0.03, out=0.05, label=PartLabel.UNKNOWN):
    """An upright bar 1.2 m long before the leaf, or in its plane where it stands out by nothing."""
    front = -0.06 - out
    return replace(box("bar", (x - width / 2, front, 0.4), (x + width / 2, front + 0.03, 1.6)), label=label)


@pytest.mark.parametrize("label", [PartLabel.UNKNOWN, PartLabel.HANDLE])
@pytest.mark.parametrize(("x", "side"), [(0.12, Side.RIGHT), (0.78, Side.LEFT)])
def test_a_leaf_turns_about_the_edge_away_from_its_long_pull(x, side, label):
    assert hinged_side(DOOR, [DOOR], [bar(x, label=label)]) is side
    assert hinged_side(DOOR, [DOOR], [knob(x)]) is side


def test_what_is_wide_lies_in_the_leaf_or_is_no_handle_is_no_pull():
    assert grasped_side(DOOR, [bar(0.12, width=0.2)]) == 0
    assert grasped_side(DOOR, [bar(0.12, out=0.0)]) == 0
    assert grasped_side(DOOR, [bar(0.12, label=PartLabel.SHELF)]) == 0
    assert grasped_side(DOOR, [bar(0.12), bar(0.78)]) == 0
    assert grasped_side(DOOR, [bar(0.45)]) == 0


def turning(x, upright=True):
    direction = vec3(0.0, 0.0, 1.0) if upright else vec3(1.0, 0.0, 0.0)
    return JointRequest("panel", JointType.REVOLUTE, Axis(vec3(x, -0.06, 1.0), direction), "network")


def test_a_single_leaf_that_nothing_is_grasped_by_hangs_where_it_was_predicted():
    assert hinged_side(DOOR, [DOOR], [], turning(0.85)) is Side.RIGHT
    assert hinged_side(DOOR, [DOOR], [], turning(0.05)) is Side.LEFT
    assert hinged_side(DOOR, [DOOR], [], turning(0.45, upright=False)) is Side.LEFT
    assert hinged_side(DOOR, [DOOR], []) is Side.LEFT
    assert hinged_side(DOOR, [DOOR], [knob(0.78)], turning(0.85)) is Side.LEFT


def test_of_two_leaves_each_hangs_at_the_outer_edge_whatever_was_predicted():
    right = leaf(x=(0.85, 1.64), name="other")
    assert hinged_side(DOOR, [DOOR, right], [], turning(0.85)) is Side.LEFT
    assert hinged_side(right, [DOOR, right], [], turning(0.85)) is Side.RIGHT
