import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link
from grafu.articulation.mass import MassProperties
from grafu.articulation.physics import joint_dynamics
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.vocabulary import JointType


def one_joint(kind: JointType, axis: Axis) -> ArticulatedObject:
    joint = Joint("j", kind, "body", "door", axis, JointLimits(0.0, 1.5))
    return ArticulatedObject("o", "body", (Link("body", ()), Link("door", ())), (joint,))


def dynamics(made: ArticulatedObject, mass: float, center: np.ndarray):
    body = MassProperties(mass, center, np.eye(3) * mass * 0.01)
    return joint_dynamics(made, made.joints[0], {link.id: body for link in made.links})


UPRIGHT = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, -1.0))
OUT = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0))


def test_a_door_is_damped_by_its_inertia_about_the_hinge():
    made = dynamics(one_joint(JointType.REVOLUTE, UPRIGHT), 5.0, vec3(0.2, 0.0, 0.3))

    inertia = 5 * 0.01 + 5 * 0.2**2
    assert made.damping == pytest.approx(inertia / 0.25)
    assert made.friction == pytest.approx(2 * inertia)  # gravity does not turn an upright hinge


def test_a_drawer_resists_by_its_weight():
    made = dynamics(one_joint(JointType.PRISMATIC, OUT), 4.0, vec3(0.0, 0.0, 0.0))

    assert made.damping == pytest.approx(16)
    assert made.friction == pytest.approx(0.03 * 4 * 9.81)


def test_a_flap_that_leans_out_is_held():
    hinge = Axis(vec3(0.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0))  # at the bottom, opens to the front
    leaning, upright = (dynamics(one_joint(JointType.REVOLUTE, hinge), 3.0, vec3(0.0, y, 0.2)) for y in (-0.01, 0.0))

    assert leaning.friction - upright.friction == pytest.approx(1.5 * 3 * 9.81 * 0.01, rel=0.1)


def test_a_drawer_that_slopes_down_is_held():
    slope = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -0.8, -0.6))

    made = dynamics(one_joint(JointType.PRISMATIC, slope), 4.0, vec3(0.0, 0.0, 0.0))

    assert made.friction > 0.6 * 4 * 9.81


@pytest.mark.parametrize("axis", [UPRIGHT, Axis(vec3(0.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0))])
def test_a_motor_can_lift_what_hangs_on_the_joint(axis):
    made = dynamics(one_joint(JointType.REVOLUTE, axis), 5.0, vec3(0.3, -0.3, 0.0))

    assert made.effort > made.friction + abs(axis.direction[0]) * 5 * 9.81 * 0.3


def test_what_hangs_on_the_child_counts():
    joint = Joint("j", JointType.PRISMATIC, "body", "door", OUT, JointLimits(0.0, 0.3))
    part = Joint("k", JointType.FIXED, "door", "box", OUT, JointLimits(0.0, 0.0))
    made = ArticulatedObject("o", "body", (Link("body", ()), Link("door", ()), Link("box", ())), (joint, part))
    masses = {n: MassProperties(m, np.zeros(3), np.eye(3)) for n, m in {"body": 50.0, "door": 2.0, "box": 3.0}.items()}

    assert joint_dynamics(made, joint, masses).damping == pytest.approx(5 / 0.25)
