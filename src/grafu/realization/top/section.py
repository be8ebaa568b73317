"""Level sections of triangles as plane polygons, and how polygons are closed up. It knows no parts.

Real furniture is full of sheets without thickness and boards that are open somewhere, so a section is taken as lines
of a hair's width, not as the inside of loops.
"""

from collections.abc import Iterable

import numpy as np
import shapely
from jaxtyping import Float
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

Segments = Float[np.ndarray, "k 2 2"]
Fewer = Float[np.ndarray, "f 2 2"]

_HAIR = 5e-4  # metres: half the width of a section's lines
_SHORTEST = 1e-7  # metres
_MANY = 700  # lines: more take longer than a tenth of a second to join
_SHARPEST = 2.0  # how much farther a corner may move than its edges: 60 degrees; a slip of a hair would grow a spike
_STEPS = (1e-5, 1e-4, 5e-4, 1e-3, 2e-3)  # metres
EMPTY = Polygon()


def section_lines(triangles: Float[np.ndarray, "n 3 3"], height: float) -> Segments:
    """Returns where triangles cross the level at `height`; those that only touch it do not."""
    above = triangles[:, :, 2] > height
    crossed = above.any(axis=1) & ~above.all(axis=1)
    corners, above = triangles[crossed], above[crossed]
    lone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    rows = np.arange(len(corners))
    tip, one, other = corners[rows, lone], corners[rows, (lone + 1) % 3], corners[rows, (lone + 2) % 3]
    found = np.stack([_at_level(tip, one, height), _at_level(tip, other, height)], axis=1)
    return found[np.linalg.norm(found[:, 1] - found[:, 0], axis=1) > _SHORTEST]


def section(triangles: Float[np.ndarray, "n 3 3"], heights: Iterable[float], metre: float) -> BaseGeometry:
    """Returns what triangles cross at some levels: their lines widened to a hair, loops filled by `filled` alone."""
    lines = np.concatenate([section_lines(triangles, z) for z in heights])
    if not len(lines):
        return EMPTY
    return shapely.union_all(shapely.polygons(_widened(_few(lines, metre), _HAIR * metre)))


def _widened(lines: Fewer, half: float) -> Float[np.ndarray, "f 4 2"]:
    """Returns the rectangle around each line, `half` wider on all four sides."""
    along = lines[:, 1] - lines[:, 0]
    along = half * along / np.linalg.norm(along, axis=1, keepdims=True)
    left = np.stack([-along[:, 1], along[:, 0]], axis=1)
    a, b = lines[:, 0] - along, lines[:, 1] + along
    return np.stack([a - left, b - left, b + left, a + left], axis=1)


def _few(lines: Segments, metre: float) -> Fewer:
    """Returns distinct lines, their ends as exact as not too many allow: shorter ones vanish in their neighbours."""
    for step in _STEPS:
        ends = np.round(lines / (step * metre)).astype(np.int64)
        swapped = (ends[:, 0, 0] > ends[:, 1, 0]) | ((ends[:, 0, 0] == ends[:, 1, 0]) & (ends[:, 0, 1] > ends[:, 1, 1]))
        ends[swapped] = ends[swapped][:, ::-1]
        rows = np.unique(ends.reshape(-1, 4), axis=0)
        rows = rows[(rows[:, :2] != rows[:, 2:]).any(axis=1)]
        found = rows.reshape(-1, 2, 2) * (step * metre)
        if len(found) <= _MANY:
            break
    return found


def filled(shape: BaseGeometry) -> BaseGeometry:
    """Returns a shape without its holes."""
    return shapely.union_all([Polygon(p.exterior) for p in polygons_in(shape)]) if not shape.is_empty else EMPTY


def closed_up(shape: BaseGeometry, width: float) -> BaseGeometry:
    """Returns a shape without holes, and without bays and gaps up to `width` metres wide; corners stay sharp."""
    plain = shapely.union_all([_plain(p, 0.1 * width) for p in polygons_in(shape)])
    closed = offset(filled(offset(plain, 0.5 * width)), -0.5 * width)
    return filled(closed.intersection(shapely.convex_hull(plain)))  # slips of a hair beget spikes beyond it


def offset(shape: BaseGeometry, distance: float) -> BaseGeometry:
    """Returns a shape with its edges moved outwards by a distance, corners of 60 degrees on sharp."""
    with np.errstate(invalid="ignore", divide="ignore"):  # of edges that meet at no angle, which come out right
        moved = shape.buffer(distance, join_style="mitre", mitre_limit=_SHARPEST)
    return moved if moved.is_valid else shapely.union_all(polygons_in(shapely.make_valid(moved)))


def _plain(polygon: Polygon, small: float) -> BaseGeometry:
    """Returns a polygon without holes; a turned leg or another small one as its convex hull."""
    low_x, low_y, high_x, high_y = polygon.bounds
    return polygon.convex_hull if max(high_x - low_x, high_y - low_y) <= small else Polygon(polygon.exterior)


def solid(shape: BaseGeometry, width: float) -> BaseGeometry:
    """Returns a section with what lies between lines up to `width` metres apart filled: boards, not rooms."""
    return offset(offset(shape, 0.5 * width), -0.5 * width)


def without_slivers(shape: BaseGeometry, width: float) -> BaseGeometry:
    """Returns a shape without tongues narrower than `width` metres; corners stay sharp."""
    return offset(offset(shape, -0.5 * width), 0.5 * width).intersection(shape)


def thinned(shape: BaseGeometry, metre: float) -> BaseGeometry:
    """Returns a shape less the hair's width that `section` gave it."""
    return offset(shape, -_HAIR * metre)


def polygons_in(shape: BaseGeometry) -> list[Polygon]:
    """Returns the polygons of a shape that have an area."""
    if isinstance(shape, Polygon):
        return [shape] if shape.area > 0 else []
    return [p for g in getattr(shape, "geoms", ()) for p in polygons_in(g)] if not shape.is_empty else []


def _at_level(a: Float[np.ndarray, "n 3"], b: Float[np.ndarray, "n 3"], height: float) -> Float[np.ndarray, "n 2"]:
    share = (height - a[:, 2]) / (b[:, 2] - a[:, 2])
    return a[:, :2] + share[:, None] * (b[:, :2] - a[:, :2])
