"""The lines over a joint: on its axis, over its range, at its value, whatever the part's size."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.articulation.articulated_object import JointLimits
from grafu.export.blend.marks import motion_marks
from grafu.geometry.box import Box
from grafu.vocabulary import JointType

SIZES = st.floats(0.01, 10.0)


def door(width: float, high: float) -> Box:
    """A door that hangs on its left edge, closed along +X."""
    return Box(np.array([0.0, -0.01, -high / 2]), np.array([width, 0.01, high / 2]))


def angles(points):
    return np.arctan2(points[..., 1], points[..., 0])


@given(width=SIZES, high=SIZES, upper=st.floats(0.1, 3.0), ratio=st.floats(0.0, 1.0))
def test_a_doors_arc_goes_from_closed_to_open_at_one_distance(width, high, upper, ratio):
    marks = motion_marks(JointType.REVOLUTE, JointLimits(0.0, upper), ratio * upper, door(width, high))
    arc, head = marks.range[:-2], marks.range[-2:]
    assert angles(arc[0, 0]) == pytest.approx(0.0, abs=1e-9)
    assert angles(arc[-1, 1]) == pytest.approx(upper)
    assert (np.diff(angles(arc[:, 0])) > 0).all()
    radius = np.linalg.norm(arc[..., :2], axis=-1)
    assert radius == pytest.approx(radius[0, 0])
    assert 0.5 * width < radius[0, 0] < width
    assert arc[1:, 0] == pytest.approx(arc[:-1, 1])
    assert head[:, 0] == pytest.approx(np.stack([arc[-1, 1]] * 2))
    assert (angles(head[:, 1]) < upper).all()
    assert angles(marks.now[0, 1]) == pytest.approx(ratio * upper)
    assert marks.now[0, 0, :2] == pytest.approx([0.0, 0.0])


@given(width=SIZES, high=SIZES)
def test_a_doors_axis_stands_out_above_and_below_it(width, high):
    axis = motion_marks(JointType.REVOLUTE, JointLimits(0.0, 1.0), 0.0, door(width, high)).axis[0]
    assert axis[:, :2] == pytest.approx(0.0)
    assert axis[0, 2] < -high / 2 < high / 2 < axis[1, 2]


@given(long=SIZES, travel=st.floats(0.01, 2.0), ratio=st.floats(0.0, 1.0))
def test_a_drawers_arrow_goes_from_its_front_as_far_as_it_slides(long, travel, ratio):
    box = Box(np.array([-0.2, 0.1, -long]), np.array([0.2, 0.3, 0.0]))
    marks = motion_marks(JointType.PRISMATIC, JointLimits(0.0, travel), ratio * travel, box)
    assert marks.range[0] == pytest.approx(np.array([[0.0, 0.2, 0.0], [0.0, 0.2, travel]]))
    assert (marks.range[1:, 1, 2] < travel).all()
    assert marks.now[..., 2] == pytest.approx(ratio * travel)


def test_what_turns_about_its_own_middle_has_an_arc_within_it():
    box = Box(np.array([-0.3, -0.2, 0.0]), np.array([0.3, 0.2, 0.1]))
    marks = motion_marks(JointType.REVOLUTE, JointLimits(0.0, 2.0), 0.0, box)
    assert np.linalg.norm(marks.range[0, 0, :2]) == pytest.approx(0.3)


def test_a_fixed_joint_has_none():
    with pytest.raises(ValueError, match="must be one that moves"):
        motion_marks(JointType.FIXED, JointLimits(0.0, 0.0), 0.0, door(1.0, 1.0))
