"""Legs and feet: square, tapered, round, turned, splayed, hairpin, cabriole, on casters."""

from collections.abc import Callable
from typing import Literal, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.sweep import loft
from grafu.synth.pieces.shapes import board, rod, turned

LegShape = Literal[
    "square", "tapered", "round", "cone", "turned", "splayed", "hairpin", "cabriole", "block", "bun", "caster", "pad"
]
# (fraction of the height from the floor, fraction of the leg's half width)
BALUSTER = ((0.0, 0.45), (0.04, 0.62), (0.10, 0.5), (0.14, 0.8), (0.19, 0.5), (0.5, 0.72), (0.66, 0.98), (0.7, 0.6))
BUN = ((0.0, 0.55), (0.2, 0.9), (0.5, 1.0), (0.8, 0.85), (0.9, 0.6), (1.0, 0.6))
STRAIGHT = 0.8  # fraction of a tapered leg's height at which its straight block begins
CABRIOLE = (
    (0.0, 0.9, 0.55),
    (0.05, 1.1, 0.5),
    (0.15, 0.75, 0.32),
    (0.4, 0.3, 0.4),
    (0.75, 0.35, 0.75),
    (1.0, 0.0, 1.0),
)


@final
@dataclass(frozen=True, slots=True)
class Leg:
    """The look of a leg, metres: as wide as `thick` at its top; tapered and splayed legs end in `foot` of it.

    Raises:
        ValueError: if `thick` or `foot` is not above 0.
    """

    shape: LegShape = "round"
    thick: float = 0.044
    foot: float = 0.6
    slant: float = 0.12  # how far a splayed leg leaves the plumb line, fraction of its height

    def __post_init__(self) -> None:
        if min(self.thick, self.foot) <= 0:
            raise ValueError(f"`Leg` must have a thickness and a foot above 0: got {self.thick}, {self.foot}")


def leg_meshes(leg: Leg, at: tuple[float, float], outward: tuple[float, float], high: float) -> list[TriangleMesh]:
    """Returns the solids of one leg from the floor to the height `high`, its top's middle above `at` (x, y).

    `outward` holds the signs of the directions away from the furniture's middle, in which legs lean and curve.
    """
    return _SHAPES[leg.shape](leg, vec3(*at, 0.0), vec3(*outward, 0.0), high)


def lean(leg: Leg, z: float, high: float) -> float:
    """Returns how far outwards of its top's middle a leg of this height stands at `z`, metres along x and along y."""
    ratio, h = min(max(z / high, 0.0), 1.0), leg.thick / 2
    match leg.shape:
        case "tapered":
            return h * (1 - leg.foot) * max(1 - ratio / STRAIGHT, 0.0)
        case "splayed":
            return leg.slant * high * (1 - ratio)
        case "cabriole":
            ratios, shifts, _ = zip(*CABRIOLE, strict=True)
            return h * float(np.interp(ratio, ratios, shifts))
        case _:
            return 0.0


def _square(leg: Leg, at: Vec3, _out: Vec3, high: float) -> list[TriangleMesh]:
    h = leg.thick / 2
    return [board((at[0] - h, at[1] - h, 0.0), (at[0] + h, at[1] + h, high))]


def _tapered(leg: Leg, at: Vec3, out: Vec3, high: float) -> list[TriangleMesh]:
    """Returns a leg whose inner faces run in towards the foot, below a straight block of a fifth of its height."""
    h = leg.thick / 2
    foot = at + out * h * (1 - leg.foot)
    rings = [_ring(foot, leg.foot * h, 0.0), _ring(at, h, STRAIGHT * high), _ring(at, h, high)]
    return [loft(np.stack(rings))]


def _splayed(leg: Leg, at: Vec3, out: Vec3, high: float) -> list[TriangleMesh]:
    h = leg.thick / 2
    foot = at + out * leg.slant * high
    return [loft(np.stack([_ring(foot, leg.foot * h, 0.0, 12), _ring(at, h, high, 12)]))]


def _round(leg: Leg, at: Vec3, _out: Vec3, high: float) -> list[TriangleMesh]:
    return [rod(at, at + vec3(0.0, 0.0, high), leg.thick / 2)]


