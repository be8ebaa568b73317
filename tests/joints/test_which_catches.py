"""Which joints get a catch: doors and drawers that move levelly and by themselves."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.catch_kind import CatchKind
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.catches import with_catches
from grafu.vocabulary import JointType, PartLabel

UP, ACROSS, OUT = vec3(0.0, 0.0, 1.0), vec3(1.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0)
NONE, DETENT = CatchKind.NONE, CatchKind.DETENT


def piece(kind: JointType, direction: np.ndarray, label: PartLabel, upper: float = 0.4) -> ArticulatedObject:
    mesh = TriangleMesh.box_mesh(Box(vec3(0.0, 0.0, 0.0), vec3(0.4, 0.02, 0.4)))
    links = (
        Link("body", (Visual("side", (Surface(mesh),)),)),
        Link("part", (Visual("part", (Surface(mesh),), label=label),)),
    )
    axis = Axis(vec3(0.0, 0.0, 0.0), direction / np.linalg.norm(direction))
    return ArticulatedObject("piece", "body", links, (Joint("j", kind, "body", "part", axis, JointLimits(0.0, upper)),))


@pytest.mark.parametrize(
    ("kind", "direction", "label", "caught"),
    [
        (JointType.REVOLUTE, UP, PartLabel.DOOR, True),
        (JointType.REVOLUTE, -UP, PartLabel.DRAWER, True),
        (JointType.REVOLUTE, vec3(0.1, 0.0, 1.0), PartLabel.DOOR, True),
        (JointType.REVOLUTE, ACROSS, PartLabel.DOOR, False),
        (JointType.REVOLUTE, vec3(0.3, 0.0, 1.0), PartLabel.DOOR, False),
        (JointType.REVOLUTE, UP, PartLabel.MISC, False),
        (JointType.PRISMATIC, OUT, PartLabel.DRAWER, True),
        (JointType.PRISMATIC, ACROSS, PartLabel.DOOR, True),
        (JointType.PRISMATIC, UP, PartLabel.DRAWER, False),
        (JointType.PRISMATIC, vec3(0.0, -1.0, -0.3), PartLabel.DRAWER, False),
        (JointType.PRISMATIC, OUT, PartLabel.SHELF, False),
    ],
)
def test_doors_and_drawers_that_move_levelly_have_one(kind, direction, label, caught) -> None:
    made = with_catches(piece(kind, direction, label), DETENT)

    assert made.joints[0].catch is (DETENT if caught else NONE)


def test_a_follower_has_none_and_a_part_that_cannot_move_neither() -> None:
    made = piece(JointType.PRISMATIC, OUT, PartLabel.DRAWER)
    second = Link("second", (replace(made.link("part").visuals[0], name="second"),))
    follower = replace(made.joints[0], id="k", child="second").following(made.joints[0], 0.5)
    coupled = replace(made, links=(*made.links, second), joints=(*made.joints, follower))

    assert [joint.catch for joint in with_catches(coupled, DETENT).joints] == [DETENT, NONE]
    still = with_catches(piece(JointType.PRISMATIC, OUT, PartLabel.DRAWER, upper=0.0), DETENT)
    assert still.joints[0].catch is NONE


def test_with_none_the_object_is_the_same() -> None:
    made = piece(JointType.PRISMATIC, OUT, PartLabel.DRAWER)

    assert with_catches(made, NONE) is made
