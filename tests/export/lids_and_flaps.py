"""Built by hand, with lids and flaps: a blanket chest, a light one, a flap that is lifted and one that falls open."""

import numpy as np
from small_cabinet import board

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.vocabulary import JointType, PartLabel

OAK = Material("oak", (0.6, 0.4, 0.2, 1.0))
BACKWARDS = vec3(-1.0, 0.0, 0.0)


def part(name: str, label: PartLabel, *bounds: float) -> Visual:
    return Visual(name, (Surface(board(*bounds), OAK),), label=label)


def box(width: float, depth: float, height: float, front: bool) -> Link:
    """An open box of boards: open above, or before."""
    w, d, t = width / 2, depth / 2, 0.018
    boards = {
        "left": (-w, -d, 0, -w + t, d, height),
        "right": (w - t, -d, 0, w, d, height),
        "back": (-w + t, d - t, 0, w - t, d, height),
        "bottom": (-w + t, -d, 0, w - t, d - t, t),
    }
    boards["face"] = (-w + t, -d, height - t, w - t, d - t, height) if front else (-w + t, -d, t, w - t, -d + t, height)
    return Link("body", tuple(part(name, PartLabel.SIDE_PANEL, *bounds) for name, bounds in boards.items()))


def turning(body: Link, leaf: Visual, point: Vec3, direction: Vec3, degrees: float) -> ArticulatedObject:
    limits = JointLimits(0.0, float(np.radians(degrees)))
    joint = Joint("lid", JointType.REVOLUTE, "body", "lid", Axis(point, direction), limits)
    return ArticulatedObject("made", "body", (body, Link("lid", (leaf,))), (joint,))


def chest() -> ArticulatedObject:
    """A blanket chest, 1.2 x 0.6 m: its lid weighs 11 kg."""
    lid = part("lid", PartLabel.DOOR, -0.62, -0.32, 0.6, 0.62, 0.3, 0.622)
    return turning(box(1.2, 0.6, 0.6, front=False), lid, vec3(0.0, 0.3, 0.6), BACKWARDS, 95)


def light_chest() -> ArticulatedObject:
    lid = part("lid", PartLabel.DOOR, -0.2, -0.15, 0.2, 0.2, 0.15, 0.21)
    return turning(box(0.4, 0.3, 0.2, front=False), lid, vec3(0.0, 0.15, 0.2), BACKWARDS, 95)


def lifted() -> ArticulatedObject:
    """A wall cabinet with one flap that opens upwards, 5 kg."""
    flap = part("lid", PartLabel.DOOR, -0.45, -0.198, 0.002, 0.45, -0.18, 0.448)
    return turning(box(0.9, 0.36, 0.45, front=True), flap, vec3(0.0, -0.2, 0.448), BACKWARDS, 90)


def dropped() -> ArticulatedObject:
    """A cabinet whose front falls open, to a table, 5 kg."""
    flap = part("lid", PartLabel.DOOR, -0.45, -0.198, 0.002, 0.45, -0.18, 0.448)
    return turning(box(0.9, 0.36, 0.45, front=True), flap, vec3(0.0, -0.2, 0.002), -BACKWARDS, 90)
