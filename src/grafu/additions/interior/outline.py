"""The free outline of a room at the level of a panel, where it is no rectangle: an L, a slope, a round wall.

Cells say how far the room reaches, sections of the meshes where exactly it ends: at what stands, and a little
before what moves. Where nothing ends it, it is open, and a panel stays behind that side.
"""

from collections.abc import Sequence
from functools import cached_property
from typing import final

import numpy as np
import shapely
from shapely.geometry import Point, Polygon
from shapely.geometry.base import BaseGeometry

from grafu.additions.interior.compartments import Compartment, inside_cells
from grafu.additions.interior.config import InteriorConfig, Sizes
from grafu.additions.interior.panels import PanelPlace
from grafu.additions.top.section import offset, polygons_in, section, slab_mesh, without_slivers
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3
from grafu.geometry.free_space import Grid, cell_boxes
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.unions import united
from grafu.refusal import Reason, Refusal
from grafu.scene.scene import Scene
from grafu.shapes import Bool, Float
from grafu.vocabulary import PartLabel

REGION_CELLS = 2.5
"""Cells beyond the free ones up to which a wall is looked for: a cell that a wall touches is not free."""
SECTION_LEVELS = (-0.98, 0.0, 0.98)
"""Levels at which a panel's outline is looked for, as fractions of half its thickness."""
PLAIN = 1e-4
"""How far an outline may lie from the section that it is drawn along, metres on furniture of usual size."""

AT_WALL = 0.25
"""Widths of a slit within which an edge of an outline lies at a wall."""
OPEN = 1.25
"""Widths of a slit from which on a side without a wall is open."""
CIRCLE = 0.005
"""Fraction by which a free circle may be smaller than the largest one."""
LINE = 3e-4
"""Half the width of the lines of a section, metres on furniture of usual size."""

Level = Bool[np.ndarray, "a b"]
Triangles = Float[np.ndarray, "n 3 3"]


@final
@dataclass(frozen=True, slots=True)
class _Plane:
    """The plane of a panel: the axes that it spans, in the order that makes its mesh face outwards, and across it."""

    axes: tuple[int, int]
    across: int

    @property
    def order(self) -> list[int]:
        return [*self.axes, self.across]


def _plane_across(axis: int) -> _Plane:
    return _Plane(((axis + 1) % 3, (axis + 2) % 3), axis)


