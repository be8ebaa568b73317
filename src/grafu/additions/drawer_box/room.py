"""The free space behind a drawer's front, on real geometry: the largest box that slides out with it. It adds nothing.

The front's back is divided into columns; each is free as deep as the first thing in it. Of all rectangles of columns
the one that makes the best box is taken, then widened to what limits it exactly. Nothing has to be labelled: walls,
runners, a drawer below, a bar at the back are all triangles.
"""

from typing import final

import numpy as np

from grafu.additions.drawer_box.config import DrawerBoxConfig
from grafu.additions.drawer_box.verdict import RAY_START
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Points, vec3
from grafu.geometry.box import Box
from grafu.geometry.cells import Pieces, largest_rectangles, meeting, nearest_depths, pieces_in, spans_of
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.joints.rail.body_region import DrawerFrame
from grafu.refusal import Reason, Refusal

COLUMNS = (32, 16)
"""Columns across a front and upwards."""
SLICES = 6
"""Slices along the path into the cabinet."""
DEPTH_QUANTILES = (0.02, 0.1, 0.25, 0.5, 0.75, 0.9)
"""Quantiles of all columns' depths at which a box may end."""
SAME_DEPTH = 1e-3
"""Space behind a front up to which there is none, metres."""
SHALLOW = "the space behind the front is only {:.3f} m deep"


@final
@dataclass(frozen=True, eq=False, slots=True)
class Room(ArrayValue):
    """The outer faces that a box may have, in the drawer's frame, metres; clearances are already taken off."""

    box: Box


def find_room(
    front: RayCaster,
    frame: DrawerFrame,
    still: np.ndarray,
    others: np.ndarray,
    config: DrawerBoxConfig,
    limit: float = float("inf"),
) -> Room | Refusal:
    """Returns the room behind a front, or why there is none.

    Args:
        front: the front in its own frame, with what rides behind it.
        frame: the drawer's frame.
        still: the triangles (n, 3, 3) of the still parts in that frame.
        others: the triangles of the other moving bodies at rest in that frame, with what was added to them.
        config: clearances and least sizes.
        limit: the y at which the box must end at the latest, metres.
    """
    end = min(end_of_room(still, frame, config), limit)
    if end <= frame.depth:
        return Refusal("", Reason.NO_SUPPORT, "nothing stands behind the front that could carry a box")
    half = np.array([frame.width / 2, frame.height / 2]) - min(config.drawn_in, config.drawn_in_ratio * frame.height)
    around = Box(vec3(-half[0], 0.5 * frame.depth, -half[1]), vec3(half[0], end, half[1]))
    near = _near(np.concatenate([still, others]), around)
    columns = _columns(around)
    seen = float(RayCaster(near).along(columns, vec3(0.0, 1.0, 0.0)).max()) + float(around.low[1])
    end = min(end, seen + config.drawn_in)
    if end - frame.depth < config.least_depth * min(frame.width, frame.height):
        return Refusal("", Reason.NO_ROOM, SHALLOW.format(max(end - frame.depth, 0.0)))
    around = Box(around.low, vec3(half[0], end, half[1]))
    pieces = pieces_in(near.triangles, around, (COLUMNS[0], SLICES, COLUMNS[1]))
    depths = nearest_depths(pieces, around, COLUMNS, (0, 2, 1), end)
    depths = np.where(_covered(front, frame, columns), depths, frame.depth)
    seed = _best_rectangle(depths, around, frame, config.crooked)
    if seed is None:
        return Refusal("", Reason.IN_THE_WAY, "the space right behind the front is not free")
    free = _widened(seed, around, pieces, frame)
    return _with_clearance(free, frame, config)


def end_of_room(still: np.ndarray, frame: DrawerFrame, config: DrawerBoxConfig) -> float:
    """Returns the y up to which a box may reach: to a thing behind it, or under the rear edge of what is around it."""
    if not len(still):
        return 0.0
    low, high = spans_of(still)
    beside = (low[:, 0] < frame.width / 2) & (high[:, 0] > -frame.width / 2) & (high[:, 2] > -frame.height / 2)
    if not beside.any():
        return 0.0
    rear = float(high[beside, 1].max())
    wide, tall = config.probe.rear_middle * frame.width, config.probe.rear_middle * frame.height
    middle = beside & (low[:, 2] < tall) & (low[:, 0] < wide)
    middle &= (high[:, 2] > -tall) & (high[:, 0] > -wide) & (low[:, 1] > frame.depth)
    closed = middle.any() and float(high[middle, 1].max()) > 0.5 * rear
    return rear if closed else frame.depth + config.open_depth * (rear - frame.depth)


def _near(triangles: np.ndarray, around: Box) -> TriangleMesh:
    """Returns the triangles whose own boxes meet a box."""
    corners = meeting(triangles, around).reshape(-1, 3)
    return TriangleMesh(corners, np.arange(len(corners)).reshape(-1, 3))


