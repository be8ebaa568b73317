"""Boards that close a carcass: a thin back between the walls or planted on their rear edges, a bottom between them.

They are added where they are requested or predicted. Each fits the real meshes: rays say where walls end, and a board
that would pierce anything, at rest or as a drawer runs, is not added. Boards are static and look like the body.

The room that boards have in a carcass, in a view: walls about a spot, what a board pierces, what holds it.
"""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace
from functools import cached_property
from typing import final

import numpy as np

from grafu.additions.carcass.bays import Bay, FrontsView
from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.carcass.missing_panels import MissingPanel, panels_missing
from grafu.additions.closed_scene import ClosedScene, closed_scene
from grafu.additions.likeness import surface_like
from grafu.additions.step import Addition, added_part, free_ids
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, Scalars, Vec3, vec3
from grafu.geometry.box import Box
from grafu.geometry.cells import meeting, pieces_in
from grafu.geometry.config_checks import at_scale
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.transform import from_rotation
from grafu.joints.plan import RealizationPlan
from grafu.joints.rail_config import DrawerConfig
from grafu.refusal import Asked, Reason, Refusal
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel

RAY_SPREAD = np.linspace(-0.4, 0.4, 9)
"""Places of rays around a spot that look for walls, as fractions of a bay's side."""
PIECES = 8
"""Pieces along each side of a board in which it is asked whether something stands there."""
FINE_PIECES = 16
"""The same where it is asked how far something reaches."""
WITHIN = 0.98
"""Fraction of a box within which a piece of a triangle lies in it, not in its rim."""


