"""The boards that complete a drawer box, as boxes in the drawer's frame.

A mere front gets all four within the room behind it; an incomplete box is completed from the boards that are there:
their outer faces, their height, their length.
"""

from collections.abc import Mapping
from typing import final

import numpy as np

from grafu.additions.drawer_box.config import DrawerBoxConfig
from grafu.additions.drawer_box.verdict import RAY_START, BoardName, BoxVerdict
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, median, vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.joints.rail.body_region import DrawerFrame
from grafu.refusal import Reason, Refusal

RAYS_PER_SIDE = 5
"""Rays along each side of a face."""
SPREAD = 0.6
"""Fraction of a face over which rays to it are spread: rims and joints lie outside."""
WHOLE_SPREAD = 0.95
"""The same where all of a front counts."""
WALL_HEIGHTS = (0.3, 0.8)
"""Lowest and highest ray to a wall, as fractions of the box's height."""


@final
@dataclass(frozen=True, eq=False, slots=True)
class Outline(ArrayValue):
    """A box's outer faces and the inner faces of its sides and back (`inner`: left, right, back), metres."""

    outer: Box
    inner: np.ndarray


def boards_in_room(room: Box, front: RayCaster, frame: DrawerFrame, config: DrawerBoxConfig) -> Mapping[BoardName, Box]:
    """Returns the four boards of a whole box that fills a room behind a front."""
    wall = _wall(frame, config)
    inner = np.array([room.low[0] + wall, room.high[0] - wall, room.high[1] - wall])
    missing: tuple[BoardName, ...] = ("side_left", "side_right", "back", "bottom")
    return _boards(Outline(room, inner), missing, (wall, wall), front, frame, config)


def has_walls(verdict: BoxVerdict) -> bool:
    """Whether a side or the back is there, which shows how high and how wide the box is."""
    return not {"side_left", "side_right", "back"} <= set(verdict.missing)


def boards_to_complete(
    verdict: BoxVerdict,
    mesh: TriangleMesh,
    caster: RayCaster,
    frame: DrawerFrame,
    config: DrawerBoxConfig,
    room: Box | None = None,
) -> Mapping[BoardName, Box] | Refusal:
    """Returns the boards that an incomplete box lacks, or why they are unknown.

    `room` is the free space behind the front: walls on a mere bottom keep within it.
    """
    y = mesh.vertices[:, 1]
    behind = mesh.vertices[y > verdict.inner_front + config.probe.length * (frame.depth - verdict.inner_front)]
    if len(behind) < config.probe.corners:
        return Refusal("", Reason.NOT_CLEAR, "the boards that are there do not show how long the box is")
    there = Box.around(behind)
    low, high = np.array(there.low), np.array(there.high)
    low[1], high[1] = verdict.inner_front, frame.depth
    wall = _wall(frame, config)
    sides: tuple[tuple[BoardName, int], ...] = (("side_left", 0), ("side_right", 1))
    if "side_left" in verdict.missing and "side_right" not in verdict.missing:
        low[0] = min(low[0], -high[0])  # a lone side has its mirror image
    if "side_right" in verdict.missing and "side_left" not in verdict.missing:
        high[0] = max(high[0], -low[0])
    if room is not None:
        low[0], high[:2] = max(low[0], room.low[0]), np.minimum(high[:2], room.high[:2])
        high[2] = max(high[2], room.high[2])
    if np.any(high - low < config.narrowest * wall):
        return Refusal("", Reason.NO_ROOM, "the boards that are there leave no room for others between them")
    outer = Box(low, high)
    inner = np.array([low[0] + wall, high[0] - wall, high[1] - wall])
    for name, k in sides:
        if name not in verdict.missing:
            inner[k] = _inner_face(caster, outer, 0, 2 * k - 1, inner[k], config.inset)
    if "back" not in verdict.missing:
        inner[2] = _inner_face(caster, outer, 1, 1, inner[2], config.inset)
    lift = _top_of_bottom(caster, outer) - float(low[2]) - config.inset if not has_walls(verdict) else 0.0
    if lift > config.highest_bottom * float(outer.size[2]):
        return Refusal("", Reason.NO_ROOM, "above the bottom that is there is no room for walls")
    lifted = Outline(Box(vec3(low[0], low[1], low[2] + lift), high), inner)
    between = (wall if "side_left" in verdict.missing else 0.0, wall if "side_right" in verdict.missing else 0.0)
    return _boards(lifted, verdict.missing, between, caster, frame, config)


