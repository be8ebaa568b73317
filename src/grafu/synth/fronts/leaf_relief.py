"""Leaves that are one board with a relief: bulges, panels, grooves, arches, finger channels, as a grid of heights.

What a door leaf or drawer front is: a style in an outline at a place.
"""

from collections.abc import Callable, Sequence
from functools import lru_cache
from math import atan
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.sweep import sheet
from grafu.shapes import Float
from grafu.synth.fronts.hold import Grip
from grafu.synth.fronts.layout import LeafStyle, Rect, Side

FRAME = 0.065  # metres: how wide the stiles and rails of framed leaves are; at most a quarter of a side


@final
@dataclass(frozen=True, slots=True)
class LeafShape:
    """A leaf in its place, metres: its outline, the y of its outer face, its thickness; `free` is opposite the hinge.

    `grip_side` is the edge that its grip is cut into, `grip_along` its position as a fraction of that edge.
    """

    style: LeafStyle
    rect: Rect
    front: float
    thickness: float
    free: Side = "top"
    grip: Grip = "none"
    grip_side: Side = "top"
    grip_along: float = 0.5

    @property
    def box(self) -> Box:
        """The board that the leaf is made of."""
        r = self.rect
        return Box(vec3(r.x0, self.front, r.z0), vec3(r.x1, self.front + self.thickness, r.z1))

    @property
    def frame(self) -> float:
        """The width of its stiles and rails, if it has some."""
        return min(FRAME, self.rect.width / 4, self.rect.height / 4)

    @property
    def rise(self) -> float:
        """How much lower its upper edge is at its ends than at its highest point: 0 but for arched outlines."""
        ratio = {"arched": 0.16, "half arched": 0.25}.get(self.style, 0.0)
        return min(ratio * self.rect.width, 0.15 * self.rect.height)


Grid = Float[np.ndarray, "n m"]
Line = Float[np.ndarray, "_"]

BOW = 0.03  # metres that a bowed leaf bulges, at most a twelfth of its width
SWEEP = 0.06  # metres that one leaf of a bowed pair comes forward, at most a seventh: 49182 has 58 mm over 388 mm
PLANK = 0.095  # metres a plank
LIP_END = 0.03  # metres from a door's hinge side to a lip on its upper or lower edge
STEP = 0.0006  # metres that an upright step of the relief is wide: a grid has no overhangs


@final
@dataclass(frozen=True, eq=False, slots=True)
class LeafRelief:
    """A board as a grid, columns from left to right by rows from bottom to top, metres.

    `x` and `back` have a value for each column, `z` and `front` (the y of the outer face) one for each point.
    """

    x: Line
    z: Grid
    front: Grid
    back: Line

    @property
    def mesh(self) -> TriangleMesh:
        """The board, closed, outward."""
        x, back = (np.broadcast_to(line[:, None], self.z.shape) for line in (self.x, self.back))
        return sheet(np.stack([x, self.front, self.z], axis=-1), np.stack([x, back, self.z], axis=-1))

    def face_at(self, x: float, z: float) -> float:
        """Returns the y of the outer face at a point of the front (of the nearest one, outside it)."""
        k = int(np.clip(np.searchsorted(self.x, x) - 1, 0, len(self.x) - 2))
        ratio = float(np.clip((x - self.x[k]) / (self.x[k + 1] - self.x[k]), 0.0, 1.0))
        left, right = (float(np.interp(z, self.z[i], self.front[i])) for i in (k, k + 1))
        return left + ratio * (right - left)


@lru_cache(128)
def relief_of(leaf: LeafShape) -> LeafRelief | None:
    """Returns the relief of a leaf (none, if its style has frames and panes, or is a plain board)."""
    if leaf.grip in _GRIPS:
        return _gripped(leaf, *_GRIPS[leaf.grip])
    return _RELIEFS[leaf.style](leaf) if leaf.style in _RELIEFS else None


