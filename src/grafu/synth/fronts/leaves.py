"""Door leaves and drawer fronts in every style, and where their outer face lies. They know no hinge and no handle.

A leaf faces -Y. Its rectangle is its outline from the front; curved leaves and lips come before it. Leaves with a frame
hold a panel, a pane, a grid of bars, slats or a mirror. Grips are cut through a slab: scoops in its edge, slots, finger
holes; an outline is drawn in (u, v), u along the grip's edge from its lower or left end, v inwards from the edge, in
metres. Channels and lips are reliefs, see `leaf_relief`.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache

import numpy as np
from shapely.geometry import Polygon

from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.shapes import Float
from grafu.synth.fronts.layout import Rect
from grafu.synth.fronts.leaf_relief import LeafShape, relief_of
from grafu.synth.pieces.finish import Finish, surface_of
from grafu.synth.pieces.shapes import arched_rail, board, chamfered_board, framed_opening, rounded_board
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


MIRROR = Material("mirror", (0.93, 0.94, 0.95, 1.0), metallic=1.0, roughness=0.03)
PANE = 0.15  # of the leaf's thickness
PANEL = 0.4
MUNTIN = 0.016  # metres a bar before a pane is wide
PITCH = 0.036  # metres from slat to slat
_SLAT = np.array(
    [0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6, 0, 4, 5, 0, 5, 1, 1, 5, 6, 1, 6, 2, 2, 6, 7, 2, 7, 3, 3, 7, 4, 3, 4, 0]
)


def framed_surfaces(leaf: LeafShape, finish: Finish) -> tuple[Surface, ...]:
    """Returns the surfaces of a leaf with a frame, or of a board behind a mirror.

    Raises:
        KeyError: if the leaf's style has no frame.
    """
    return _FRAMED[leaf.style](leaf, finish)


def recess(leaf: LeafShape, x: float, z: float) -> float:
    """Returns how far behind the front's plane the face of a framed leaf lies at a point, metres."""
    r = _opening(leaf)
    if not (r.x0 < x < r.x1 and r.z0 < z < r.z1):
        return 0.0
    return {"mirror": 0.0, "louvred": 0.2, "shaker": (1 - PANEL) / 2, "arched rail": (1 - PANEL) / 2}.get(
        leaf.style, (1 - PANE) / 2
    ) * leaf.thickness


def _opening(leaf: LeafShape) -> Rect:
    r, w = leaf.rect, leaf.frame
    return Rect(r.x0 + w, r.x1 - w, r.z0 + w, r.z1 - w)


def _frame(leaf: LeafShape, finish: Finish) -> list[Surface]:
    return [surface_of(mesh, finish.front) for mesh in framed_opening(leaf.box, leaf.frame)]


def _filling(leaf: LeafShape, ratio: float, material: Material) -> Surface:
    half = leaf.box.half - vec3(leaf.frame, (1 - ratio) * leaf.box.half[1], leaf.frame)
    return surface_of(TriangleMesh.box_mesh(Box.from_center(leaf.box.center, half)), material)


def _shaker(leaf: LeafShape, finish: Finish) -> tuple[Surface, ...]:
    return (*_frame(leaf, finish), _filling(leaf, PANEL, finish.front))


def _glass(leaf: LeafShape, finish: Finish) -> tuple[Surface, ...]:
    return (*_frame(leaf, finish), _filling(leaf, PANE, finish.glass))


def _mirror(leaf: LeafShape, finish: Finish) -> tuple[Surface, ...]:
    """Returns a board whose front is a mirror up to a narrow border."""
    r, pane = leaf.rect, min(0.004, 0.25 * leaf.thickness)
    border = min(0.012, r.width / 20, r.height / 20)
    back = board((r.x0, leaf.front + pane, r.z0), (r.x1, leaf.front + leaf.thickness, r.z1))
    low, high = (r.x0 + border, leaf.front, r.z0 + border), (r.x1 - border, leaf.front + pane, r.z1 - border)
    return surface_of(back, finish.front), surface_of(board(low, high), MIRROR)


