"""Feet of unequal length, as they are drawn, and what a piece stands on in a simulator."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.collision_shapes import CollisionShape, corners_of
from grafu.articulation.convex_pieces import hull_of
from grafu.articulation.level_feet import LevelFeetConfig, level_feet
from grafu.articulation.mass import MassProperties
from grafu.articulation.physics import physics_of
from grafu.articulation.stability import StabilityConfig, stability_of
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box, OrientedBox
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.vocabulary import JointType

CASE = (-0.4, -0.2, 0.1, 0.4, 0.2, 0.8)
MASSES = {"case": MassProperties(20.0, vec3(0.0, 0.0, 0.4), np.eye(3))}


def box(bounds: tuple[float, ...]) -> Box:
    return Box(vec3(*bounds[:3]), vec3(*bounds[3:]))


def shape(bounds: tuple[float, ...]) -> CollisionShape:
    held = box(bounds)
    return OrientedBox(held.center, held.size / 2, np.eye(3))


def feet(*lows: float) -> tuple[CollisionShape, ...]:
    """Four feet, front left, front right, rear left, rear right, which end at these heights."""
    corners = [(-0.4, -0.2), (0.36, -0.2), (-0.4, 0.16), (0.36, 0.16)]
    return tuple(shape((x, y, low, x + 0.04, y + 0.04, 0.1)) for (x, y), low in zip(corners, lows, strict=True))


def levelled(*body: CollisionShape) -> tuple[tuple[CollisionShape, ...], str]:
    link = Link("case", (Visual("case", (Surface(TriangleMesh.box_mesh(box(CASE))),)),))
    found, note = level_feet(ArticulatedObject("o", "case", (link,), ()), MASSES, {"case": body})
    return found["case"], note


def lows(body: tuple[CollisionShape, ...]) -> list[float]:
    return [float(corners_of(one)[:, 2].min()) for one in body]


def margin(body: tuple[CollisionShape, ...]) -> float:
    link = Link("case", (Visual("case", (Surface(TriangleMesh.box_mesh(box(CASE))),)),))
    found = stability_of(
        ArticulatedObject("o", "case", (link,), ()), MASSES, {"case": body}, StabilityConfig(on_floor=0.001)
    )
    return -1.0 if found is None else found.margin


@given(st.floats(0.002, 0.0115), st.floats(0.002, 0.0115))
def test_a_piece_whose_rear_feet_are_short_stands_on_all_four(left, right):
    body, note = levelled(*feet(0.0, 0.0, left, right), shape(CASE))
    assert lows(body) == pytest.approx([0.0, 0.0, 0.0, 0.0, 0.1])
    assert [float(corners_of(foot)[:, 2].max()) for foot in body[:4]] == pytest.approx([0.1] * 4)
    assert margin(body) == pytest.approx(0.2)
    assert float(note.split(" up to ")[1].split(" mm")[0]) == pytest.approx(1000 * max(left, right), abs=0.51)


@pytest.mark.parametrize(
    "body",
    [
        (*feet(0.0, 0.0, 0.0, 0.0), shape((-0.3, -0.1, 0.008, 0.3, 0.1, 0.02))),
        feet(0.0, 0.0, 0.08, 0.08),
        (*feet(0.0, 0.0, 0.0, 0.0), shape((-0.3, -0.1, 0.04, 0.3, 0.1, 0.06))),
        feet(0.0, 0.0, 0.0, 0.0),
    ],
    ids=["a board just above the floor", "feet that hang", "a board above the floor", "feet of one length"],
)
def test_what_stands_as_it_is_or_would_not_be_helped_stays(body):
    assert levelled(*body, shape(CASE)) == ((*body, shape(CASE)), "")


@given(st.floats(0.013, 0.059), st.floats(-0.0115, 0.0115))
def test_a_piece_that_leans_on_two_legs_stands_on_all_four_however_short_the_others_are(left, more):
    right = float(np.clip(left + more, 0.0125, 0.0595))
    body, note = levelled(*feet(0.0, 0.0, left, right), shape(CASE))
    assert lows(body) == pytest.approx([0.0, 0.0, 0.0, 0.0, 0.1])
    assert margin(body) == pytest.approx(0.2)
    assert f"{1000 * max(left, right):.0f} mm" in note


def test_a_pedestal_without_glides_carries_and_what_is_not_needed_hangs():
    """A desk's centre of mass is above its pedestal, which ends above the floor; a stretcher ends a little higher."""
    legs = (shape((0.34, -0.2, 0.0, 0.4, -0.14, 0.7)), shape((0.34, 0.14, 0.0, 0.4, 0.2, 0.7)))
    pedestal, stretcher = shape((-0.4, -0.2, 0.04, 0.1, 0.2, 0.7)), shape((0.1, -0.02, 0.055, 0.4, 0.02, 0.1))
    body, _ = levelled(*legs, pedestal, stretcher)
    assert lows(body) == pytest.approx([0.0, 0.0, 0.0, 0.055])
    assert margin(body) > 0.1


