"""Where rails may go on a drawer: mounts, heights and thicknesses that the flanks and walls allow. It sweeps nothing.

Rails are described on the left side (-x) of the drawer frame; the right one is the mirror image.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.geometry.raycast import RayCaster
from grafu.realization.rail.body_region import BodyRegion, DrawerFrame
from grafu.templates.template import RailModel, RailSize

_THINNEST = 0.0025  # thinner rails are let into the flank and the wall by what is missing
_LOWEST = 0.004
_GRID = (12, 5)


@final
@dataclass(frozen=True, slots=True)
class RailSpot:
    """A pair of rails: size, and the left rail's origin (x, y, z) in the drawer frame."""

    size: RailSize
    x: float
    y: float
    z: float


@final
@dataclass(frozen=True, slots=True)
class Walls:
    """The gap in metres from each flank outwards to the static body; infinity where no wall is in reach."""

    left: float
    right: float

    @property
    def nearer(self) -> float:
        """The smaller gap."""
        return min(self.left, self.right)


def find_walls(frame: DrawerFrame, body: BodyRegion, static: RayCaster, reach: float) -> Walls:
    """Returns how far the walls are, seen from within both flanks; negative where the drawer cuts into one."""
    y, z = np.meshgrid(
        np.linspace(body.front + 0.05 * body.length, body.back - 0.05 * body.length, _GRID[0]),
        np.linspace(0.8 * body.bottom + 0.2 * body.top, 0.2 * body.bottom + 0.8 * body.top, _GRID[1]),
    )
    inside = min(0.01, 0.2 * body.half_width)
    gaps = []
    for sign in (-1.0, 1.0):
        x = np.full(y.size, sign * (body.half_width - inside))
        origins = frame.to_object(np.column_stack([x, y.ravel(), z.ravel()]))
        distances = np.sort(static.along(origins, sign * frame.rotation[:, 0]))
        distances = distances[distances <= reach + inside]
        enough = len(distances) >= 0.2 * y.size
        gaps.append(float(distances[len(distances) // 10]) - inside if enough else float("inf"))
    return Walls(*gaps)


def rail_spots(model: RailModel, body: BodyRegion, walls: Walls, share: float) -> Iterator[RailSpot]:
    """Yields spots for one model, best first: at full thickness and let in, at the middle of the flank, then elsewhere.

    `share` is the rail's length over the body's (supplement, Scaling).
    """
    flank = body.top - body.bottom
    length = share * body.length
    for thickness in _thicknesses(model, walls.nearer):
        let_in = max(0.0, thickness - max(walls.nearer, 0.0)) / 2
        height = max(min(model.natural.height, 0.6 * flank, 4.0 * thickness + 0.01), min(_LOWEST, flank))
        for level in (0.5, 0.3, 0.7, 0.15, 0.85):
            z = body.bottom + level * flank
            z = min(max(z, body.bottom + height / 2), body.top - height / 2)
            size = RailSize(length, height, thickness)
            yield RailSpot(size, -body.half_width - thickness + let_in, body.back - length / 2, z)


def _thicknesses(model: RailModel, gap: float) -> list[float]:
    """Returns the thicknesses to try: what the gap holds, then thinner ones that are let in."""
    natural = model.natural.thickness
    if gap >= natural:
        return [natural, natural / 2, _THINNEST]
    if gap > _THINNEST:
        return [gap, gap / 2, _THINNEST]
    return [_THINNEST, 0.0015, 0.001]


def front_only_region(
    frame: DrawerFrame, front_depth: float, static: RayCaster, reach: float, thickness: float
) -> BodyRegion | None:
    """Returns the region behind a front without a container, where rails can run along the walls; None if too shallow.

    Its flanks stand one rail's thickness inside the walls, but never outside the front.
    """
    inset = 0.02 * frame.width
    z = np.linspace(-0.3, 0.3, 5) * frame.height
    back = _reach_along(frame, static, (0.0, front_depth + 1e-3), z, 1, reach)
    depth = min(back, reach) - 0.01
    if not np.isfinite(back) or depth < 0.5 * frame.height:
        return None
    middle = front_depth + 0.4 * depth
    sides = [_reach_along(frame, static, (0.0, middle), z, 0, reach, sign) for sign in (-1.0, 1.0)]
    half = min(*sides, frame.width / 2 - inset) - thickness
    if half <= 0.1 * frame.width:
        return None
    start = front_depth - 2e-4
    return BodyRegion(half, start, start + depth, -0.3 * frame.height, 0.3 * frame.height)


def _reach_along(
    frame: DrawerFrame,
    static: RayCaster,
    start: tuple[float, float],
    z: np.ndarray,
    axis: int,
    reach: float,
    sign: float = 1.0,
) -> float:
    """Returns the least distance from (x, y) along +-X or +Y to the static body."""
    origins = frame.to_object(np.column_stack([np.full(len(z), start[0]), np.full(len(z), start[1]), z]))
    distances = static.along(origins, sign * frame.rotation[:, axis])
    distances = distances[distances <= reach]
    return float(distances.min()) if len(distances) else float("inf")
