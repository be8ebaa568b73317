"""Leaf shapes of hinges, drawn flat, and hinge pins with what ends them: flat heads, ball tips, acorn finials.

s runs from the pin to the leaf's far edge, t along the pin. No third dimension. A shape is given as fractions: s in
0..1 of the leaf, t in -1..1 of the half length, then cut and drilled in metres.
"""

from collections.abc import Callable
from typing import final

import numpy as np
from shapely.geometry import Polygon
from shapely.ops import unary_union

from grafu.dataclass import dataclass
from grafu.geometry.mesh import TriangleMesh
from grafu.templates.solids import disc, rectangle, turned
from grafu.templates.template import HingeSize


@final
@dataclass(frozen=True, slots=True)
class PinStyle:
    """The ends of a pin: (radius, height) points from the barrel's end to the tip, in radii of the barrel."""

    profile: tuple[tuple[float, float], ...]

    @property
    def head(self) -> float:
        """How far the pin stands out of the barrel, in radii of the barrel."""
        return max((height for _, height in self.profile), default=0.0)


def _ball(radius: float, neck: float) -> tuple[tuple[float, float], ...]:
    angles = np.linspace(-0.32 * np.pi, 0.5 * np.pi, 6)
    return tuple((radius * float(np.cos(a)), neck + radius * (1 + float(np.sin(a)))) for a in angles)


PLAIN = PinStyle(())
FLAT_HEAD = PinStyle(((0.86, 0.0), (0.86, 0.22), (0.68, 0.4)))
BALL_TIP = PinStyle(((0.7, 0.0), (0.7, 0.16), (0.5, 0.24), *_ball(0.82, 0.1)))
ACORN = PinStyle(
    (
        (0.92, 0.0),
        (0.92, 0.3),
        (0.6, 0.45),
        (0.6, 0.6),
        (0.88, 0.85),
        (0.9, 1.15),
        (0.7, 1.65),
        (0.35, 2.0),
        (0.14, 2.3),
    )
)


def pin_solid(style: PinStyle, size: HingeSize, reach: tuple[float, float], segments: int) -> TriangleMesh:
    """Returns the pin with both its ends, as one solid about Z.

    `reach` is the barrel's extent along Z; heads that would pass the hinge's length are pressed flat.
    """
    radius, (low, high) = 0.5 * size.radius, reach
    room = min(size.length / 2 - high, low + size.length / 2)
    pressed = min(1.0, max(room, 0.0) / max(style.head * size.radius, 1e-9))
    head = [(r * size.radius, h * size.radius * pressed) for r, h in style.profile]
    top = [(r, high + h) for r, h in head]
    bottom = [(r, low - h) for r, h in reversed(head)]
    profile = [*_to_axis(bottom, first=True), (radius, low), (radius, high), *_to_axis(top, first=False)]
    return turned(profile if head else [(0.0, low), (radius, low), (radius, high), (0.0, high)], segments)


def _to_axis(points: list[tuple[float, float]], first: bool) -> list[tuple[float, float]]:
    """Returns the points with one more on the axis, level with the outermost."""
    if not points:
        return []
    return [(0.0, points[0][1]), *points] if first else [*points, (0.0, points[-1][1])]


@final
@dataclass(frozen=True, slots=True)
class LeafArea:
    """The room of a leaf in metres: s from `start` (clear of the barrel) to `leaf`, t from -`half` to +`half`."""

    start: float
    leaf: float
    half: float

    @property
    def width(self) -> float:
        """How far the leaf reaches beyond the barrel."""
        return self.leaf - self.start

    def s(self, ratio: float) -> float:
        """Returns the s at a fraction of the distance from the barrel to the far edge."""
        return self.start + ratio * self.width

    def screw_radius(self) -> float:
        """Returns a screw hole's radius: 3.4 mm as on a common no. 8 screw, less on a small leaf."""
        return min(0.0034, 0.2 * self.width, 0.13 * self.half)


LeafShape = Callable[[LeafArea], Polygon]
ScrewPattern = Callable[[LeafArea], list[tuple[float, float]]]


def plain(area: LeafArea) -> Polygon:
    """A rectangle with chamfered corners."""
    return rectangle((area.start, area.leaf), (-area.half, area.half), 0.12 * min(area.width, area.half))


def square(area: LeafArea) -> Polygon:
    """A rectangle."""
    return rectangle((area.start, area.leaf), (-area.half, area.half))