@final
class FreeSpace:
    """The free space of a scene at rest, prepared for sections at many levels; not a value."""

    def __init__(self, scene: Scene, compartments: Sequence[Compartment], sizes: Sizes, config: InteriorConfig) -> None:
        self._scene, self._compartments, self._sizes, self._config = scene, compartments, sizes, config
        self._metre = scene.metre

    @cached_property
    def _still(self) -> Triangles:
        return _all_triangles([part.mesh for part in self._scene.static_parts])

    @cached_property
    def _moving(self) -> Triangles:
        return _all_triangles([self._scene.moving_mesh(moving) for moving in self._scene.moving_bodies])

    def better(
        self, place: PanelPlace, plain: TriangleMesh | Refusal, boards: Sequence[TriangleMesh], thickness: float
    ) -> TriangleMesh | None:
        """Returns a panel that fills the room at its place; None: the plain one does as well, or none can.

        `plain` is the panel that four edges bound, or why there is none; `boards` stand in the room, too.
        """
        plane = _plane_across(place.stack)
        cells = self._level(place)
        if place.compartment.is_chest or not self._is_wider(cells, place, plane):
            return None
        reach = offset(self._squares(cells, plane), REGION_CELLS * self._sizes.cell)
        levels = place.at + thickness / 2 * np.array(SECTION_LEVELS)
        still = np.concatenate([self._still, *(board.triangles for board in boards)])
        walls = self._section(still, plane, levels, reach)
        doors = offset(self._section(self._moving, plane, levels, reach), place.inset)
        outline = self._outline(place, reach, walls, doors)
        if outline is None or not (self._is_gain(outline, plain, place, plane) and self._is_carried(outline, walls)):
            return None
        slab = slab_mesh(outline, place.at - thickness / 2, place.at + thickness / 2)
        vertices = np.empty_like(slab.vertices)
        vertices[:, plane.order] = slab.vertices
        return TriangleMesh(vertices, slab.faces)

    def _is_gain(self, outline: Polygon, plain: TriangleMesh | Refusal, place: PanelPlace, plane: _Plane) -> bool:
        """Whether an outline covers more than the plain panel; a strip in front, where a door is flat, is no gain."""
        if isinstance(plain, Refusal):
            return True
        opening, depth = place.compartment.opening, plane.axes.index(place.compartment.depth_axis)
        low, high = np.reshape(outline.bounds, (2, 2))
        own = plain.vertices[:, list(plane.axes)]
        ends = (high, own.max(axis=0)) if opening % 2 else (low, own.min(axis=0))
        if abs(float(ends[0][depth] - ends[1][depth])) <= self._sizes.least_side / 2:
            ends[0][depth] = ends[1][depth]
        covered = shapely.convex_hull(shapely.multipoints(own)).area
        counted = shapely.clip_by_rect(outline, *low, *high)
        return bool(counted.area > (1 + self._config.wider) * covered)

    def _is_wider(self, cells: Level, place: PanelPlace, plane: _Plane) -> bool:
        """Whether free cells around a panel's place take more than its compartment's box."""
        size = place.compartment.box.size[list(plane.axes)] / self._sizes.cell
        return bool(cells.sum() > (1 + self._config.wider) * float(np.prod(size)))

    def free_circle(
        self, compartment: Compartment, levels: Sequence[float], height: float
    ) -> tuple[tuple[float, float], float] | None:
        """Returns the middle (x, y) and radius of the largest circle that is free at levels, over a height around each.

        It stays behind doors and open sides as panels do. None: there is none.
        """
        plane = _plane_across(2)
        free: BaseGeometry | None = None
        for level in levels:
            place = PanelPlace(compartment, PartLabel.SHELF, level, self._sizes.inset)
            reach = offset(self._squares(self._level(place), plane), REGION_CELLS * self._sizes.cell)
            if reach.is_empty:
                return None
            heights = level + height / 2 * np.array(SECTION_LEVELS)
            walls = self._section(self._still, plane, heights, reach)
            doors = offset(self._section(self._moving, plane, heights, reach), place.inset)
            outline = self._outline(place, reach, walls, doors)
            if outline is None:
                return None
            free = outline if free is None else free.intersection(outline)
        largest = max(polygons_in(free) if free is not None else [], key=lambda p: float(p.area), default=None)
        if largest is None:
            return None
        radius = float(shapely.maximum_inscribed_circle(largest).length) * (1 - CIRCLE)
        middles = largest.buffer(-radius)  # of all circles about as large, the one in the middle
        spot = middles.centroid if middles.contains(middles.centroid) else middles.representative_point()
        return (float(spot.x), float(spot.y)), radius

    def slanted(self, place: PanelPlace, boards: Sequence[TriangleMesh], thickness: float) -> TriangleMesh | Refusal:
        """Returns a shelf that slopes down to the front between the walls, or why there is none."""
        box, depth = place.compartment.box, place.compartment.depth_axis
        frame = _sloping(place)
        opening = float(box.high[depth] if place.compartment.opening % 2 else box.low[depth])
        back = float(box.low[depth] if place.compartment.opening % 2 else box.high[depth])
        front = abs(opening - float(box.center[depth])) - place.inset - thickness / 2 * np.sin(place.angle)
        rear = abs(back - float(box.center[depth])) + self._sizes.cell
        side = box.half[place.reach] + self._config.askew_cells * self._sizes.cell
        if front + rear < self._sizes.least_side / 2:
            return Refusal("", Reason.NO_ROOM, "it is too shallow")
        slope = float(np.cos(place.angle))
        reach = shapely.box(-side, -front / slope, side, rear / slope)
        middle = box.center.copy()
        middle[2] = place.at
        still = (np.concatenate([self._still, *(b.triangles for b in boards)]) - middle) @ frame.T
        plane = _Plane((0, 1), 2)
        levels = thickness / 2 * np.array(SECTION_LEVELS)
        walls = self._section(still, plane, levels, reach)
        doors = offset(self._section((self._moving - middle) @ frame.T, plane, levels, reach), place.inset)
        free = without_slivers(reach.difference(walls).difference(doors), self._config.slit * self._metre)
        inside = free.intersection(shapely.convex_hull(walls.union(doors)))
        room = _around(inside, Point(0.0, 0.0))
        outline = None if room is None else _plain(Polygon(room.exterior), PLAIN * self._metre)
        if outline is None:
            return Refusal("", Reason.NO_ROOM)
        if not self._is_held(outline, walls):
            return Refusal("", Reason.NO_SUPPORT, "it has no wall to rest on at both ends")
        slab = slab_mesh(outline, -thickness / 2, thickness / 2)
        return TriangleMesh(slab.vertices @ frame + middle, slab.faces)

    def _is_held(self, outline: Polygon, walls: BaseGeometry) -> bool:
        """Whether a sloping shelf touches walls along enough of both its ends."""
        low, near, high, far = outline.bounds
        touching = outline.exterior.intersection(walls.buffer(self._sizes.touch))
        margin = self._sizes.least_side / 2
        ends = ((low, low + margin), (high - margin, high))
        held = (touching.intersection(shapely.box(left, near, right, far)).length for left, right in ends)
        return all(length >= self._config.carried * (far - near) for length in held)

    def _section(self, triangles: Triangles, plane: _Plane, levels: np.ndarray, reach: BaseGeometry) -> BaseGeometry:
        """Returns what triangles cross at some levels near a region."""
        placed = triangles[:, :, plane.order]
        low, high = np.reshape(reach.bounds, (2, 2)) + self._config.slit * self._metre * np.array([[-1.0], [1.0]])
        flat = placed[:, :, :2]
        near = ((flat.min(axis=1) <= high) & (flat.max(axis=1) >= low)).all(axis=1)
        return section(placed[near], levels.tolist(), LINE * self._metre, self._metre)

    def _outline(
        self, place: PanelPlace, reach: BaseGeometry, walls: BaseGeometry, doors: BaseGeometry
    ) -> Polygon | None:
        """Returns the one free polygon around the place, without slits, set back where the room is open."""
        slit, cell = self._config.slit * self._metre, self._sizes.cell
        middle = Point(*place.compartment.box.center[list(_plane_across(place.stack).axes)])
        free = without_slivers(reach.difference(walls).difference(doors), slit)
        room = _around(free, middle)
        if room is None:
            return None
        ends = united([walls, doors]).buffer(AT_WALL * slit)
        edges = shapely.get_parts(shapely.line_merge(shapely.get_parts(room.boundary.difference(ends))))
        opened = [edge for edge in edges if edge.length > OPEN * slit]
        back = united(opened).buffer(REGION_CELLS * cell + place.inset, cap_style="flat", join_style="mitre")
        room = _around(
            without_slivers(room.difference(back), slit).intersection(shapely.convex_hull(walls.union(doors))), middle
        )
        return None if room is None else _plain(Polygon(room.exterior), PLAIN * self._metre)

    def _level(self, place: PanelPlace) -> Level:
        """Returns the free cells around a place that reach its compartment, over the whole thickness of a panel."""
        from scipy.ndimage import label  # local: most commands need no interiors

        taken, inside = inside_cells(self._scene, self._config)
        free = self._without_others(inside, place.compartment)
        plane = _plane_across(place.stack)
        half = self._sizes.thickness / 2
        ends = (np.array([place.at - half, place.at + half]) - taken.origin[plane.across]) / taken.cell
        start, stop = int(np.floor(ends[0])), int(np.ceil(ends[1]))
        level = np.moveaxis(free, plane.order, (0, 1, 2))[:, :, max(start, 0) : stop].all(axis=2)
        low, high = (
            (end[list(plane.axes)] - taken.origin[list(plane.axes)]) / taken.cell
            for end in (place.compartment.box.low, place.compartment.box.high)
        )
        seed = tuple(slice(max(int(np.ceil(a)), 0), int(np.floor(b))) for a, b in zip(low, high, strict=True))
        names, _ = label(level)
        counts = np.bincount(names[seed].ravel(), minlength=2)
        counts[0] = 0
        found: Level = names == counts.argmax() if counts.any() else np.zeros_like(level)
        return found

    def _without_others(self, inside: Grid, own: Compartment) -> Grid:
        """Returns the free cells that lie in no other compartment."""
        taken, _ = inside_cells(self._scene, self._config)
        found = inside.copy()
        for other in self._compartments:
            if (other.box.axis_gaps(own.box) < -taken.cell).all():  # itself, or a part of it between dividers
                continue
            for box in (other.box, *other.arms):
                low, high = ((end - taken.origin) / taken.cell for end in (box.low, box.high))
                found[tuple(slice(max(round(a), 0), max(round(b), 0)) for a, b in zip(low, high, strict=True))] = False
        return found

    def _squares(self, cells: Level, plane: _Plane) -> BaseGeometry:
        taken, _ = inside_cells(self._scene, self._config)
        boxes = cell_boxes(cells[:, :, None])[:, :, :2] * taken.cell + taken.origin[list(plane.axes)]
        return united(shapely.box(*boxes.reshape(-1, 4).T))

    def _is_carried(self, outline: Polygon, walls: BaseGeometry) -> bool:
        """Whether enough of an outline rests on walls, on all sides of its middle."""
        touching = outline.exterior.intersection(walls.buffer(self._sizes.touch))
        is_enough = touching.length >= self._config.rests * outline.exterior.length
        return bool(is_enough and shapely.convex_hull(touching).contains(outline.centroid))


