"""The outline of a missing top: what stands just under its rim, closed up (paper, Adding Countertops).

Rectangles stay rectangles, L-shaped, cut-off and bowed outlines keep their shape; kneeholes are spanned. What stands up
through the top (backs, posts, towers, a basin's rim) is left out of it.
"""

from dataclasses import replace
from typing import final

import numpy as np
import shapely
from shapely.geometry import Polygon, box
from shapely.geometry.base import BaseGeometry

from grafu.additions.top.config import OutlineConfig, TopConfig
from grafu.additions.top.coverage import Coverage
from grafu.additions.top.height_map import CellMask, grown, heights_of
from grafu.additions.top.roles import Closed, Roles, triangles_of
from grafu.additions.top.section import (
    EMPTY,
    closed_up,
    filled,
    offset,
    polygons_in,
    section,
    solid,
    without_slivers,
)
from grafu.additions.top.views import Views
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.unions import united
from grafu.shapes import Float

ALONG_AXES = 1.02
"""Area of the rectangle along the axes, over that of the smallest one, up to which it is taken instead (ratio)."""
SPECK = 0.02
"""Fraction of the openings up to which a piece of an outline holds none of them."""


@final
@dataclass(frozen=True, eq=False)
class Rim:
    """What carries a top: the height of its seat, the boards under it, and the outline around them."""

    seat: float
    walls: BaseGeometry
    outline: BaseGeometry


def rim_of(roles: Roles, views: Views, coverage: Coverage, config: OutlineConfig, metre: float) -> Rim | None:
    """Returns the rim around an opening, in roles without basins; None where nothing still carries a top."""
    seat = _seat(roles, views, coverage, config, metre)
    if seat is None:
        return None
    line = config.line * metre
    triangles = _near(triangles_of(p.mesh for p in roles.still), coverage, config.front * metre)
    heights = [seat - skin * metre for skin in (config.skin, config.deep_skin)]
    walls = section(triangles, heights, line, metre)
    hollow = united(shapely.box(*coverage.grid.boxes(coverage.opened).T))
    held = united([walls, hollow, *(_plan_box(p.box) for p in _standing_on(roles, seat, config, metre))])
    held = held.intersection(shapely.convex_hull(walls.union(hollow)))
    body = offset(closed_up(held, config.span * metre), -line)
    body = _joined(body, coverage, config.kneehole * metre)
    body = _of_openings(_squared(body, config, metre), coverage)
    return Rim(seat, offset(solid(walls, config.board * metre), -line), body) if body.area > 0 else None


def with_fronts(rim: Rim, moving_bodies: tuple[Closed, ...], config: OutlineConfig, metre: float) -> BaseGeometry:
    """Returns a rim's outline with the doors and drawers before it whose upper ends come near it."""
    near, line = offset(rim.outline, config.front * metre), config.line * metre
    found = [rim.outline]
    for moving in moving_bodies:
        top = float(moving.mesh.box.high[2])
        if top < rim.seat - config.reach * metre or not _plan_box(moving.mesh.box).intersects(near):
            continue
        height = min(top, rim.seat) - config.front_below * metre
        front = offset(filled(section(moving.mesh.triangles, [height], line, metre)), -line)
        found.append(front.intersection(near))
    if len(found) == 1:
        return rim.outline
    return _squared(closed_up(united(found), 2 * config.front * metre), config, metre)


def over_the_base(
    plan: BaseGeometry, roles: Roles, seat: float, config: TopConfig, metre: float
) -> tuple[float, float, float]:
    """Returns how far a top juts out in front, at the sides and behind: as asked for, or as what is below it."""
    low_x, low_y, high_x, high_y = plan.bounds
    boxes = [p.box for p in roles.still if p.box.high[2] < seat]
    low = np.min([b.low for b in boxes], axis=0) if boxes else np.full(3, np.inf)
    high = np.max([b.high for b in boxes], axis=0) if boxes else np.full(3, -np.inf)
    beyond = (low_y - low[1], min(low_x - low[0], high[0] - high_x), high[1] - high_y)
    asked = (config.front * metre, config.side * metre, config.back * metre)
    front, side, back = (
        max(own, float(base)) if base <= config.outline.base * metre else own
        for own, base in zip(asked, beyond, strict=True)
    )
    trays = [
        float(low_y - m.mesh.box.low[1]) for m in roles.sliding if _is_tray(m.mesh.box, seat, config.outline, metre)
    ]
    return max([front, *(t for t in trays if t <= config.outline.tray * metre)]), side, back


