"""Motion codes: every border and sign, round trips, the opening side, mirror rules."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.errors import GraphError
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.transform import reflection
from grafu.graph.edges import BORDERS, SIGNED_AXES, SIGNS, Hinge, Rail
from grafu.graph.motion import (
    axis_to_hinge,
    axis_to_rail,
    border_to_face,
    border_to_signed_axis,
    code_to_direction,
    direction_to_code,
    face_to_border,
    hinge_to_axis,
    mirror_face,
    mirror_hinge,
    opening_face,
    opposite,
    rail_to_axis,
    sign_for_opening,
)

coordinates = st.floats(-5, 5, allow_nan=False)
vectors = st.tuples(coordinates, coordinates, coordinates).map(np.array)
halves = st.permutations([0.01, 0.2, 0.3]).flatmap(
    lambda sides: st.floats(0.5, 1.4).map(lambda scale: np.array(sides) * scale)
)
boxes = st.builds(Box.from_center, vectors, halves)
borders, signs, codes = st.sampled_from(BORDERS), st.sampled_from(SIGNS), st.sampled_from(SIGNED_AXES)
FRONT_DOOR = Box(np.array([0.0, -0.02, 0.0]), np.array([0.4, 0.0, 0.7]))


@given(boxes, borders, signs)
def test_a_hinge_survives_the_way_to_a_line_and_back(box, border, sign):
    assert axis_to_hinge(box, hinge_to_axis(box, border, sign)) == (border, sign)
    assert axis_to_hinge(box, hinge_to_axis(box, border, sign, "official")) == (border, sign)


@given(boxes, codes)
def test_a_rail_survives_the_way_to_a_line_and_back(box, code):
    assert axis_to_rail(rail_to_axis(box, code)) == code


@given(codes)
def test_a_signed_axis_survives_the_way_to_a_direction_and_back(code):
    assert direction_to_code(code_to_direction(code)) == code
    assert np.array_equal(code_to_direction(opposite(code)), -code_to_direction(code))


@pytest.mark.parametrize(
    ("border", "sign", "face", "axis"),
    [(0, 0, 0, 4), (0, 1, 0, 5), (1, 0, 1, 4), (1, 1, 1, 5), (2, 0, 4, 0), (2, 1, 4, 1), (3, 0, 5, 0), (3, 1, 5, 1)],
)
def test_the_authors_decode_table_for_a_door_thin_in_y(border, sign, face, axis):
    assert border_to_face(1, border) == face
    assert border_to_signed_axis(1, border, sign) == axis


@given(st.integers(0, 2), borders)
def test_borders_and_faces_are_one_to_one(thin, border):
    assert face_to_border(thin, border_to_face(thin, border)) == border


@given(boxes, borders, signs)
def test_the_free_edge_sets_off_towards_the_opening_face(box, border, sign):
    axis = hinge_to_axis(box, border, sign)
    free_edge = box.face_center(opposite(border_to_face(box.thin_axis, border)))
    free_edge[box.thin_axis] = axis.point[box.thin_axis]
    moved = (axis.rotation(0.01) @ np.append(free_edge, 1.0))[:3] - free_edge
    assert direction_to_code(moved) == opening_face(box.thin_axis, border, sign)


@given(boxes, borders, st.booleans())
def test_the_sign_is_found_that_opens_to_a_front(box, border, positive):
    front = 2 * box.thin_axis + int(positive)
    sign = sign_for_opening(box.thin_axis, border, front)
    assert opening_face(box.thin_axis, border, sign) == front


def test_a_left_hung_front_door_opens_about_minus_z():
    axis = hinge_to_axis(FRONT_DOOR, 0, 0)
    assert np.allclose(axis.direction, [0, 0, -1])
    assert np.allclose(axis.point, [0.0, -0.02, 0.35])


def test_the_authors_pin_lies_on_the_negative_side_whatever_the_opening():
    assert hinge_to_axis(FRONT_DOOR, 0, 1, "official").point[1] == -0.02
    assert hinge_to_axis(FRONT_DOOR, 0, 1).point[1] == 0.0


@given(boxes, borders, signs, st.integers(0, 1))
def test_a_mirrored_hinge_is_the_mirrored_line(box, border, sign, across):
    mirror = reflection(np.zeros(3), np.eye(3)[across])
    ends = np.stack([box.low, box.high]) @ mirror[:3, :3]
    image = Box(ends.min(axis=0), ends.max(axis=0))
    expected = hinge_to_axis(box, border, sign).transformed(mirror)
    found = hinge_to_axis(image, *mirror_hinge(box.thin_axis, border, sign, across))
    assert np.allclose(found.direction, expected.direction)
    assert expected.distance_to(found.point) < 1e-9


@given(st.integers(0, 2), borders, signs, st.integers(0, 1))
def test_the_mirror_rule_in_bits(thin, border, sign, across):
    first, second = (a for a in range(3) if a != thin)
    pin, turn = (first, second) if border < 2 else (second, first)
    image = mirror_hinge(thin, border, sign, across)
    assert image == (border ^ int(pin == across), sign ^ int(turn != across))
    assert mirror_hinge(thin, *image, across) == (border, sign)


@given(codes, st.integers(0, 2))
def test_mirroring_a_slide_reverses_it_along_the_mirror_axis_alone(code, across):
    assert (mirror_face(code, across) == code) == (code // 2 != across)


def test_an_axis_across_a_door_has_no_border():
    with pytest.raises(GraphError, match="door's plane"):
        axis_to_hinge(FRONT_DOOR, Axis(np.zeros(3), np.array([0.0, 1.0, 0.0])))


def test_a_broad_face_is_no_border():
    with pytest.raises(GraphError, match="broad face -Y"):
        face_to_border(1, 2)


def test_a_door_opens_across_its_thin_axis_alone():
    with pytest.raises(GraphError, match="across its thin axis Y"):
        sign_for_opening(1, 0, 0)


@pytest.mark.parametrize(("border", "sign"), [(4, 0), (-1, 0), (0, 2), (True, 0)])
def test_a_hinge_refuses_codes_that_do_not_exist(border, sign):
    with pytest.raises(Exception, match=r"Hinge|type"):
        Hinge("side", "door", border, sign)


def test_a_rail_refuses_codes_that_do_not_exist():
    with pytest.raises(Exception, match=r"Rail|type"):
        Rail("side", "drawer", 6)
