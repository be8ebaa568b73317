"""Leaves with a frame around something: a panel, a pane, a grid of bars, slats, a mirror. It cuts no reliefs."""

from collections.abc import Callable

import numpy as np

from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.fronts.layout import Rect
from grafu.synth.fronts.leaf_shape import LeafShape
from grafu.synth.pieces.finish import Finish, surface_of
from grafu.synth.pieces.shapes import arched_rail, board, framed_opening

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


def _filling(leaf: LeafShape, share: float, material: Material) -> Surface:
    half = leaf.box.half - vec3(leaf.frame, (1 - share) * leaf.box.half[1], leaf.frame)
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
