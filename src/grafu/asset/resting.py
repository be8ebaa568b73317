"""What a piece without labels rests on, and whether another of its six sides is the one that it stands on.

Coordinates are the input's; directions are spelled like `-Y`. No label and no joint is asked.
"""

from collections.abc import Sequence
from typing import final

import numpy as np

from grafu.asset.options import DIRECTIONS
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, distinct, extremes
from grafu.geometry.config_checks import require_positive
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.sampling import sample_surface
from grafu.shapes import Float, Int

_Places = Float[np.ndarray, "n 2"]
_Cells = Int[np.ndarray, "n 2"]


@final
@dataclass(frozen=True, slots=True)
class RestConfig:
    """When the shape alone tells that a piece stands on another side than the stated one.

    A table has a broad top over slender legs; what lies on its face rests on its handles. 137 models of five sources
    as they stand keep their direction with these numbers.

    Raises:
        ValueError: if a number is not above 0.
    """

    points: int = 20000
    """Points that are spread over the surface."""
    cells: int = 48
    """Cells along each side of the outline seen from above."""
    near: float = 0.015
    """How far from an end of the piece a point touches the floor there (fraction of the largest side)."""
    poor: float = 0.3
    """Extent of what touches the floor below which a piece does not rest there (fraction of its outline's box) ..."""
    steady: float = 0.6
    """... and from which on it does."""
    slender: float = 0.15
    """Area of what touches the floor up to which it may be legs (fraction of the outline's box)."""
    broad: float = 0.3
    """Area at the other end from which on that is a top over legs (fraction of the outline's box) ..."""
    whole: float = 0.8
    """... where it also has this extent (fraction of the outline's box)."""
    corner: float = 0.25
    """How far from two sides of the outline legs in its corners stand at most (fraction of these sides) ..."""
    long: float = 0.05
    """... and how long they are at least: handles stand out less far (fraction of the largest side)."""
    kick: float = 0.8
    """A plinth or a grille in front reaches over this much of one side of the outline at least (fraction) ..."""
    border: float = 0.25
    """... within this of the border (fraction of the other side) ..."""
    spans: int = 12
    """... in each of so many spans of that side: the handles of a row of fronts leave spans free."""
    over_handles: float = 0.5
    """Area within that length of an end from which on what lies at it are no legs but handles on fronts (fraction of
    the outline's box)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class _End:
    """What lies at one end of a piece: its area and the area of the box around it, over that of the outline's box."""

    area: float
    extent: float
    has_corner_legs: bool = False
    """Whether it lies in all four corners and nowhere else, with nothing between for the length of a leg."""
    area_beside: float = 0.0
    """The area of what lies within the length of a leg from that end."""
    is_plinth: bool = False
    """Whether it lies along one border of the outline: a plinth or a grille, and the bottom ends right above it."""


def stands_on_another_side(
    parts: Sequence[Part], stated: str, usual: str, config: RestConfig = RestConfig()
) -> str | None:
    """Returns the upward direction that the shape tells instead of the stated one; None: that one holds.

    Another direction is believed where it alone has legs below a broad top, and the piece stands on its head, or rests
    on little and these are no handles on fronts; where it alone has long legs in the four corners; or, where the piece
    rests on little, `usual`, the direction that other formats have up, if it rests on that and no handles on fronts
    would be on top.

    Args:
        parts: the parts, in the input's coordinates.
        stated: the direction that is up by the format.
        usual: the direction that is up in formats of the other kind.
        config: when the shape tells.
    """
    points = sample_surface(merge_meshes([part.mesh for part in parts]), config.points).points
    ends = {direction: _end(points, direction, config) for direction in DIRECTIONS}
    below = ends[_opposite(stated)]
    is_poor = below.extent < config.poor and not (below.is_plinth and below.area_beside >= config.broad)
    on_legs = [up for up in DIRECTIONS if up != stated and _is_on_legs(ends[_opposite(up)], ends[up], config)]
    if len(on_legs) == 1:
        on_handles = _has_handles(ends[_opposite(on_legs[0])], config)
        if on_legs[0] == _opposite(stated) or (is_poor and not on_handles):
            return on_legs[0]
    in_corners = [up for up in DIRECTIONS if ends[_opposite(up)].has_corner_legs]
    if len(in_corners) == 1 and in_corners[0] in on_legs:
        return in_corners[0]
    is_steady = all(ends[end].extent >= config.steady for end in (usual, _opposite(usual)))
    is_better = is_steady and not _has_handles(ends[usual], config) and usual != stated
    return usual if is_poor and is_better else None


def _opposite(direction: str) -> str:
    return ("-" if direction[0] == "+" else "+") + direction[1]


def _has_handles(end: _End, config: RestConfig) -> bool:
    """Whether little lies at an end and much within the length of a leg from it: fronts with handles."""
    return end.area <= config.slender and end.area_beside >= config.over_handles


def _is_on_legs(bottom: _End, top: _End, config: RestConfig) -> bool:
    has_legs = bottom.extent >= config.steady and bottom.area <= config.slender
    return has_legs and top.area >= config.broad and top.extent >= config.whole


def _end(points: Points, direction: str, config: RestConfig) -> _End:
    axis = "XYZ".index(direction[1])
    low, high = extremes(points)
    size = high - low
    gap = high[axis] - points[:, axis] if direction[0] == "+" else points[:, axis] - low[axis]
    others = [other for other in range(3) if other != axis]
    at = points[gap < config.near * size.max()][:, others]
    ratio = (at - low[others]) / np.maximum(size[others], 1e-12)
    if not len(ratio):
        return _End(0.0, 0.0)
    rows, columns = _cells(ratio, config).T
    extent = int(np.ptp(rows) + 1) * int(np.ptp(columns) + 1)
    area = _area(ratio, config)
    outer = (ratio < config.corner) | (ratio > 1.0 - config.corner)
    corners = {*map(tuple, (ratio > 0.5).tolist())}
    beside = points[gap < config.long * size.max()][:, others]
    is_long = bool(
        (
            (beside - low[others] < config.corner * size[others])
            | (high[others] - beside < config.corner * size[others])
        ).all()
    )
    in_corners = bool(outer.all()) and len(corners) == 4 and is_long
    area_beside = _area((beside - low[others]) / np.maximum(size[others], 1e-12), config)
    return _End(area, float(extent) / config.cells**2, in_corners, area_beside, _is_plinth(ratio, config))


def _is_plinth(ratio: _Places, config: RestConfig) -> bool:
    """Whether places, fractions of both sides of the outline, lie along nearly the whole of one of its borders."""
    low, high = extremes(ratio)
    at_border = (high <= config.border) | (low >= 1.0 - config.border)
    spans = [len(distinct((along * config.spans).astype(np.int64))) for along in np.minimum(ratio, 0.999).T]
    return bool(((np.array(spans) >= config.kick * config.spans) & at_border[::-1]).any())


def _cells(ratio: _Places, config: RestConfig) -> _Cells:
    """Returns row and column of the cell of each place, a fraction of both sides of the outline."""
    return np.minimum((ratio * config.cells).astype(np.int64), config.cells - 1)


def _area(ratio: _Places, config: RestConfig) -> float:
    """Returns the area of the cells that have a place in them, over that of the outline's box."""
    row, column = _cells(ratio, config).T
    return float(np.count_nonzero(np.bincount(row * config.cells + column)) / config.cells**2)
