"""What a slab leaves free for doors, drawers and flaps: grooves in its underside, and edges that end before them.

It knows how moving bodies move, not how their joints will be built: those come later and respect the slab.
"""

from typing import final

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from grafu.additions.top.config import CutoutConfig, TopConfig
from grafu.additions.top.roles import Closed
from grafu.additions.top.section import EMPTY, offset, polygons_in, section_lines
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec2
from grafu.geometry.transform import transform_points
from grafu.geometry.unions import united

SWEEP_POSES = 12
"""Poses of a turning body between which its sweep is joined."""
ROUNDED_UP = 1.001
"""Factor that makes a slab surely thick enough."""


@final
@dataclass(frozen=True, eq=False)
class Cutouts:
    """What a slab must leave free: `cut` through its whole thickness, and `grooves` up to heights."""

    cut: BaseGeometry
    grooves: tuple[tuple[BaseGeometry, float], ...]


def cutouts_of(
    moving_bodies: tuple[Closed, ...],
    outline: BaseGeometry,
    seat: float,
    thickness: float,
    config: TopConfig,
    metre: float,
) -> Cutouts:
    """Returns what a slab over `outline` that stands at height `seat` must leave free, the air of `gap` included."""
    gap, own = config.gap * metre, config.cutouts
    cuts, grooves = [], []
    for moving in moving_bodies:
        low, top = float(moving.mesh.box.low[2]), float(moving.mesh.box.high[2])
        if low >= seat + thickness:
            continue
        if lifts(moving, own) and top > seat - gap - own.near * metre:
            cuts.append(_beyond(moving, outline, own, metre))
        if top <= seat - gap:
            continue
        path = offset(_swept(moving, seat - gap, own.opening), gap)
        if not path.intersects(outline):
            continue
        if top + gap - seat > (1 - own.left) * thickness:
            cuts.append(path)
        else:
            grooves.append((path, top + gap))
    return Cutouts(united(cuts) if cuts else EMPTY, tuple(grooves))


def thick_enough(
    moving_bodies: tuple[Closed, ...],
    body: BaseGeometry,
    seat: float,
    thickness: float,
    config: TopConfig,
    metre: float,
) -> float:
    """Returns a thickness that passes over trays and drawers that stand a little higher than what carries the slab."""
    gap, own = config.gap * metre, config.cutouts
    for moving in moving_bodies:
        rise = float(moving.mesh.box.high[2]) + gap - seat
        if not (1 - own.left) * thickness < rise <= own.thickest * metre or lifts(moving, own):
            continue
        points = moving.mesh.vertices[moving.mesh.vertices[:, 2] > seat - gap][:, :2]
        plan = shapely.convex_hull(shapely.multipoints(points))
        if plan.intersection(body).area > own.tray * body.area:
            thickness = ROUNDED_UP * rise / (1 - own.left)
    return thickness


def lifts(moving: Closed, config: CutoutConfig) -> bool:
    """Whether a moving body turns about a level axis at its upper end: a flap that rises when it opens."""
    joint = moving.request
    if joint is None or not joint.kind.turns:
        return False
    if abs(float(joint.axis.direction[2])) > 1 - config.upright:
        return False
    box = moving.mesh.box
    return bool(joint.axis.point[2] >= box.high[2] - config.flap * box.size[2])


def _beyond(moving: Closed, outline: BaseGeometry, config: CutoutConfig, metre: float) -> BaseGeometry:
    """Returns the plan of what lies before a flap's face, away from the body's middle: there it rises.

    An overhang that lies before the face goes as a whole, so that the slab has one straight edge there.
    """
    box, middle = moving.mesh.box, outline.centroid
    away = box.center[:2] - np.array([middle.x, middle.y])
    across = int(np.argmin(box.size[:2]))
    outer = box.high[across] if away[across] > 0 else box.low[across]
    ends = np.sort([outer, outer + np.sign(away[across]) * config.before * metre])
    along = np.array([box.low[1 - across], box.high[1 - across]]) + np.array([-1.0, 1.0]) * config.beside * metre
    strip = _box(across, ends, along)
    bounds = np.asarray(outline.bounds, dtype=np.float64).reshape(2, 2)
    all_along = np.array([bounds[0, 1 - across], bounds[1, 1 - across]])
    everything = np.sort([outer, bounds[int(away[across] > 0), across]])
    pieces = polygons_in(outline.intersection(_box(across, everything, all_along)))
    spans = np.array([[p.bounds[across], p.bounds[across + 2]] for p in pieces]).reshape(-1, 2)
    narrow = [p for p, span in zip(pieces, spans, strict=True) if np.ptp(span) <= config.before * metre]
    return united([strip, *(p for p in narrow if p.intersects(strip))])


def _box(across: int, ends: Vec2, along: Vec2) -> BaseGeometry:
    """Returns the rectangle between two ends across, and two along the other axis of the plan."""
    x, y = (ends, along) if across == 0 else (along, ends)
    return shapely.box(float(x[0]), float(y[0]), float(x[1]), float(y[1]))


def _swept(moving: Closed, height: float, opening: float) -> BaseGeometry:
    """Returns the plan of what a moving body's parts above a height pass over when it opens, doors by `opening`."""
    vertices = moving.mesh.vertices
    level = section_lines(moving.mesh.triangles, height).reshape(-1, 2)
    flat = np.concatenate([vertices[vertices[:, 2] > height][:, :2], level])
    hull = np.asarray(shapely.get_coordinates(shapely.convex_hull(shapely.multipoints(flat))), dtype=np.float64)
    points = np.column_stack([hull, np.full(len(hull), height)])
    joint = moving.request
    if joint is None:
        poses = [points]
    else:
        motion = joint.kind.along(joint.axis)
        turns = joint.kind.turns
        reach = opening if turns else float(moving.mesh.box.size[:2].max())
        poses = [transform_points(motion(v), points) for v in np.linspace(0.0, reach, SWEEP_POSES if turns else 2)]
    steps = [np.concatenate([a, b])[:, :2] for a, b in zip(poses, poses[1:] or poses, strict=False)]
    return united([shapely.convex_hull(shapely.multipoints(step)) for step in steps])
