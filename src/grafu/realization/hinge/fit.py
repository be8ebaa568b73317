"""Fits hinges of one template to one pin: size, count, heights, and the hardware in the object frame.

It builds; whether the hardware is in anything's way is judged by `place`.
"""

from dataclasses import dataclass
from math import ceil
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.intersection import share_shape
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.realization.hinge.border import BorderFrame
from grafu.realization.hinge.candidates import PinCandidate
from grafu.templates.template import HingeModel, HingeSize, HingeTemplate
from grafu.vocabulary import PartLabel

# A hinge never exceeds this share of its door (official 7.3: 12 % of the door's axial length per hinge).
_LENGTH_SHARE = 0.12
_RADIUS_SHARE = 0.22
_RADIUS = 0.0036  # of a common 60 mm butt hinge
SMALLEST = 0.001


@final
@dataclass(frozen=True)
class FittedHinge:
    """One hinge in the object frame: the template as built, its pose, and the two ends as visuals."""

    template: HingeTemplate
    T_object_template: Mat4
    static: Visual
    dynamic: Visual


def barrel_radius(frame: BorderFrame) -> float:
    """Returns the barrel radius that suits a door, metres; a door drawn without thickness counts as a thin board."""
    return max(SMALLEST, min(_RADIUS, _RADIUS_SHARE * frame.board))


def hinge_count(length: float) -> int:
    """Returns how many hinges a border of this length takes: two, and one more per 0.6 m beyond the first 0.9.

    Cabinet makers put 2 up to 0.9 m, 3 up to 1.5, 4 up to 2.1.
    """
    return 2 + max(0, ceil((length - 0.9) / 0.6 - 1e-9))


def hinge_heights(length: float, count: int) -> np.ndarray:
    """Returns the z of each hinge: the i-th of N at i / (N + 1) of the height (supplement, Search and Snap)."""
    return (np.arange(1, count + 1) / (count + 1) - 0.5) * length


def hinge_size(
    model: HingeModel, frame: BorderFrame, pin: PinCandidate, count: int, scale: float = 1.0
) -> HingeSize | None:
    """Returns the size at which a model fits a pin; None where its leaves would be no wider than its barrel.

    `scale` multiplies what suits the door; the pin's radius has it already, and hinges still must find room.
    """
    radius = pin.radius
    wanted = scale * min(model.natural.length, _LENGTH_SHARE * frame.length)
    length = min(wanted, 0.8 * frame.length / (count + 1))
    leaf = min(scale * model.natural.leaf, pin.leaf_room)
    thickness = min(scale * model.natural.thickness, 0.6 * radius)
    if leaf < 1.5 * radius + 2e-4 or length < 2 * radius:
        return None
    return HingeSize(length, leaf, thickness, radius)


def fit_hinge(model: HingeModel, size: HingeSize, frame: BorderFrame, pin: PinCandidate, z: float) -> FittedHinge:
    """Returns one hinge of `model` at height z of a pin; names are given by `named`."""
    template = model.build(size)
    T = frame.T_object_border @ from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), pin.roll), vec3(pin.x, pin.y, z))
    static = Visual("hinge_static", template.static.transformed(T).surfaces, VisualRole.HARDWARE, PartLabel.MISC)
    dynamic = Visual("hinge_dynamic", template.dynamic.transformed(T).surfaces, VisualRole.HARDWARE, PartLabel.MISC)
    share_shape(static.mesh, template.static.mesh, T)
    share_shape(dynamic.mesh, template.dynamic.mesh, T)
    return FittedHinge(template, T, static, dynamic)