def _wall(frame: DrawerFrame, config: DrawerBoxConfig) -> float:
    return min(config.wall, config.wall_ratio * min(frame.width, frame.height))


def _inner_face(caster: RayCaster, outer: Box, axis: int, sign: int, fallback: float, inset: float) -> float:
    """Returns where a board's inner face lies, seen from the box's middle; `fallback` where nothing is met."""
    other = 1 - axis
    along, height = (
        a.ravel()
        for a in np.meshgrid(
            outer.center[other] + np.linspace(-SPREAD, SPREAD, RAYS_PER_SIDE) * outer.half[other],
            outer.low[2] + np.linspace(*WALL_HEIGHTS, RAYS_PER_SIDE) * outer.size[2],
            indexing="ij",
        )
    )
    origins = np.empty((along.size, 3))
    origins[:, axis], origins[:, other], origins[:, 2] = outer.center[axis], along, height
    direction = np.zeros(3)
    direction[axis] = sign
    hits = caster.along(origins, direction)
    found = hits[hits <= outer.half[axis] + inset]
    return float(outer.center[axis] + sign * median(found)) if len(found) else float(fallback)


def _top_of_bottom(caster: RayCaster, outer: Box) -> float:
    """Returns the height of the upper side of the bottom that is there."""
    x, y = (
        a.ravel()
        for a in np.meshgrid(
            outer.center[0] + np.linspace(-SPREAD, SPREAD, RAYS_PER_SIDE) * outer.half[0],
            outer.center[1] + np.linspace(-SPREAD, SPREAD, RAYS_PER_SIDE) * outer.half[1],
            indexing="ij",
        )
    )
    start = float(outer.high[2]) + RAY_START
    hits = caster.along(np.column_stack([x, y, np.full(x.size, start)]), vec3(0.0, 0.0, -1.0))
    found = hits[np.isfinite(hits)]
    return start - median(found) if len(found) else float(outer.low[2])


def _boards(
    outline: Outline,
    missing: tuple[BoardName, ...],
    sides: tuple[float, float],
    drawer: RayCaster,
    frame: DrawerFrame,
    config: DrawerBoxConfig,
) -> Mapping[BoardName, Box]:
    """Returns the missing boards: sides run through, back and bottom lie between them, the bottom before the back.

    `sides` are the thicknesses of those that are new (0: a side that is there).
    """
    (x0, y0, z0), (x1, y1, z1) = outline.outer.low.tolist(), outline.outer.high.tolist()
    left, right, back = outline.inner.tolist()
    bottom = min(config.bottom, config.wall_ratio * min(frame.width, frame.height) / 2)
    inset = config.inset
    found: dict[BoardName, Box] = {}
    front = float(_front_face(drawer, outline.outer, y0, min(config.to_front, 0.5 * frame.depth))) - inset
    if "side_left" in missing:
        found["side_left"] = Box(vec3(x0, front, z0), vec3(x0 + sides[0], y1, z1))
    if "side_right" in missing:
        found["side_right"] = Box(vec3(x1 - sides[1], front, z0), vec3(x1, y1, z1))
    if "back" in missing:
        found["back"] = Box(vec3(left - inset, back, z0), vec3(right + inset, y1, z1))
    if "bottom" in missing:
        low = vec3(left - inset, front, z0)
        found["bottom"] = Box(low, vec3(right + inset, back + inset, z0 + bottom))
    return found


def _front_face(drawer: RayCaster, outer: Box, start: float, ahead: float) -> float:
    """Returns the y of the front's inner face over the section of the box, hollows up to `ahead` metres counted in."""
    x, z = (
        a.ravel()
        for a in np.meshgrid(
            outer.center[0] + np.linspace(-WHOLE_SPREAD, WHOLE_SPREAD, 2 * RAYS_PER_SIDE) * outer.half[0],
            outer.center[2] + np.linspace(-WHOLE_SPREAD, WHOLE_SPREAD, RAYS_PER_SIDE) * outer.half[2],
            indexing="ij",
        )
    )
    hits = drawer.along(np.column_stack([x, np.full(x.size, start + RAY_START), z]), vec3(0.0, -1.0, 0.0)) - RAY_START
    found = hits[(hits >= -RAY_START) & (hits <= ahead)]
    return start - max(median(found), 0.0) if len(found) else start
