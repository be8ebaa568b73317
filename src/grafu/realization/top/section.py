"""Level sections of triangles as plane polygons, and how polygons are closed up. It knows no parts.

Real furniture is full of sheets without thickness and boards that are open somewhere, so a section is taken as lines
of a hair's width, not as the inside of loops.
"""

from collections.abc import Iterable

import numpy as np
import shapely
from jaxtyping import Float
from shapely.geometry import MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

Segments = Float[np.ndarray, "n 2 2"]

_HAIR = 5e-4  # metres: half the width of a section's lines
_SHORTEST = 1e-7  # metres
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
    lines = np.unique(np.round(lines / (1e-5 * metre)), axis=0) * (1e-5 * metre)
    drawn = shapely.unary_union(shapely.linestrings(lines))
    return drawn.buffer(_HAIR * metre, cap_style="square", join_style="mitre")


def filled(shape: BaseGeometry) -> BaseGeometry:
    """Returns a shape without its holes."""
    return shapely.union_all([Polygon(p.exterior) for p in polygons_in(shape)]) if not shape.is_empty else EMPTY


def closed_up(shape: BaseGeometry, width: float) -> BaseGeometry:
    """Returns a shape without holes, and without bays and gaps up to `width` metres wide; corners stay sharp."""
    grown = filled(shape.buffer(0.5 * width, join_style="mitre"))
    return filled(grown.buffer(-0.5 * width, join_style="mitre"))


def without_slivers(shape: BaseGeometry, width: float) -> BaseGeometry:
    """Returns a shape without tongues narrower than `width` metres; corners stay sharp."""
    return shape.buffer(-0.5 * width, join_style="mitre").buffer(0.5 * width, join_style="mitre").intersection(shape)


def thinned(shape: BaseGeometry, metre: float) -> BaseGeometry:
    """Returns a shape less the hair's width that `section` gave it."""
    return shape.buffer(-_HAIR * metre, join_style="mitre")


def polygons_in(shape: BaseGeometry) -> list[Polygon]:
    """Returns the polygons of a shape that have an area."""
    if isinstance(shape, Polygon):
        return [shape] if shape.area > 0 else []
    return [p for g in getattr(shape, "geoms", ()) for p in polygons_in(g)] if not shape.is_empty else []


def as_shape(polygons: Iterable[Polygon]) -> BaseGeometry:
    """Returns polygons that do not overlap as one shape."""
    return MultiPolygon(list(polygons))


def _at_level(a: Float[np.ndarray, "n 3"], b: Float[np.ndarray, "n 3"], height: float) -> Float[np.ndarray, "n 2"]:
    share = (height - a[:, 2]) / (b[:, 2] - a[:, 2])
    return a[:, :2] + share[:, None] * (b[:, :2] - a[:, :2])
