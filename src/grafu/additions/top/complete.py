"""Whether furniture lacks a top, and the top that it is given: one slab, once, where the coverage test states it.

It asks no network; a predicted top's box may settle a close call. It changes no part and builds no joint.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import final

import shapely
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

from grafu.additions.likeness import surface_like
from grafu.additions.step import Addition, added_part, free_ids
from grafu.additions.top.config import TopConfig
from grafu.additions.top.coverage import Coverage, coverage_of
from grafu.additions.top.cutouts import cutouts_of, thick_enough
from grafu.additions.top.evidence import (
    basin_with_tap,
    basins_of,
    bowls_of,
    cells_of,
    named_cells,
    plate_in,
    speaks_for_bars,
    vessel_in,
)
from grafu.additions.top.lids_below import lid_in
from grafu.additions.top.outline import (
    inset_regions,
    one_piece,
    over_the_base,
    overhanging,
    rim_of,
    under_what_stands,
    what_pierces,
    with_fronts,
)
from grafu.additions.top.roles import Roles, roles_of
from grafu.additions.top.section import (
    EMPTY,
    closed_up,
    offset,
    section,
    slab_mesh,
    with_corners,
    without_block,
    without_slivers,
)
from grafu.additions.top.sloping import rim_and_slab
from grafu.additions.top.views import Views, outer_body, views_of
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.unions import united
from grafu.joints.plan import JointRequest
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

NARROWEST_GROOVE = 3.0
"""Width of a groove, in overruns, below which it is left out (ratio)."""
GROOVE_DETAIL = 0.2
"""Distance by which a groove's outline may be simplified, in overruns (ratio)."""
RECTANGLE = 0.97
"""Fraction of its smallest rectangle from which on an outline is called one."""


@final
@dataclass(frozen=True)
class TopVerdict:
    """Whether there is a top, by what fraction, and why; and the top to add where there is none.

    `coverage` holds the paper's two occupancy maps (None: nothing has a face). `addition` is None where a top is there,
    and where none can be put: `why` states which. `close_call` states that the maps alone did not decide. `others` are
    the tops of what stands higher or lower and lacks one, too.
    """

    covered: bool
    ratio: float
    why: str
    coverage: Coverage | None = None
    addition: Addition | None = None
    close_call: bool = False
    others: tuple[Addition, ...] = ()

    @property
    def additions(self) -> tuple[Addition, ...]:
        """All tops to add, the largest first."""
        return (self.addition, *self.others) if self.addition is not None else ()

    @property
    def missing(self) -> bool:
        """Whether furniture lacks a top."""
        return not self.covered


def missing_tops(
    parts: Sequence[Part],
    moving_bodies: Iterable[JointRequest] = (),
    config: TopConfig = TopConfig(),
    hint: Box | None = None,
) -> TopVerdict:
    """Returns what `missing_top` does, and further tops: of a desk below its hutch, of a base beside a tower.

    Each is judged with those before it in place; a further one must lie clearly higher or lower than all of them.
    """
    moving_bodies, parts = tuple(moving_bodies), list(parts)
    first = missing_top(parts, moving_bodies, config, hint)
    found = list(first.additions)
    while 0 < len(found) < config.most_tops:
        parts.append(found[-1].part)
        further = missing_top(parts, moving_bodies, config)
        if further.addition is None or not _is_apart(further.addition, found, config.apart):
            break
        found.append(further.addition)
    return replace(first, others=tuple(found[1:]))


def _is_apart(top: Addition, others: Sequence[Addition], ratio: float) -> bool:
    """Whether a top lies higher or lower than others by more than this fraction of its height."""
    box = top.part.box
    return all(abs(float(box.high[2] - o.part.box.high[2])) > ratio * float(box.high[2]) for o in others)


def missing_top(
    parts: Sequence[Part],
    moving_bodies: Iterable[JointRequest] = (),
    config: TopConfig = TopConfig(),
    hint: Box | None = None,
) -> TopVerdict:
    """Returns whether parts lack a top, and the slab for them.

    `moving_bodies` are the joints asked for: lids cover, drawers do not, and the slab lets all of them move. `hint` is
    the box of a top that a network predicts, in the object frame; it settles close calls and nothing else.
    """
    roles = roles_of(parts, moving_bodies, config.upright)
    if roles is None:
        return TopVerdict(True, 1.0, "nothing has a surface")
    metre = metre_on(float(Box.enclosing(p.box for p in parts).size.max()))
    views, coverage, basins = _seen(roles, config, metre)
    verdict = _judged(roles, views, coverage, config, metre, hint)
    sloping = None if verdict.covered and coverage.level is not None else rim_and_slab(roles, config, metre)
    if sloping is not None:
        return _sloping(verdict, parts, roles, config, sloping)
    if verdict.covered:
        return verdict
    made = _slab(roles, views, coverage, basins, config, metre)
    if made is None:
        return replace(verdict, why=f"{verdict.why}; nothing carries a slab there")
    mesh, outline = made
    (part_id,) = free_ids("top_panel", 1, {p.id for p in parts})
    part = added_part(part_id, PartLabel.TOP_PANEL, [surface_like(mesh, outer_body(parts, roles, config))])
    style = config.shape if _is_rectangle(outline) else f"outline, {config.shape}"
    return replace(verdict, addition=Addition(part, verdict.why, style))


def _sloping(
    verdict: TopVerdict,
    parts: Sequence[Part],
    roles: Roles,
    config: TopConfig,
    made: tuple[str, TriangleMesh],
) -> TopVerdict:
    """Returns the verdict on furniture whose rim slopes, and the sloping top for it: why, and its mesh."""
    why, mesh = made
    (part_id,) = free_ids("top_panel", 1, {p.id for p in parts})
    part = added_part(part_id, PartLabel.TOP_PANEL, [surface_like(mesh, outer_body(parts, roles, config))])
    return replace(verdict, covered=False, ratio=0.0, why=why, addition=Addition(part, why, f"sloping, {config.shape}"))


