"""Where a grip may sit: spots from the motion, best first, and whether a front bears one there. It carves nothing."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import product

import numpy as np

from grafu.additions.grip.config import GripConfig, GripKind, GripSize
from grafu.additions.grip.ground import FrontLayers, Grid, GripSite, Triangles, aside
from grafu.additions.grip.shape import GripCut, GripFrame
from grafu.geometry.arrays import Mask, Scalars, Vec3, median
from grafu.geometry.box import Box
from grafu.geometry.mesh import triangle_bounds
from grafu.geometry.raycast import line_crossings
from grafu.refusal import Reason
from grafu.scene.scene import Scene

LINES = (21, 17)
"""Lines along and across a grip that look at the front: near enough for beads and narrow mouldings."""


def spots(frame: GripFrame, config: GripConfig, kind: GripKind, scene: Scene, wish: Vec3 | None) -> Iterator[GripCut]:
    """Yields grips to try, best first; their levels are not known yet (0). None: the front is too small.

    `wish` is a point of the object frame near which the grip is wanted.
    """
    scale = scene.metre
    margin = _margin(frame, config, scale)
    wanted = config.wanted(kind)
    length = min(wanted.length * scale, config.length_ratio * frame.length)
    width = min(wanted.width * scale, config.width_ratio * frame.breadth)
    if kind is GripKind.HOLE and wanted.length == wanted.width:
        length = width = min(length, width)
    edge = float(frame.box.high[1])
    for factor in config.trials.sizes:
        size = GripSize(factor * length, factor * width, wanted.depth * scale)
        if _is_too_small(size, scale, config):
            continue
        rows = [edge] if kind is GripKind.EDGE else [edge - m * margin - size.width / 2 for m in config.trials.margins]
        ends = size.length / 2 + margin
        low, high = float(frame.box.low[0]) + ends, float(frame.box.high[0]) - ends
        if wish is not None:
            x, y, _ = frame.local(wish[None])[0]
            inner = size.width / 2 + margin
            y = edge if kind is GripKind.EDGE else np.clip(y, frame.box.low[1] + inner, frame.box.high[1] - inner)
            yield GripCut(kind, config.profile, float(np.clip(x, low, high)), float(y), size, 0.0, 0.0, 0.0)
        middle = best_along(frame, scene, config)
        columns = dict.fromkeys(float(np.clip(middle + s * frame.length, low, high)) for s in config.trials.shifts)
        for y, x in product(rows, columns):
            yield GripCut(kind, config.profile, x, y, size, 0.0, 0.0, 0.0)


def _margin(frame: GripFrame, config: GripConfig, scale: float) -> float:
    """Returns how much material stays between a grip and the edges, metres."""
    return min(config.margin * scale, config.margin_ratio * frame.length, config.margin_ratio * frame.breadth)


def _is_too_small(size: GripSize, scale: float, config: GripConfig) -> bool:
    across, along = sorted((size.width, size.length))
    return across < config.finger_thickness * scale - 1e-9 or along < config.finger_width * scale - 1e-9


def best_along(frame: GripFrame, scene: Scene, config: GripConfig) -> float:
    """Returns the X at which a front is best gripped: in its middle; tall and high doors where a hand reaches."""
    scale, low, high = scene.metre, float(frame.box.low[0]), float(frame.box.high[0])
    up = float(frame.rotation[2, 0])
    if abs(up) < config.upright or frame.length < config.tall * scale:
        return (low + high) / 2
    bottom, top = sorted((low * up, high * up))
    inset = config.end_ratio * (top - bottom)
    reach = bottom if bottom - scene.floor > config.high * scale else scene.floor + config.reach_height * scale
    return min(max(reach, bottom + inset), top - inset) / up


def levelled(site: GripSite, cut: GripCut, config: GripConfig) -> GripCut | Reason:
    """Returns a grip with the levels between which it is cut, or why the front does not bear it there."""
    ring = _margin(site.frame, config, site.scale) / 2
    box = cut.box
    over = -config.blunt * site.scale if cut.kind is GripKind.EDGE else ring
    xs = np.linspace(box.low[0] - ring, box.high[0] + ring, LINES[0])
    ys = np.linspace(box.low[1] - ring, box.high[1] + over, LINES[1])
    ground = site.ground(xs, ys)
    if not ground.is_covered or ground.is_mixed:
        return Reason.UNEVEN
    if not ground.is_opaque.all():
        return Reason.GLASS
    x, y = (grid.reshape(-1) for grid in np.meshgrid(xs, ys, indexing="ij"))
    cut = replace(cut, is_hollow=ground.is_hollow, tilt=_tilt(x, y, np.asarray(ground.face)))
    if max(abs(t) for t in cut.tilt) > config.steepest:
        return Reason.UNEVEN
    ground = ground.lowered(cut.lift(x, y))
    found = _groove(site, cut, ground, config) if cut.kind is GripKind.GROOVE else _through(site, cut, ground, config)
    return found if isinstance(found, Reason) else _unless_in_the_way(site, found, ground, (xs, ys), config)


def _tilt(x: Scalars, y: Scalars, face: Scalars) -> tuple[float, float]:
    """Returns how a front's face rises along x and y."""
    columns = np.column_stack([x - x.mean(), y - y.mean(), np.ones(len(x))])
    along, across, _ = np.linalg.lstsq(columns, face, rcond=None)[0]
    return float(along), float(across)


