"""Takes a trace off the moving part: pieces pressed back to their neighbours' faces, by at most 2 % of its side.

What the front of a drawer hides may lose more: lower or narrower sides are not seen. Where front and sides are one
piece, the two are pressed back apart from each other.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Points, Scalars, distinct
from grafu.geometry.box import Box
from grafu.geometry.budget import require_time
from grafu.geometry.components import BoxEnds, faces_of_parts, part_boxes, part_numbers
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import transform_points
from grafu.joints.clearance.carve import Path, box_in
from grafu.joints.config import RealizationConfig
from grafu.joints.report import Clearance
from grafu.scene.scene import Scene
from grafu.shapes import Bool, Int

_FIRST_STEP = 0.02  # of an opening: where a door has left what it closes
_ON_BACK = 1e-4  # metres: how near the back of a front a vertex lies on it


@final
@dataclass(frozen=True, slots=True)
class _Press:
    """Presses a piece's vertices back to a plane: along `axis`, everything beyond `limit` on `side` (0 low, 1 high).

    A board that would be pressed flat `moves` instead, by `depth`.
    """

    axis: int
    side: int
    limit: float
    depth: float
    moves: bool

    def applied(self, column: Scalars) -> Scalars:
        """Returns the vertices' coordinates along the axis, pressed."""
        if self.moves:
            return column + (self.depth if self.side == 0 else -self.depth)
        return np.maximum(column, self.limit) if self.side == 0 else np.minimum(column, self.limit)


@final
@dataclass(frozen=True, slots=True)
class DrawerFront:
    """Where a drawer's front ends: at `plane` along its own axis `axis`, which it opens along (`sign`).

    Behind `back`, a coordinate like `plane`, the drawer is narrower or lower than its front: there, all of it lies in
    the box `body`. None if front and drawer are of one cross-section.
    """

    axis: int
    sign: float
    plane: float
    back: float | None
    body: Box

    def sections(self, points: Points) -> list[Bool[np.ndarray, " n"]]:
        """Returns which points are of the front, and which of what it hides; those where both meet are of both."""
        if self.back is None:
            return [np.ones(len(points), dtype=bool)]
        gap = self.back - self.sign * points[:, self.axis]
        across = [k for k in range(3) if k != self.axis]
        low, high = self.body.low[across] - _ON_BACK, self.body.high[across] + _ON_BACK
        inside = ((points[:, across] >= low) & (points[:, across] <= high)).all(axis=1)
        return [gap <= _ON_BACK, (gap > _ON_BACK) | ((gap > -_ON_BACK) & inside)]


@final
@dataclass(frozen=True, eq=False, slots=True)
class _Limits:
    """By how much pieces may be pressed along each axis, in metres, and the fraction of thickness that they keep.

    Pieces are `hidden` that end at least `behind` metres behind the outer face of the front. The `back` of a door, an
    axis and a side as in `_Press`, lies on what it closes, and may be pressed by `most_at_back` metres.
    """

    most: Scalars
    hidden: Scalars
    front: DrawerFront | None
    back: tuple[int, int] | None
    most_at_back: float
    behind: float
    kept: float

    def at(self, axis: int, side: int, is_hidden: bool) -> float:
        """Returns by how much a piece may be pressed along an axis, from one side."""
        most = float((self.hidden if is_hidden else self.most)[axis])
        return max(most, self.most_at_back) if (axis, side) == self.back else most

    def hides(self, box: Box) -> bool:
        """Whether a piece lies behind the front's outer face."""
        if self.front is None:
            return False
        ends = box.high if self.front.sign > 0 else -box.low
        return self.front.plane - float(ends[self.front.axis]) >= self.behind


def drawer_front(points: Points, path: Path, step: float) -> DrawerFront | None:
    """Returns the front of what slides; None for what turns: all of it is seen.

    `points` are the part's vertices in its own axes; from `step` metres on, what is narrower is narrower. What is
    shorter than that is a bevel at the far end, and no box.
    """
    if path.is_turn:
        return None
    axis = path.slide_axis
    sign = float(np.sign(path.shift[axis]))
    along = sign * points[:, axis]
    order = np.argsort(along)
    low, high = np.minimum.accumulate(points[order]), np.maximum.accumulate(points[order])
    across = [k for k in range(3) if k != axis]
    margins = np.concatenate([low - low[-1], high[-1] - high], axis=1)[:, [*across, *(3 + k for k in across)]]
    count = int(np.count_nonzero(margins.max(axis=1) >= step))  # the margins only shrink from the back to the front
    plane = float(along.max())
    back = float(along[order[min(count, len(order) - 1)]])
    is_body = along < back - _ON_BACK
    if not is_body.any() or back - float(along.min()) < step:
        return DrawerFront(axis, sign, plane, None, Box.around(points))
    return DrawerFront(axis, sign, plane, back, Box.around(points[is_body]))