def _sloping(place: PanelPlace) -> Mat3:
    """Returns the axes of a sloping shelf as rows: to the side, up along it to the back, and its upper normal."""
    inward = np.zeros(3)
    inward[place.compartment.depth_axis] = -1.0 if place.compartment.opening % 2 else 1.0
    up = np.array([0.0, 0.0, 1.0])
    along = np.cos(place.angle) * inward + np.sin(place.angle) * up
    normal = np.cos(place.angle) * up - np.sin(place.angle) * inward
    return np.stack([np.cross(along, normal), along, normal])


def _all_triangles(meshes: Sequence[TriangleMesh]) -> Triangles:
    found = [mesh.triangles for mesh in meshes if len(mesh.faces)]
    return np.concatenate(found) if found else np.zeros((0, 3, 3))


def _around(shape: BaseGeometry, middle: Point) -> Polygon | None:
    """Returns the polygon of a shape that holds a point, else the largest."""
    polygons = polygons_in(shape)
    holding = [p for p in polygons if p.contains(middle)]
    return max(holding or polygons, key=lambda p: float(p.area), default=None)


def _plain(polygon: Polygon, tolerance: float) -> Polygon | None:
    found = polygons_in(polygon.simplify(tolerance))
    return found[0] if len(found) == 1 else None
