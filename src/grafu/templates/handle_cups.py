"""The shapes of cup handles: hollow shells on the front, open below for the fingers. Frame: see `handle`."""

from functools import lru_cache

import numpy as np

from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.sweep import Rings, sheet

Meshes = tuple[TriangleMesh, ...]
_CACHED = 128  # shapes kept per style: a piece of furniture repeats a few sizes
_WALL = 0.002  # metres of metal
_END = 0.04  # radians short of the shell's ends, where it would be a point


@lru_cache(_CACHED)
def shell(length: float, protrusion: float) -> Meshes:
    """Returns a half dome."""
    return _cup((length, protrusion, min(0.42 * length, 0.04)), 2.0, 1.0)


@lru_cache(_CACHED)
def square_cup(length: float, protrusion: float) -> Meshes:
    """Returns a box-like cup with rounded edges."""
    return _cup((length, protrusion, min(0.4 * length, 0.03)), 8.0, 0.3)


@lru_cache(_CACHED)
def slim_cup(length: float, protrusion: float) -> Meshes:
    """Returns a long, low cup with a round back and straight ends."""
    return _cup((length, protrusion, min(0.2 * length, 0.02)), 16.0, 0.7)


def _cup(size: tuple[float, float, float], fullness: float, roundness: float) -> Meshes:
    """Returns a shell of a length, protrusion and height.

    Along x its sections shrink as a superellipse of exponent `fullness` (2: an ellipse); `roundness` is the exponent of
    its sections' sine and cosine (1: round, towards 0: boxy).
    """
    inner = tuple(max(side - 2 * _WALL if k == 0 else side - _WALL, 0.5 * side) for k, side in enumerate(size))
    outer_grid, inner_grid = (_grid(s, fullness, roundness) for s in (size, (inner[0], inner[1], inner[2])))
    rise = np.array([0.0, 0.0, size[2] / 2])
    return (sheet(outer_grid - rise, inner_grid - rise),)


def _grid(size: tuple[float, float, float], fullness: float, roundness: float) -> Rings:
    """Returns points on the shell, stations from right to left by steps from its foot above to its lip below."""
    along, round_ = np.linspace(_END, np.pi - _END, 13), np.linspace(0.0, np.pi / 2, 6)
    share = np.cos(along) / np.cos(_END)
    narrowing = (1 - np.abs(np.cos(along)) ** fullness) ** (1 / fullness)
    out, up = np.sin(round_) ** roundness, np.maximum(np.cos(round_), 0.0) ** roundness
    up[-1] = 0.0  # the cosine of a right angle is not quite nothing
    grid = np.empty((13, 6, 3))
    grid[..., 0] = (size[0] / 2 * share)[:, None]
    grid[..., 1] = -size[1] * narrowing[:, None] * out
    grid[..., 2] = size[2] * narrowing[:, None] * up
    return grid