def _columns(around: Box) -> Points:
    """Returns the middle of each column on the near side of a box."""
    x, z = (
        around.low[axis] + (np.arange(count) + 0.5) / count * around.size[axis]
        for axis, count in zip((0, 2), COLUMNS, strict=True)
    )
    grid_x, grid_z = (a.ravel() for a in np.meshgrid(x, z, indexing="ij"))
    return np.column_stack([grid_x, np.full(grid_x.size, around.low[1]), grid_z])


def _covered(front: RayCaster, frame: DrawerFrame, columns: Points) -> np.ndarray:
    """Returns for each column whether the front stands before it, holes in its middle counted in."""
    behind = columns + vec3(0.0, frame.depth + RAY_START - float(columns[0, 1]), 0.0)
    hit = np.isfinite(front.along(behind, vec3(0.0, -1.0, 0.0))).reshape(COLUMNS)
    both = np.ones_like(hit)
    for axis in (0, 1):
        forward = np.logical_or.accumulate(hit, axis=axis)
        backward = np.flip(np.logical_or.accumulate(np.flip(hit, axis), axis=axis), axis)
        both &= forward & backward
    return both


def _best_rectangle(depths: np.ndarray, around: Box, frame: DrawerFrame, crooked: float) -> Box | None:
    """Returns the box of free columns that makes the best drawer: wide and deep rather than high."""
    step = np.array([around.size[0] / COLUMNS[0], around.size[2] / COLUMNS[1]])
    best, chosen = 0.0, None
    for deep in np.unique(np.append(np.quantile(depths, DEPTH_QUANTILES), depths.max())):
        level = deep - crooked * (deep - frame.depth)
        if level <= frame.depth + SAME_DEPTH:
            continue
        rows, found = largest_rectangles(depths >= level)
        width = (rows[:, 1] - rows[:, 0] + 1) * step[0]
        height = (rows[:, 3] - rows[:, 2] + 1) * step[1]
        score = np.where(found, width * np.sqrt(height) * (level - frame.depth), 0.0)
        k = int(np.argmax(score))
        if score[k] > best:
            best, chosen = float(score[k]), (rows[k], float(level))
    if chosen is None:
        return None
    (x0, x1, z0, z1), level = chosen
    low = vec3(float(around.low[0] + x0 * step[0]), float(around.low[1]), float(around.low[2] + z0 * step[1]))
    high = vec3(float(around.low[0] + (x1 + 1) * step[0]), level, float(around.low[2] + (z1 + 1) * step[1]))
    return Box(low, high)


def _widened(seed: Box, around: Box, pieces: Pieces, frame: DrawerFrame) -> Box:
    """Returns a free box grown to what limits it: sideways first, then up and down, then to the back."""
    low, high = np.array(seed.low), np.array(seed.high)
    for axis in (0, 2, 1):
        low[axis], high[axis] = around.low[axis], around.high[axis]
        near = pieces.of(pieces.within(Box(low, high)))
        middle = seed.center[axis]
        if axis != 1:
            below = near.high[near.high[:, axis] <= middle, axis]
            low[axis] = max(around.low[axis], float(below.max(initial=-np.inf)))
        beyond = near.low[near.low[:, axis] >= (middle if axis != 1 else frame.depth), axis]
        high[axis] = min(around.high[axis], float(beyond.min(initial=np.inf)))
    return Box(low, high)


def _with_clearance(free: Box, frame: DrawerFrame, config: DrawerBoxConfig) -> Room | Refusal:
    """Returns the room for a box within a free space, or what it is too small in."""
    side = min(config.side_gap, config.side_ratio * frame.width)
    height, depth = float(free.size[2]), float(free.high[1]) - frame.depth
    under, over = (min(gap, config.height_ratio * height) for gap in (config.under, config.over))
    behind = min(config.behind, config.behind_ratio * depth)
    high = float(free.high[2]) - over
    most = max(config.highest, config.high_ratio * height)
    high = min(high, float(free.low[2]) + under + most)
    low = vec3(float(free.low[0]) + side, frame.depth, float(free.low[2]) + under)
    far = vec3(float(free.high[0]) - side, float(free.high[1]) - behind, high)
    if far[0] - low[0] < config.least_width * frame.width:
        return _narrow(float(far[0] - low[0]), frame.width, "width")
    if far[1] - low[1] < config.least_depth * min(frame.width, frame.height):
        return Refusal("", Reason.NO_ROOM, SHALLOW.format(max(float(far[1] - low[1]), 0.0)))
    if far[2] - low[2] < config.least_depth * frame.height:
        return _narrow(float(far[2] - low[2]), frame.height, "height")
    return Room(Box(low, far))


def _narrow(free: float, whole: float, side: str) -> Refusal:
    why = f"only {max(free, 0.0):.3f} m of the front's {whole:.3f} m of {side} are free behind it"
    return Refusal("", Reason.NO_ROOM, why)