def _is_tray(body: Box, seat: float, config: OutlineConfig, metre: float) -> bool:
    """Whether what slides lies in a top's thickness: closed, a keyboard's tray ends with the top that hides it."""
    low, high = seat - config.inset * metre, seat + config.high_slot * metre
    return bool(body.low[2] >= low and body.high[2] <= high)


def overhanging(outline: BaseGeometry, front: float, side: float, back: float) -> BaseGeometry:
    """Returns an outline that juts out by these lengths to -Y, to both sides, and to +Y."""
    around = np.array([[-side, -front], [side, -front], [side, back], [-side, back]], dtype=np.float64)
    swept = []
    for polygon in polygons_in(outline):
        corners = np.asarray(polygon.exterior.coords)[:, :2]
        ends = np.concatenate([corners[:-1, None] + around, corners[1:, None] + around], axis=1)
        swept += [shapely.convex_hull(shapely.multipoints(points)) for points in ends]
    return filled(united([outline, *swept]))


def under_what_stands(roles: Roles, rim: Rim, thickness: float, config: TopConfig, metre: float) -> float:
    """Returns how thick a slab may be under what was built to stand on it: as thick as the slot that is left there.

    What moves above it keeps `config.gap` of air.
    """
    gap, own = config.gap * metre, config.outline
    slot = _slot(rim.seat, own, metre)
    above = [p for p in _standing_on(roles, rim.seat, own, metre) if _plan_box(p.box).intersects(rim.outline)]
    found = min((float(p.box.low[2]) for p in above), default=rim.seat + thickness)
    bodies = [m.mesh.box for m in roles.moving if m.mesh.box.high[2] > slot[1] and m.mesh.box.low[2] >= slot[0]]
    free = min((float(b.low[2]) - gap for b in bodies if _plan_box(b).intersects(rim.outline)), default=np.inf)
    return min(found, free) - rim.seat


def _slot(seat: float, config: OutlineConfig, metre: float) -> tuple[float, float]:
    """Returns between which heights what stands on a top begins."""
    return seat + config.slot * metre, seat + config.high_slot * metre


def _standing_on(roles: Roles, seat: float, config: OutlineConfig, metre: float) -> list[Part]:
    """Returns what is static on a top that was there: it begins as high above a seat as tops are thick."""
    low, high = _slot(seat, config, metre)
    return [p for p in roles.still if low <= p.box.low[2] <= high]


def what_pierces(
    roles: Roles, rim: Rim, thickness: float, seat: float, config: OutlineConfig, metre: float
) -> BaseGeometry:
    """Returns what stands up through a slab on the rim, hollow things filled: no top goes there."""
    tall = [p.mesh for p in roles.still if p.box.high[2] > rim.seat + max(seat, config.inset * metre)]
    heights = (rim.seat + seat, rim.seat + 0.5 * thickness, rim.seat + thickness - seat)
    return _standing(tall, heights, config, metre)


def inset_regions(
    roles: Roles, rim: Rim, seat: float, config: OutlineConfig, metre: float
) -> list[tuple[BaseGeometry, float]]:
    """Returns what stands a little above the rest of the rim and how high: there a slab's underside gives way."""
    found = []
    for part in roles.still:
        top = float(part.box.high[2])
        if rim.seat + seat < top <= rim.seat + max(seat, config.inset * metre):
            heights = (rim.seat + 0.5 * seat, 0.5 * (rim.seat + top))
            found.append((_standing([part.mesh], heights, config, metre), top))
    return found


def _standing(
    meshes: list[TriangleMesh], heights: tuple[float, ...], config: OutlineConfig, metre: float
) -> BaseGeometry:
    if not meshes:
        return EMPTY
    lines = section(triangles_of(meshes), heights, config.line * metre, metre)
    return filled(closed_up(lines, config.crevice * metre))


def one_piece(shape: BaseGeometry, coverage: Coverage, config: OutlineConfig, metre: float) -> Polygon | None:
    """Returns the piece of a slab's outline that covers most of the opening, without tongues; None if none does."""
    pieces = [p for p in polygons_in(without_slivers(shape, config.tongue * metre)) if p.area > 0]
    x, y = coverage.grid.centers(coverage.opened).T
    best = max(pieces, key=lambda p: int(shapely.contains_xy(p, x, y).sum()), default=None)
    if best is None:
        return None
    plain = shapely.simplify(best, config.detail * metre)
    return plain if isinstance(plain, Polygon) and plain.is_valid and plain.area > 0 else best


