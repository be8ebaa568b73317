"""What a slab leaves free for doors, drawers and flaps: grooves in its underside, and edges that end before them.

It knows how moving bodies move, not how their joints will be built: those come later and respect the slab.
"""

from dataclasses import dataclass
from typing import final

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from grafu.additions.top.roles import Closed
from grafu.additions.top.section import EMPTY, offset, section_lines
from grafu.geometry.transform import transform_points

_LEFT = 0.4  # of the thickness that must be left over a groove
_UPRIGHT = 0.7  # of a unit direction
_FLAP = 0.25  # of a leaf's height: an axis within that of its upper end lifts it
_TURN = np.radians(110)  # as far as doors open (realization config)
_POSES = 12
_NEAR = 0.06  # metres below the slab within which a flap's upper end meets it
_BEYOND = 0.15  # metres before a flap that stay free
_BESIDE = 0.05  # metres beside it
_TRAY = 0.1  # of the body's plan: a moving body that takes more is no front but a tray or drawer
_THICKEST = 0.05  # metres that a slab spans above its seat for the sake of such a one


@final
@dataclass(frozen=True, eq=False)
class Cutouts:
    """What a slab must leave free: `cut` through its whole thickness, and `grooves` up to heights."""

    cut: BaseGeometry
    grooves: tuple[tuple[BaseGeometry, float], ...]


def cutouts_of(
    moving_bodies: tuple[Closed, ...], outline: BaseGeometry, seat: float, thickness: float, gap: float, metre: float
) -> Cutouts:
    """Returns what a slab over `outline` that stands at height `seat` must leave free, `gap` metres of air included."""
    cuts, grooves = [], []
    for moving in moving_bodies:
        low, top = float(moving.mesh.box.low[2]), float(moving.mesh.box.high[2])
        if low >= seat + thickness:
            continue
        if lifts(moving) and top > seat - gap - _NEAR * metre:
            cuts.append(_beyond(moving, outline, metre))
        if top <= seat - gap:
            continue
        way = offset(_swept(moving, seat - gap), gap)
        if not way.intersects(outline):
            continue
        if top + gap - seat > (1 - _LEFT) * thickness:
            cuts.append(way)
        else:
            grooves.append((way, top + gap))
    return Cutouts(shapely.union_all(cuts) if cuts else EMPTY, tuple(grooves))


def thick_enough(
    moving_bodies: tuple[Closed, ...], body: BaseGeometry, seat: float, thickness: float, gap: float, metre: float
) -> float:
    """Returns a thickness that passes over trays and drawers that stand a little higher than what carries the slab."""
    for moving in moving_bodies:
        rise = float(moving.mesh.box.high[2]) + gap - seat
        if not (1 - _LEFT) * thickness < rise <= _THICKEST * metre or lifts(moving):
            continue
        points = moving.mesh.vertices[moving.mesh.vertices[:, 2] > seat - gap][:, :2]
        plan = shapely.convex_hull(shapely.multipoints(points))
        if plan.intersection(body).area > _TRAY * body.area:
            thickness = 1.001 * rise / (1 - _LEFT)
    return thickness


def lifts(moving: Closed) -> bool:
    """Whether a moving body turns about a level axis at its upper end: a flap that rises when it opens."""
    joint = moving.request
    if joint is None or not joint.kind.turns:
        return False
    if abs(float(joint.axis.direction[2])) > 1 - _UPRIGHT:
        return False
    box = moving.mesh.box
    return bool(joint.axis.point[2] >= box.high[2] - _FLAP * box.size[2])


def _beyond(moving: Closed, outline: BaseGeometry, metre: float) -> BaseGeometry:
    """Returns the plan of what lies before a flap's face, away from the body's middle: there it rises."""
    box, middle = moving.mesh.box, outline.centroid
    away = box.center[:2] - np.array([middle.x, middle.y])
    across = int(np.argmin(box.size[:2]))
    outer = box.high[across] if away[across] > 0 else box.low[across]
    ends = np.sort([outer, outer + np.sign(away[across]) * _BEYOND * metre])
    along = np.array([box.low[1 - across], box.high[1 - across]]) + np.array([-1.0, 1.0]) * _BESIDE * metre
    x, y = (ends, along) if across == 0 else (along, ends)
    return shapely.box(float(x[0]), float(y[0]), float(x[1]), float(y[1]))


def _swept(moving: Closed, height: float) -> BaseGeometry:
    """Returns the plan of what a moving body's parts above a height pass over when it opens."""
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
        reach = float(_TURN) if turns else float(moving.mesh.box.size[:2].max())
        poses = [transform_points(motion(v), points) for v in np.linspace(0.0, reach, _POSES if turns else 2)]
    steps = [np.concatenate([a, b])[:, :2] for a, b in zip(poses, poses[1:] or poses, strict=False)]
    return shapely.union_all([shapely.convex_hull(shapely.multipoints(step)) for step in steps])