def _groove(site: GripSite, cut: GripCut, ground: FrontLayers, config: GripConfig) -> GripCut | Reason:
    """Returns a groove as deep as the front allows."""
    if float(ground.thickness.min()) <= config.ground.thinnest * site.scale:
        return Reason.NO_THICKNESS
    face = median(ground.face)
    room = float((face - ground.back).min())
    depth = min(cut.size.depth, config.depth_ratio * room, room - config.wall * site.scale)
    if depth < config.shallowest * site.scale:
        return Reason.TOO_THIN
    if float(np.ptp(ground.face)) > config.uneven * depth:
        return Reason.UNEVEN
    top = float(ground.face.max()) + config.uneven * depth
    return replace(cut, size=replace(cut.size, depth=depth), top=top, face=face, bottom=face - depth)


def _through(site: GripSite, cut: GripCut, ground: FrontLayers, config: GripConfig) -> GripCut | Reason:
    """Returns a hole or notch through the first layer."""
    if float(np.ptp(ground.face)) > config.step * site.scale:
        return Reason.UNEVEN
    face, back = float(ground.face.max()), float(ground.back.min())
    if face - back > min(config.thickest * site.scale, config.thick_ratio * cut.size.length):
        return Reason.TOO_THICK
    over = config.ground.over * site.seam
    bottom = back - over
    if float(np.ptp(ground.back)) > 2 * config.step * site.scale or np.any(ground.beneath > bottom):
        return Reason.UNEVEN
    size = replace(cut.size, depth=max(face - back, 1e-6))
    return replace(cut, size=size, top=face + over, face=face, bottom=bottom)


def _unless_in_the_way(
    site: GripSite, cut: GripCut, ground: FrontLayers, grid: tuple[Grid, Grid], config: GripConfig
) -> GripCut | Reason:
    """Returns the grip, unless something sits on it or leaves fingers no room; `ground` lies level."""
    scale, near = site.scale, cut.box.grown(config.clear * site.scale)
    low, high = (*near.low[:2], cut.bottom + site.seam), (*near.high[:2], cut.face + config.away * scale)
    if _meets(site.attached, Box(np.array(low), np.array(high))):
        return Reason.TAKEN
    x, y = (values.reshape(-1) for values in np.meshgrid(*grid, indexing="ij"))
    inside, lift = _within(cut, x, y), cut.lift(x, y)
    before = (cut.face, cut.face + config.finger_thickness * scale)
    if _met([site.still], grid, before, lift)[inside].any():
        return Reason.NO_FINGER_ROOM
    if cut.kind is GripKind.GROOVE:
        return cut
    room = (cut.bottom - config.finger_room * scale, cut.bottom)
    met = _met([site.still, site.others, site.attached], grid, room, lift) | (ground.beneath > room[0])
    return cut if (~met)[inside].mean() >= config.shown else Reason.NO_FINGER_ROOM


def _within(cut: GripCut, x: Scalars, y: Scalars) -> Mask:
    """Returns which points lie before the part of the grip where fingers reach in: a notch's inner half."""
    box = cut.box
    high = box.high[1] - (0.5 * cut.size.width if cut.kind is GripKind.EDGE else 0.0)
    return np.asarray((x >= box.low[0]) & (x <= box.high[0]) & (y >= box.low[1]) & (y <= high))


def _meets(triangles: Triangles, zone: Box) -> bool:
    """Whether the box of some triangle meets a zone."""
    low, high = triangle_bounds(triangles)
    return bool(np.any(np.all((low <= zone.high) & (high >= zone.low), axis=1)))


def _met(obstacles: list[Triangles], grid: tuple[Grid, Grid], span: tuple[float, float], lift: Scalars) -> Mask:
    """Returns for each line of a grid whether it crosses an obstacle within a span of heights, which rise by `lift`."""
    met = np.zeros(len(lift), dtype=bool)
    xs, ys = (aside(values) for values in grid)
    for triangles in obstacles:
        low, high = triangle_bounds(triangles)
        near = (low[:, 2] <= span[1] + lift.max()) & (high[:, 2] >= span[0] + lift.min())
        found = line_crossings(triangles[near & (low[:, 0] <= xs[-1]) & (high[:, 0] >= xs[0])], xs, ys)
        height = found.height - lift[found.line]
        met[found.line[(height > span[0]) & (height < span[1])]] = True
    return met
