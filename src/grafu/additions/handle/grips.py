"""Grips that are geometry of a door or drawer itself: what stands out, holes, channels, notches, free edges.

It weighs what `finger_room` finds and states the confidence of each.

Cells that lie together on a relief, and their extents.
"""

from collections.abc import Iterator, Sequence
from typing import Literal, final

import numpy as np

from grafu.additions.handle.finger_room import (
    STEPS,
    Cells,
    Step,
    find_channels,
    find_hollows,
    find_hooks,
    find_lips,
    find_ridges,
)
from grafu.additions.handle.grasp_config import GraspConfig, GripConfidences
from grafu.additions.handle.relief import Relief
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Indices, Vec3, freeze_arrays, median
from grafu.scene.front import Side
from grafu.shapes import Int

CellRows = Int[np.ndarray, "k 2"]

CLUSTER_CELLS = 2
"""Cells across which two count as together."""


@final
@dataclass(frozen=True, eq=False)
class Cluster:
    """Cells that lie together: their indices, and the row numbers that they had among those asked for."""

    cells: CellRows
    rows: Indices

    def extent(self, relief: Relief, axis: int) -> float:
        """Returns the metres that the cells span along u (0) or v (1)."""
        return relief.cell * (float(np.ptp(self.cells[:, axis])) + 1.0)

    def longest_run(self, relief: Relief, axis: int) -> float:
        """Returns the metres of the longest gapless run of cells along u (0) or v (1), steps aside allowed."""
        at = np.unique(self.cells[:, axis])
        runs = np.split(at, np.flatnonzero(np.diff(at) > CLUSTER_CELLS) + 1)
        return relief.cell * max((float(run[-1] - run[0]) + 1.0 for run in runs), default=0.0)


def clusters_of(cells: CellRows) -> list[Cluster]:
    """Returns the groups of cells that lie within two cells of one another, largest first; cells may repeat."""
    numbers: dict[tuple[int, int], list[int]] = {}
    for row, (i, j) in enumerate(cells.tolist()):
        numbers.setdefault((i, j), []).append(row)
    left = set(numbers)
    groups: list[list[tuple[int, int]]] = []
    while left:
        found = [left.pop()]
        for i, j in found:
            near = [
                (a, b)
                for a in range(i - CLUSTER_CELLS, i + CLUSTER_CELLS + 1)
                for b in range(j - CLUSTER_CELLS, j + CLUSTER_CELLS + 1)
            ]
            found.extend(cell for cell in near if cell in left)
            left.difference_update(near)
        groups.append(found)
    return [_cluster(cells, numbers, group) for group in sorted(groups, key=len, reverse=True)]


def _cluster(cells: CellRows, numbers: dict[tuple[int, int], list[int]], group: Sequence[tuple[int, int]]) -> Cluster:
    rows = np.array(sorted(row for cell in group for row in numbers[cell]), dtype=np.int64)
    return Cluster(cells[rows], rows)


@final
@dataclass(frozen=True, eq=False)
class Grip(ArrayValue):
    """Where and how fingers hold a front; `center` in the object frame, `length` in metres, `confidence` in [0, 1]."""

    kind: Literal["recess", "edge"]
    confidence: float
    why: str
    center: Vec3
    length: float

    def __post_init__(self) -> None:
        freeze_arrays(self, "center", dtype=np.float64)


def grips_on(relief: Relief, config: GraspConfig) -> list[Grip]:
    """Returns all grips on a front that can open it: on doors, those far enough from the hinge."""
    where = _beyond_lever(relief, config)
    return [*_hooked(relief, config, where), *_standing_out(relief, config, where), *_sunk(relief, config, where)]


def _beyond_lever(relief: Relief, config: GraspConfig) -> Cells:
    """Returns the cells where a pull opens the moving body: all of a drawer's, those far from the hinge of a door's."""
    u, v = relief.u[:, None] / relief.front.width, relief.v[None, :] / relief.front.height
    away = {"left": u, "right": 1 - u, "bottom": v, "top": 1 - v}.get(relief.front.hinge or "", np.ones((1, 1)))
    return np.broadcast_to(away >= config.lever, relief.face.shape).copy()


