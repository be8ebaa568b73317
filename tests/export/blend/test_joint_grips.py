"""Where a joint is taken hold of in Blender: its grip is under the ray that points at it, for every value and view."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from grafu.export.blend.grips import JointGrips, borders, grips_of
from grafu.export.blend.layout import CHILD, ID, KIND, LOWER, OPEN, TYPE, UPPER
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.joints.motion_choice import Side

TURNS = JointGrips(turns=True, closed=vec3(0.3, -0.1, 0.2), lower=0.0, upper=2.0, value=0.0)
SLIDES = JointGrips(turns=False, closed=vec3(0.1, 0.2, 0.3), lower=0.0, upper=0.4, value=0.0)
EYES = st.tuples(*[st.floats(-3.0, 3.0)] * 3).map(np.array)


class Thing(dict):
    """An object of Blender: custom properties, and what it holds."""

    def __init__(self, properties, **held):
        super().__init__(properties)
        self.__dict__.update(held)


class Turn:
    """A rotation that turns nothing."""

    def to_matrix(self):
        return np.eye(3)


def joint(kind: str, upper: float, ratio: float) -> Thing:
    """The empty of a joint on which a board hangs."""
    corners = Box(vec3(0.0, -0.01, -0.3), vec3(0.4, 0.01, 0.3)).corners()
    part = Thing({KIND: "part", ID: "door"}, data=object(), bound_box=corners, children=())
    link = Thing({KIND: "link"}, children=(part,), data=None)
    properties = {KIND: "joint", TYPE: kind, CHILD: "door", LOWER: 0.0, UPPER: upper, OPEN: ratio}
    return Thing(properties, children=(link,), rotation_quaternion=Turn())


@given(st.floats(-1.5, 3.0), EYES)
def test_what_turns_has_its_grip_under_the_ray_that_points_at_it(value, eye):
    point = TURNS.point_at(value)
    assume(np.linalg.norm(point - eye) > 0.1)
    ray = Axis(eye, point - eye)
    assume(abs(ray.direction[2]) > 0.06)
    assert TURNS.value_under(ray, value - 0.4) == pytest.approx(value, abs=1e-6)


@given(st.floats(-1.0, 1.0), EYES)
def test_what_slides_has_its_grip_under_the_ray_that_points_at_it(value, eye):
    point = SLIDES.point_at(value)
    assume(np.linalg.norm(np.cross(point - eye, vec3(0.0, 0.0, 1.0))) > 0.1)
    assert SLIDES.value_under(Axis(eye, point - eye), 0.0) == pytest.approx(value, abs=1e-6)


def test_a_full_turn_is_not_jumped_over():
    ray = Axis(TURNS.point_at(3.2) + vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, -1.0))
    assert TURNS.value_under(ray, 3.0) == pytest.approx(3.2)
    assert TURNS.value_under(ray, -3.0) == pytest.approx(3.2 - 2.0 * np.pi)


def test_a_circle_that_is_seen_as_a_line_is_followed_along_it():
    ray = Axis(TURNS.point_at(0.5) - 2.0 * vec3(1.0, 0.2, 0.0), vec3(1.0, 0.2, 0.0))
    assert TURNS.value_under(ray, 0.5) == pytest.approx(0.5)
    assert SLIDES.value_under(Axis(vec3(0.0, 0.0, 5.0), vec3(0.0, 0.0, -1.0)), 0.2) == 0.2  # no value is under it


@given(st.floats(0.0, 2.0))
def test_the_grip_goes_where_the_joint_opens(value):
    ahead = TURNS.point_at(value + 1e-6) - TURNS.point_at(value)
    assert ahead / np.linalg.norm(ahead) @ TURNS.direction_at(value) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize(("kind", "upper"), [("revolute", 1.5), ("prismatic", 0.3)])
def test_the_grips_of_an_empty_are_where_its_marks_are(kind, upper):
    found = grips_of(joint(kind, upper, 0.5))
    assert found is not None
    assert found.turns == (kind == "revolute")
    assert (found.lower, found.upper, found.value) == pytest.approx((0.0, upper, 0.5 * upper))
    if found.turns:
        assert np.hypot(*found.closed[:2]) > 0.2
    else:
        assert found.closed[2] == pytest.approx(0.3)


def test_what_does_not_move_has_no_grips():
    assert grips_of(joint("revolute", 0.0, 0.0)) is None


def test_a_board_has_borders_where_it_is_no_broad_face():
    box = Box(vec3(-0.2, -0.01, 0.0), vec3(0.2, 0.01, 0.6))
    found = borders(box)
    assert found.keys() == {Side.LEFT, Side.RIGHT, Side.TOP, Side.BOTTOM}
    np.testing.assert_allclose(found[Side.LEFT], [[-0.2, 0.0, 0.0], [-0.2, 0.0, 0.6]])
    np.testing.assert_allclose(found[Side.TOP], [[-0.2, 0.0, 0.6], [0.2, 0.0, 0.6]])
    lid = borders(Box(vec3(0.0, 0.0, 0.0), vec3(0.4, 0.3, 0.02)))
    assert lid.keys() == {Side.LEFT, Side.RIGHT, Side.FRONT, Side.BACK}
