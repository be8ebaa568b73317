"""Straight borders for the fronts of a parted surface, whose pieces end in teeth that hold them to each other.

What tells the parts of a scan apart does so face by face: the border between a front and its case zigzags by a few
faces, and what turns or slides would cut into its neighbours at once. A front that fills a rectangle gets the borders
of that, and its neighbours end outside it. Vertices alone are moved, by no more than a tooth.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, Vec2, Vec3, distinct
from grafu.geometry.box import Box
from grafu.geometry.components import edge_numbers, linked, welded
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh
from grafu.shapes import Bool, Float, Int

_Flat = Float[np.ndarray, "_ 2"]
_Numbers = Int[np.ndarray, "_"]


@final
@dataclass(frozen=True, slots=True)
class StraightBordersConfig:
    """Which pieces of a surface are rectangular fronts, and how far vertices are moved; lengths in the largest side.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    tooth: float = 0.02
    """A border zigzags by this at most to each side: two or three faces of a scan of some ten thousand."""
    gap: float = 0.002
    """How far a front, and what is around it, end from the line between them, each: 2 mm on 1 m."""
    relief: float = 0.012
    """What lies within this of the plane of a front, before or behind it, is its board: what is farther out is its
    handle."""
    within: float = 0.8
    """So much of the border of a rectangular front lies within a tooth of its rectangle (of the vertices) ..."""
    least: float = 4.0
    """Its shorter side is this at least (teeth): what is narrower is a handle, or a strip of the case."""
    filled: float = 0.85
    """... and it fills this, seen from in front (fraction of the area)."""

    def __post_init__(self) -> None:
        require_positive(self, "tooth", "gap", "relief", "least")
        require_ratios(self, "within", "filled")


@final
@dataclass(frozen=True, eq=False)
class _Front:
    """The board of a front: a box in the order of the meshes' axes, as it is seen along `towards`, in which it looks.

    `reach` is a tooth, and `gap` the distance to keep from the border, in the unit of the meshes.
    """

    board: Box
    towards: Vec3
    reach: float
    gap: float

    @property
    def across(self) -> list[int]:
        """The two axes along which it is wide and high."""
        return np.flatnonzero(self.towards == 0).tolist()

    def is_seen_in(self, points: Points) -> Bool[np.ndarray, " n"]:
        """Returns which points lie before or behind its rectangle."""
        low, high = self.board.low[self.across], self.board.high[self.across]
        flat = points[:, self.across]
        return np.asarray(((flat >= low) & (flat <= high)).all(axis=1))

    def own(self, points: Points, border: _Numbers) -> Points:
        """Returns the points of the front itself, its border on the rectangle and nothing of its board beyond."""
        depth, sign = points @ self.towards, float(self.towards.sum())
        axis = int(np.argmax(np.abs(self.towards)))
        ahead, back = sorted((sign * self.board.low[axis], sign * self.board.high[axis]), reverse=True)
        of_board, on_border = depth <= ahead, np.zeros(len(points), dtype=bool)
        on_border[border] = True
        moved = points.copy()
        for k in self.across:
            low, high = self.board.low[k] + self.gap, self.board.high[k] - self.gap
            near_low = on_border & (points[:, k] < low + self.reach)
            near_high = on_border & (points[:, k] > high - self.reach)
            along = np.where(near_low, low, np.where(near_high, high, np.clip(points[:, k], low, high)))
            moved[:, k] = np.where(of_board, along, points[:, k])
        moved[:, axis] = np.where(of_board, sign * np.maximum(depth, back), points[:, axis])
        return moved

    def beside(self, points: Points) -> Points:
        """Returns the points of another piece: those that reach into the board by less than a tooth end beside it."""
        low, high = self.board.low - self.gap, self.board.high + self.gap
        inside = np.flatnonzero(((points > low) & (points < high)).all(axis=1))
        flat = points[inside][:, self.across]
        sides = np.hstack([flat - low[self.across], high[self.across] - flat])
        nearest = sides.argmin(axis=1)
        shallow = sides[np.arange(len(inside)), nearest] <= self.reach + self.gap
        inside, nearest = inside[shallow], nearest[shallow]
        line = np.concatenate([low[self.across], high[self.across]])[nearest]
        moved = points.copy()
        moved[inside, np.array(self.across)[nearest % 2]] = line
        return moved


def with_straight_borders(
    parts: Sequence[Part],
    facing: Sequence[Vec3 | None],
    thick: float,
    config: StraightBordersConfig = StraightBordersConfig(),
) -> tuple[Part, ...]:
    """Returns the parts of a parted surface, those borders straight that rectangular fronts have.

    Args:
        parts: the pieces of one surface.
        facing: for each the direction along an axis that it faces, None for what is no sheet.
        thick: how thick the board of a sheet becomes, in the unit of the meshes.
        config: what is rectangular, and how far vertices are moved.
    """
    meshes = [part.mesh for part in parts]
    extent = float(Box.enclosing(mesh.box for mesh in meshes).size.max())
    made: list[Part] = []
    fronts: list[_Front | None] = []
    for part, mesh, towards in zip(parts, meshes, facing, strict=True):
        front = None if towards is None else _front(mesh, towards, thick, extent, config)
        fronts.append(front)
        made.append(part if front is None else _with_points(part, front.own(mesh.vertices, _border(mesh)[0])))
    return tuple(_beside_fronts(part, fronts[:k] + fronts[k + 1 :]) for k, part in enumerate(made))