def _hooked(relief: Relief, config: GraspConfig, where: Cells) -> Iterator[Grip]:
    """Yields what fingers reach round."""
    hooks = find_hooks(relief, config, where)
    steps = np.repeat(np.arange(len(STEPS)), [len(h.cells) for h in hooks])
    lips = np.concatenate([h.lip for h in hooks])
    for cluster in clusters_of(np.vstack([h.cells for h in hooks])):
        grip = _hook(relief, config, cluster, steps[cluster.rows], median(lips[cluster.rows]))
        if grip is not None:
            yield grip


def _hook(relief: Relief, config: GraspConfig, cluster: Cluster, steps: np.ndarray, lip: float) -> Grip | None:
    s, center, sure = relief.factor, _center(relief, cluster, lip), config.confidences
    runs = {int(step): _run_along(relief, cluster, steps == step, int(step)) for step in np.unique(steps)}
    step, length = max(runs.items(), key=lambda item: item[1])
    if lip < relief.plane - s * config.stands_out:
        out = length + relief.cell >= s * config.knob
        return Grip("edge", sure.hooked, "a grip of its own mesh stands out of it", center, length) if out else None
    within = _ratio_within(relief, cluster)
    narrow = min(cluster.extent(relief, 0), cluster.extent(relief, 1)) + relief.cell
    if within > config.inside and any(other ^ 1 in runs for other in runs) and narrow >= s * config.hole:
        return Grip("recess", sure.through, "a hole or slot goes through it", center, length)
    if length < min(s * config.length, config.long_ratio * relief.front.width, config.long_ratio * relief.front.height):
        return None
    if within > 0.5 and not _open_to_border(relief, cluster.cells[steps == step], STEPS[step], lip + s * config.hollow):
        return None  # behind slats or mouldings
    if within > 0.5:
        return Grip("recess", sure.cut_out, "fingers reach round the edge of a cut-out", center, length)
    confidence = _edge_confidence(relief.front.held, STEPS[step], sure)
    return Grip("edge", confidence, "fingers reach round a free edge of it", center, length)


def _edge_confidence(held: Side | None, step: Step, sure: GripConfidences) -> float:
    """Returns the confidence that a free edge, reached round towards `step`, is what a front is opened at.

    The edge that a door is held at and the upper edge of a drawer are; others serve where there is nothing else.
    """
    usual = {"left": (1, 0), "right": (-1, 0), "bottom": (0, 1), "top": (0, -1)}[held or "top"]
    return sure.held_edge if step == usual else sure.other_edge


def _run_along(relief: Relief, cluster: Cluster, rows: np.ndarray, step: int) -> float:
    side = Cluster(cluster.cells[rows], cluster.rows[rows])
    return side.longest_run(relief, 1 if STEPS[step][0] else 0)


def _standing_out(relief: Relief, config: GraspConfig, where: Cells) -> Iterator[Grip]:
    """Yields what fingers pinch, and lips along a border."""
    s, front, sure = relief.factor, relief.front, config.confidences
    for cluster in _clusters(find_ridges(relief, s * config.stub, s * config.pinch, s * config.gap, where)):
        depth, length = _depth(relief, cluster, config), _length(relief, cluster)
        out = depth < relief.plane - s * config.stands_out
        local = all(cluster.extent(relief, k) <= config.local_ratio * (front.width, front.height)[k] for k in (0, 1))
        if out and local and length + relief.cell >= s * config.knob:
            yield Grip(
                "edge", sure.pinched, "a grip of its own mesh stands out of it", _center(relief, cluster, depth), length
            )
    for cluster in _clusters(find_ridges(relief, s * config.reach, s * config.pinch, s * config.gap, where)):
        if (length := _length(relief, cluster)) >= s * config.length:
            center = _center(relief, cluster, _depth(relief, cluster, config))
            yield Grip("edge", sure.thin_edge, "it has a thin edge that is free on both sides", center, length)
    for cluster in _clusters(find_lips(relief, s * config.stub, s * config.lip, s * config.gap, where)):
        if (length := _length(relief, cluster)) >= s * config.length:
            center = _center(relief, cluster, _depth(relief, cluster, config))
            yield Grip("edge", sure.lip, "a lip stands out along its border", center, length)


