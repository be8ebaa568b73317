"""Feet of unequal length, as they are drawn, and what a piece stands on in a simulator."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.articulation.articulated_object import ArticulatedObject, Link, Visual
from grafu.articulation.collision_shapes import CollisionShape, corners_of
from grafu.articulation.convex_pieces import hull_of
from grafu.articulation.level_feet import LevelFeetConfig, level_feet
from grafu.articulation.mass import MassProperties
from grafu.articulation.physics import physics_of
from grafu.articulation.stability import StabilityConfig, stability_of
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box, OrientedBox
from grafu.geometry.mesh import TriangleMesh, merge_meshes

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
        feet(0.0, 0.0, 0.03, 0.03),
        feet(0.0, 0.0, 0.0, 0.0),
    ],
    ids=["a board just above the floor", "feet that hang", "feet of one length"],
)
def test_what_stands_as_it_is_or_would_not_be_helped_stays(body):
    assert levelled(*body, shape(CASE)) == ((*body, shape(CASE)), "")


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