def _beside_fronts(part: Part, fronts: Sequence[_Front | None]) -> Part:
    points = before = part.mesh.vertices
    for front in fronts:
        if front is not None and np.mean(front.is_seen_in(points)) < 0.5:  # else it is a handle on it, or in it
            points = front.beside(points)
    return part if np.array_equal(points, before) else _with_points(part, points)


def _with_points(part: Part, points: Points) -> Part:
    """Returns the part with other places for its vertices, those of one surface after the other."""
    ends = np.cumsum([len(surface.mesh.vertices) for surface in part.surfaces])
    placed = zip(part.surfaces, np.split(points, ends[:-1]), strict=True)
    surfaces = tuple(replace(s, mesh=TriangleMesh(own, s.mesh.faces)) for s, own in placed)
    return replace(part, surfaces=surfaces)


def _border(mesh: TriangleMesh) -> tuple[_Numbers, _Numbers]:
    """Returns the vertices on edges that one face alone has, and those of the loop of them that is largest."""
    position = welded(mesh.vertices, 1e-6 * float(mesh.box.size.max()))
    corners = position[mesh.faces]
    edges = edge_numbers(corners).ravel()
    alone = np.flatnonzero(np.bincount(edges)[edges] == 1)
    start, end = corners.ravel()[alone], np.roll(corners, -1, axis=1).ravel()[alone]
    loop = linked(int(position.max()) + 1, start, end)[position]
    border = np.flatnonzero(np.isin(position, np.concatenate([start, end])))
    sizes = {k: float(np.ptp(mesh.vertices[border[loop[border] == k]], axis=0).sum()) for k in distinct(loop[border])}
    largest = max(sizes, key=lambda k: sizes[k], default=-1)
    return border, border[loop[border] == largest]


@final
@dataclass(frozen=True, eq=False)
class SeenRectangle:
    """The rectangle that a sheet fills, seen from in front: its ends along the two axes across, in their order.

    `plane` is how far most of the sheet lies in the direction in which it looks, `border` what its largest border runs
    through.
    """

    low: Vec2
    high: Vec2
    plane: float
    border: Points

    @property
    def size(self) -> Vec2:
        """How wide and high it is."""
        return np.asarray(self.high - self.low)


def seen_rectangle(
    mesh: TriangleMesh, towards: Vec3, thick: float, extent: float, config: StraightBordersConfig
) -> SeenRectangle | None:
    """Returns the rectangle that a sheet fills as it is seen along a direction, None where it is none."""
    plane, border = plane_of(mesh, towards), mesh.vertices[_border(mesh)[1]]
    leaf = (mesh.face_normals @ towards > 0.5) & (np.abs(mesh.triangles.mean(axis=1) @ towards - plane) <= thick)
    if len(border) < 4 or not leaf.any():
        return None
    across, tooth = np.flatnonzero(towards == 0), config.tooth * extent
    low, high = _rectangle(border[:, across], mesh.triangles[leaf].reshape(-1, 3)[:, across], tooth)
    off = np.hstack([np.abs(border[:, across] - low), np.abs(border[:, across] - high)]).min(axis=1)
    projected = float((mesh.face_areas * (mesh.face_normals @ towards))[leaf].sum())
    is_met = np.mean(off <= tooth) >= config.within and projected >= config.filled * float(np.prod(high - low))
    return SeenRectangle(low, high, plane, border) if is_met else None


def _front(
    mesh: TriangleMesh, towards: Vec3, thick: float, extent: float, config: StraightBordersConfig
) -> _Front | None:
    """Returns the front that a sheet is, None where it is not rectangular."""
    seen, tooth = seen_rectangle(mesh, towards, thick, extent, config), config.tooth * extent
    if seen is None or seen.size.min() < config.least * tooth:
        return None
    deep = max(thick, float(np.quantile(seen.plane - seen.border @ towards, 0.9)))
    ends = np.sort(np.array([seen.plane - deep, seen.plane + config.relief * extent]) * towards.sum())
    box = np.zeros((2, 3))
    box[:, towards == 0], box[:, towards != 0] = np.stack([seen.low, seen.high]), ends[:, None]
    return _Front(Box(*box), towards, tooth, config.gap * extent)


def plane_of(mesh: TriangleMesh, towards: Vec3) -> float:
    """Returns how far in a direction half of the area lies that looks there."""
    ahead = mesh.face_normals @ towards > 0.5
    depth, area = (mesh.triangles.mean(axis=1) @ towards)[ahead], mesh.face_areas[ahead]
    order = np.argsort(depth)
    covered = np.cumsum(area[order])
    return float(depth[order][np.searchsorted(covered, covered[-1] / 2)])


def _rectangle(border: _Flat, leaf: _Flat, tooth: float) -> tuple[Vec2, Vec2]:
    """Returns low and high of the rectangle whose sides lie amid the teeth of a border, seen from in front."""
    ends = np.stack([leaf.min(axis=0), leaf.max(axis=0)])
    off = np.abs(border[:, None] - ends).reshape(-1, 4)
    nearest = off.argmin(axis=1)
    for side in range(4):
        of_side = border[(nearest == side) & (off[:, side] <= 3 * tooth), side % 2]
        if len(of_side):
            ends[side // 2, side % 2] = np.median(of_side)
    return ends[0], ends[1]
