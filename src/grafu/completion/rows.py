"""Doors beside one another: which hang as a pair, and which slide past each other. It looks at boxes alone."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Literal

import numpy as np

from grafu.completion.config import RowConfig
from grafu.completion.rule_scene import RuleScene, overlap_ratio
from grafu.graph.functional_graph import PartNode

Side = Literal["low", "high", "none"]


def across_axis(door: PartNode) -> int:
    """Returns the horizontal axis in the plane of an upright door."""
    return 1 if door.box.thin_axis == 0 else 0


def pair_side(door: PartNode, scene: RuleScene) -> Side:
    """Returns the side of an upright door on which it should hang because it is one of a pair: the outer one.

    Doors of one row are split where a panel stands behind the seam; within each group every two make a pair.
    """
    axis = across_axis(door)
    groups = _split_at_panels(_row_of(door, scene), scene)
    group = next(g for g in groups if any(d.id == door.id for d in g))
    position = next(k for k, d in enumerate(group) if d.id == door.id)
    if len(group) % 2:
        return _side_in_odd_group(group, position, axis, scene)
    return "low" if position % 2 == 0 else "high"


def row_size(door: PartNode, scene: RuleScene) -> int:
    """Returns how many doors stand side by side in the row of an upright door, itself counted."""
    return len(_row_of(door, scene))


def slides_past(door: PartNode, scene: RuleScene) -> PartNode | None:
    """Returns a door that this one slides past: lapping, of one height, in the next plane. None for a hinged door."""
    if door.box.thin_axis == 2:
        return None
    level = (d for d in scene.door_boxes.level_with(door.box) if d.id != door.id)
    return next((d for d in level if _laps(door, d, scene.config.rows)), None)


def _laps(door: PartNode, other: PartNode, config: RowConfig) -> bool:
    thin, axis = door.box.thin_axis, across_axis(door)
    if other.box.thin_axis != thin or _shared_height(door, other) < config.lap_height:
        return False
    apart = abs(float(door.box.center[thin] - other.box.center[thin]))
    sides = [_thickness(one, config) for one in (door, other)]
    thickness, farthest = min(sides), max(sides) * config.planes[1]
    if _face_in_depth_of(door, other, config):
        return False
    lap = -float(door.box.axis_gaps(other.box)[axis])
    width = float(min(door.box.size[axis], other.box.size[axis]))
    least, most = config.lap
    laps = least * width <= lap <= most * width
    beside = -float(door.box.axis_gaps(other.box)[thin]) <= config.shared_depth * thickness
    meets = abs(lap) <= least * width and apart >= config.in_two_planes * thickness and beside
    return config.planes[0] * thickness <= apart <= farthest and (laps or meets)


def _face_in_depth_of(door: PartNode, other: PartNode, config: RowConfig) -> bool:
    """Whether one of two doors is drawn as a face alone that lies within the depth of the other, a slab, or on it."""
    thin = door.box.thin_axis
    if _is_face(door, config) == _is_face(other, config):
        return False
    face, slab = (door, other) if _is_face(door, config) else (other, door)
    reach, at = config.sheet * float(slab.box.size.max()), float(face.box.center[thin])
    return bool(slab.box.low[thin] - reach <= at <= slab.box.high[thin] + reach)


def _is_face(door: PartNode, config: RowConfig) -> bool:
    return float(door.box.size[door.box.thin_axis]) <= config.sheet * float(door.box.size.max())


def _thickness(door: PartNode, config: RowConfig) -> float:
    """Returns how thick a door is, metres, and how thick one would be that is drawn as a face alone."""
    thickness, largest = float(door.box.size[door.box.thin_axis]), float(door.box.size.max())
    return config.thick * largest if _is_face(door, config) else thickness


def _row_of(door: PartNode, scene: RuleScene) -> list[PartNode]:
    """Returns the doors of one row, this one among them, in order of position."""
    axis, thin, config = across_axis(door), door.box.thin_axis, scene.config.rows
    level = scene.door_boxes.level_with(door.box)
    alike = [d for d in level if d.box.thin_axis == thin and _in_line(door, d, config)]
    alike.sort(key=lambda d: float(d.box.center[axis]))
    start = next(k for k, d in enumerate(alike) if d.id == door.id)
    first, last = start, start
    while first > 0 and _seam(alike[first - 1], alike[first], axis) <= config.seam:
        first -= 1
    while last + 1 < len(alike) and _seam(alike[last], alike[last + 1], axis) <= config.seam:
        last += 1
    return alike[first : last + 1]


def _in_line(door: PartNode, other: PartNode, config: RowConfig) -> bool:
    thin = door.box.thin_axis
    apart = abs(float(door.box.center[thin] - other.box.center[thin]))
    thickness = float(max(door.box.size[thin], other.box.size[thin]))
    nearest = max(thickness, config.in_line * float(door.box.size.max()))
    return apart <= nearest and _shared_height(door, other) >= config.shared_height


def _shared_height(a: PartNode, b: PartNode) -> float:
    return min(overlap_ratio(a.box, b.box, 2), overlap_ratio(b.box, a.box, 2))


def _seam(a: PartNode, b: PartNode, axis: int) -> float:
    """Returns the gap between two doors as a fraction of the narrower one's width."""
    return float(b.box.low[axis] - a.box.high[axis]) / max(float(min(a.box.size[axis], b.box.size[axis])), 1e-9)


def _split_at_panels(row: Sequence[PartNode], scene: RuleScene) -> list[list[PartNode]]:
    axis = across_axis(row[0])
    groups = [[row[0]]]
    for left, right in pairwise(row):
        if panel_behind(left, right, axis, scene):
            groups.append([])
        groups[-1].append(right)
    # Two doors alone are a pair whatever stands between them: each hangs on its own outer side.
    return [list(row)] if len(row) == 2 else groups


def panel_behind(left: PartNode, right: PartNode, axis: int, scene: RuleScene) -> bool:
    """Whether an upright panel stands behind the seam of two doors."""
    config, seam = scene.config.rows, (left.box.high[axis] + right.box.low[axis]) / 2
    reach = config.panel_near * float(left.box.size[axis] + right.box.size[axis]) / 2
    return any(
        abs(float(node.box.center[axis]) - seam) <= reach
        and overlap_ratio(left.box, node.box, 2) > config.panel_height
        and float(node.box.size[axis]) < config.panel_width * float(left.box.size[axis])
        for node in scene.supports
    )


def _side_in_odd_group(group: Sequence[PartNode], position: int, axis: int, scene: RuleScene) -> Side:
    """Returns the side for one of three, five, ...: pairs from the outer end that is nearer to the body's."""
    if len(group) == 1:
        return "none"
    gaps = (abs(group[0].box.low[axis] - scene.body.low[axis]), abs(group[-1].box.high[axis] - scene.body.high[axis]))
    order = position if gaps[0] <= gaps[1] else len(group) - 1 - position
    if order == len(group) - 1:
        return "none"
    outer = order % 2 == 0
    return "low" if outer == bool(np.less_equal(gaps[0], gaps[1])) else "high"
