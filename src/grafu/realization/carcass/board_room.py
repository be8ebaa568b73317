"""The room that boards have in a carcass, in a view: walls about a spot, what a board pierces, what holds it."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import final

import numpy as np

from grafu.geometry.arrays import Points, Scalars, Vec3
from grafu.geometry.box import Box
from grafu.geometry.cells import meeting, pieces_in
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.realization.carcass.bays import Bay

_SPREAD = np.linspace(-0.4, 0.4, 9)  # shares of a bay's side around a spot from which walls are felt for
_BEFORE = 0.1  # share of a bay's side before its end from which a wall is felt for, and beyond it
_LET_IN = 2e-4  # metres by which a board is let into the walls that hold it
_NEAR = 2e-3  # metres within which a board is held


@final
@dataclass(frozen=True, eq=False)
class BoardRoom:
    """The still body, boards added to it so far, and the moving bodies, all closed, in a view."""

    body: TriangleMesh
    rays: RayCaster
    moving: np.ndarray
    boards: tuple[Box, ...] = ()

    @classmethod
    def of(cls, still: TriangleMesh, moving: TriangleMesh) -> "BoardRoom":
        """Returns the room around a still mesh and a moving one, both in the view."""
        return cls(still, RayCaster(still), moving.triangles)

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
        ends = []
        for sign, end in ((-1.0, low), (1.0, high)):
            origins = np.repeat(spot[None], len(_SPREAD), axis=0)
            origins[:, axis] = end - sign * _BEFORE * (high - low)
            origins[:, spread] += _SPREAD * (bay.high[spread] - bay.low[spread])
            direction = np.zeros(3)
            direction[axis] = sign
            hits = np.sort(self._cast(origins, direction))
            reach = np.inf if axis == 2 else 2.0 * _BEFORE * (high - low)  # a back ends at a board, not at a front
            is_wall = np.isfinite(hits[len(hits) // 2]) and hits[len(hits) // 2] <= reach
            ends.append(float(origins[0, axis]) + sign * (float(hits[0]) + _LET_IN) if is_wall else end)
        return ends[0], ends[1]

    def rear_of(self, around: Box, fallback: float) -> float:
        """Returns how far back anything reaches in a box."""
        pieces = pieces_in(np.concatenate([self._still, self.moving]), around, (8, 1, 8))
        return max(float(pieces.high[:, 1].max(initial=fallback)), fallback) - _LET_IN

    def is_free(self, board: Box, touch: float) -> bool:
        """Whether a board pierces nothing by more than a touch in metres."""
        inside = Box.from_center(board.center, np.maximum(board.half - touch, 0.1 * board.half))
        still = pieces_in(meeting(self._still, inside), inside, (8, 8, 8))
        moving = pieces_in(meeting(self.moving, inside), inside, (8, 8, 8))
        return not len(still.low) and not len(moving.low)

    def behind_fronts(self, board: Box, share: float) -> float:
        """Returns the y from which on a board is clear of what stands in the first `share` of its depth (fronts, bars).

        What reaches further back does not count.
        """
        end = float(board.low[1] + share * board.size[1])
        inside = Box(board.low, np.array([board.high[0], end + share * board.size[1], board.high[2]]))
        pieces = pieces_in(np.concatenate([self._still, self.moving]), inside, (16, 16, 2))
        ends = pieces.high[pieces.within(Box.from_center(inside.center, 0.98 * inside.half)), 1]
        return max(float(ends[ends <= end].max(initial=board.low[1])), float(board.low[1]))

    def holds(self, board: Box) -> bool:
        """Whether the body touches a board on both sides, above and below, or in front: what it is fixed to."""
        return any(self._touches(board, a, 0) and self._touches(board, a, 1) for a in (0, 2)) or (
            board.thin_axis == 1 and self._touches(board, 1, 0)
        )

    def _touches(self, board: Box, axis: int, end: int) -> bool:
        low, high = np.array(board.low), np.array(board.high)
        face = (board.high if end else board.low)[axis]
        low[axis], high[axis] = face - _NEAR, face + _NEAR
        return len(pieces_in(self._still, Box(low, high), (16, 16, 16)).low) > 0
