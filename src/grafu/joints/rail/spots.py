"""Where rails may go on a drawer: mounts, heights and thicknesses that the flanks and walls allow. It sweeps nothing.

Rails are described on the left side (-x) of the drawer frame; the right one is the mirror image.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.geometry.raycast import RayCaster
from grafu.joints.config import RailConfig
from grafu.joints.rail.body_region import BodyRegion, DrawerFrame
from grafu.templates.template import RailModel, RailSize
from grafu.vocabulary import MechanismClass

_GRID = (12, 5)
_STEPS = 61  # places behind it at which a board above it is felt for
_LEVELS = 7  # heights at which the room behind a mere front is felt for


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
class FlankGaps:
    """The gap in metres from each flank outwards to the static body; infinity where no wall is in reach.

    `passage` is the narrowest that the drawer's path leaves beside it: a face frame may stand in before the walls.
    """

    left: float
    right: float
    passage: float

    @property
    def nearer(self) -> float:
        """The smaller gap."""
        return min(self.left, self.right)


def flank_gaps(frame: DrawerFrame, body: BodyRegion, static: RayCaster, reach: float) -> FlankGaps:
    """Returns how far the walls are, seen from within both flanks; negative where the drawer cuts into one."""
    margin = 0.05 * body.length
    beside = [
        _gaps(frame, body, static, reach, (body.front + margin, body.back - margin), sign) for sign in (-1.0, 1.0)
    ]
    left, right = (float(g[len(g) // 10]) if len(g) >= 0.2 * _GRID[0] * _GRID[1] else float("inf") for g in beside)
    ahead = [_gaps(frame, body, static, reach, (-0.02 - 0.1 * body.length, body.front), sign) for sign in (-1.0, 1.0)]
    passage = min((float(g[0]) for g in (*ahead, *beside) if len(g)), default=float("inf"))
    return FlankGaps(left, right, max(passage, 0.0))


def _gaps(
    frame: DrawerFrame, body: BodyRegion, static: RayCaster, reach: float, span: tuple[float, float], sign: float
) -> np.ndarray:
    """Returns the gaps from one flank (sign of x) to the static body over a span of y, ascending, those in reach."""
    y, z = np.meshgrid(
        np.linspace(*span, _GRID[0]),
        np.linspace(0.8 * body.bottom + 0.2 * body.top, 0.2 * body.bottom + 0.8 * body.top, _GRID[1]),
    )
    inside = min(0.01, 0.2 * body.half_width)
    x = np.full(y.size, body.middle + sign * (body.half_width - inside))
    origins = frame.to_object(np.column_stack([x, y.ravel(), z.ravel()]))
    distances = np.sort(static.along(origins, sign * frame.rotation[:, 0]))
    return distances[distances <= reach + inside] - inside


def rail_spots(
    model: RailModel, body: BodyRegion, gaps: FlankGaps, ratio: float, config: RailConfig
) -> Iterator[RailSpot]:
    """Yields spots for one model, best first: at full thickness and inset, at the middle of the flank, then elsewhere.

    `ratio` is the rail's length over the body's (supplement, Scaling).
    """
    flank = body.top - body.bottom
    length = ratio * body.length
    y = body.front + length / 2 if body.is_front_only else body.back - length / 2
    for thickness in _thicknesses(model, gaps, config):
        tight = (thickness - min(max(gaps.nearer, 0.0), thickness)) / 2
        inset = min(max(tight, config.dynamic_reach * thickness - gaps.passage, 0.0), config.most_inset * thickness)
        height = max(min(model.natural.height, 0.6 * flank, 4.0 * thickness + 0.01), min(config.lowest, flank))
        for z in _heights_on(model, body, height):
            size = RailSize(length, height, thickness)
            yield RailSpot(size, body.left - thickness + inset, y, z)


def _heights_on(model: RailModel, body: BodyRegion, height: float) -> list[float]:
    """Returns the z to try: the flank's middle and around it, or a corner mount's, its shelf under the drawer.

    A corner mount's support plane lies at its lower edge and must meet the underside (supplement, eq. rail priors).
    """
    lowest, highest = body.bottom + height / 2, body.top - height / 2
    if model.mechanism is MechanismClass.CORNER:
        return [lowest]
    flank = body.top - body.bottom
    return [min(max(body.bottom + level * flank, lowest), highest) for level in (0.5, 0.3, 0.7, 0.15, 0.85)]


def _thicknesses(model: RailModel, gaps: FlankGaps, config: RailConfig) -> list[float]:
    """Returns the thicknesses to try: what gap and passage hold, then thinner ones that are inset."""
    full = min(model.natural.thickness, gaps.nearer)
    through = min(full, gaps.passage / (config.dynamic_reach - config.most_inset))
    fitting = [t for t in (full, min(full, gaps.passage), through, through / 2) if t > config.thinnest]
    return [*dict.fromkeys(fitting), config.thinnest, *((0.0018, 0.001) if through <= config.thinnest else ())]


def front_only_region(frame: DrawerFrame, static: RayCaster, reach: float, rail: float) -> BodyRegion | None:
    """Returns the region behind a front without a container, where rails can run along the walls; None if too shallow.

    Its flanks stand one rail's thickness (`rail`, metres) inside the walls, but never outside the front.
    """
    front_depth = frame.depth
    inset = 0.02 * frame.width
    z, depth = _free_behind(frame, static, front_depth + 1e-3, reach)
    if depth < 0.5 * frame.height:
        return None
    deep = (front_depth + np.array([0.005, 0.015, 0.4 * depth])).tolist()  # a face frame leaves the narrowest passage
    sides = [_reach_along(frame, static, (0.0, y), z, 0, reach, sign) for y in deep for sign in (-1.0, 1.0)]
    half = min(*sides, frame.width / 2 - inset) - rail
    if half <= 0.1 * frame.width:
        return None
    start = front_depth - 2e-4
    return BodyRegion(-half, half, start, start + depth, float(z[0]), float(z[-1]), True)


def _free_behind(frame: DrawerFrame, static: RayCaster, start: float, reach: float) -> tuple[np.ndarray, float]:
    """Returns the heights behind a front at which it is free to the back, and how deep, metres; 0 where nowhere.

    A front may overlap the case's boards above and below: the longest run of heights that are as free as the middle.
    """
    z = np.linspace(-0.3, 0.3, _LEVELS) * frame.height
    depths = np.array([_reach_along(frame, static, (0.0, start), z[k : k + 1], 1, reach) for k in range(_LEVELS)])
    middle = float(depths[_LEVELS // 2])
    if not np.isfinite(middle):
        middle = _covered(frame, static, start, reach) / 2  # another front may stand on the far side
    shallow = np.flatnonzero(depths < 0.8 * middle)
    low = int(max(shallow[shallow < _LEVELS // 2], default=-1)) + 1
    high = int(min(shallow[shallow > _LEVELS // 2], default=_LEVELS)) - 1
    return z[low : high + 1], min(middle, float(depths[low : high + 1].min())) - 0.01


def _covered(frame: DrawerFrame, static: RayCaster, start: float, reach: float) -> float:
    """Returns how deep behind a front something stands above it without a gap: a table top, where there is no back."""
    steps = start + np.linspace(0.0, reach, _STEPS)
    origins = frame.to_object(np.column_stack([np.zeros(_STEPS), steps, np.zeros(_STEPS)]))
    met = static.along(origins, frame.rotation[:, 2]) <= 1.5 * frame.height
    return float(steps[int(np.argmin(met))] - start) if not met.all() else reach


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
