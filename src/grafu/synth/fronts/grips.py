"""Grips cut through a slab: scoops in its edge, slots, finger holes. Channels and lips are reliefs, see `leaf_relief`.

An outline is drawn in (u, v): u along the grip's edge from its lower or left end, v inwards from the edge; metres.
"""

from functools import lru_cache

import numpy as np
from jaxtyping import Float
from shapely.geometry import Polygon

from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.fronts.leaf_shape import LeafShape
from grafu.templates.solids import extrude, placed

Outline = Float[np.ndarray, "n 2"]

SCOOP = (0.045, 0.028)  # metres: half the width and the depth of a cut-out for four fingers
SLOT = (0.055, 0.012)  # metres: half the length and half the width
HOLE = 0.0175  # metres: the radius of a finger hole
FROM_EDGE = 0.04  # metres from the edge to the middle of a slot or hole


@lru_cache(64)
def gripped_slab(leaf: LeafShape) -> TriangleMesh:
    """Returns the slab of a leaf with its scoop, slot or finger hole.

    Raises:
        ValueError: if the leaf has none of these.
    """
    r, upright = leaf.rect, leaf.grip_side in ("left", "right")
    length, depth = (r.height, r.width) if upright else (r.width, r.height)
    border = np.array([(0.0, 0.0), (length, 0.0), (length, depth), (0.0, depth)])
    if leaf.grip == "scoop":
        border = np.vstack([border[:1], _scoop(length, depth, leaf.grip_along), border[1:]])
        shape = Polygon(_on_front(leaf, border))
    elif leaf.grip in ("slot", "finger hole"):
        half = SLOT if leaf.grip == "slot" else (HOLE, HOLE)
        shape = Polygon(_on_front(leaf, border), [_on_front(leaf, _hole(length, depth, leaf.grip_along, half))])
    else:
        raise ValueError(f"`leaf` must have a scoop, slot or finger hole: got {leaf.grip}")
    solid = extrude(shape, -leaf.front - leaf.thickness, -leaf.front)
    return placed(solid, vec3(1.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0), vec3(0.0, -1.0, 0.0))


def _scoop(length: float, depth: float, along: float) -> Outline:
    wide, deep = min(SCOOP[0], 0.3 * length), min(SCOOP[1], 0.3 * depth)
    middle = _between(along * length, 1.2 * wide, length)
    angles = np.linspace(0.0, np.pi, 13)
    return np.column_stack([middle - wide * np.cos(angles), deep * np.sin(angles)])


def _hole(length: float, depth: float, along: float, half: tuple[float, float]) -> Outline:
    """Returns a slot with round ends, as long as it is wide a circle."""
    across = min(half[1], depth / 8, length / 8)
    straight = min(half[0], 0.3 * length) - across if half[0] > half[1] else 0.0
    middle = _between(along * length, 1.5 * across + max(straight, 0.0), length)
    angles = np.pi * np.arange(7) / 6
    arc = across * np.column_stack([np.sin(angles), -np.cos(angles)])
    ends = np.array([max(straight, 0.0), 0.0])
    round_hole = np.vstack([arc + ends, -arc - ends]) if straight > 0 else np.vstack([arc[:-1], -arc[:-1]])
    return round_hole + np.array([middle, min(FROM_EDGE, depth / 4)])


def _between(middle: float, room: float, length: float) -> float:
    return min(max(middle, room), length - room) if 2 * room < length else length / 2


def _on_front(leaf: LeafShape, outline: Outline) -> Outline:
    """Returns an outline's points as (x, z)."""
    r, (u, v) = leaf.rect, outline.T
    x, z = {
        "left": (r.x0 + v, r.z0 + u),
        "right": (r.x1 - v, r.z0 + u),
        "bottom": (r.x0 + u, r.z0 + v),
        "top": (r.x0 + u, r.z1 - v),
    }[leaf.grip_side]
    return np.column_stack([x, z])
