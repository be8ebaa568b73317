from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.articulation.motion_kind import MOTION_KINDS, MotionKind, kind_named, motion_kind, moving_kinds
from grafu.errors import ArticulationError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import reflection, transform_points
from grafu.vocabulary import JointType, PartLabel

AXIS = Axis(vec3(0.2, -0.1, 0.4), vec3(1.0, 2.0, -1.0))
TURN, SLIDE, FIXED = (motion_kind(t) for t in (JointType.REVOLUTE, JointType.PRISMATIC, JointType.FIXED))
SCREW = MotionKind(JointType.REVOLUTE, 1.0, 0.05, "rad", TURN.shown, "screws", "thread", PartLabel.MISC)
POINTS = np.array([[0.0, 0.0, 0.0], [1.0, -0.5, 0.3]])


def test_every_joint_type_has_one_kind():
    assert set(MOTION_KINDS) == set(JointType)
    moving = [JointType.REVOLUTE, JointType.PRISMATIC, JointType.CONTINUOUS]
    assert [kind.type for kind in moving_kinds()] == moving
    assert [kind.type for kind in moving_kinds() if not kind.limited] == [JointType.CONTINUOUS]


@given(st.floats(-4, 4))
def test_a_turn_is_about_the_axis_and_a_slide_along_it(value):
    assert np.array_equal(TURN.transform(AXIS, value), AXIS.rotation(value))
    assert np.array_equal(SLIDE.transform(AXIS, value), AXIS.shift(value))
    assert np.array_equal(FIXED.transform(AXIS, value), np.eye(4))
    assert np.allclose(SCREW.transform(AXIS, value), AXIS.rotation(value) @ AXIS.shift(0.05 * value))


def test_many_values_at_once_are_as_one_by_one():
    values = np.linspace(0.0, 1.5, 4)
    for kind in (TURN, SLIDE, FIXED, SCREW):
        made = kind.transforms(AXIS, values)
        assert np.array_equal(made, [kind.transform(AXIS, v) for v in values])
        moved = transform_points(made[-1], POINTS)
        assert np.allclose(kind.displacement(AXIS, POINTS, values[-1]), moved - POINTS)


def test_where_a_point_sets_off():
    upright = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
    assert np.allclose(TURN.sets_off(upright, vec3(1.0, 0.0, 0.0)), [0, 1, 0], atol=1e-3)
    assert np.allclose(TURN.sets_off(upright, vec3(1.0, 0.0, 0.0), -1.0), [0, -1, 0], atol=1e-3)
    assert np.allclose(SLIDE.sets_off(upright, vec3(1.0, 0.0, 0.0)), [0, 0, 1])
    assert np.array_equal(TURN.sets_off(upright, vec3(0.0, 0.0, 2.0)), np.zeros(3))


@given(st.floats(0.1, 1.5))
def test_the_mirror_image_of_a_motion_moves_the_mirror_image_of_points(value):
    M = reflection(vec3(0.3, 0.0, 0.0), vec3(1.0, 0.0, 0.0))
    for kind in (TURN, SLIDE):
        mirrored = kind.transform(kind.mapped_axis(AXIS, M), value)
        assert np.allclose(mirrored, M @ kind.transform(AXIS, value) @ M)


def test_values_as_formats_and_people_read_them():
    assert (TURN.in_degrees(pi / 2), SLIDE.in_degrees(0.3)) == (90.0, 0.3)
    assert (TURN.from_degrees(180.0), SLIDE.from_degrees(0.3)) == (pi, 0.3)
    assert (TURN.length_scale(100.0), SLIDE.length_scale(100.0)) == (1.0, 100.0)
    assert (TURN.worded(pi / 2), SLIDE.worded(0.1234)) == ("90°", "12.3 cm")


def test_formats_have_words_for_kinds():
    assert kind_named("urdf", "continuous") is TURN
    assert kind_named("partnet", "slider+") is SLIDE
    assert kind_named("urdf", "fixed") is None
    assert (TURN.word("mjcf"), SLIDE.word("mjcf")) == ("hinge", "slide")
    with pytest.raises(ArticulationError, match="mjcf cannot say a fixed joint"):
        FIXED.word("mjcf")
