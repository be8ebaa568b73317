import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.joint_dynamics import JointDynamics, joint_dynamics
from grafu.articulation.mass import MassProperties
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
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
    assert made.inertia == 4


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


def turning(
    kind: JointType, box: Box, axis: Axis, mass: float, upper: float = 1.5
) -> tuple[JointDynamics, float, float]:
    """Returns the dynamics of a part that is one box, its inertia about the axis, and the distance of its far edge."""
    mesh = TriangleMesh.box_mesh(box)
    joint = Joint("j", kind, "body", "part", axis, JointLimits(0.0, upper))
    part = Link("part", (Visual("part", (Surface(mesh),)),))
    made = ArticulatedObject("o", "body", (Link("body", ()), part), (joint,))
    size = box.size
    moments = MassProperties(mass, box.center, mass / 12 * np.diag((size**2).sum() - size**2))
    dynamics = joint_dynamics(made, joint, {"body": moments, "part": moments})
    return dynamics, dynamics.inertia, float(axis.distances_to(mesh.vertices).max())


def pulled(dynamics: JointDynamics, arm: float, upper: float, force: float = 20.0, seconds: float = 3.0) -> float:
    """Returns how far a joint gets, as a part of its range, in a simulation of its own with small steps."""
    value, speed, step = 0.0, 0.0, 1e-4
    for _ in range(round(seconds / step)):
        torque = force * arm - dynamics.friction * (1.0 if speed >= 0 else -1.0)
        speed = (speed + step * torque / dynamics.inertia) / (1 + step * dynamics.damping / dynamics.inertia)
        value += step * speed
        if value >= upper:
            return 1.0
    return value / upper


@pytest.mark.parametrize("mass", [0.5, 5.0, 20.0, 40.0])
@pytest.mark.parametrize("width", [0.2, 0.6])
def test_a_pull_of_20_n_opens_any_door_within_3_s(mass, width):
    leaf = Box(vec3(0.0, -0.02, 0.0), vec3(width, 0.0, 1.8))

    made, inertia, reach = turning(JointType.REVOLUTE, leaf, UPRIGHT, mass)

    assert pulled(made, reach, 1.5) == 1.0
    assert made.friction <= 0.25 * 20 * reach + 1e-9
    assert made.damping <= inertia / 0.01


@pytest.mark.parametrize("mass", [0.2, 4.0, 30.0, 60.0])
def test_a_pull_of_20_n_opens_any_drawer_within_3_s(mass):
    made = dynamics(one_joint(JointType.PRISMATIC, OUT), mass, vec3(0.0, 0.0, 0.0))

    assert pulled(made, 1.0, 0.5) == 1.0


def test_a_knob_does_not_spin_when_it_is_let_go_and_not_by_itself():
    shaft = Axis(vec3(0.0, 0.0, 0.5), vec3(0.0, -1.0, 0.0))
    knob = Box(vec3(-0.02, -0.03, 0.48), vec3(0.03, 0.0, 0.52))  # its pointer makes it heavier on one side

    made, inertia, reach = turning(JointType.CONTINUOUS, knob, shaft, 0.06, 2 * np.pi)

    gravity = 0.06 * 9.81 * 0.005
    assert made.friction >= 1.5 * gravity  # in whichever pose it is left
    assert made.friction >= 1.0 * reach
    thrown = 10.0  # rad/s
    assert thrown / (made.friction / inertia + made.damping * thrown / inertia / 2) < 0.1  # seconds until it stands
    assert inertia / made.damping == pytest.approx(0.01)  # no stiffer than explicit simulators bear


def test_a_button_stays_as_it_is_left():
    button = dynamics(one_joint(JointType.PRISMATIC, OUT), 0.01, vec3(0.0, 0.0, 0.0))

    assert button.friction == pytest.approx(1.0)
    assert button.damping == pytest.approx(1.0)  # 10 ms
