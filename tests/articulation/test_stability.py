"""Statics of tipping over, against cases that can be worked out by hand."""

from dataclasses import replace
from math import inf, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.collision_shapes import CollisionShape
from grafu.articulation.counterbalance import GRAVITY
from grafu.articulation.mass import MassProperties
from grafu.articulation.stability import Stability, stability_of, standing_points
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box, OrientedBox
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import JointType, PartLabel

CASE, FRONT = (-0.5, -0.2, 0.0, 0.5, 0.2, 1.0), (-0.5, -0.22, 0.4, 0.5, -0.2, 0.6)


def box(bounds: tuple[float, ...]) -> Box:
    return Box(vec3(*bounds[:3]), vec3(*bounds[3:]))


def link(name: str, bounds: tuple[float, ...], label: PartLabel) -> Link:
    return Link(name, (Visual(name, (Surface(TriangleMesh.box_mesh(box(bounds))),), label=label),))


def shape(bounds: tuple[float, ...]) -> tuple[CollisionShape, ...]:
    held = box(bounds)
    return (OrientedBox(held.center, held.size / 2, np.eye(3)),)


def mass(kg: float, bounds: tuple[float, ...]) -> MassProperties:
    return MassProperties(kg, box(bounds).center, np.eye(3) * kg / 6)


def chest(case: float, drawer: float, travel: float, feet: tuple[float, ...] = CASE) -> Stability | None:
    """A case of 1 x 0.4 x 1 m whose drawer front, 20 mm thick, has all the drawer's mass."""
    joint = Joint(
        "slide",
        JointType.PRISMATIC,
        "case",
        "drawer",
        Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0)),
        JointLimits(0.0, travel),
    )
    links = (link("case", CASE, PartLabel.UNKNOWN), link("drawer", FRONT, PartLabel.DRAWER))
    made = ArticulatedObject("chest", "case", links, (joint,))
    masses = {"case": mass(case, CASE), "drawer": mass(drawer, FRONT)}
    return stability_of(made, masses, {"case": shape(feet), "drawer": shape(FRONT)})


def test_an_open_drawer_moves_the_centre_and_the_pull_that_tips_is_that_of_the_lever():
    found = chest(case=20.0, drawer=5.0, travel=0.4)

    inside = 0.2 + (20.0 * 0.0 + 5.0 * -0.61) / 25.0  # of the front side of the polygon
    assert found is not None
    assert found.mass == 25.0
    assert found.margin == pytest.approx(inside)
    assert found.closed_margin == pytest.approx(0.2 + 5.0 * -0.21 / 25.0)
    assert found.tipping_force == pytest.approx(25.0 * GRAVITY * inside / 0.5)  # the grip is 0.5 m high
    assert found.tipping_joint == "slide"
    assert (found.weight_needed, found.wall_force) == (0.0, 0.0)
    assert found.is_safe


def test_what_lacks_is_a_weight_at_the_rear_side_or_a_pull_at_the_upper_edge():
    found = chest(case=4.0, drawer=5.0, travel=0.4)

    moment = GRAVITY * (5.0 * 0.41 - 4.0 * 0.2) + 30.0 * 0.5  # about the front side
    assert found is not None
    assert found.margin < 0
    assert (found.tipping_force, found.tipping_joint) == (0.0, "")
    assert found.weight_needed == pytest.approx(moment / (GRAVITY * 0.4))
    assert found.wall_force == pytest.approx(moment / 1.0)


@given(st.floats(1.0, 50.0), st.floats(0.1, 20.0), st.floats(0.05, 0.8))
def test_with_the_weight_that_it_needs_it_just_bears_the_pulls(case, drawer, travel):
    found = chest(case, drawer, travel)
    assert found is not None
    weight = found.weight_needed
    front = GRAVITY * (case * 0.2 + weight * 0.4 - drawer * (travel + 0.01))  # holding moment about the front side
    assert front >= 30.0 * 0.5 - 1e-6
    assert weight == 0.0 or front == pytest.approx(30.0 * 0.5)