def _sunk(relief: Relief, config: GraspConfig, where: Cells) -> Iterator[Grip]:
    """Yields hollows, channels and notches that fingers do not reach round."""
    s, sure = relief.factor, config.confidences
    widest, length = s * config.widest_hollow, s * config.length
    small = []
    for cluster in _clusters(
        find_hollows(relief, s * config.deep_hollow, s * config.smallest_hole, widest, where, config.fingers)
    ):
        u, v = cluster.extent(relief, 0), cluster.extent(relief, 1)
        narrow, wide = min(u, v) + relief.cell, max(u, v)
        center = _center(relief, cluster, _depth(relief, cluster, config))
        if narrow >= s * config.hole and (wide >= length or wide <= widest):
            yield Grip("recess", sure.hollow, "a hollow takes fingers", center, wide)
        elif wide <= widest:
            small.append(Grip("recess", sure.finger_hole, "a hole drawn for a finger", center, wide))
    yield from small if len(small) <= config.most_holes else ()
    for cluster in _clusters(find_channels(relief, s * config.hollow, s * config.gap, widest, where, config.fingers)):
        if (wide := _length(relief, cluster)) >= length:
            yield Grip(
                "recess",
                sure.channel,
                "a channel takes fingers",
                _center(relief, cluster, _depth(relief, cluster, config)),
                wide,
            )
    for cluster in _clusters(
        find_channels(relief, s * config.notch, s * config.smallest_hole, widest, where, config.fingers)
    ):
        u, v = cluster.extent(relief, 0), cluster.extent(relief, 1)
        local = u <= config.local_ratio * relief.front.width and v <= config.local_ratio * relief.front.height
        wide = max(u, v)
        if local and s * config.shortest_notch <= wide <= s * config.longest_notch and _meets_border(relief, cluster):
            center = _center(relief, cluster, _depth(relief, cluster, config))
            yield Grip("recess", sure.notch, "a notch drawn for fingers", center, wide)


def _clusters(cells: Cells) -> list[Cluster]:
    return clusters_of(np.argwhere(cells))


def _length(relief: Relief, cluster: Cluster) -> float:
    return max(cluster.longest_run(relief, 0), cluster.longest_run(relief, 1))


def _depth(relief: Relief, cluster: Cluster, config: GraspConfig) -> float:
    """Returns how deep a cluster lies, a finger's reach behind the front's plane at most."""
    seen = relief.face[cluster.cells[:, 0], cluster.cells[:, 1]]
    return median(np.minimum(seen, relief.plane + config.held * relief.factor))


def _center(relief: Relief, cluster: Cluster, depth: float) -> Vec3:
    i, j = cluster.cells.T
    return relief.front.to_object(np.array([[relief.u[i].mean(), depth, relief.v[j].mean()]]))[0]


def _open_to_border(relief: Relief, cells: np.ndarray, step: Step, depth: float) -> bool:
    """Whether most cells see free space `depth` deep all the way to the outline's border, away from `step`."""
    (i, j), box = np.array(step), relief.outline
    free = relief.first >= depth
    free |= ((relief.u < box.low[0]) | (relief.u > box.high[0]))[:, None]
    free |= ((relief.v < box.low[2]) | (relief.v > box.high[2]))[None, :]
    clear = []
    for a, b in cells.tolist():
        line = free[:, b] if i else free[a, :]
        at, forwards = (a, i < 0) if i else (b, j < 0)
        clear.append(bool(line[at:].all() if forwards else line[: at + 1].all()))
    return float(np.mean(clear)) > 0.5


def _meets_border(relief: Relief, cluster: Cluster) -> bool:
    """Whether a cell of the cluster lies on the border of the front's outline."""
    box, (i, j) = relief.outline, cluster.cells.T
    u, v = relief.u[i], relief.v[j]
    ends = np.minimum(np.minimum(u - box.low[0], box.high[0] - u), np.minimum(v - box.low[2], box.high[2] - v))
    return bool((ends <= 1.2 * relief.cell).any())


def _ratio_within(relief: Relief, cluster: Cluster) -> float:
    """Returns the fraction of a cluster's cells that lie in the front's outline."""
    box, (i, j) = relief.outline, cluster.cells.T
    u, v = relief.u[i], relief.v[j]
    return float(np.mean((u > box.low[0]) & (u < box.high[0]) & (v > box.low[2]) & (v < box.high[2])))