def with_a_drawer(low: float, high: float) -> tuple[ArticulatedObject, dict[str, MassProperties], CollisionShape]:
    """The case and a drawer at its rear between two heights that comes out below it, towards the rear."""
    bounds = (-0.4, 0.0, low, 0.4, 0.14, high)
    links = tuple(
        Link(name, (Visual(name, (Surface(TriangleMesh.box_mesh(box(b))),)),))
        for name, b in (("case", CASE), ("drawer", bounds))
    )
    axis = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0))
    joint = Joint("slide", JointType.PRISMATIC, "case", "drawer", axis, JointLimits(0.0, 0.1))
    drawer = MassProperties(0.1, box(bounds).center, 0.001 * np.eye(3))
    return ArticulatedObject("o", "case", links, (joint,)), {**MASSES, "drawer": drawer}, shape(bounds)


@pytest.mark.parametrize(("low", "high", "stands"), [(0.005, 0.02, False), (0.045, 0.09, True)])
def test_no_foot_grows_into_the_way_of_a_drawer(low, high, stands):
    articulated, masses, drawer = with_a_drawer(low, high)
    body = (*feet(0.0, 0.0, 0.03, 0.03), shape(CASE))
    found, note = level_feet(articulated, masses, {"case": body, "drawer": (drawer,)})
    assert bool(note) == stands
    assert lows(found["case"])[2:4] == pytest.approx([0.0, 0.0] if stands else [0.03, 0.03])


def test_a_piece_on_wheels_is_left_as_it_is():
    articulated, masses, _ = with_a_drawer(0.045, 0.09)
    hanging, wheel = (*feet(0.03, 0.03, 0.04, 0.04), shape(CASE)), shape((-0.4, -0.2, 0.0, 0.4, -0.1, 0.05))
    assert level_feet(articulated, masses, {"case": hanging, "drawer": (wheel,)}) == (
        {"case": hanging, "drawer": (wheel,)},
        "",
    )


def test_a_slanting_foot_keeps_its_upper_end():
    slanting = hull_of(
        np.array([[x, y, z] for x in (-0.4, -0.36) for y, z in ((0.1, 0.1), (0.14, 0.1), (0.16, 0.009), (0.2, 0.009))]),
        0.001,
    )
    front = feet(0.0, 0.0, 0.0, 0.0)
    body, _ = levelled(*front[:2], slanting, shape((0.36, 0.16, 0.009, 0.4, 0.2, 0.1)), shape(CASE))
    points = corners_of(body[2])
    assert float(points[:, 2].min()) == pytest.approx(0.0)
    assert float(points[:, 2].max()) == pytest.approx(0.1)
    assert points[points[:, 2] < 1e-6][:, 1].min() == pytest.approx(0.16)


def test_the_physics_of_a_piece_has_level_feet_and_states_it():
    meshes = [TriangleMesh.box_mesh(box(CASE))]
    for x, y, low in ((-0.4, -0.2, 0.0), (0.36, -0.2, 0.0), (-0.4, 0.16, 0.007), (0.36, 0.16, 0.007)):
        meshes.append(TriangleMesh.box_mesh(box((x, y, low, x + 0.04, y + 0.04, 0.1))))
    made = ArticulatedObject("o", "case", (Link("case", (Visual("case", (Surface(merge_meshes(meshes)),)),)),), ())
    physics = physics_of(made)
    assert sum(low < 0.002 for low in lows(physics.shapes["case"])) == 4
    assert [note for note in physics.notes if "above the floor" in note]


def test_a_config_refuses_what_is_no_length():
    with pytest.raises(ValueError, match="short"):
        LevelFeetConfig(short=0.0)