def _muntins(leaf: LeafShape, finish: Finish) -> tuple[Surface, ...]:
    """Returns a glazed frame with a grid of bars: panes of about 150 by 220 mm."""
    r, half = _opening(leaf), MUNTIN / 2
    columns, rows = int(np.clip(round(r.width / 0.15), 1, 5)), int(np.clip(round(r.height / 0.22), 2, 8))
    y0, y1 = leaf.front + 0.1 * leaf.thickness, leaf.front + 0.9 * leaf.thickness
    upright = [r.x0 + r.width * k / columns for k in range(1, columns)]
    level = [r.z0 + r.height * k / rows for k in range(1, rows)]
    bars = [board((x - half, y0, r.z0), (x + half, y1, r.z1)) for x in upright]
    inner = 0.05 * leaf.thickness  # level bars are a little thinner: no two faces lie in one plane
    bars += [board((r.x0, y0 + inner, z - half), (r.x1, y1 - inner, z + half)) for z in level]
    return (*_glass(leaf, finish), *(surface_of(bar, finish.front) for bar in bars))


def _louvred(leaf: LeafShape, finish: Finish) -> tuple[Surface, ...]:
    """Returns a frame with slanting slats, all of them one mesh."""
    r, t = _opening(leaf), leaf.thickness
    count = int(np.clip(round(r.height / PITCH), 3, 22))
    pitch = r.height / count
    thick, rise = 0.18 * pitch, 0.8 * pitch
    outer, inner = leaf.front + 0.1 * t, leaf.front + 0.9 * t
    section = np.array([(outer, 0.0), (outer, thick), (inner, thick + rise), (inner, rise)])
    ends = [np.column_stack([np.full(4, x), section]) for x in (r.x0, r.x1)]
    starts = r.z0 + pitch * np.arange(count)
    slats = np.vstack(ends) + np.column_stack([np.zeros((count, 2)), starts])[:, None]
    faces = _SLAT.reshape(-1, 3) + 8 * np.arange(count)[:, None, None]
    mesh = TriangleMesh(slats.reshape(-1, 3), faces.reshape(-1, 3))
    return (*_frame(leaf, finish), surface_of(mesh, finish.front))


def _arched_rail(leaf: LeafShape, finish: Finish) -> tuple[Surface, ...]:
    """Returns a framed panel whose upper rail is cut out in an arch."""
    r, w = _opening(leaf), leaf.frame
    rise = min(0.25 * r.width, 0.15 * r.height, 0.08)
    *rest, _ = framed_opening(leaf.box, w)
    y0, y1 = leaf.front, leaf.front + leaf.thickness
    top = arched_rail(Box(vec3(r.x0, y0, r.z1 - rise), vec3(r.x1, y1, leaf.rect.z1)), rise)
    return (*(surface_of(m, finish.front) for m in (*rest, top)), _filling(leaf, PANEL, finish.front))


_FRAMED: dict[str, Callable[[LeafShape, Finish], tuple[Surface, ...]]] = {
    "shaker": _shaker,
    "glass": _glass,
    "mirror": _mirror,
    "muntins": _muntins,
    "louvred": _louvred,
    "arched rail": _arched_rail,
}


_CUT = ("scoop", "slot", "finger hole")


def leaf_surfaces(leaf: LeafShape, finish: Finish) -> tuple[Surface, ...]:
    """Returns the surfaces of a leaf; each is closed."""
    relief = relief_of(leaf)
    if relief is not None:
        return (surface_of(relief.mesh, finish.front),)
    if leaf.style in _BOARDS:
        mesh = gripped_slab(leaf) if leaf.grip in _CUT else _BOARDS[leaf.style](leaf)
        return (surface_of(mesh, finish.front),)
    return framed_surfaces(leaf, finish)


def face_at(leaf: LeafShape, x: float, z: float) -> float:
    """Returns the y of the leaf's outer face at a point of the front."""
    relief = relief_of(leaf)
    if relief is not None:
        return relief.face_at(x, z)
    return leaf.front + (0.0 if leaf.style in _BOARDS else recess(leaf, x, z))


def filled_rect(leaf: LeafShape) -> Rect:
    """Returns the part of the leaf's outline that it fills whatever its style: not the corners beside an arch."""
    return replace(leaf.rect, z1=leaf.rect.z1 - leaf.rise)


def _softening(leaf: LeafShape) -> float:
    return min(0.4 * leaf.thickness, leaf.rect.width / 8, leaf.rect.height / 8)


_BOARDS: dict[str, Callable[[LeafShape], TriangleMesh]] = {
    "slab": lambda leaf: TriangleMesh.box_mesh(leaf.box),
    "chamfered": lambda leaf: chamfered_board(leaf.box, _softening(leaf)),
    "rounded": lambda leaf: rounded_board(leaf.box, _softening(leaf)),
}