def rounded(area: LeafArea) -> Polygon:
    """A rectangle whose outer corners are round."""
    radius = min(0.45 * area.width, 0.4 * area.half)
    inner = rectangle((area.start, area.leaf - radius), (-area.half + radius, area.half - radius))
    return unary_union(
        [inner.buffer(radius, quad_segs=4), rectangle((area.start, area.s(0.2)), (-area.half, area.half))]
    ) & (square(area))


def butterfly(area: LeafArea) -> Polygon:
    """Narrow at the pin, wide outside, with a wavy outer edge: one wing of a butterfly."""
    ratios = [(0.0, 0.55), (0.22, 0.55), (0.55, 0.95), (0.78, 1.0), (0.97, 0.8), (1.0, 0.55), (0.93, 0.22), (0.88, 0.0)]
    return _mirrored(area, ratios)


def h_shape(area: LeafArea) -> Polygon:
    """An upright joined to the pin by a short bar: one half of an H, its ends pointed."""
    ratios = [(0.0, 0.42), (0.45, 0.42), (0.45, 0.88), (0.725, 1.0), (1.0, 0.88)]
    return _mirrored(area, [*ratios, (1.0, 0.0)])


def strap(area: LeafArea) -> Polygon:
    """A band that tapers away from the pin and ends in a round tip."""
    tip = min(0.34 * area.half, 0.2 * area.width)
    ratios = [(0.0, 1.0), (0.12, 1.0), (0.2, 0.8), (1.0 - 3.2 * tip / area.width, 0.42), (1.0 - tip / area.width, 0.3)]
    return unary_union([_mirrored(area, ratios), disc((area.leaf - tip, 0.0), tip, 20)])


def scalloped(area: LeafArea) -> Polygon:
    """An ornamental outline: shoulders, a waist and a tongue, as on cast half-mortise hinges."""
    ratios = [(0.0, 1.0), (0.3, 1.0), (0.36, 0.86), (0.5, 0.86), (0.6, 0.72), (0.58, 0.58), (0.7, 0.5), (0.84, 0.42)]
    return _mirrored(area, [*ratios, (0.95, 0.26), (1.0, 0.0)])


def quarter_round(area: LeafArea) -> Polygon:
    """A half-disc on the pin, stretched to the leaf."""
    angles = np.linspace(np.pi / 2, 0.0, 9)
    return _mirrored(area, [(0.0, 1.0), *((0.15 + 0.85 * float(np.cos(a)), float(np.sin(a))) for a in angles)])


def _mirrored(area: LeafArea, ratios: list[tuple[float, float]]) -> Polygon:
    """Returns the outline whose upper half is given, mirrored across the leaf's middle."""
    upper = [(area.s(s), t * area.half) for s, t in ratios]
    lower = [(s, -t) for s, t in reversed(upper) if t > 0]
    return Polygon([*upper, *lower])


def screws_in_column(area: LeafArea) -> list[tuple[float, float]]:
    """Three screws in a line, the middle one set further out, as on butt hinges; two on a short leaf."""
    if area.half < 2.2 * area.width * 0.5 + 4 * area.screw_radius():
        return [(area.s(0.55), t * area.half) for t in (-0.62, 0.62)]
    return [(area.s(0.42), -0.72 * area.half), (area.s(0.66), 0.0), (area.s(0.42), 0.72 * area.half)]


def screws_wide(area: LeafArea) -> list[tuple[float, float]]:
    """Two screws in the wings and none in the middle."""
    return [(area.s(0.72), t * area.half) for t in (-0.58, 0.58)]


def screws_on_upright(area: LeafArea) -> list[tuple[float, float]]:
    """Three screws on the upright of an H."""
    return [(area.s(0.725), t * area.half) for t in (-0.72, 0.0, 0.72)]


def screws_along(area: LeafArea) -> list[tuple[float, float]]:
    """Three screws in a row away from the pin."""
    first = area.start + max(0.14 * area.width, 1.5 * area.screw_radius())
    return [(first, 0.0), (area.s(0.5), 0.0), (area.s(0.78), 0.0)]


def screws_in_triangle(area: LeafArea) -> list[tuple[float, float]]:
    """Two screws near the pin and one in the tongue."""
    return [(area.s(0.2), 0.62 * area.half), (area.s(0.2), -0.62 * area.half), (area.s(0.72), 0.0)]


def screws_every(pitch: float) -> ScrewPattern:
    """Returns the pattern of a continuous hinge: one screw every `pitch` metres, at most six."""

    def pattern(area: LeafArea) -> list[tuple[float, float]]:
        count = int(np.clip(round(2 * area.half / pitch), 2, 6))
        return [(area.s(0.55), float(t)) for t in area.half * (2 * np.arange(count) + 1 - count) / count]

    return pattern
