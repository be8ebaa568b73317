"""The solids that are cut away: convex, in the front frame (X along the gripped edge, Y towards it, Z outwards)."""

from dataclasses import dataclass
from itertools import pairwise
from typing import final

import numpy as np
from jaxtyping import Float

from grafu.geometry.arrays import Points, Scalars
from grafu.geometry.box import Box
from grafu.geometry.solids import ConvexSolid
from grafu.realization.grip.config import GripKind, GripProfile, GripSize

Outline = Float[np.ndarray, "n 2"]

_QUARTER = 6  # straight pieces of a quarter turn
_STEPS = 5  # levels of a rounded bottom, and of an eased rim
_BOTTOM = 0.7  # the radius of a groove's rounded bottom, as a share of its depth
_EASED = 0.15  # the radius of a hole's rounded rim, as a share of the front's thickness


@final
@dataclass(frozen=True, slots=True)
class Cut:
    """One grip in the front frame: its middle (x, y), where an edge notch's y is the edge itself; its size; its levels.

    It is cut from `top`, above the front, down to `bottom`; `face` is the level of the front's face.
    """

    kind: GripKind
    profile: GripProfile
    x: float
    y: float
    size: GripSize
    top: float
    face: float
    bottom: float

    @property
    def box(self) -> Box:
        """The box around all that is cut, without what stands over the edge or the face."""
        half, width = self.size.length / 2, self.size.width
        low, high = (self.y - width, self.y) if self.kind is GripKind.EDGE else (self.y - width / 2, self.y + width / 2)
        return Box(np.array([self.x - half, low, self.bottom]), np.array([self.x + half, high, self.face]))


def cutters(cut: Cut) -> tuple[ConvexSolid, ...]:
    """Returns the solids of a grip, in the front frame."""
    rounded = cut.profile == "rounded"
    if cut.kind is GripKind.GROOVE:
        solids = [_groove(cut)] if rounded else [_prism(_rectangle(cut), cut.bottom, cut.top)]
    elif cut.kind is GripKind.EDGE:
        solids = [_prism(_notch(cut), cut.bottom, cut.top)]
    else:
        outline = _oval(cut)
        solids = [_prism(outline, cut.bottom, cut.top)]
        if rounded and cut.face - cut.bottom > 0:
            solids += _eased_rim(cut)
    return tuple(solid for solid in solids if solid is not None)


def _prism(outline: Outline, bottom: float, top: float) -> ConvexSolid | None:
    return ConvexSolid.around(np.vstack([_at(outline, bottom), _at(outline, top)]))


def _at(outline: Outline, level: float) -> Points:
    return np.column_stack([outline, np.full(len(outline), level)])


def _rectangle(cut: Cut) -> Outline:
    half = np.array([cut.size.length, cut.size.width]) / 2
    return np.array([cut.x, cut.y]) + half * np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])


def _oval(cut: Cut, grown: float = 0.0) -> Outline:
    """Returns a slot with round ends, a circle where it is as long as wide; grown or shrunk all round."""
    size = np.array([cut.size.length, cut.size.width])
    radius = float(size.min()) / 2
    ends = size / 2 - radius
    angles = _half_turn(4 * _QUARTER, 2 * np.pi)
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    return np.array([cut.x, cut.y]) + (radius + grown) * circle + ends * np.sign(np.round(circle, 9))


def _groove(cut: Cut) -> ConvexSolid | None:
    """Returns a hollow with round ends whose walls curve into its bottom."""
    depth = cut.face - cut.bottom
    radius = _BOTTOM * min(depth, 0.5 * min(cut.size.length, cut.size.width))
    angles = np.linspace(0.0, np.pi / 2, _STEPS + 1)
    levels = [(cut.bottom + radius * (1 - np.sin(a)), -radius * (1 - np.cos(a))) for a in angles]
    points = [_at(_oval(cut, inset), level) for level, inset in levels]
    return ConvexSolid.around(np.vstack([_at(_oval(cut), cut.top), *points]))


def _notch(cut: Cut) -> Outline:
    """Returns a notch that is open over the edge: half an ellipse, or a rectangle."""
    half, width, over = cut.size.length / 2, cut.size.width, 0.25 * cut.size.width
    if cut.profile == "sharp":
        inner = np.array([(-half, -width), (half, -width)])
    else:
        angles = np.linspace(-np.pi, 0.0, 4 * _QUARTER + 1)
        inner = np.column_stack([half * np.cos(angles), width * np.sin(angles)])
    return np.array([cut.x, cut.y]) + np.vstack([inner, [(half, over), (-half, over)]])


def _eased_rim(cut: Cut) -> list[ConvexSolid | None]:
    """Returns solids that round a hole's rim at the face off by a quarter turn."""
    radius = _EASED * (cut.face - cut.bottom)
    angles = np.linspace(0.0, np.pi / 2, _STEPS)
    inset = radius * (1 - np.sin(angles))
    levels = cut.face - radius * (1 - np.cos(angles))
    rings = [_at(_oval(cut, float(g)), float(level)) for g, level in zip(inset, levels, strict=True)]
    rings = [_at(_oval(cut, radius), cut.top), *rings]
    return [ConvexSolid.around(np.vstack([a, b])) for a, b in pairwise(rings)]


def _half_turn(pieces: int, turn: float) -> Scalars:
    """Returns the angles of the corners of a turn in straight pieces, none of them straight ahead."""
    return np.arange(pieces) * turn / pieces + turn / pieces / 2
