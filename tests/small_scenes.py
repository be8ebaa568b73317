"""Scenes of a few boxes, where what must come out can be said beforehand."""

from dataclasses import replace
from math import radians

import numpy as np
import trimesh

from grafu.asset.part import AnnotatedJoint, Asset, Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import JointType, PartLabel

Point = tuple[float, float, float]


def box(name: str, low: Point, high: Point, carried_by: str | None = None) -> Part:
    """A board; doors, drawers and handles are known by how their names begin."""
    label = next((PartLabel(w) for w in ("door", "drawer", "handle") if name.startswith(w)), PartLabel.UNKNOWN)
    mesh = TriangleMesh.box_mesh(Box(vec3(*low), vec3(*high)))
    return Part(name, label, (Surface(mesh),), PartSource(name), "annotation", carried_by)


def cylinder(name, ends, radius=0.006, carried_by=None) -> Part:
    tube = trimesh.creation.cylinder(radius=radius, segment=np.array(ends), sections=24)
    part = box(name, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), carried_by)
    return replace(part, surfaces=(Surface(TriangleMesh.from_trimesh(tube)),))


# An open case of 0.6 x 0.55 x 0.82 m whose front lies at y = 0, labelled.
BASE_CASE = [
    replace(part, label=label)
    for part, label in (
        (box("left", (0.0, 0.0, 0.0), (0.02, 0.55, 0.82)), PartLabel.SIDE_PANEL),
        (box("right", (0.58, 0.0, 0.0), (0.6, 0.55, 0.82)), PartLabel.SIDE_PANEL),
        (box("floor", (0.02, 0.0, 0.08), (0.58, 0.55, 0.1)), PartLabel.BOTTOM_PANEL),
        (box("top", (0.02, 0.0, 0.8), (0.58, 0.55, 0.82)), PartLabel.TOP_PANEL),
        (box("back", (0.02, 0.53, 0.1), (0.58, 0.55, 0.8)), PartLabel.BACK_PANEL),
    )
]

# A door of 0.4 x 0.6 m in the plane y = 0 that hangs on its left edge, and the wall that it hangs on.
DOOR = box("door", (0.0, -0.02, 0.0), (0.4, 0.0, 0.6))
SIDE = box("side", (-0.02, 0.0, 0.0), (0.0, 0.4, 0.6))
LEFT_EDGE = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, -1.0))


def hinged(
    part: str = "door", axis: Axis = LEFT_EDGE, lower: float = 0.0, upper: float = radians(90)
) -> AnnotatedJoint:
    return AnnotatedJoint(part, JointType.REVOLUTE, axis, lower, upper)


def sliding(part: str, direction: Point, upper: float = 0.3, lower: float = 0.0) -> AnnotatedJoint:
    return AnnotatedJoint(part, JointType.PRISMATIC, Axis(vec3(0.0, 0.0, 0.3), vec3(*direction)), lower, upper)


def scene(*parts: Part, joints: tuple[AnnotatedJoint, ...] = ()) -> Asset:
    return Asset("scene", "", "made", parts, joints=joints)


def drawer(gap: float = 0.0125, wall: float = 0.02) -> Asset:
    """A drawer box of 0.4 x 0.4 x 0.15 m between two walls at `gap`, with a back behind it."""
    w = 0.2 + gap
    walls = [
        box("side_left", (-w - wall, -0.2, 0.0), (-w, 0.25, 0.2)),
        box("side_right", (w, -0.2, 0.0), (w + wall, 0.25, 0.2)),
        box("back", (-w, 0.23, 0.0), (w, 0.25, 0.5)),  # half a metre: furniture of usual size
    ]
    body = box("drawer", (-0.2, -0.2, 0.02), (0.2, 0.2, 0.17))
    return scene(*walls, body, joints=(sliding("drawer", (0.0, -1.0, 0.0)),))