def test_a_pull_straight_down_outside_tips_and_one_inside_does_not():
    axis = Axis(vec3(0.0, -0.2, 1.0), vec3(1.0, 0.0, 0.0))  # the lid opens towards the front and hangs down there
    lid = (-0.5, -0.2, 1.0, 0.5, 0.2, 1.02)
    joint = Joint("lid_joint", JointType.REVOLUTE, "case", "lid", axis, JointLimits(0.0, pi / 2))
    made = ArticulatedObject(
        "chest", "case", (link("case", CASE, PartLabel.UNKNOWN), link("lid", lid, PartLabel.DOOR)), (joint,)
    )
    shapes = {"case": shape(CASE), "lid": shape(lid)}
    masses = {"case": mass(30.0, CASE), "lid": mass(3.0, lid)}

    found = stability_of(made, masses, shapes)

    assert found is not None
    assert found.tipping_joint == "lid_joint"
    assert 0 < found.tipping_force < inf


def test_nothing_tips_a_piece_without_joints_and_what_stands_on_an_edge_does_not_stand():
    case = ArticulatedObject("case", "case", (link("case", CASE, PartLabel.UNKNOWN),))
    found = stability_of(case, {"case": mass(10.0, CASE)}, {"case": shape(CASE)})
    assert found is not None
    assert (found.margin, found.tipping_force, found.weight_needed) == (pytest.approx(0.2), inf, 0.0)

    blade = replace(case)
    thin = (-0.5, -0.002, 0.0, 0.5, 0.002, 1.0)
    assert stability_of(blade, {"case": mass(10.0, CASE)}, {"case": shape(thin)}) is None
    assert stability_of(blade, {"case": mass(10.0, CASE)}, {"case": ()}) is None


def test_what_leans_on_a_wall_tips_while_it_is_closed():
    feet = (-0.5, -0.2, 0.0, 0.5, -0.15, 0.02)
    found = chest(case=20.0, drawer=5.0, travel=0.1, feet=feet)
    assert found is not None
    assert found.closed_margin == pytest.approx(-0.15 - (5.0 * -0.21) / 25.0)
    assert found.margin == found.closed_margin
    assert found.tipping_force == 0.0
    assert found.weight_needed > 0


@pytest.mark.parametrize(("apart", "depth"), [(0.008, 0.4), (0.02, 0.05)])
def test_feet_a_little_apart_in_height_are_leaned_onto_and_others_hang(apart, depth):
    front, rear = shape((-0.5, -0.2, 0.0, 0.5, -0.15, 0.1)), shape((-0.5, 0.15, apart, 0.5, 0.2, 0.1))
    made = ArticulatedObject("case", "case", (link("case", CASE, PartLabel.UNKNOWN),))
    points = standing_points(made, {"case": (*front, *rear, *shape((-0.5, -0.2, 0.1, 0.5, 0.2, 1.0)))})
    assert float(np.ptp(points[:, 1])) == pytest.approx(depth)


def test_a_front_that_ends_just_above_the_floor_carries_nothing():
    low = (-0.5, -0.22, 0.003, 0.5, -0.2, 0.6)
    links = (link("case", CASE, PartLabel.UNKNOWN), link("drawer", low, PartLabel.DRAWER))
    axis = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0))
    joint = Joint("slide", JointType.PRISMATIC, "case", "drawer", axis, JointLimits(0.0, 0.1))
    made = ArticulatedObject("chest", "case", links, (joint,))
    shapes = {"case": shape(CASE), "drawer": shape(low)}
    found = stability_of(made, {"case": mass(20.0, CASE), "drawer": mass(5.0, low)}, shapes)
    assert found is not None
    assert standing_points(made, shapes)[:, 1].min() == pytest.approx(-0.2)
    assert found.closed_margin == pytest.approx(0.2 - 5.0 * 0.21 / 25.0)
