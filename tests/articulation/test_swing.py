from dataclasses import replace

import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.swing import Swing
from grafu.errors import ArticulationError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import transform_points
from grafu.vocabulary import JointType

PIN = Axis(vec3(0.1, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
HALF = Swing("door", PIN, np.array([0.0, 0.5, 1.0]), np.array([0.0, 0.2, 0.5]))


def test_it_turns_on_its_pin_by_the_angle_of_the_value():
    point = vec3(1.1, 0.0, 0.0)

    moved = transform_points(HALF.motion(0.75), point[None])[0]

    assert moved == pytest.approx([0.1 + np.cos(0.35), np.sin(0.35), 0.0])
    assert np.allclose(HALF.angles_at(np.array([0.25, 0.5, 2.0])), [0.1, 0.2, 0.5])


@pytest.mark.parametrize(
    ("values", "angles"),
    [([0.0], [0.0]), ([0.0, 0.0], [0.0, 1.0]), ([0.1, 1.0], [0.0, 1.0]), ([0.0, 1.0], [0.1, 1.0])],
)
def test_a_table_that_is_none_is_refused(values, angles):
    with pytest.raises(ArticulationError, match="a swing"):
        Swing("door", PIN, np.array(values), np.array(angles))


def test_it_swings_only_with_a_link_that_moves():
    bar = Visual("hinge_bar", (), swing=HALF)
    joint = Joint("j", JointType.REVOLUTE, "body", "door", PIN, JointLimits(0.0, 1.0))
    made = ArticulatedObject("o", "body", (Link("body", (bar,)), Link("door", ())), (joint,))

    assert made.link("body").rigid_visuals == ()
    with pytest.raises(ArticulationError, match="must swing with a link that moves"):
        replace(made, joints=(replace(joint, type=JointType.FIXED),))
