"""Hinge pins and what ends them: flat heads, ball tips, acorn finials. It knows no leaves."""

from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.geometry.mesh import TriangleMesh
from grafu.templates.solids import turned
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
