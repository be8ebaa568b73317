"""A large mesh in blocks of faces that lie together, each with a BVH of its own, built when something comes near it.

Parts meet at their borders. A question about a border then builds what lies along it, not the whole mesh.
"""

from collections.abc import Iterator
from functools import cached_property
from typing import final
from weakref import finalize

import fcl
import numpy as np

from grafu.geometry.arrays import Mat3, Points, Vec3, renumbered
from grafu.geometry.bvh import MeshTree, model_of, next_number
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.shapes import Float, Int

LARGE = 5_000  # faces: smaller meshes are not divided
BLOCK = 2_000  # faces of a block, at most
_SLACK = 1e-9  # metres by which boxes that only touch may seem apart, by rounding


@final
class MeshBlocks:
    """The blocks of a mesh, and the boxes around them in its frame; not a value."""

    def __init__(self, mesh: TriangleMesh) -> None:
        self._vertices, self._corners = mesh.vertices, mesh.faces  # not the mesh, which would never die
        low, high = triangle_bounds(mesh.triangles)
        self.faces: list[Int[np.ndarray, " _"]] = list(_divided((low + high) / 2, np.arange(len(low))))
        ends = [(low[block].min(axis=0), high[block].max(axis=0)) for block in self.faces]
        lows, highs = (np.array(side) for side in zip(*ends, strict=True))
        self.centers, self.halves = (lows + highs) / 2, (highs - lows) / 2
        self._made: dict[int, TriangleMesh] = {}
        self.number = next_number()

    def tree(self, block: int) -> MeshTree:
        """Returns the BVH of a block, built when first asked for."""
        if block not in self._made:
            corners, used = renumbered(self._corners[self.faces[block]], len(self._vertices))
            self._made[block] = TriangleMesh(self._vertices[corners], used)
        return model_of(self._made[block])


_divided_meshes: dict[int, MeshBlocks] = {}


def blocks_of(mesh: TriangleMesh) -> MeshBlocks | None:
    """Returns the blocks of a large mesh, found once in the mesh's life; None of a mesh that is not large."""
    if len(mesh.faces) <= LARGE:
        return None
    key = id(mesh)
    if key not in _divided_meshes:
        _divided_meshes[key] = MeshBlocks(mesh)
        finalize(mesh, _divided_meshes.pop, key, None)
    return _divided_meshes[key]


def forget_large_shapes() -> None:
    """Forgets the BVHs of large meshes, which take several times the room of the mesh; they are built again when asked.

    What was prepared of them before stays as it is.
    """
    _divided_meshes.clear()


def _divided(centers: Points, chosen: Int[np.ndarray, " _"]) -> Iterator[Int[np.ndarray, " _"]]:
    """Yields the faces halved along the longest side of the box around their centres until few are left together."""
    if len(chosen) <= BLOCK:
        yield chosen
        return
    own = centers[chosen]
    along = own[:, int(np.argmax(np.ptp(own, axis=0)))]
    order, middle = np.argpartition(along, len(along) // 2), len(along) // 2
    yield from _divided(centers, chosen[order[:middle]])
    yield from _divided(centers, chosen[order[middle:]])


@final
class PosedBlocks:
    """The blocks of a mesh in a rigid pose; not a value."""

    def __init__(self, blocks: MeshBlocks) -> None:
        self.blocks = blocks
        self._R: Mat3 = np.eye(3)
        self._t: Vec3 = np.zeros(3)
        self._pose = 0
        self._objects: dict[int, tuple[fcl.CollisionObject, int]] = {}  # each with the pose that it has

    def place(self, R: Mat3, t: Vec3) -> None:
        """Poses the mesh: turned by R, then moved by t metres."""
        self._R, self._t, self._pose = R, t, self._pose + 1
        self.__dict__.pop("ends", None)

    @cached_property
    def ends(self) -> tuple[Points, Points]:
        """The lowest and highest corners of the boxes around the blocks as posed."""
        centers, halves = self.blocks.centers @ self._R.T + self._t, self.blocks.halves @ np.abs(self._R).T
        return centers - halves - _SLACK, centers + halves + _SLACK

    def object_of(self, block: int) -> fcl.CollisionObject:
        """Returns a block as FCL's object in the present pose."""
        made, pose = self._objects.get(block, (None, -1))
        if made is None:
            made = fcl.CollisionObject(self.blocks.tree(block).bvh)
        if pose != self._pose:
            made.setTransform(fcl.Transform(*self._transform(block)))
            self._objects[block] = made, self._pose
        return made

    def _transform(self, block: int) -> tuple[Mat3, Vec3]:
        start = self.blocks.tree(block).pose
        if start is None:
            return self._R, self._t
        return self._R @ start[:3, :3], self._R @ start[:3, 3] + self._t


_Ends = tuple[Float[np.ndarray, "a 3"], Float[np.ndarray, "a 3"]]  # lowest and highest corners of boxes
_OtherEnds = tuple[Float[np.ndarray, "b 3"], Float[np.ndarray, "b 3"]]


def meeting_boxes(one: _Ends, other: _OtherEnds) -> Int[np.ndarray, "n 2"]:
    """Returns which boxes of one and of another share a point: rows of two numbers."""
    (low, high), (their_low, their_high) = one, other
    first = np.flatnonzero(((low <= their_high.max(axis=0)) & (high >= their_low.min(axis=0))).all(axis=1))
    second = np.flatnonzero(((their_low <= high.max(axis=0)) & (their_high >= low.min(axis=0))).all(axis=1))
    lowest = np.maximum(low[first, None], their_low[None, second])
    i, j = np.nonzero((lowest <= np.minimum(high[first, None], their_high[None, second])).all(axis=2))
    return np.stack([first[i], second[j]], axis=1)


def gaps_between(one: _Ends, other: _OtherEnds) -> Float[np.ndarray, "a b"]:
    """Returns the distances between the boxes of one and of another, metres: a row for each of `one`."""
    (low, high), (their_low, their_high) = one, other
    apart = np.maximum(low[:, None] - their_high[None], their_low[None] - high[:, None])
    return np.linalg.norm(np.maximum(apart, 0.0), axis=2)