@final
@dataclass(frozen=True, eq=False)
class BoardRoom:
    """The still body, boards added to it so far, and the moving bodies, all closed, in a view."""

    body: TriangleMesh
    rays: RayCaster
    moving: np.ndarray
    floor: float
    config: CarcassConfig
    boards: tuple[Box, ...] = ()

    @classmethod
    def of(cls, still: TriangleMesh, moving: TriangleMesh, floor: float, config: CarcassConfig) -> "BoardRoom":
        """Returns the room around a still mesh and a moving one, both in the view."""
        return cls(still, RayCaster(still), moving.triangles, floor, config)

    @property
    def box(self) -> Box:
        """The box around the still body."""
        return self.body.box

    @cached_property
    def _added(self) -> TriangleMesh:
        return merge_meshes([TriangleMesh.box_mesh(board) for board in self.boards])

    @cached_property
    def _still(self) -> np.ndarray:
        return np.concatenate([self.body.triangles, self._added.triangles]) if self.boards else self.body.triangles

    def with_board(self, board: Box) -> "BoardRoom":
        """Returns the room with one more board in it."""
        return replace(self, boards=(*self.boards, board))

    def _cast(self, origins: Points, direction: Vec3) -> Scalars:
        met = self.rays.along(origins, direction)
        return np.minimum(met, RayCaster(self._added).along(origins, direction)) if self.boards else met

    def between(self, spot: Vec3, axis: int, bay: Bay, spread: int) -> tuple[float, float]:
        """Returns the coordinates of the walls before and beyond a spot along an axis.

        They are felt for from near the ends of the bay, at places along the axis `spread`; the innermost count. Where
        there is none, the bay ends.
        """
        low, high = float(bay.low[axis]), float(bay.high[axis])
        felt = self.config.wall_reach * (high - low)
        ends = []
        for sign, end in ((-1.0, low), (1.0, high)):
            origins = np.repeat(spot[None], len(RAY_SPREAD), axis=0)
            origins[:, axis] = end - sign * felt
            origins[:, spread] += RAY_SPREAD * (bay.high[spread] - bay.low[spread])
            direction = np.zeros(3)
            direction[axis] = sign
            hits = np.sort(self._cast(origins, direction))
            reach = np.inf if axis == 2 else 2.0 * felt  # a back ends at a board, not at a front
            is_wall = np.isfinite(hits[len(hits) // 2]) and hits[len(hits) // 2] <= reach
            ends.append(float(origins[0, axis]) + sign * (float(hits[0]) + self.config.inset) if is_wall else end)
        return ends[0], ends[1]

    def rear_of(self, around: Box, fallback: float) -> float:
        """Returns how far back anything reaches in a box."""
        pieces = pieces_in(np.concatenate([self._still, self.moving]), around, (PIECES, 1, PIECES))
        return max(float(pieces.high[:, 1].max(initial=fallback)), fallback) - self.config.inset

    def is_free(self, board: Box, touch: float) -> bool:
        """Whether a board pierces nothing by more than a touch in metres."""
        inside = Box.from_center(board.center, np.maximum(board.half - touch, self.config.core * board.half))
        still = pieces_in(meeting(self._still, inside), inside, (PIECES,) * 3)
        moving = pieces_in(meeting(self.moving, inside), inside, (PIECES,) * 3)
        return not len(still.low) and not len(moving.low)

    def behind_fronts(self, board: Box, ratio: float) -> float:
        """Returns the y from which on a board is clear of what stands in the first `ratio` of its depth (fronts, bars).

        What reaches further back does not count.
        """
        end = float(board.low[1] + ratio * board.size[1])
        inside = Box(board.low, np.array([board.high[0], end + ratio * board.size[1], board.high[2]]))
        pieces = pieces_in(np.concatenate([self._still, self.moving]), inside, (FINE_PIECES, FINE_PIECES, 2))
        ends = pieces.high[pieces.within(Box.from_center(inside.center, WITHIN * inside.half)), 1]
        return max(float(ends[ends <= end].max(initial=board.low[1])), float(board.low[1]))

    def holds(self, board: Box) -> bool:
        """Whether the body touches a board on both sides, above and below, or in front: what it is fixed to."""
        return any(self._touches(board, a, 0) and self._touches(board, a, 1) for a in (0, 2)) or (
            board.thin_axis == 1 and self._touches(board, 1, 0)
        )

    def _touches(self, board: Box, axis: int, end: int) -> bool:
        low, high = np.array(board.low), np.array(board.high)
        face = (board.high if end else board.low)[axis]
        low[axis], high[axis] = face - self.config.held, face + self.config.held
        return len(pieces_in(self._still, Box(low, high), (FINE_PIECES,) * 3).low) > 0


NO_ROOM = "no board fits between the walls without piercing something"


@final
@dataclass(frozen=True)
class CarcassCompletion:
    """What the carcasses lack, the boards added, and those that could not be, with why."""

    missing: tuple[MissingPanel, ...] = ()
    additions: tuple[Addition, ...] = ()
    refused: tuple[Refusal, ...] = ()


def complete_carcass(
    scene: Scene,
    plan: RealizationPlan,
    config: CarcassConfig = CarcassConfig(),
    drawers: DrawerConfig = DrawerConfig(),
    kinds: Collection[PartLabel] = (PartLabel.BACK_PANEL, PartLabel.BOTTOM_PANEL),
) -> CarcassCompletion:
    """Returns the backs and bottoms that close the bodies behind the doors and drawers of a plan; only those `kinds`.

    `missing` of the outcome are all that lack.
    """
    closed = closed_scene(scene, plan, drawers)
    config = at_scale(config, closed.scene.metre)
    missing = panels_missing(closed, config)
    additions, refused = list[Addition](), list[Refusal]()
    taken = set(scene.parts)
    rooms = {id(panel.view): _room(panel.view, closed, config) for panel in {id(k.view): k for k in missing}.values()}
    for group in _groups((panel for panel in missing if panel.what in kinds), config):
        room = rooms[id(group[0].view)]
        whole = _whole(group)
        together = _board(whole, room, config) is not None
        for panel in [whole] if together else group:
            board = _board(panel, room, config)
            if board is None:
                why = f"no {panel.what.value}: {NO_ROOM}"
                refused.append(Refusal(panel.moving_bodies[0], Reason.NO_ROOM, why, Asked.BOARD))
                continue
            room = rooms[id(panel.view)] = room.with_board(board)
            additions.append(_addition(panel, board, closed, taken))
            taken.add(additions[-1].part.id)
    return CarcassCompletion(missing, tuple(additions), tuple(refused))


def _addition(panel: MissingPanel, board: Box, closed: ClosedScene, taken: Collection[str]) -> Addition:
    (part_id,) = free_ids(panel.what.value.replace(" ", "_"), 1, taken)
    mesh = TriangleMesh.box_mesh(board).transformed(from_rotation(panel.view.rotation))
    return Addition(added_part(part_id, panel.what, (surface_like(mesh, closed.body),)), panel.why, "carcass board")


def _groups(missing: Iterable[MissingPanel], config: CarcassConfig) -> list[list[MissingPanel]]:
    """Returns the lacks of bays that adjoin one another together: they may share one board."""
    groups: list[list[MissingPanel]] = []
    for panel in missing:
        group = next((g for g in groups if _adjoins(panel, _whole(g), config)), None)
        if group is None:
            groups.append([panel])
        else:
            group.append(panel)
    return groups


def _whole(group: Sequence[MissingPanel]) -> MissingPanel:
    """Returns lacks as one."""
    bay = group[0].bay
    for panel in group[1:]:
        bay = bay.joined(panel.bay)
    return replace(group[0], bay=bay, moving_bodies=bay.moving_bodies, why="; ".join(panel.why for panel in group))


def _adjoins(a: MissingPanel, b: MissingPanel, config: CarcassConfig) -> bool:
    if a.view is not b.view or a.what is not b.what:
        return False
    low, high = np.minimum(a.bay.low, b.bay.low), np.maximum(a.bay.high, b.bay.high)
    gaps = np.maximum(a.bay.low - b.bay.high, b.bay.low - a.bay.high)[[0, 2]]
    areas = [float((s.high - s.low)[0] * (s.high - s.low)[2]) for s in (a.bay, b.bay)]
    whole = float((high - low)[0] * (high - low)[2])
    return bool(gaps.max() < config.side_by_side and whole - sum(areas) < config.wasted * whole)


def _board(panel: MissingPanel, room: BoardRoom, config: CarcassConfig) -> Box | None:
    """Returns the board that a carcass lacks, in its view; None where none fits."""
    for board in (
        _backs(panel.bay, room, config) if panel.what is PartLabel.BACK_PANEL else _bottoms(panel, room, config)
    ):
        if _fills(board, panel.bay, config.closed_ratio) and room.is_free(board, config.touch) and room.holds(board):
            return board
    return None


def _fills(board: Box, bay: Bay, ratio: float) -> bool:
    """Whether a board closes this fraction of a bay along its two longer sides."""
    thin = board.thin_axis
    along = [a for a in range(3) if a != thin]
    return bool(board.size[thin] > 0 and np.all(board.size[along] > ratio * (bay.high - bay.low)[along]))


def _room(view: FrontsView, closed: ClosedScene, config: CarcassConfig) -> BoardRoom:
    moving = [closed.scene.parts[i] for i in sorted(closed.scene.moving_ids)]
    merged = (merge_meshes([p.mesh for p in some]) for some in (closed.scene.static_parts, moving))
    still, moved = (TriangleMesh(view.local(mesh.vertices), mesh.faces) for mesh in merged)
    return BoardRoom.of(still, moved, closed.scene.floor, config)


def _backs(bay: Bay, room: BoardRoom, config: CarcassConfig) -> Iterable[Box]:
    """Yields backs, best first: between the walls, at their rear edges; then planted on these."""
    width, height = float(bay.high[0] - bay.low[0]), float(bay.high[2] - bay.low[2])
    thick = min(config.back, config.thickness_ratio * min(width, height))
    rear, middle = float(bay.high[1]), (bay.low + bay.high) / 2
    spot = vec3(float(middle[0]), rear - thick / 2, float(middle[2]))
    (x0, x1), (z0, z1) = room.between(spot, 0, bay, 2), room.between(spot, 2, bay, 0)
    yield _box((x0, rear - thick, z0), (x1, rear, z1))
    lap = min(config.on_edge, config.thickness_ratio * min(width, height))
    body = room.box
    low = vec3(
        max(float(bay.low[0]) - lap, body.low[0]),
        rear - config.rear_edges * width,
        max(float(bay.low[2]) - lap, body.low[2]),
    )
    high = vec3(min(float(bay.high[0]) + lap, body.high[0]), body.high[1], min(float(bay.high[2]) + lap, body.high[2]))
    edge = room.rear_of(Box(low, high), rear)
    yield _box((low[0], edge, low[2]), (high[0], edge + thick, high[2]))


def _bottoms(panel: MissingPanel, room: BoardRoom, config: CarcassConfig) -> Iterable[Box]:
    """Yields bottoms, best first: behind fronts that lie before the walls, below those between them; else the other.

    A face frame, or a front between the walls, stands before the board. Where drawers run low, a thinner one is tried.
    """
    bay = panel.bay
    width, depth = (float(bay.high[axis] - bay.low[axis]) for axis in (0, 1))
    full = min(config.bottom, config.thickness_ratio * min(width, depth))
    foot = float(bay.outline[2])
    for thick in (full, config.thinner * full):
        below = foot - min(config.gap, config.gap_ratio * thick) - thick
        for z in (below, foot) if bay.inset else (foot, below):
            if z < room.floor - config.touch:
                continue
            start, end = float(bay.low[1]), float(bay.high[1])
            spot = vec3(float(bay.low[0] + bay.high[0]) / 2, (start + end) / 2, z + thick / 2)
            x0, x1 = room.between(spot, 0, bay, 1)
            _, end = room.between(spot, 1, bay, 0)
            front = room.behind_fronts(_box((x0, start, z), (x1, end, z + thick)), config.frame_depth)
            yield _box((x0, front, z), (x1, end, z + thick))


def _box(low: tuple[float, float, float], high: tuple[float, float, float]) -> Box:
    return Box(np.minimum(low, high), np.maximum(low, high))
