"""Moving collision shapes keep off the floor; what carries the piece, and what hangs, is left as it is."""

from math import pi

import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.collision_shapes import corners_of
from grafu.articulation.floor_clearance import FloorConfig, off_floor
from grafu.articulation.kinematics import link_poses
from grafu.articulation.sweep import rest_to_full
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box, OrientedBox
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.solids import ConvexSolid
from grafu.vocabulary import JointType, PartLabel

GAP = FloorConfig().gap
UPRIGHT, LEVEL = Axis(vec3(-0.3, -0.2, 0.0), vec3(0.0, 0.0, -1.0)), Axis(vec3(0.0, -0.2, 0.2), vec3(1.0, 0.0, 0.0))


def made(low: float, axis: Axis, label: PartLabel = PartLabel.DOOR) -> ArticulatedObject:
    door = TriangleMesh.box_mesh(Box(vec3(-0.3, -0.22, low), vec3(0.3, -0.2, 0.5)))
    case = TriangleMesh.box_mesh(Box(vec3(-0.3, -0.2, 0.0), vec3(0.3, 0.2, 0.5)))
    links = [
        Link(n, (Visual(n, (Surface(m),), label=k),))
        for n, m, k in (("case", case, PartLabel.UNKNOWN), ("door", door, label))
    ]
    joint = Joint("joint", JointType.REVOLUTE, "case", "door", axis, JointLimits(0.0, pi / 2))
    return ArticulatedObject("cabinet", "case", tuple(links), (joint,))


def shapes(articulated: ArticulatedObject, case_low: float = 0.0, hull: bool = False):
    found = {}
    for link in articulated.links:
        box = link.mesh.box
        low = np.array([box.low[0], box.low[1], case_low if link.id == "case" else box.low[2]])
        solid = OrientedBox((low + box.high) / 2, (box.high - low) / 2, np.eye(3))
        found[link.id] = (ConvexSolid.around(corners_of(solid)) if hull else solid,)
    return found


def lowest(articulated: ArticulatedObject, found, link: str = "door") -> float:
    heights = []
    for values in rest_to_full(articulated, "joint", 60):
        T = link_poses(articulated, values)[link]
        heights += [float((corners_of(s) @ T[2, :3] + T[2, 3]).min()) for s in found[link]]
    return min(heights)


@pytest.mark.parametrize("hull", [False, True])
@pytest.mark.parametrize("axis", [UPRIGHT, LEVEL], ids=["door", "flap"])
@pytest.mark.parametrize("low", [0.0, 0.0005, -0.02])
def test_a_front_keeps_off_the_floor_over_its_whole_motion(low, axis, hull):
    articulated = made(low, axis)

    found = off_floor(articulated, shapes(articulated, hull=hull))

    assert lowest(articulated, found) >= GAP - (1e-9 if axis is UPRIGHT else 2e-3)  # between poses of a flap
    assert np.allclose(corners_of(found["case"][0]), corners_of(shapes(articulated, hull=hull)["case"][0]))


def test_the_floor_is_where_the_case_stands_not_where_the_front_ends():
    articulated = made(0.0, UPRIGHT)
    found = off_floor(articulated, shapes(articulated, case_low=0.01))
    assert lowest(articulated, found) == pytest.approx(0.01 + GAP)


def test_a_thick_shape_of_a_thin_bottom_does_not_lower_the_floor():
    articulated = made(0.0, UPRIGHT)
    found = off_floor(articulated, shapes(articulated, case_low=-0.0017))
    assert lowest(articulated, found) == pytest.approx(GAP)


def test_a_front_that_hangs_below_all_else_is_left_whole():
    articulated = made(0.0, UPRIGHT)
    found = off_floor(articulated, shapes(articulated, case_low=0.1))
    assert lowest(articulated, found) == pytest.approx(0.0)


def test_wheels_that_carry_the_piece_are_left_whole():
    articulated = made(0.0, UPRIGHT, PartLabel.MISC)
    found = off_floor(articulated, shapes(articulated, case_low=0.05))
    assert lowest(articulated, found) == pytest.approx(0.0)


def test_what_is_all_below_is_left_out():
    articulated = made(-0.02, UPRIGHT)
    thin = OrientedBox(vec3(0.0, -0.21, -0.01), vec3(0.3, 0.01, 0.005), np.eye(3))
    assert off_floor(articulated, {**shapes(articulated), "door": (thin,)})["door"] == ()