def _seen(roles: Roles, config: TopConfig, metre: float) -> tuple[Views, Coverage, tuple[Part, ...]]:
    """Returns furniture from above, its two maps, and the basins in it: their rims are none that a top closes."""
    bowls = bowls_of(roles, config.evidence, metre)
    if 0 < len(bowls) < len(roles.still):  # what is all bowl is no piece with a basin in it
        views = views_of(_without(bowls, roles), config.openings.front * metre)
        basins = basins_of(bowls, views, coverage_of(views, config, metre), config.evidence, metre)
        if basins:
            views = views_of(_without(basins, roles), config.openings.front * metre)
            return views, coverage_of(views, config, metre, cells_of(basins, views)), basins
    views = views_of(roles, config.openings.front * metre)
    return views, coverage_of(views, config, metre), ()


def _without(some: tuple[Part, ...], roles: Roles) -> Roles:
    return replace(roles, still=tuple(p for p in roles.still if p not in some))


def _judged(
    roles: Roles, views: Views, coverage: Coverage, config: TopConfig, metre: float, hint: Box | None
) -> TopVerdict:
    """Returns the verdict of the maps, and in close calls of what else speaks."""
    level = coverage.level
    if level is None:
        return TopVerdict(True, coverage.ratio, "nothing is open at the top", coverage)
    basin = basin_with_tap(roles, coverage, config.evidence, metre)
    if basin is not None:
        return TopVerdict(True, coverage.ratio, f"`{basin[0].id}` is a basin: `{basin[1].id}` stands over it", coverage)
    vessel = vessel_in(roles, coverage, config.evidence, metre)
    if vessel is not None:
        return TopVerdict(True, coverage.ratio, f"`{vessel.id}` is a vessel: its plan is round", coverage)
    lid = lid_in(roles, coverage)
    if lid is not None:
        return TopVerdict(True, coverage.ratio, f"`{lid.id}` is a lid: it closes what is open there", coverage)
    named = named_cells(roles, views, coverage, config.evidence, metre)
    near_top = coverage.near_top | (named & coverage.everything)
    coverage = replace(coverage, near_top=near_top)
    ratio = coverage.ratio
    seen = f"{ratio:.0%} of what stands at {level:.2f} m is covered"
    if abs(ratio - config.coverage) > config.doubt:
        return TopVerdict(ratio >= config.coverage, ratio, seen, coverage)
    covered, told = ratio >= config.coverage, ""
    if (plate := plate_in(roles, views, coverage, config, metre)) is not None:
        covered, told = True, f", `{plate.id}` is a top with a cut-out"
    elif hint is not None and abs(float(hint.high[2]) - level) <= config.evidence.predicted * metre:
        covered, told = False, ", and a top was predicted there"
    elif named.sum() < config.evidence.named * near_top.sum() and speaks_for_bars(roles, coverage, config, metre):
        covered, told = False, " by bars"
    return TopVerdict(covered, ratio, seen + told, coverage, close_call=True)


def _slab(
    roles: Roles, views: Views, coverage: Coverage, basins: tuple[Part, ...], config: TopConfig, metre: float
) -> tuple[TriangleMesh, Polygon] | None:
    """Returns the slab and its outline from above; None where nothing carries one."""
    own = config.outline
    rim = rim_of(_without(basins, roles), views, coverage, own, metre)
    if rim is None:
        return None
    thickness = min(config.thickness * metre, config.thickness_ratio * (rim.seat - views.floor))
    if thickness <= 0:
        return None
    seat, clean = config.seat * metre, config.overrun * metre
    thickness = thick_enough(roles.moving, rim.outline, rim.seat, thickness, config, metre)
    thickness = under_what_stands(roles, rim, thickness, config, metre)
    plan = with_fronts(rim, roles.moving, own, metre)
    plan = overhanging(plan, *over_the_base(plan, roles, rim.seat, config, metre))
    plan = with_corners(plan, config.shape, config.corner * metre)
    free = cutouts_of(roles.moving, plan, rim.seat, thickness, config, metre)
    standing = what_pierces(roles, rim, thickness, seat, own, metre)
    left = plan.difference(free.cut).difference(standing).difference(_cut_outs(basins, config, metre))
    outline = one_piece(left, coverage, own, metre)
    if outline is None:
        return None
    mesh = slab_mesh(outline, rim.seat, rim.seat + thickness, config.shape, config.edge)
    for region, height in free.grooves:
        below = region.intersection(offset(outline, clean)).difference(rim.walls)
        wide = without_slivers(below, NARROWEST_GROOVE * config.overrun * metre)
        groove = shapely.simplify(wide, GROOVE_DETAIL * config.overrun * metre)
        mesh = without_block(mesh, groove, rim.seat - thickness, height)
    for region, height in inset_regions(roles, rim, seat, own, metre):
        mesh = without_block(mesh, region, rim.seat - thickness, height)
    return mesh, outline


def _cut_outs(basins: tuple[Part, ...], config: TopConfig, metre: float) -> BaseGeometry:
    """Returns the plans of basins below their flanges."""
    below, line = config.evidence.flange * metre, config.outline.line * metre
    walls = (section(p.mesh.triangles, [float(p.box.high[2]) - below], line, metre) for p in basins)
    cut = [closed_up(wall, config.outline.crevice * metre) for wall in walls]
    return united(cut) if cut else EMPTY


def _is_rectangle(outline: Polygon) -> bool:
    return bool(outline.area >= RECTANGLE * outline.minimum_rotated_rectangle.area)
