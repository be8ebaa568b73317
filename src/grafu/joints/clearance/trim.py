"""Takes a trace off the moving part: pieces pressed back to their neighbours' faces, by at most 2 % of its side.

Pieces that the front of a drawer hides may lose more: lower or narrower sides are not seen.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Scalars
from grafu.geometry.box import Box
from grafu.geometry.budget import require_time
from grafu.geometry.components import BoxEnds, faces_of_parts, part_boxes, part_numbers
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.clearance.carve import Path, box_in
from grafu.joints.config import RealizationConfig
from grafu.joints.report import Clearance
from grafu.scene.scale import metre_on
from grafu.scene.scene import Scene


@final
@dataclass(frozen=True, slots=True)
class _Press:
    """Presses a piece's vertices back to a plane: along `axis`, everything beyond `limit` on `side` (0 low, 1 high)."""

    axis: int
    side: int
    limit: float
    depth: float


@final
@dataclass(frozen=True, slots=True)
class _Front:
    """Where a drawer's front ends: at `plane` along its own axis `axis`, which it opens along (`sign`)."""

    axis: int
    sign: float
    plane: float


@final
@dataclass(frozen=True, eq=False, slots=True)
class _Limits:
    """By how much pieces may be pressed along each axis, in metres, and the fraction of thickness that they keep.

    Pieces are `hidden` that end at least `behind` metres behind the outer face of the front.
    """

    most: Scalars
    hidden: Scalars
    front: _Front | None
    behind: float
    kept: float

    def of(self, box: Box) -> Scalars:
        """Returns the limits of a piece: those of hidden ones where it lies behind the front's outer face."""
        if self.front is None:
            return self.most
        ends = box.high if self.front.sign > 0 else -box.low
        gap = self.front.plane - float(ends[self.front.axis])
        return self.hidden if gap >= self.behind else self.most


def _front_of(whole: Box, path: Path) -> _Front | None:
    """Returns the front of what slides; None for what turns: all of it is seen."""
    if path.is_turn:
        return None
    shift = path.motion(path.reach)[:3, 3] @ path.axes
    axis = int(np.argmax(np.abs(shift)))
    sign = float(np.sign(shift[axis]))
    return _Front(axis, sign, float((whole.high if sign > 0 else -whole.low)[axis]))


def trim(
    scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig, touching: bool = False
) -> tuple[Scene, list[Clearance]]:
    """Returns the scene with the moving part's pieces pressed back where they cut into static pieces.

    With `touching`, also where they merely touch: a drawer without any play leaves no room for rails.
    """
    part = scene.parts[path.moving]
    whole = box_in(path.axes, part.mesh)
    most = config.max_trim * whole.size
    metre = metre_on(scene.extent)
    hidden = np.maximum(most, config.max_hidden_trim * metre)
    limits = _Limits(most, hidden, _front_of(whole, path), config.thinnest_front * metre, config.kept)
    play = 2.5 * config.depth * scene.extent
    boxes = [part_boxes(scene.parts[name].mesh, path.axes) for name in ids]
    theirs = np.concatenate([np.zeros((0, 2, 3)), *boxes])
    depth = 0.0
    surfaces = []
    for surface in part.surfaces:
        pressed, deepest = _pressed(surface, theirs, path, limits, (play, 0.9 * play if touching else 0.0))
        surfaces.append(pressed)
        depth = max(depth, deepest)
    if depth == 0.0:
        return scene, []
    trimmed: Part = replace(part, surfaces=tuple(surfaces))
    ratio = depth / float(most.max() / config.max_trim)
    why = f"{'touched' if touching else 'cut into'} {', '.join(ids)}"
    return scene.replaced([trimmed]), [Clearance(path.moving, "trimmed", depth, ratio, why)]


def _pressed(
    surface: Surface, theirs: BoxEnds, path: Path, limits: _Limits, play: tuple[float, float]
) -> tuple[Surface, float]:
    """Returns the surface with its pieces pressed back, and by how much at most (`play`: see `_presses`)."""
    numbers = part_numbers(surface.mesh)
    local = surface.mesh.vertices @ path.axes
    deepest = 0.0
    for faces in faces_of_parts(numbers):
        require_time()
        used = np.unique(surface.mesh.faces[faces])
        box = Box.around(local[used])
        for press in _presses(box, theirs, path, limits, play):
            column = local[used, press.axis]
            limit = np.maximum(column, press.limit) if press.side == 0 else np.minimum(column, press.limit)
            local[used, press.axis] = limit
            deepest = max(deepest, press.depth)
    if deepest == 0.0:
        return surface, 0.0
    mesh = TriangleMesh(local @ path.axes.T, surface.mesh.faces)
    return replace(surface, mesh=mesh), deepest


def _presses(box: Box, theirs: BoxEnds, path: Path, limits: _Limits, play: tuple[float, float]) -> list[_Press]:
    """Returns how a piece must be pressed so that it clears the static pieces that it cuts into a little.

    `play` is what it gets, and up to which gap it counts as cutting in.
    """
    most = limits.of(box)
    swept = _swept(box, path)
    depths = np.stack([theirs[:, 1] - swept.low, swept.high - theirs[:, 0]], axis=1)
    found: list[_Press] = []
    for both in depths[(depths > -play[1]).all(axis=(1, 2))]:
        side, axis = (int(i) for i in np.unravel_index(int(np.argmin(both)), both.shape))
        depth = float(both[side, axis]) + play[0]
        if depth <= most[axis] and depth <= (1 - limits.kept) * box.size[axis]:
            limit = float(swept.low[axis] + depth) if side == 0 else float(swept.high[axis] - depth)
            found.append(_Press(axis, side, limit, depth))
    return found


def _swept(box: Box, path: Path) -> Box:
    """Returns the box of a sliding piece's whole path (of a turning piece: its rest box)."""
    if path.is_turn:
        return box
    shift = (path.motion(path.reach)[:3, 3]) @ path.axes
    return box.union(Box(box.low + shift, box.high + shift))
