"""A two-leaf folding door on a case: leaf 1 hinged on the case, leaf 2 hinged on leaf 1 and coupled to its hinge."""

from math import pi

import numpy as np

from grafu.articulation.articulated_object import (
    ArticulatedObject,
    Joint,
    JointLimits,
    Link,
    Visual,
    VisualRole,
)
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import JointType, PartLabel

UP = np.array([0.0, 0.0, 1.0])
LIMITS = JointLimits(0.0, 1.4)
CASE_HINGE = Joint("leaf_1_hinge", JointType.REVOLUTE, "case", "leaf_1", Axis(vec3(-0.4, -0.22, 0.0), -UP), LIMITS)
LEAF_HINGE = Joint(
    "leaf_2_hinge", JointType.REVOLUTE, "leaf_1", "leaf_2", Axis(vec3(0.0, -0.2, 0.0), -UP), JointLimits(0.0, pi)
).following(CASE_HINGE, multiplier=-2.0)
"""Both pins are drawn pointing down; the second leaf folds back by twice what the first opens."""


def board(*bounds: float) -> TriangleMesh:
    low, high = np.array(bounds[:3], dtype=float), np.array(bounds[3:], dtype=float)
    return TriangleMesh.box_mesh(Box(low, high))


def visual(name: str, label: PartLabel, *boards: TriangleMesh) -> Visual:
    return Visual(name, tuple(Surface(mesh) for mesh in boards), VisualRole.PART, label)


def make_bifold() -> ArticulatedObject:
    """Returns the case with both leaves; the free edge of leaf 2 stays in the plane of the front."""
    sides = board(-0.42, -0.2, 0.0, -0.4, 0.2, 0.8), board(0.4, -0.2, 0.0, 0.42, 0.2, 0.8)
    back = board(-0.4, 0.18, 0.0, 0.4, 0.2, 0.8)
    links = (
        Link("case", (visual("case", PartLabel.SIDE_PANEL, *sides, back),)),
        Link("leaf_1", (visual("leaf_1", PartLabel.DOOR, board(-0.4, -0.22, 0.0, -0.001, -0.2, 0.8)),)),
        Link("leaf_2", (visual("leaf_2", PartLabel.DOOR, board(0.001, -0.22, 0.0, 0.4, -0.2, 0.8)),)),
    )
    return ArticulatedObject("bifold", "case", links, (CASE_HINGE, LEAF_HINGE))
