"""Does a posed mesh cut into others by more than a touch: asked pose after pose, along a path."""

from collections.abc import Sequence
from functools import cached_property
from typing import final

import numpy as np

from grafu.geometry.arrays import Mat3, Mat4
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import transform_points

# A mesh is never shrunk to less than this fraction of its side: thin hardware keeps a core.
_CORE = 0.2


def shrunk(mesh: TriangleMesh, depth: float, rotation: Mat3 | None = None) -> TriangleMesh:
    """Returns the mesh scaled towards its box's centre so that each side of the box moves in by `depth` metres.

    `rotation` gives the axes of the box as columns (none: the object frame's). A side keeps at least a fifth.
    """
    R = np.eye(3) if rotation is None else rotation
    local = mesh.vertices @ R
    box = Box.around(local)
    size = np.maximum(box.size, 1e-12)
    factor = np.maximum(size - 2 * depth, _CORE * size) / size
    T = np.eye(4)
    T[:3, :3] = R @ np.diag(factor) @ R.T
    center = R @ box.center
    T[:3, 3] = center - T[:3, :3] @ center
    return TriangleMesh(transform_points(T, mesh.vertices), mesh.faces)


@final
class SweptBody:
    """A rigid moving mesh that tells a touch from a penetration deeper than `depth` metres.

    It penetrates an obstacle when it still intersects it after it was shrunk by `depth` on each side, and still does so
    after a further shift by `depth` along each of the six directions of its own box: faces that merely lie flush come
    free in one of them. A single face thus counts as cut from twice the depth on.

    `pieces` are meshes that make up the body (none: it is one): what was tested before is not prepared anew.
    """

    def __init__(
        self, mesh: TriangleMesh, depth: float, rotation: Mat3 | None = None, pieces: Sequence[TriangleMesh] = ()
    ) -> None:
        axes = np.eye(3) if rotation is None else rotation
        self._plain = [MeshCollider(piece) for piece in pieces or (mesh,)]
        self._whole = mesh, depth, axes
        self._T: Mat4 = np.eye(4)
        self._pose = 0
        self._poses: dict[bytes, int] = {np.eye(4).tobytes(): 0}
        self._known: dict[tuple[int, int, int], bool] = {}
        self._is_core_first: dict[int, bool] = {}  # by pose: once it is prepared the core, which meets less, is first
        self._shifts = [sign * depth * axes[:, k] for k in range(3) for sign in (-1.0, 1.0)]
        self._latest = 0

    @cached_property
    def _shrunk(self) -> MeshCollider:
        """What counts as penetrating; most bodies come near nothing."""
        return MeshCollider(shrunk(*self._whole))

    def place(self, T: Mat4) -> None:
        """Poses the body at T for the queries that follow."""
        self._T = T
        self._pose = self._poses.setdefault(T.tobytes(), len(self._poses))
        for piece in self._plain:
            piece.place(T)

    def touches(self, obstacle: MeshCollider) -> bool:
        """Whether the body, as posed, shares a point with the obstacle."""
        for k, piece in enumerate(self._plain, len(self._shifts) + 1):  # most are apart: no more calls than needed
            if not piece.is_apart(obstacle) and self._meet(piece, k, obstacle):
                return True
        return False

    def _meet(self, own: MeshCollider, step: int, obstacle: MeshCollider) -> bool:
        """Whether one of the body's own meshes, as posed, intersects an obstacle whose box it meets.

        `step` tells which, and its shift. Sweep after sweep asks for the same poses: what is known of an obstacle at
        rest is not asked again.
        """
        number = obstacle.number
        if number is None:
            return own.hits(obstacle)
        key = (self._pose, step, number)
        if (found := self._known.get(key)) is None:
            found = self._known[key] = own.hits(obstacle)
        return found

    def _core_meets(self, step: int, obstacle: MeshCollider) -> bool:
        return not self._shrunk.is_apart(obstacle) and self._meet(self._shrunk, step, obstacle)

    def penetrates(self, obstacle: MeshCollider) -> bool:
        """Whether the body, as posed, cuts into the obstacle by more than the depth."""
        return bool(self.penetrated([obstacle]))

    def penetrated(self, obstacles: Sequence[MeshCollider]) -> list[int]:
        """Returns the numbers of the obstacles that the body, as posed, cuts into by more than the depth.

        They count together: a body wedged between two obstacles comes free of each in some direction, of both in none.
        """
        if all(piece.is_apart(obstacle) for obstacle in obstacles for piece in self._plain):
            return []
        self._shrunk.place(self._T)
        if all(self._shrunk.is_apart(obstacle) for obstacle in obstacles):
            return []
        core_first = self._is_core_first.setdefault(self._pose, len(self._plain) == 1 and self._shrunk.is_prepared)
        if not core_first and not self._touches_any(obstacles):
            return []
        met = [k for k, obstacle in enumerate(obstacles) if self._core_meets(0, obstacle)]
        if not met or (core_first and not self._touches_any(obstacles)):
            return []
        order = (*met, *(k for k in range(len(obstacles)) if k not in met))  # what was met is likely met again
        for step, shift in enumerate(self._shifts, 1):
            self._shrunk.place(self._T, shift)
            if not any(self._core_meets(step, obstacles[k]) for k in order):
                return []
        return met

    def _touches_any(self, obstacles: Sequence[MeshCollider]) -> bool:
        """Whether the body, as posed, shares a point with one of them; the one that it touched last is asked first."""
        if self._latest < len(obstacles) and self.touches(obstacles[self._latest]):
            return True
        found = next((k for k, obstacle in enumerate(obstacles) if k != self._latest and self.touches(obstacle)), None)
        if found is None:
            return False
        self._latest = found
        return True

    def cutting_faces(self, obstacles: Sequence[MeshCollider], counted: Sequence[bool]) -> set[int]:
        """Returns the numbers of the body's faces that, as posed, cut into those obstacles that are counted.

        The others count where the body is wedged between them and a counted one.
        """
        met = [k for k in self.penetrated(obstacles) if counted[k]]
        if not met:
            return set()
        self._shrunk.place(self._T)
        return set().union(*(self._shrunk.faces_in_contact(obstacles[k]) for k in met))

    def distance(self, obstacle: MeshCollider) -> float:
        """Returns the distance in metres of the body, as posed, from the obstacle; 0 where they intersect."""
        return min(piece.distance(obstacle) for piece in self._plain)
