"""When two motions of a part agree."""

from math import radians

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.geometry.appearance import Surface
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import rotation_about
from grafu.metrics.motion import Motion, agreement_ratio, compare_motions, motion_agreement
from grafu.vocabulary import JointType

CENTER = np.array([0.5, 0.0, 0.5])
UP = np.array([0.0, 0.0, 1.0])


def hinge(x: float, direction=UP, y: float = 0.0) -> Motion:
    return Motion(JointType.REVOLUTE, Axis(np.array([x, y, 0.0]), direction), CENTER)


def slide(direction) -> Motion:
    return Motion(JointType.PRISMATIC, Axis(np.zeros(3), np.array(direction, float)), CENTER)


def agrees(found: Motion, truth: Motion) -> bool:
    return compare_motions({"a": found}, {"a": truth})[0].whole


@pytest.mark.parametrize(
    ("found", "truth", "expected"),
    [
        (hinge(0.0), hinge(0.02, y=-0.02), True),
        (hinge(1.0), hinge(0.0), False),
        (hinge(0.0, -UP), hinge(0.0), False),
        (hinge(0.0, np.array([1.0, 0.0, 0.0])), hinge(0.0), False),
        (slide([0, -1, 0]), slide([0, -1, 0]), True),
        (slide([0, 1, 0]), slide([0, -1, 0]), False),
        (slide([0, -1, 0]), hinge(0.0), False),
    ],
)
def test_agreement(found, truth, expected):
    assert agrees(found, truth) is expected


def test_each_part_of_the_verdict_is_told_apart():
    wrong_side = compare_motions({"a": hinge(1.0)}, {"a": hinge(0.0)})[0]
    assert (wrong_side.type, wrong_side.direction, wrong_side.border) == (True, True, False)
    missing = compare_motions({}, {"a": hinge(0.0)})[0]
    assert (missing.type, missing.direction, missing.border) == (False, False, False)


@given(st.floats(-30, 30))
def test_directions_agree_within_ten_degrees(degrees):
    if abs(abs(degrees) - 10) > 0.01:
        tilted = np.array([np.sin(radians(degrees)), 0.0, np.cos(radians(degrees))])
        assert agrees(slide(tilted), slide(UP)) is (abs(degrees) < 10)


@given(st.floats(-3, 3), st.sampled_from([0.0, 1.0]), st.sampled_from([1.0, -1.0]))
def test_turning_the_object_changes_nothing(yaw, side, sense):
    turn = rotation_about(np.zeros(3), UP, yaw)
    turned = [
        Motion(m.type, m.axis.transformed(turn), turn[:3, :3] @ m.center) for m in (hinge(side, sense * UP), hinge(0.0))
    ]
    assert agrees(*turned) is (side == 0.0 and sense > 0)


def made(x: float) -> ArticulatedObject:
    door = TriangleMesh.box_mesh(Box(np.array([0.0, -0.02, 0.0]), np.array([1.0, 0.0, 1.0])))
    links = (Link("case", ()), Link("door", (Visual("door", (Surface(door),)),)))
    axis = Axis(np.array([x, 0.0, 0.0]), UP)
    return ArticulatedObject(
        "m", "case", links, (Joint("j", JointType.REVOLUTE, "case", "door", axis, JointLimits(0.0, 1.0)),)
    )


def test_objects_are_compared_link_by_link():
    assert agreement_ratio(motion_agreement(made(0.0), made(0.01))) == 1.0
    assert agreement_ratio(motion_agreement(made(1.0), made(0.01))) == 0.0
    assert agreement_ratio(motion_agreement(ArticulatedObject("m", "case", (Link("case", ()),)), made(0.0))) == 0.0


def test_nothing_to_find_is_all_found():
    assert agreement_ratio(()) == 1.0
