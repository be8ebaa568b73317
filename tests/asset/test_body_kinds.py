"""What turns without end about its own middle is no door."""

import pytest

from grafu.articulation.articulated_object import Coupling
from grafu.asset.bodies import Body, BodyVisual, StatedMotion, annotation_of_bodies
from grafu.asset.body_kinds import is_rotor
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.vocabulary import JointType
from small_scenes import box

PLATE = Box(vec3(-0.15, -0.15, 0.0), vec3(0.15, 0.15, 0.01))
UP = vec3(0.0, 0.0, 1.0)


@pytest.mark.parametrize(("x", "expected"), [(0.0, True), (0.029, True), (0.031, False), (0.15, False)])
def test_the_axis_of_a_rotor_passes_through_its_middle(x, expected):
    assert is_rotor(PLATE, Axis(vec3(x, 0.0, 5.0), UP)) is expected


def bodies(limited: bool, x: float, coupling: Coupling | None = None) -> list[Body]:
    def visuals(name, low, high):
        return (BodyVisual(name, box(name, low, high).surfaces, link=name),)

    motion = StatedMotion(JointType.REVOLUTE, Axis(vec3(x, 0.0, 0.0), UP), 0.0, 1.0, limited, coupling)
    case = Body("case", "case", visuals("case", (-0.3, -0.3, -0.1), (0.3, 0.3, 0.0)))
    return [case, Body("plate", "plate", visuals("plate", (-0.15, -0.15, 0.0), (0.15, 0.15, 0.01)), motion, "case")]


def test_an_unlimited_plate_about_its_middle_is_a_small_part_and_others_are_doors():
    rotor = annotation_of_bodies(bodies(limited=False, x=0.0), 2)
    assert rotor is None or (rotor.joints, [j.part for j in rotor.small_joints]) == ((), ["plate"])
    for limited, x in ((True, 0.0), (False, 0.15)):
        found = annotation_of_bodies(bodies(limited, x), 2)
        assert found is not None
        assert [joint.part for joint in found.joints] == ["plate"]
        assert found.small_joints == ()
