"""Frees the way of a drawer or a door where it and its case are closed bodies that are drawn into each other.

Parts that were made apart, by a program that completes what it sees, are wavy and overlap by about a hundredth of the
piece, all along their sides. What a hull of a drawer sweeps would cut away far more than that, and its triangles one
by one are too many. The sections of the drawer across its way, from its back to its front, are a few boxes, and the
leaf of a door is one: what of the case reaches into these goes, where it does so by little.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.geometry.sampling import sample_surface
from grafu.geometry.solids import ConvexSolid, in_any, subtract
from grafu.geometry.transform import transform_points
from grafu.joints.clearance.carve import Carving, Change, Path, box_in, cut_by, is_hidden, steps_of
from grafu.joints.config import RealizationConfig
from grafu.scene.scene import Scene


def carve_channel(
    scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig
) -> tuple[Scene, list[Change]]:
    """Returns the scene with those blockers carved that reach by a little into where a drawer slides or a door turns.

    Both must be closed bodies, and hardly any of what goes may be seen from outside while all is closed.
    """
    if not scene.parts[path.moving].mesh.is_watertight:
        return scene, []
    play = config.clearance.play * config.depth * scene.extent
    deep = config.clearance.channel * scene.extent + play
    swept = _Turn.of(scene, path, play) if path.is_turn else _Slide.of(scene, path, play, config.clearance.sections)
    carved: list[Part] = []
    done: list[Change] = []
    for name in ids:
        part = scene.parts[name]
        if len(part.mesh.faces) > config.carved_faces or not part.mesh.is_watertight:
            continue
        points = np.vstack([sample_surface(part.mesh, config.clearance.points).points, part.mesh.vertices])
        if not swept.is_shallow(points, deep):
            continue
        cut = cut_by(part, swept.solids, config)
        if cut.ratio == 0 or cut.ratio > config.max_carve_hidden:
            continue
        if cut.ratio > config.max_carve and not is_hidden(scene, part, cut.solids, config.clearance.rim):
            continue
        surfaces = (subtract(s, cut.solids, left) for s, left in zip(part.surfaces, cut.clipped, strict=True))
        carved.append(replace(part, surfaces=tuple(s for s in surfaces if not s.is_empty)))
        done.append(Carving(part, cut.solids, cut.area, cut.lost, path.moving))
    return scene.replaced(carved), done


@final
@dataclass(frozen=True, eq=False)
class _Slide:
    """The way of a drawer: boxes in its own axes."""

    path: Path
    boxes: tuple[Box, ...]
    solids: tuple[ConvexSolid, ...]

    @classmethod
    def of(cls, scene: Scene, path: Path, play: float, sections: int) -> "_Slide":
        """Returns the way of the moving body of a path, with some play."""
        mesh = scene.moving_mesh(path.moving)
        boxes = tuple(channel_boxes(mesh, path, play, sections))
        return cls(path, boxes, _solids(box.corners() @ path.axes.T for box in boxes))

    def is_shallow(self, points: Points, deep: float) -> bool:
        """Whether no point of a surface lies deeper in the way than `deep` metres, from the side or from its end."""
        local, axis = points @ self.path.axes, self.path.slide_axis
        comes_up = self.path.shift[axis] > 0
        for box in self.boxes:
            inside = local[box.contains(local)]
            into = np.minimum(inside - box.low, box.high - inside)
            into[:, axis] = inside[:, axis] - box.low[axis] if comes_up else box.high[axis] - inside[:, axis]
            if len(inside) and float(into.min(axis=1).max()) > deep:
                return False
        return True


@final
@dataclass(frozen=True, eq=False)
class _Turn:
    """The way of a door: the box of its leaf as closed, in its own axes, and what that sweeps."""

    path: Path
    box: Box
    solids: tuple[ConvexSolid, ...]

    @classmethod
    def of(cls, scene: Scene, path: Path, play: float) -> "_Turn":
        """Returns the way of the leaf of a path without its handle, with some play."""
        box = box_in(path.axes, scene.parts[path.moving].mesh).grown(play)
        corners = box.corners() @ path.axes.T
        poses = [transform_points(path.motion(v), corners) for v in np.linspace(0.0, path.reach, steps_of(path) + 1)]
        return cls(path, box, _solids(np.vstack(pair) for pair in pairwise(poses)))

    def is_shallow(self, points: Points, deep: float) -> bool:
        """Whether what of a surface lies in the way is within the closed leaf, and no deeper in it, or right beside."""
        inside = points[in_any(self.solids, points)] @ self.path.axes
        into = np.minimum(inside - self.box.low, self.box.high - inside).min(axis=1)
        return bool((np.abs(into) <= deep).all())


def _solids(corners: Iterable[Points]) -> tuple[ConvexSolid, ...]:
    return tuple(solid for points in corners if (solid := ConvexSolid.around(points)) is not None)


def channel_boxes(mesh: TriangleMesh, path: Path, play: float, sections: int) -> Iterator[Box]:
    """Yields boxes in the part's own axes that cover its whole way: from each section to where that ends when open.

    A section holds all that is behind it, as that comes through it. Sections that differ by less than the `play`
    (metres), which all of them get on their sides, are one box.
    """
    axis = path.slide_axis
    sign = float(np.sign(path.shift[axis]))
    turned = mesh.triangles @ path.axes
    low, high = triangle_bounds(turned)
    back, front = (low, high) if sign > 0 else (-high, -low)  # along the way, of each triangle
    ends = np.linspace(back[:, axis].min(), front[:, axis].max(), sections + 1)
    reach = abs(float(path.shift[axis]))
    begun, section = ends[0], None
    for start, end in pairwise(ends):
        is_met = (back[:, axis] <= end) & (front[:, axis] >= start)
        if not is_met.any():
            continue
        grown = Box(low[is_met].min(axis=0), high[is_met].max(axis=0))
        grown = grown if section is None else grown.union(section)
        if section is not None and _grows(section, grown, axis, play):
            yield _swept(section, axis, sign, begun, ends[-1] + reach, play)
            begun = start
        section = grown
    if section is not None:
        yield _swept(section, axis, sign, begun, ends[-1] + reach, play)


def _grows(inner: Box, outer: Box, axis: int, play: float) -> bool:
    """Whether a section is wider or higher than the one behind it by more than the play, on any side."""
    more = np.maximum(inner.low - outer.low, outer.high - inner.high)
    return bool(np.delete(more, axis).max() > play)


def _swept(section: Box, axis: int, sign: float, start: float, end: float, play: float) -> Box:
    """Returns the box of a section from `start` to `end` along its way, wider by the play on its four sides."""
    low, high = section.low - play, section.high + play
    low[axis], high[axis] = (start, end) if sign > 0 else (-end, -start)
    return Box(low, high)
