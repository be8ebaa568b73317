"""Unions of polygons that do not fail where their corners nearly meet."""

from collections.abc import Iterable
from typing import Final

import shapely
from shapely.geometry.base import BaseGeometry

_GRID: Final = 1e-7  # metres


def united(shapes: Iterable[BaseGeometry]) -> BaseGeometry:
    """Returns the union of shapes; where corners that nearly meet defeat GEOS, of these on a grid of 0.1 micrometres.

    Edges that cross at an angle near zero make GEOS fail (`TopologyException`), unless it rounds all corners.
    """
    parts = list(shapes)
    try:
        return shapely.union_all(parts)
    except shapely.GEOSException:
        return shapely.union_all(parts, grid_size=_GRID)