def _seat(roles: Roles, views: Views, coverage: Coverage, config: OutlineConfig, metre: float) -> float | None:
    """Returns the greatest height at which enough of the rim ends; single points a little higher lift it.

    What begins above the rim stood on the top and carries none.
    """
    if coverage.level is None:
        return None
    carriers = [p for p in roles.still if p.box.low[2] < coverage.level + config.slot * metre]
    if len(carriers) < len(roles.still):
        views = replace(views, still=heights_of(triangles_of(p.mesh for p in carriers), views.grid))
    around = grown(coverage.opened, coverage.grid.cells(config.rim * metre))
    low, high = coverage.level - config.below_rim * metre, coverage.level + config.above_rim * metre
    rim = around & (views.still >= low) & (views.still <= high)
    heights = np.sort(views.still[rim])
    if not len(heights):
        return None
    ends = np.searchsorted(heights, heights - config.even * metre), np.searchsorted(heights, heights, "right")
    carried = ends[1] - ends[0]
    for high in np.unique(heights[carried >= config.carries * len(heights)])[::-1]:
        level = rim & (views.still <= high) & (views.still >= high - config.even * metre)
        if _is_spread(level, rim, config.apart):
            return _lifted(float(high), rim, views, config, metre)
    return _lifted(float(heights[carried.argmax()]), rim, views, config, metre)


def _lifted(seat: float, rim: CellMask, views: Views, config: OutlineConfig, metre: float) -> float:
    """Returns the seat of a top, lifted by single points a little higher, or by posts that carry it alone."""
    low, high = seat + config.low_point * metre, seat + config.posts * metre
    points = rim & (views.still > seat) & (views.still <= low)
    posts = rim & (views.still > low) & (views.still <= high)
    if _is_spread(posts, rim, config.apart):
        points |= posts
    return float(views.still[points].max(initial=seat))


def _is_spread(some: CellMask, rim: CellMask, ratio: float) -> bool:
    """Whether some cells of a rim span this fraction of it, and carry a top without it tilting."""
    if not some.any():
        return False
    return bool(np.all(np.ptp(np.argwhere(some), axis=0) >= ratio * np.ptp(np.argwhere(rim), axis=0)))


def _near(triangles: Float[np.ndarray, "n 3 3"], coverage: Coverage, around: float) -> Float[np.ndarray, "m 3 3"]:
    """Returns the triangles within the region of an opening and `around` metres of it, seen from above."""
    points = coverage.grid.centers(coverage.everything)
    low, high = points.min(axis=0) - around, points.max(axis=0) + around
    flat = triangles[:, :, :2]
    return triangles[np.all((flat.max(axis=1) >= low) & (flat.min(axis=1) <= high), axis=1)]


def _squared(shape: BaseGeometry, config: OutlineConfig, metre: float) -> BaseGeometry:
    """Returns each polygon as the rectangle that it was meant to be, where all of whose corners lie near it."""
    made, tolerance = [], config.square * metre
    for polygon in polygons_in(shape):
        upright = box(*polygon.bounds)
        turned = polygon.minimum_rotated_rectangle
        rectangle = upright if upright.area <= ALONG_AXES * turned.area else turned
        corners = shapely.points(np.asarray(rectangle.exterior.coords)[:-1])
        is_meant = float(shapely.distance(polygon, corners).max()) <= tolerance
        is_full = rectangle.difference(offset(polygon, 2 * tolerance)).area <= config.empty * rectangle.area
        made.append(rectangle if is_meant and is_full else polygon)
    return united(made) if made else EMPTY


def _joined(body: BaseGeometry, coverage: Coverage, kneehole: float) -> BaseGeometry:
    """Returns the outlines of several openings as one where up to `kneehole` metres lie between them."""
    held = _of_openings(body, coverage)
    return closed_up(held, kneehole) if len(polygons_in(held)) > 1 else body


def _of_openings(shape: BaseGeometry, coverage: Coverage) -> BaseGeometry:
    """Returns the polygons of a shape that hold some of the openings, as one."""
    x, y = coverage.grid.centers(coverage.opened).T
    held = [p for p in polygons_in(shape) if shapely.contains_xy(p, x, y).sum() > SPECK * len(x)]
    return united(held) if held else EMPTY


def _plan_box(body: Box) -> Polygon:
    low, high = body.low, body.high
    return box(float(low[0]), float(low[1]), float(high[0]), float(high[1]))