def _cone(leg: Leg, at: Vec3, _out: Vec3, high: float) -> list[TriangleMesh]:
    h = leg.thick / 2
    return [turned(at, at + vec3(0.0, 0.0, high), ((0.0, leg.foot * h), (1.0, h)))]


def _profiled(profile: tuple[tuple[float, float], ...], at: Vec3, half: float, high: float) -> TriangleMesh:
    return turned(at, at + vec3(0.0, 0.0, high), tuple((ratio, half * radius) for ratio, radius in profile))


def _turned(leg: Leg, at: Vec3, _out: Vec3, high: float) -> list[TriangleMesh]:
    """Returns a baluster below a square block, which aprons and cases meet."""
    h, low = leg.thick / 2, 0.78 * high
    profile = (*BALUSTER, (0.8, 0.95), (0.9, 0.6), (1.0, 0.9))
    block = board((at[0] - h, at[1] - h, low), (at[0] + h, at[1] + h, high))
    return [_profiled(profile, at, h, low), block]


def _bun(leg: Leg, at: Vec3, _out: Vec3, high: float) -> list[TriangleMesh]:
    return [_profiled(BUN, at, leg.thick / 2, high)]


def _cabriole(leg: Leg, at: Vec3, out: Vec3, high: float) -> list[TriangleMesh]:
    """Returns a leg in a double curve, its knee and its foot outwards."""
    h = leg.thick / 2
    rings = [_ring(at + out * h * shift, h * half, ratio * high, 8) for ratio, shift, half in CABRIOLE]
    return [loft(np.stack(rings))]


def _hairpin(leg: Leg, at: Vec3, out: Vec3, high: float) -> list[TriangleMesh]:
    """Returns two bent wires that meet at the floor, under a small plate."""
    h, wire = leg.thick / 2, min(0.006, leg.thick / 5)
    foot = at + vec3(0.0, 0.0, wire) + out * 0.5 * h
    ends = [at + vec3(-out[0] * 1.5 * h, 0.0, high), at + vec3(0.0, -out[1] * 1.5 * h, high)]
    plate = board((at[0] - h, at[1] - h, high - 0.004), (at[0] + h, at[1] + h, high))
    return [*(rod(foot, end, wire, 8) for end in ends), rod(foot - vec3(0.0, 0.0, wire), foot, 1.2 * wire, 8), plate]


def _caster(leg: Leg, at: Vec3, _out: Vec3, high: float) -> list[TriangleMesh]:
    """Returns a wheel in a fork under a plate."""
    r, h = 0.38 * high, leg.thick / 2
    hub = at + vec3(0.0, 0.0, r)
    across, w = vec3(1.0, 0.0, 0.0), min(0.4 * h, 0.012)
    cheeks = [
        board((at[0] + s * w - 0.002, at[1] - 0.3 * r, 0.8 * r), (at[0] + s * w + 0.002, at[1] + 0.3 * r, high - 0.004))
        for s in (-1.0, 1.0)
    ]
    plate = board((at[0] - h, at[1] - h, high - 0.004), (at[0] + h, at[1] + h, high))
    return [rod(hub - 0.7 * w * across, hub + 0.7 * w * across, r), *cheeks, plate]


_SHAPES: dict[LegShape, Callable[[Leg, Vec3, Vec3, float], list[TriangleMesh]]] = {
    "square": _square,
    "block": _square,
    "pad": _square,
    "tapered": _tapered,
    "round": _round,
    "cone": _cone,
    "turned": _turned,
    "splayed": _splayed,
    "hairpin": _hairpin,
    "cabriole": _cabriole,
    "bun": _bun,
    "caster": _caster,
}


def _ring(center: Vec3, half: float, z: float, sides: int = 4) -> np.ndarray:
    """Returns a regular ring counter-clockwise about +Z; one of four sides is a square of that half width."""
    angles = 2 * np.pi * (np.arange(sides) + 0.5) / sides
    radius = half / np.cos(np.pi / 4) if sides == 4 else half
    return np.column_stack(
        [center[0] + radius * np.cos(angles), center[1] + radius * np.sin(angles), np.full(sides, z)]
    )
