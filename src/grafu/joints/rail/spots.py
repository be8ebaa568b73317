"""Where rails may go on a drawer: mounts, heights and thicknesses that the flanks and walls allow. It sweeps nothing.

Rails are described on the left side (-x) of the drawer frame; the right one is the mirror image.
"""

from collections.abc import Iterator
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.raycast import RayCaster
from grafu.joints.rail.body_region import BodyRegion, DrawerFrame
from grafu.joints.rail_config import BehindConfig, FlankConfig, RailConfig
from grafu.templates.template import RailModel, RailSize
from grafu.vocabulary import MechanismClass


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


def flank_gaps(frame: DrawerFrame, body: BodyRegion, static: RayCaster, reach: float, config: FlankConfig) -> FlankGaps:
    """Returns how far the walls are, seen from within both flanks; negative where the drawer cuts into one."""
    margin, ahead_of = config.margin * body.length, (-config.ahead - config.ahead_length * body.length, body.front)
    along = (body.front + margin, body.back - margin)
    beside, ahead = (
        [_gaps(frame, body, static, reach, span, sign, config) for sign in (-1.0, 1.0)] for span in (along, ahead_of)
    )
    least = config.met * config.along * config.up
    left, right = (float(g[len(g) // config.narrow]) if len(g) >= least else float("inf") for g in beside)
    passage = min((float(g[0]) for g in (*ahead, *beside) if len(g)), default=float("inf"))
    return FlankGaps(left, right, max(passage, 0.0))


def _gaps(
    frame: DrawerFrame,
    body: BodyRegion,
    static: RayCaster,
    reach: float,
    span: tuple[float, float],
    sign: float,
    config: FlankConfig,
) -> np.ndarray:
    """Returns the gaps from one flank (sign of x) to the static body over a span of y, ascending, those in reach."""
    edge = config.margin_height
    low, high = (1 - edge) * body.bottom + edge * body.top, edge * body.bottom + (1 - edge) * body.top
    y, z = np.meshgrid(np.linspace(*span, config.along), np.linspace(low, high, config.up))
    inside = min(config.inside, config.inside_width * body.half_width)
    x = np.full(y.size, body.middle + sign * (body.half_width - inside))
    origins = frame.to_object(np.column_stack([x, y.ravel(), z.ravel()]))
    distances = np.sort(static.along(origins, sign * frame.rotation[:, 0]))
    return distances[distances <= reach + inside] - inside


def rail_spots(
    model: RailModel, body: BodyRegion, gaps: FlankGaps, ratio: float, config: RailConfig
) -> Iterator[RailSpot]:
    """Yields spots for one model, best first: at full thickness and inset, at the middle of the flank, then elsewhere.

    `ratio` is the rail's length over the body's (supplement, Scaling). A body that is a mere sheet has no flanks.
    """
    flank = body.top - body.bottom
    if flank < config.thinnest:
        return
    length = ratio * body.length
    y = body.front + length / 2 if body.is_front_only else body.back - length / 2
    for thickness in _thicknesses(model.natural.thickness, gaps, config):
        tight = (thickness - min(max(gaps.nearer, 0.0), thickness)) / 2
        inset = min(max(tight, config.dynamic_reach * thickness - gaps.passage, 0.0), config.most_inset * thickness)
        slender = config.flank.slender * thickness + config.flank.taller
        highest = min(model.natural.height, config.flank.highest * flank, slender)
        height = max(highest, min(config.lowest, flank))
        for z in _heights_on(model, body, height, config.flank):
            size = RailSize(length, height, thickness)
            yield RailSpot(size, body.left - thickness + inset, y, z)


def _heights_on(model: RailModel, body: BodyRegion, height: float, config: FlankConfig) -> list[float]:
    """Returns the z to try: the flank's middle and around it, or a corner mount's, its shelf under the drawer.

    A corner mount's support plane lies at its lower edge and must meet the underside (supplement, eq. rail priors).
    """
    lowest, highest = body.bottom + height / 2, body.top - height / 2
    if model.mechanism is MechanismClass.CORNER:
        return [lowest]
    flank = body.top - body.bottom
    return [min(max(body.bottom + level * flank, lowest), highest) for level in config.heights]


def _thicknesses(natural: float, gaps: FlankGaps, config: RailConfig) -> list[float]:
    """Returns the thicknesses to try: what gap and passage hold, then thinner ones that are inset."""
    full = min(natural, gaps.nearer)
    through = min(full, gaps.passage / (config.dynamic_reach - config.most_inset))
    fitting = [t for t in (full, min(full, gaps.passage), through, through / 2) if t > config.thinnest]
    return [*dict.fromkeys(fitting), config.thinnest, *(config.flank.thinner if through <= config.thinnest else ())]


def front_only_region(frame: DrawerFrame, static: RayCaster, reach: float, rails: RailConfig) -> BodyRegion | None:
    """Returns the region behind a front without a container, where rails can run along the walls; None if too shallow.

    Its flanks stand one rail's usual thickness inside the walls, but never outside the front.
    """
    front_depth, config = frame.depth, rails.behind
    inset = config.inset * frame.width
    z, depth = _free_behind(frame, static, front_depth + config.start, reach, config)
    if depth < config.shallow * min(frame.width, frame.height):
        return None
    deep = (front_depth + np.array([*config.near, config.deep * depth])).tolist()
    sides = [_reach_along(frame, static, (0.0, y), z, 0, reach, sign) for y in deep for sign in (-1.0, 1.0)]
    half = min(*sides, frame.width / 2 - inset) - rails.common
    if half <= config.narrow * frame.width:
        return None
    start = front_depth + config.seam
    return BodyRegion(-half, half, start, start + depth, float(z[0]), float(z[-1]), True)


def _free_behind(
    frame: DrawerFrame, static: RayCaster, start: float, reach: float, config: BehindConfig
) -> tuple[np.ndarray, float]:
    """Returns the heights behind a front at which it is free to the back, and how deep, metres; 0 where nowhere.

    A front may overlap the case's boards above and below: the longest run of heights that are as free as the middle.
    """
    count, half = config.heights, config.heights // 2
    z = np.linspace(-config.span, config.span, count) * frame.height
    depths = np.array([_reach_along(frame, static, (0.0, start), z[k : k + 1], 1, reach) for k in range(count)])
    middle = float(depths[half])
    if not np.isfinite(middle):
        middle = _covered(frame, static, start, reach, config) / 2  # another front may stand on the far side
    shallow = np.flatnonzero(depths < config.as_deep * middle)
    low = int(max(shallow[shallow < half], default=-1)) + 1
    high = int(min(shallow[shallow > half], default=count)) - 1
    return z[low : high + 1], min(middle, float(depths[low : high + 1].min())) - config.air


def _covered(frame: DrawerFrame, static: RayCaster, start: float, reach: float, config: BehindConfig) -> float:
    """Returns how deep behind a front something stands above it without a gap: a table top, where there is no back."""
    steps = start + np.linspace(0.0, reach, config.steps)
    origins = frame.to_object(np.column_stack([np.zeros_like(steps), steps, np.zeros_like(steps)]))
    met = static.along(origins, frame.rotation[:, 2]) <= config.covered * frame.height
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
