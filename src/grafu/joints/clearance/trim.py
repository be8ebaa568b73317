"""Takes a trace off the moving part: pieces pressed back to their neighbours' faces, by at most 2 % of its side."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.budget import require_time
from grafu.geometry.components import BoxEnds, faces_of_parts, part_boxes, part_numbers
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.clearance.carve import Path, box_in
from grafu.joints.config import RealizationConfig
from grafu.joints.report import Clearance
from grafu.scene.scene import Scene


@final
@dataclass(frozen=True, slots=True)
class _Press:
    """Presses a piece's vertices back to a plane: along `axis`, everything beyond `limit` on `side` (0 low, 1 high)."""

    axis: int
    side: int
    limit: float
    depth: float


def trim(
    scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig, touching: bool = False
) -> tuple[Scene, list[Clearance]]:
    """Returns the scene with the moving part's pieces pressed back where they cut into static pieces.

    With `touching`, also where they merely touch: a drawer without any play leaves no room for rails.
    """
    part = scene.parts[path.moving]
    most = config.max_trim * box_in(path.axes, part.mesh).size
    play = 2.5 * config.depth * scene.extent
    boxes = [part_boxes(scene.parts[name].mesh, path.axes) for name in ids]
    theirs = np.concatenate([np.zeros((0, 2, 3)), *boxes])
    depth = 0.0
    surfaces = []
    for surface in part.surfaces:
        pressed, deepest = _pressed(surface, theirs, path, most, (play, 0.9 * play if touching else 0.0), config.kept)
        surfaces.append(pressed)
        depth = max(depth, deepest)
    if depth == 0.0:
        return scene, []
    trimmed: Part = replace(part, surfaces=tuple(surfaces))
    ratio = depth / float(most.max() / config.max_trim)
    why = f"{'touched' if touching else 'cut into'} {', '.join(ids)}"
    return scene.replaced([trimmed]), [Clearance(path.moving, "trimmed", depth, ratio, why)]


def _pressed(
    surface: Surface, theirs: BoxEnds, path: Path, most: np.ndarray, play: tuple[float, float], kept: float
) -> tuple[Surface, float]:
    """Returns the surface with its pieces pressed back, and by how much at most (`play`, `kept`: see `_presses`)."""
    numbers = part_numbers(surface.mesh)
    local = surface.mesh.vertices @ path.axes
    deepest = 0.0
    for faces in faces_of_parts(numbers):
        require_time()
        used = np.unique(surface.mesh.faces[faces])
        box = Box.around(local[used])
        for press in _presses(box, theirs, path, most, play, kept):
            column = local[used, press.axis]
            limit = np.maximum(column, press.limit) if press.side == 0 else np.minimum(column, press.limit)
            local[used, press.axis] = limit
            deepest = max(deepest, press.depth)
    if deepest == 0.0:
        return surface, 0.0
    mesh = TriangleMesh(local @ path.axes.T, surface.mesh.faces)
    return replace(surface, mesh=mesh), deepest


def _presses(
    box: Box, theirs: BoxEnds, path: Path, most: np.ndarray, play: tuple[float, float], kept: float
) -> list[_Press]:
    """Returns how a piece must be pressed so that it clears the static pieces that it cuts into a little.

    `play` is what it gets, and up to which gap it counts as cutting in; `kept` the fraction of
    its thickness that it keeps at least.
    """
    swept = _swept(box, path)
    depths = np.stack([theirs[:, 1] - swept.low, swept.high - theirs[:, 0]], axis=1)
    found: list[_Press] = []
    for both in depths[(depths > -play[1]).all(axis=(1, 2))]:
        side, axis = (int(i) for i in np.unravel_index(int(np.argmin(both)), both.shape))
        depth = float(both[side, axis]) + play[0]
        if depth <= most[axis] and depth <= (1 - kept) * box.size[axis]:
            limit = float(swept.low[axis] + depth) if side == 0 else float(swept.high[axis] - depth)
            found.append(_Press(axis, side, limit, depth))
    return found


def _swept(box: Box, path: Path) -> Box:
    """Returns the box of a sliding piece's whole path (of a turning piece: its rest box)."""
    if path.is_turn:
        return box
    shift = (path.motion(path.reach)[:3, 3]) @ path.axes
    return box.union(Box(box.low + shift, box.high + shift))