def _flat(leaf: LeafShape, x: Sequence[float] | Line, z: Sequence[float] | Line, depth: Grid) -> LeafRelief:
    """Returns a board of the leaf's thickness, its outer face `depth` metres behind the front's plane."""
    columns = np.asarray(x, dtype=np.float64)
    rows = np.broadcast_to(np.asarray(z, dtype=np.float64), (len(columns), len(z)))
    return LeafRelief(columns, rows, leaf.front + depth, np.full(len(columns), leaf.front + leaf.thickness))


def _curved(relief: LeafRelief, leaf: LeafShape) -> LeafRelief:
    """Returns the relief on a board that comes forward: in the middle, or towards the free side."""
    u = (relief.x - leaf.rect.x0) / leaf.rect.width
    if leaf.style == "bowed":
        out = min(BOW, leaf.rect.width / 12) * (1 - (2 * u - 1) ** 2)
    else:
        v = u if leaf.free == "right" else 1 - u
        out = swept_depth(leaf.rect.width) * (1 - (1 - v) ** 2)
    return LeafRelief(relief.x, relief.z, relief.front - out[:, None], relief.back - out)


def swept_depth(width: float) -> float:
    """Returns how far the free side of a swept leaf of this width comes forward, metres."""
    return min(SWEEP, width / 7)


def bend_at_hinge(style: LeafStyle, width: float) -> float:
    """Returns the angle between a leaf's face at its hinge and the front's plane, radians: 0 where it is flat."""
    if style == "bowed":
        return atan(4 * min(BOW, width / 12) / width)
    return atan(2 * swept_depth(width) / width) if style in ("swept", "swept frame") else 0.0


def _bent(leaf: LeafShape) -> LeafRelief:
    x = np.linspace(leaf.rect.x0, leaf.rect.x1, 13)
    return _curved(_flat(leaf, x, (leaf.rect.z0, leaf.rect.z1), np.zeros((13, 2))), leaf)


def _arched(leaf: LeafShape) -> LeafRelief:
    r, u = leaf.rect, np.linspace(0.0, 1.0, 17)
    away = {"arched": 2 * u - 1}.get(leaf.style, 1 - u if leaf.free == "right" else u)
    flat = _flat(leaf, r.x0 + u * r.width, (r.z0, r.z1), np.zeros((17, 2)))
    z = flat.z.copy()
    z[:, 1] -= leaf.rise * away**2
    return LeafRelief(flat.x, z, flat.front, flat.back)


def _planks(leaf: LeafShape) -> LeafRelief:
    r, deep = leaf.rect, min(0.004, 0.25 * leaf.thickness)
    seams = r.x0 + r.width * np.arange(1, count := int(np.clip(round(r.width / PLANK), 2, 12))) / count
    wide = min(0.003, r.width / 60)
    x = np.concatenate([[r.x0], (seams[:, None] + (-wide, 0.0, wide)).ravel(), [r.x1]])
    depth = np.concatenate([[0.0], np.tile((0.0, deep, 0.0), count - 1), [0.0]])
    return _flat(leaf, x, (r.z0, r.z1), np.column_stack([depth, depth]))


def _raised(leaf: LeafShape) -> LeafRelief:
    """Returns a frame around a field with a bevelled border."""
    deep = 0.35 * leaf.thickness
    bevel = min(0.03, 0.5 * (min(leaf.rect.width, leaf.rect.height) / 2 - leaf.frame))
    profile = (0.0, STEP, 0.004, 0.004 + bevel), (0.0, deep, deep, 0.1 * deep)
    return _panelled(leaf, 1, profile)


def _two_panels(leaf: LeafShape) -> LeafRelief:
    """Returns a frame with a rail (on wide leaves: a stile) between two sunk fields."""
    return _panelled(leaf, 2, _sunk(leaf))


def _swept_frame(leaf: LeafShape) -> LeafRelief:
    return _curved(_panelled(leaf, 1, _sunk(leaf), 9), leaf)


def _sunk(leaf: LeafShape) -> tuple[tuple[float, ...], tuple[float, ...]]:
    deep = 0.35 * leaf.thickness
    return (0.0, STEP, min(0.008, leaf.frame / 4)), (0.0, 0.6 * deep, deep)


