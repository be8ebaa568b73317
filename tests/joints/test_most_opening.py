"""How far flaps and lids open at most: lids past upright, the front of a desk until it is level, however it slopes."""

from math import cos, degrees, radians, sin

import numpy as np
import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.config import RealizationConfig
from grafu.joints.hinge.most_opening import most_opening
from grafu.joints.plan import JointRequest
from grafu.scene.border import border_frame
from grafu.vocabulary import JointType

FORWARD = vec3(1.0, 0.0, 0.0)  # what turns so about its lower edge drops towards -Y


def board(rise: float) -> TriangleMesh:
    """A board of 0.8 x 0.4 m and 2 cm that rises so many degrees from its front edge at the origin, backwards."""
    flat = TriangleMesh.box_mesh(Box(vec3(-0.4, 0.0, 0.0), vec3(0.4, 0.4, 0.02)))
    c, s = cos(radians(rise)), sin(radians(rise))
    return TriangleMesh(flat.vertices @ np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]]), flat.faces)


@pytest.mark.parametrize("rise", [20.0, 35.0, 44.0, 46.0, 60.0, 80.0])
def test_the_front_of_a_desk_opens_until_it_is_level(rise):
    mesh, axis = board(rise), Axis(vec3(0.0, 0.0, 0.0), FORWARD)
    request = JointRequest("front", JointType.REVOLUTE, axis, "annotation", radians(180.0 - rise))
    most = most_opening(request, border_frame(mesh, axis), mesh, RealizationConfig(door_opening=radians(180.0)))
    assert degrees(most) == pytest.approx(180.0 - rise, abs=1.0)


@pytest.mark.parametrize("fall", [0.0, 10.0, 25.0])
def test_a_lid_that_is_level_or_falls_to_its_front_opens_past_upright(fall):
    mesh = board(-fall)
    mesh = TriangleMesh(mesh.vertices * (1.0, -1.0, 1.0), mesh.faces[:, ::-1])  # hinged at its back, high edge
    axis = Axis(vec3(0.0, 0.0, 0.0), -FORWARD)
    request = JointRequest("lid", JointType.REVOLUTE, axis, "annotation", radians(120.0))
    most = most_opening(request, border_frame(mesh, axis), mesh, RealizationConfig())
    assert degrees(most) == pytest.approx(95.0)
