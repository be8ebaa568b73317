from dataclasses import fields
from math import cos, radians

import numpy as np
import pytest

from grafu.articulation.articulated_object import Joint, JointLimits
from grafu.articulation.counterbalance import (
    GRAVITY,
    Counterbalance,
    CounterbalanceConfig,
    Holding,
    gravity_torque,
    held,
)
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import transform_points
from grafu.vocabulary import JointType

ORIGIN = vec3(0.0, 0.0, 0.0)
X = vec3(1.0, 0.0, 0.0)
LID = Axis(ORIGIN, -X), vec3(0.0, -0.3, 0.01)  # hinged at its back, opens up
LIFT = Axis(ORIGIN, -X), vec3(0.0, -0.01, -0.2)  # hinged at its top, opens to the front and up
DROP = Axis(ORIGIN, X), vec3(0.0, -0.01, 0.2)  # hinged at its bottom, opens to the front and down
KINDS = pytest.mark.parametrize(("axis", "center"), [LID, LIFT, DROP], ids=["lid", "lift", "drop"])


def joint(axis: Axis, upper: float = radians(90), kind: JointType = JointType.REVOLUTE) -> Joint:
    return Joint("j", kind, "body", "door", axis, JointLimits(0.0, upper))


def counterbalance(axis: Axis, center: np.ndarray, mass: float = 6.0) -> Counterbalance:
    found = held(joint(axis), mass, center, 2 * joint(axis).axis.distance_to(center), (0.1, 0.2)).counterbalance
    assert found is not None
    return found


@KINDS
@pytest.mark.parametrize("value", [0.0, 0.4, 1.1, 1.5])
def test_gravitys_torque_is_what_the_moved_centre_has(axis, center, value):
    moved = transform_points(axis.rotation(value), center[None])[0]
    expected = float(axis.direction @ np.cross(3.0 * moved, vec3(0.0, 0.0, -GRAVITY)))

    assert gravity_torque(joint(axis), 3.0, center, np.array([value]))[0] == pytest.approx(expected)


@KINDS
def test_the_spring_between_the_bodies_balances_gravity_at_any_opening(axis, center):
    spring = counterbalance(axis, center)

    for value in np.linspace(0.0, radians(90), 7):
        moved = transform_points(axis.rotation(value), center[None])[0]
        force = spring.stiffness * (spring.anchor - moved)
        torque = float(axis.direction @ np.cross(moved, force))
        assert torque == pytest.approx(-gravity_torque(joint(axis), 6.0, center, np.array([value]))[0], abs=1e-9)


@pytest.mark.parametrize(("axis", "center"), [LID, DROP], ids=["lid", "drop"])
def test_a_spring_about_the_joint_opens_nothing_and_friction_holds_the_rest(axis, center):
    spring = counterbalance(axis, center).spring
    assert spring is not None
    values = np.linspace(0.0, radians(90), 31)

    torque = gravity_torque(joint(axis), 6.0, center, values) - spring.stiffness * (values - spring.target)

    assert torque[0] == pytest.approx(0.0, abs=1e-9)
    assert np.abs(torque).max() < spring.friction < 0.4 * 6.0 * GRAVITY * 0.3


def test_no_spring_about_a_joint_lifts_a_flap_which_needs_more_the_further_it_opens():
    assert counterbalance(*LIFT).spring is None


def test_a_light_lid_is_held_by_friction():
    axis, center = LID
    found = held(joint(axis), 0.8, center, 0.6, (0.1, 0.1))

    assert found.counterbalance is None
    assert found.friction == pytest.approx(1.2 * 0.8 * GRAVITY * np.hypot(0.3, 0.01), rel=0.01)


@pytest.mark.parametrize(
    "moving",
    [
        joint(Axis(ORIGIN, vec3(0.0, 0.0, 1.0))),
        joint(Axis(ORIGIN, X), 0.4, JointType.PRISMATIC),
        joint(Axis(ORIGIN, X), 6.0, JointType.CONTINUOUS),
    ],
    ids=["upright", "slides", "without limits"],
)
def test_what_does_not_turn_about_a_level_axis_keeps_its_friction(moving):
    assert held(moving, 6.0, vec3(0.0, -0.3, 0.0), 0.6, (0.1, 0.1)) == Holding(0.1)


def test_what_its_own_friction_holds_is_left_as_it_is():
    axis, _ = LIFT

    assert held(joint(axis, 0.1), 6.0, vec3(0.0, 0.0, -0.2), 0.4, (5.0, 5.0)) == Holding(5.0)


def test_a_leaning_axis_is_balanced_as_well():
    axis = Axis(ORIGIN, vec3(cos(0.1), 0.0, 0.1))
    center = vec3(0.05, -0.3, 0.02)
    spring = held(joint(axis), 6.0, center, 0.6, (0.1, 0.1)).counterbalance
    assert spring is not None

    moved = transform_points(axis.rotation(0.7), center[None])[0]
    torque = float(axis.direction @ np.cross(moved, spring.stiffness * (spring.anchor - moved)))

    assert torque == pytest.approx(-gravity_torque(joint(axis), 6.0, center, np.array([0.7]))[0])


@pytest.mark.parametrize("name", [f.name for f in fields(CounterbalanceConfig)])
def test_a_number_that_is_not_above_0_is_refused(name):
    with pytest.raises(ValueError, match=f"`CounterbalanceConfig.{name}` must be above 0"):
        CounterbalanceConfig(**{name: type(getattr(CounterbalanceConfig(), name))(0)})


def test_a_spring_without_stiffness_is_refused():
    with pytest.raises(ValueError, match="must be above 0"):
        Counterbalance(ORIGIN, X, 0.0)


@KINDS
@pytest.mark.parametrize("mass", [0.3, 1.0, 1.5, 2.1, 3.0])
def test_what_friction_holds_opens_and_closes_with_a_light_pull(axis, center, mass):
    reach = 2 * joint(axis).axis.distance_to(center)

    made = held(joint(axis), mass, center, reach, (0.01, 0.02))

    heaviest = np.abs(gravity_torque(joint(axis), mass, center, np.linspace(0.0, radians(90), 61))).max()
    if made.counterbalance is None:
        assert made.friction + heaviest <= 12 * reach
    else:
        assert 2.2 * heaviest > 12 * reach
