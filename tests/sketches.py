"""Furniture sketched in a few lines of boxes, with true joints, for tests of what is made of it."""

from dataclasses import dataclass
from math import radians

from grafu.asset.part import AnnotatedJoint, Asset, Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import JointType, PartLabel

Corner = tuple[float, float, float]


@dataclass(frozen=True)
class Sketched:
    """A part and, where it moves, its joint."""

    part: Part
    joint: AnnotatedJoint | None = None


def sketch(*pieces: Sketched) -> Asset:
    """Returns the asset of all pieces, where they are."""
    joints = tuple(piece.joint for piece in pieces if piece.joint)
    return Asset("sketch", "", "made", tuple(piece.part for piece in pieces), joints=joints)


def board(name: str, label: PartLabel, low: Corner, high: Corner, carried_by: str | None = None) -> Sketched:
    """Returns a still box."""
    return Sketched(Part(name, label, (_surface(low, high),), PartSource(name), "annotation", carried_by))


def door(name: str, low: Corner, high: Corner, hinge: str) -> Sketched:
    """Returns a door that faces -Y, its pin at the front edge on its left or right."""
    x, sign = (low[0], -1.0) if hinge == "left" else (high[0], 1.0)
    axis = Axis(vec3(x, low[1], (low[2] + high[2]) / 2), vec3(0.0, 0.0, sign))
    part = board(name, PartLabel.DOOR, low, high).part
    return Sketched(part, AnnotatedJoint(name, JointType.REVOLUTE, axis, 0.0, radians(95)))


def drawer(name: str, low: Corner, high: Corner) -> Sketched:
    """Returns a drawer that opens to -Y: a front, two flanks and a back."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    boards = (
        _surface(low, (x1, y0 + 0.018, z1)),
        _surface((x0, y0 + 0.018, z0), (x0 + 0.01, y1, z1)),
        _surface((x1 - 0.01, y0 + 0.018, z0), high),
        _surface((x0 + 0.01, y1 - 0.01, z0), (x1 - 0.01, y1, z1)),
    )
    part = Part(name, PartLabel.DRAWER, boards, PartSource(name), "annotation")
    axis = Axis(vec3((x0 + x1) / 2, y0, (z0 + z1) / 2), vec3(0.0, -1.0, 0.0))
    return Sketched(part, AnnotatedJoint(name, JointType.PRISMATIC, axis, 0.0, 0.8 * (y1 - y0)))


def handle(name: str, carrier: str, at: Corner) -> Sketched:
    """Returns a small upright bar, 20 mm deep, that rides on a door or drawer."""
    x, y, z = at
    return board(name, PartLabel.HANDLE, (x - 0.006, y, z - 0.06), (x + 0.006, y + 0.02, z + 0.06), carrier)


def _surface(low: Corner, high: Corner) -> Surface:
    return Surface(TriangleMesh.box_mesh(Box(vec3(*low), vec3(*high))))
