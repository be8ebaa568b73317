"""The shapes of knobs and rings: turned ones from a table of profiles, square ones, rings. Frame: see `handle`."""

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.sweep import chamfered_rectangle, circle, loft, swept
from grafu.templates.solids import placed, turned

Meshes = tuple[TriangleMesh, ...]
_CACHED = 128  # shapes kept per style: a piece of furniture repeats a few sizes
_SIDES = 16
_X, _Y, _Z = vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)

# Profiles from the foot outwards: shares of the greatest radius and of the protrusion.
ROUND = ((0.45, 0.0), (0.38, 0.3), (0.62, 0.42), (0.92, 0.55), (1.0, 0.7), (0.9, 0.86), (0.6, 0.97), (0.0, 1.0))
FLAT = ((0.35, 0.0), (0.35, 0.62), (0.94, 0.62), (1.0, 0.68), (1.0, 0.94), (0.94, 1.0), (0.0, 1.0))
MUSHROOM = ((0.5, 0.0), (0.32, 0.15), (0.32, 0.5), (0.9, 0.56), (1.0, 0.64), (0.86, 0.84), (0.5, 0.96), (0.0, 1.0))
CONE = ((0.4, 0.0), (0.95, 0.92), (1.0, 0.95), (0.95, 1.0), (0.0, 1.0))
TURNED = (
    (0.9, 0.0), (0.9, 0.07), (0.45, 0.12), (0.36, 0.32), (0.52, 0.4), (0.36, 0.48), (0.85, 0.62), (1.0, 0.75),
    (0.8, 0.9), (0.3, 0.95), (0.22, 1.0), (0.0, 1.0),
)  # fmt: skip


def knob(profile: tuple[tuple[float, float], ...]) -> Callable[[float, float], Meshes]:
    """Returns the shape of a turned knob; its length is its diameter."""

    @lru_cache(_CACHED)
    def shape(length: float, protrusion: float) -> Meshes:
        rows = [(0.0, 0.0), *((radius * length / 2, share * protrusion) for radius, share in profile)]
        return (placed(turned(rows, _SIDES), _X, _Z, -_Y),)

    return shape


@lru_cache(_CACHED)
def square_knob(length: float, protrusion: float) -> Meshes:
    """Returns a square knob with bevelled edges on a square stem."""
    steps = ((0.45, 0.0), (0.45, 0.45), (0.95, 0.45), (1.0, 0.5), (1.0, 0.92), (0.9, 1.0))
    rings = []
    for share, out in steps:
        half = share * length / 2
        flat = chamfered_rectangle((half, half), 0.1 * half)
        rings.append(np.column_stack([flat[:, 0], np.full(8, -out * protrusion), flat[:, 1]]))
    return (loft(np.stack(rings)),)


@lru_cache(_CACHED)
def ring(length: float, protrusion: float) -> Meshes:
    """Returns a ring that hangs from a boss on a rosette; the foot plane's origin is the ring's middle."""
    thickness = min(0.003, protrusion / 4, length / 10)
    radius = length / 2 - thickness / np.cos(np.pi / 16)  # a mitred ring stands out at its 16 corners
    angles = 2 * np.pi * np.arange(16) / 16
    path = radius * np.column_stack([np.cos(angles), np.zeros(16), np.sin(angles)])
    hoop = swept(path, circle(thickness, 8), -_Y, closed=True).translated(vec3(0.0, thickness - protrusion, 0.0))
    wide = 0.32 * length
    steps = (1.0, 0.0), (1.0, 0.12), (0.5, 0.25), (0.4, 1.0), (0.0, 1.0)
    boss = [(0.0, 0.0), *((share * wide, out * protrusion) for share, out in steps)]
    return (placed(turned(boss, 12), _X, _Z, -_Y).translated(vec3(0.0, 0.0, length / 2 - thickness)), hoop)
