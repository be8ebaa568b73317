"""What parts say beyond the two maps: basins that hang at the rim, tops by name, plates with cut-outs, bars.

The maps alone cannot tell a worktop with a hole for a sink from a frame of bars, nor a basin from a cabinet.
"""

from collections.abc import Iterable

import numpy as np
from shapely import MultiPoint

from grafu.additions.top.config import EvidenceConfig, TopConfig
from grafu.additions.top.coverage import Coverage
from grafu.additions.top.height_map import CellMask, grown, heights_of
from grafu.additions.top.roles import Roles
from grafu.additions.top.tap_config import TapConfig
from grafu.additions.top.views import Views
from grafu.asset.part import Part
from grafu.geometry.box import Box
from grafu.shapes import Float
from grafu.vocabulary import PartLabel

NAMELESS_LABELS = (PartLabel.MISC, PartLabel.UNKNOWN)
STRIP_LABELS = (PartLabel.BAR, PartLabel.FACE_FRAME, PartLabel.LEG, PartLabel.SIDE_PANEL, PartLabel.BACK_PANEL)


def bowls_of(roles: Roles, config: EvidenceConfig, metre: float) -> tuple[Part, ...]:
    """Returns the still, nameless parts that are as deep as basins."""
    low, high = config.shallowest_basin * metre, config.deepest_basin * metre
    return tuple(p for p in roles.still if p.label in NAMELESS_LABELS and low <= p.box.size[2] <= high)


def basins_of(
    bowls: Iterable[Part], views: Views, coverage: Coverage, config: EvidenceConfig, metre: float
) -> tuple[Part, ...]:
    """Returns the bowls that hang at a rim, well within what stands there; views and coverage are without them."""
    return tuple(p for p in bowls if _is_basin(p, views, coverage, config, metre))


def cells_of(parts: Iterable[Part], views: Views) -> CellMask:
    """Returns the cells that parts cover, however high."""
    mask = np.zeros(views.grid.shape, dtype=bool)
    for part in parts:
        mask |= np.isfinite(heights_of(part.mesh.triangles, views.grid))
    return mask


def named_cells(roles: Roles, views: Views, coverage: Coverage, config: EvidenceConfig, metre: float) -> CellMask:
    """Returns the cells covered by parts that are called top panels and lie not too far below the rim."""
    assert coverage.level is not None
    high = coverage.level - config.inset * metre
    named = [p for p in roles.still if p.label is PartLabel.TOP_PANEL and p.box.high[2] >= high]
    mask = np.zeros(views.grid.shape, dtype=bool)
    for part in named:
        mask |= heights_of(part.mesh.triangles, views.grid) >= high
    return mask


def plate_in(roles: Roles, views: Views, coverage: Coverage, config: TopConfig, metre: float) -> Part | None:
    """Returns a still, flat part that spans what stands at the rim, holes or not; None where only bars do."""
    assert coverage.level is not None
    own, flat = config.evidence, config.evidence.flat * metre
    low, high = coverage.level - config.recess * metre, coverage.level + flat
    for part in roles.still:
        if part.label in STRIP_LABELS or not low <= part.box.high[2] <= high or part.box.size[2] > flat:
            continue
        held = np.isfinite(heights_of(part.mesh.triangles, views.grid))
        spanned = _within(part.box, views)
        ratio = float(held.sum()) / max(int(spanned.sum()), 1)
        least = own.named_plate if part.label is PartLabel.TOP_PANEL else own.plate
        if ratio >= least and (spanned & coverage.everything).sum() >= own.spans * coverage.everything.sum():
            return part
    return None


def basin_with_tap(
    roles: Roles, coverage: Coverage, config: EvidenceConfig, metre: float, tap: TapConfig = TapConfig()
) -> tuple[Part, Part] | None:
    """Returns the still part that one looks into and that has a bottom of its own, and what stands over it; else None.

    A door or a drawer beside it states that it is a case, whose top is missing.
    """
    level, opened, grid = coverage.level, coverage.opened, coverage.grid
    assert level is not None
    deep = level - tap.shallowest * metre
    for part in roles.still:
        if abs(float(part.box.high[2]) - level) > config.basin_below * metre:
            continue
        own = heights_of(part.mesh.triangles, grid)[opened]
        bottom = (own <= deep) & (own >= level - config.deepest_basin * metre)
        if not bottom.any() or bottom.sum() < tap.bottom * len(own):
            continue
        low = float(own[bottom].min())
        if any(moves.mesh.box.low[2] < deep and moves.mesh.box.high[2] > low for moves in roles.moving):
            continue
        over = next((p for p in roles.still if _is_tap(p, part.box, coverage, tap, metre)), None)
        if over is not None:
            return part, over
    return None


