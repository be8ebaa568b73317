"""A bar across a door shows that it drops or lifts; other handles show nothing of that."""

import numpy as np
import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.joints.wide_bars import SOURCE, with_wide_bars
from grafu.vocabulary import JointType
from small_scenes import SIDE, box, scene

DOOR = box("door", (0.0, -0.02, 0.1), (0.6, 0.0, 0.7))
UPRIGHT = Axis(vec3(0.0, 0.0, 0.4), vec3(0.0, 0.0, -1.0))
REQUEST = JointRequest("door", JointType.REVOLUTE, UPRIGHT, "network", attached=("handle",))


def bar(x=(0.05, 0.55), y=-0.06, z=(0.64, 0.655), name="handle"):
    return box(name, (x[0], y, z[0]), (x[1], y + 0.012, z[1]), carried_by="door")


def turned(handle, request=REQUEST, settled=()):
    plan = with_wide_bars(RealizationPlan((request,), ()), scene(DOOR, SIDE, handle), settled)
    return plan.joints[0]


@pytest.mark.parametrize(("z", "edge"), [((0.64, 0.655), 0.1), ((0.14, 0.155), 0.7)])
def test_a_door_turns_about_the_border_away_from_the_bar(z, edge):
    made = turned(bar(z=z))
    assert made.source == SOURCE
    assert abs(float(made.axis.direction[0])) == pytest.approx(1.0)
    assert made.axis.point[2] == pytest.approx(edge, abs=0.02)


NO_BARS = {
    "a short handle": bar(x=(0.3, 0.55)),
    "an upright handle": box("handle", (0.55, -0.06, 0.2), (0.565, -0.048, 0.6), carried_by="door"),
    "a profile on the edge": bar(y=-0.032),
    "a bar at half height": bar(z=(0.4, 0.415)),
    "a plate": bar(z=(0.5, 0.69)),
    "no handle": bar(name="board"),
}


@pytest.mark.parametrize("what", NO_BARS)
def test_other_handles_leave_the_door_as_it_was_predicted(what):
    assert turned(NO_BARS[what]) == REQUEST


def test_doors_side_by_side_may_have_such_bars():
    second = box("second_door", (0.605, -0.02, 0.1), (1.2, 0.0, 0.7))
    plan = with_wide_bars(RealizationPlan((REQUEST,), ()), scene(DOOR, second, SIDE, bar()))
    assert plan.joints == (REQUEST,)


def test_what_the_user_states_and_what_drops_already_stay():
    assert turned(bar(), settled=("door",)) == REQUEST
    level = JointRequest("door", JointType.REVOLUTE, Axis(vec3(0.3, 0.0, 0.7), vec3(-1.0, 0.0, 0.0)), "network")
    assert turned(bar(), level) == level


@pytest.mark.parametrize("scale", [0.01, 39.37])
def test_a_bar_is_found_at_any_scale(scale):
    parts = [box(p.id, tuple(scale * p.box.low), tuple(scale * p.box.high), p.carried_by) for p in (DOOR, SIDE, bar())]
    plan = with_wide_bars(RealizationPlan((REQUEST,), ()), scene(*parts))
    assert np.abs(plan.joints[0].axis.direction[0]) == pytest.approx(1.0)


HIGH = box("high", (0.0, -0.02, 0.705), (0.6, 0.0, 1.7))
HIGH_BAR = box("high_handle", (0.05, -0.06, 0.75), (0.55, -0.048, 0.765), carried_by="high")
ON_RIGHT = Axis(vec3(0.6, 0.0, 1.2), vec3(0.0, 0.0, 1.0))
DROPPED = Axis(vec3(0.3, 0.0, 0.1), vec3(1.0, 0.0, 0.0))


def column(low_axis, low_bar, high=HIGH, high_bar=HIGH_BAR):
    """The requests of a door and of a high one above it, with their bars."""
    requests = (
        JointRequest("door", JointType.REVOLUTE, low_axis, "network", attached=("handle",)),
        JointRequest("high", JointType.REVOLUTE, ON_RIGHT, "network", attached=("high_handle",)),
    )
    return with_wide_bars(RealizationPlan(requests, ()), scene(DOOR, high, SIDE, low_bar, high_bar)).joints


def test_doors_of_a_refrigerator_with_bars_where_they_meet_hang_on_one_side():
    low, high = column(DROPPED, bar())
    assert high.axis == ON_RIGHT
    assert np.allclose(low.axis.direction, ON_RIGHT.direction)
    assert np.allclose(low.axis.point, (0.6, 0.0, 0.4))
    assert column(UPRIGHT, bar())[0].axis == UPRIGHT


def test_a_door_below_a_high_one_drops_where_the_bars_do_not_meet():
    assert column(DROPPED, bar(z=(0.4, 0.415)))[0].axis == DROPPED
    away = box("high", (0.0, -0.02, 0.9), (0.6, 0.0, 1.9))
    far_bar = box("high_handle", (0.05, -0.06, 0.95), (0.55, -0.048, 0.965), carried_by="high")
    assert column(DROPPED, bar(), away, far_bar)[0].axis == DROPPED