def _panelled(
    leaf: LeafShape, fields: int, profile: tuple[tuple[float, ...], tuple[float, ...]], steps: int = 0
) -> LeafRelief:
    """Returns a board with sunk fields; `profile` gives depths at distances inwards from a field's border.

    `steps` more columns follow a curve.
    """
    r, w = leaf.rect, leaf.frame
    spans = {"x": [(r.x0 + w, r.x1 - w)], "z": [(r.z0 + w, r.z1 - w)]}
    if fields == 2:
        axis = "x" if r.width > 1.5 * r.height else "z"
        low, high = spans[axis][0]
        middle, half = low + 0.42 * (high - low), min(w / 2, 0.1 * (high - low))
        spans[axis] = [(low, middle - half), (middle + half, high)]
    x = np.union1d(_lines((r.x0, r.x1), spans["x"], profile[0]), np.linspace(r.x0, r.x1, steps) if steps else [])
    z = _lines((r.z0, r.z1), spans["z"], profile[0])
    inside = np.minimum(_inside(x, spans["x"])[:, None], _inside(z, spans["z"]))
    return _flat(leaf, x, z, np.interp(inside, *profile))


def _lines(ends: tuple[float, float], spans: Sequence[tuple[float, float]], steps: Sequence[float]) -> Line:
    inner = [v for low, high in spans for step in steps for v in (low + step, high - step)]
    return np.array(sorted({*ends, *inner}))


def _inside(at: Line, spans: Sequence[tuple[float, float]]) -> Line:
    """Returns how far inside the nearest field each coordinate is, negative outside."""
    return np.max([np.minimum(at - low, high - at) for low, high in spans], axis=0)


def _gripped(leaf: LeafShape, distances: Sequence[float], depths: Sequence[float]) -> LeafRelief:
    """Returns a slab whose face has a profile of depths (fractions of the thickness) from the grip's edge inwards."""
    r, side = leaf.rect, leaf.grip_side
    upright = side in ("left", "right")
    low, high = (r.x0, r.x1) if upright else (r.z0, r.z1)
    scale = min(1.0, 0.5 * (high - low) / distances[-1])
    inwards = np.array([*(scale * np.asarray(distances)), high - low])
    depth = leaf.thickness * np.array([*depths, depths[-1]])
    at, depth = (low + inwards, depth) if side in ("left", "bottom") else (high - inwards[::-1], depth[::-1])
    if upright:
        return _flat(leaf, at, (r.z0, r.z1), np.column_stack([depth, depth]))
    if leaf.grip == "lip" and leaf.free in ("left", "right"):
        return _short_lip(leaf, at, depth)
    return _flat(leaf, (r.x0, r.x1), at, np.stack([depth, depth]))


def _short_lip(leaf: LeafShape, at: Line, depth: Line) -> LeafRelief:
    """Returns a leaf whose lip ends before its hinge: there it would strike the case as the door opens."""
    r, end = leaf.rect, min(LIP_END, leaf.rect.width / 6)
    x, ratios = np.array([r.x0, r.x0 + end, r.x0 + end + STEP, r.x1]), np.array([0.0, 0.0, 1.0, 1.0])
    if leaf.free == "left":
        x, ratios = r.x0 + r.x1 - x[::-1], ratios[::-1]
    return _flat(leaf, x, at, ratios[:, None] * depth)


# A channel of 20 mm for the fingers; a lip of 10 mm that stands 0.8 of the thickness before the front.
_GRIPS: dict[str, tuple[tuple[float, ...], tuple[float, ...]]] = {
    "edge channel": ((0.0, 0.02, 0.032), (0.65, 0.65, 0.0)),
    "lip": ((0.0, 0.01, 0.01 + STEP), (-0.8, -0.8, 0.0)),
}
_RELIEFS: dict[str, Callable[[LeafShape], LeafRelief]] = {
    "bowed": _bent,
    "swept": _bent,
    "swept frame": _swept_frame,
    "arched": _arched,
    "half arched": _arched,
    "planks": _planks,
    "raised panel": _raised,
    "two panels": _two_panels,
}