def vessel_in(
    roles: Roles, coverage: Coverage, config: EvidenceConfig, metre: float, tap: TapConfig = TapConfig()
) -> Part | None:
    """Returns the still part of round plan with a bottom of its own that one looks into: a tub, a pot; else None.

    Doors and drawers state that it is a case, whose top is missing.
    """
    if roles.moving or coverage.level is None:
        return None
    for part in roles.still:
        if abs(float(part.box.high[2]) - coverage.level) > config.basin_below * metre:
            continue
        own = heights_of(part.mesh.triangles, coverage.grid)
        bottom = own[coverage.opened] <= coverage.level - tap.shallowest * metre
        if bottom.mean() >= tap.bottom and _is_round(coverage.grid.centers(np.isfinite(own)), coverage, tap):
            return part
    return None


def _is_round(at: Float[np.ndarray, "n 2"], coverage: Coverage, tap: TapConfig) -> bool:
    """Whether the plan of the cells at some points fills its hull, and leaves the corners of its rectangle free."""
    hull = MultiPoint(at).convex_hull
    area = len(at) * coverage.grid.cell**2
    rectangle = float(np.prod(np.ptp(at, axis=0) + coverage.grid.cell))
    return bool(area <= tap.round * rectangle and area >= tap.convex * hull.area)


def _is_tap(part: Part, basin: Box, coverage: Coverage, config: TapConfig, metre: float) -> bool:
    """Whether a part stands over or in what one looks into, within the plan of a basin, and rises above its rim."""
    assert coverage.level is not None
    box = part.box
    slim = float(box.size[:2].max()) <= config.size * float(basin.size[:2].min())
    within = bool(np.all(box.low[:2] >= basin.low[:2]) and np.all(box.high[:2] <= basin.high[:2]))
    if not (slim and within and box.high[2] > coverage.level + config.rises * metre):
        return False
    cells = np.isfinite(heights_of(part.mesh.triangles, coverage.grid))
    return bool((cells & grown(coverage.opened, 1)).any())


def speaks_for_bars(roles: Roles, coverage: Coverage, config: TopConfig, metre: float) -> bool:
    """Whether most flat parts at the rim are bars by name."""
    assert coverage.level is not None
    most = config.evidence.flat * metre
    low, high = coverage.level - config.recess * metre, coverage.level + most
    flat = [p for p in roles.still if low <= p.box.high[2] <= high and p.box.size[2] <= most]
    bars = sum(p.label in (PartLabel.BAR, PartLabel.FACE_FRAME) for p in flat)
    return len(flat) > 0 and 2 * bars > len(flat)


def _is_basin(part: Part, views: Views, coverage: Coverage, config: EvidenceConfig, metre: float) -> bool:
    box, level = part.box, coverage.level
    if level is None:
        return False
    if not level - config.basin_below * metre <= box.high[2] <= level + config.basin_above * metre:
        return False
    at = coverage.grid.centers(coverage.everything)
    around = Box.around(np.column_stack([at, np.zeros(len(at))])).grown(-config.basin_margin * metre)
    inside = bool(np.all(box.low[:2] >= around.low[:2]) and np.all(box.high[:2] <= around.high[:2]))
    own = heights_of(part.mesh.triangles, views.grid)
    held = np.isfinite(own)
    hollow = held & (own <= box.high[2] - config.shallowest_basin * metre)
    large = held.sum() >= config.basin_area * coverage.everything.sum()
    full = held.sum() >= config.basin_full * _within(box, views).sum()
    return inside and bool(large and full and hollow.sum() >= config.basin_hollow * held.sum())


def _within(box: Box, views: Views) -> CellMask:
    """Returns the cells whose middles lie in the plan of a box."""
    grid = views.grid
    x = grid.low[0] + (np.arange(grid.columns) + 0.5) * grid.cell
    y = grid.low[1] + (np.arange(grid.rows) + 0.5) * grid.cell
    return np.outer((x >= box.low[0]) & (x <= box.high[0]), (y >= box.low[1]) & (y <= box.high[1]))