def _back_of(part: Part, path: Path) -> tuple[int, int] | None:
    """Returns the axis and the side of a door's back: that from which it moves away; None for what slides."""
    if not path.is_turn:
        return None
    box = box_in(path.axes, part.mesh)
    axis = int(np.argmin(box.size))
    center = path.axes @ box.center
    moved = transform_points(path.motion(_FIRST_STEP * path.reach), center[None])[0] - center
    return axis, int((moved @ path.axes)[axis] < 0)


def trim(
    scene: Scene,
    path: Path,
    ids: Sequence[str],
    config: RealizationConfig,
    touching: bool = False,
    at_back: bool = False,
) -> tuple[Scene, list[Clearance]]:
    """Returns the scene with the moving part's pieces pressed back where they cut into static pieces.

    `ids` are those of static parts, and of static hardware that is installed: the rails of a drawer right beside.
    With `touching`, also where they merely touch: a drawer without any play leaves no room for rails. With `at_back`,
    the back of a door by more than its other sides.
    """
    part = scene.parts[path.moving]
    most = config.max_trim * box_in(path.axes, part.mesh).size
    hidden = np.maximum(most, config.max_hidden_trim)
    thinnest = config.thinnest_front
    front = drawer_front(part.mesh.vertices @ path.axes, path, thinnest)
    back = _back_of(part, path) if at_back else None
    limits = _Limits(most, hidden, front, back, config.max_back_trim, thinnest, config.kept)
    play = config.clearance.play * config.depth * scene.extent
    hardware = {visual.name: visual for owner, visual in scene.hardware if not owner}
    boxes = [part_boxes((scene.parts.get(name) or hardware[name]).mesh, path.axes) for name in ids]
    theirs = np.concatenate([np.zeros((0, 2, 3)), *boxes])
    near = config.clearance.touching * play if touching else 0.0
    depth = 0.0
    surfaces = []
    for surface in part.surfaces:
        pressed, deepest = _pressed(surface, theirs, path, limits, (play, near))
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
        for used in _sections(local, distinct(surface.mesh.faces[faces]), limits):
            for press in _presses(Box.around(local[used]), theirs, path, limits, play):
                local[used, press.axis] = press.applied(local[used, press.axis])
                deepest = max(deepest, press.depth)
    if deepest == 0.0:
        return surface, 0.0
    mesh = TriangleMesh(local @ path.axes.T, surface.mesh.faces)
    return replace(surface, mesh=mesh), deepest


def _sections(local: Points, used: Int[np.ndarray, " _"], limits: _Limits) -> list[Int[np.ndarray, " _"]]:
    """Returns the vertices of a piece: together, or of a drawer's front and of what it hides, where it is of both."""
    if limits.front is None or limits.hides(Box.around(local[used])):
        return [used]
    return [used[is_of] for is_of in limits.front.sections(local[used]) if is_of.any()]


def _presses(box: Box, theirs: BoxEnds, path: Path, limits: _Limits, play: tuple[float, float]) -> list[_Press]:
    """Returns how a piece must be pressed so that it clears the static pieces that it cuts into a little.

    `play` is what it gets, and up to which gap it counts as cutting in.
    """
    is_hidden = limits.hides(box)
    swept = _swept(box, path)
    depths = np.stack([theirs[:, 1] - swept.low, swept.high - theirs[:, 0]], axis=1)
    found: list[_Press] = []
    for both in depths[(depths > -play[1]).all(axis=(1, 2))]:
        side, axis = (int(i) for i in np.unravel_index(int(np.argmin(both)), both.shape))
        depth = float(both[side, axis]) + play[0]
        moves = bool(depth > (1 - limits.kept) * box.size[axis])
        if depth <= limits.at(axis, side, is_hidden) and (is_hidden or not moves):
            limit = float(swept.low[axis] + depth) if side == 0 else float(swept.high[axis] - depth)
            found.append(_Press(axis, side, limit, depth, moves))
    deepest = {(press.axis, press.side): press for press in sorted(found, key=lambda press: press.depth)}
    return list(deepest.values())


def _swept(box: Box, path: Path) -> Box:
    """Returns the box of a sliding piece's whole path (of a turning piece: its rest box)."""
    if path.is_turn:
        return box
    return box.union(Box(box.low + path.shift, box.high + path.shift))
