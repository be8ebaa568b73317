"""Do two posed meshes intersect, and how far apart are they.

A BVH of triangles has no inside: a mesh that lies wholly within another does not intersect it. Furniture parts that
pass through one another cut surfaces, which is what is asked here.
"""

from functools import cached_property
from typing import final

import fcl
import numpy as np

from grafu.geometry.arrays import Mat3, Mat4, Points, Vec3
from grafu.geometry.blocks import PosedBlocks, blocks_of, gaps_between, meeting_boxes
from grafu.geometry.box import Box
from grafu.geometry.budget import require_time
from grafu.geometry.bvh import model_of
from grafu.geometry.mesh import TriangleMesh

_MOST_CONTACTS = 5000
_ANY_CONTACT = fcl.CollisionRequest()


@final
class MeshCollider:
    """A mesh prepared for many queries in rigid poses (a triangle BVH); not a value.

    `box` is the box at rest.
    """

    def __init__(self, mesh: TriangleMesh) -> None:
        self.box: Box = mesh.box
        self._mesh = mesh
        self._low, self._high = mesh.box.low.tolist(), mesh.box.high.tolist()
        self._turned: tuple[bytes, tuple[float, ...], tuple[float, ...]] | None = None
        self._pose: tuple[Mat3, Vec3] | None = None
        self._set: bytes = b""  # the rotation that the FCL object has
        self._made: fcl.CollisionObject | None = None
        self._start: Mat4 | None = None
        self._number: int | None = None
        self._is_at_rest = True

    @cached_property
    def _corners(self) -> Points:
        return self.box.corners()

    @property
    def number(self) -> int | None:
        """The number of the mesh where it stands at rest; None of a posed one, which may stand anywhere."""
        if self._number is None:
            blocks = blocks_of(self._mesh)
            self._number = model_of(self._mesh).number if blocks is None else blocks.number
        return self._number if self._is_at_rest else None

    @property
    def _object(self) -> fcl.CollisionObject:
        """The FCL object in its present pose; the BVH is built when first asked for."""
        if self._made is None:
            model = model_of(self._mesh)
            self._made, self._start = fcl.CollisionObject(model.bvh), model.pose
            if self._pose is None and self._start is not None:
                self._pose = (np.eye(3), np.zeros(3))
        if self._pose is not None:
            R, t = self._pose
            if self._start is not None:
                R, t = R @ self._start[:3, :3], R @ self._start[:3, 3] + t
            if (rotation := R.tobytes()) == self._set:
                self._made.setTranslation(t)  # a tenth of the time
            else:
                self._made.setTransform(fcl.Transform(R, t))
                self._set = rotation
            self._pose = None
        return self._made

    @cached_property
    def _blocks(self) -> PosedBlocks | None:
        """The blocks of a large mesh."""
        blocks = blocks_of(self._mesh)
        return None if blocks is None else PosedBlocks(blocks)

    @property
    def _ends(self) -> tuple[Points, Points]:
        """The lowest and highest corners of the boxes around the blocks as posed, or of the one around a small mesh."""
        if self._blocks is None:
            return np.array([self._low]), np.array([self._high])
        if self._pose is not None:
            self._blocks.place(*self._pose)
            self._pose = None
        return self._blocks.ends

    def _part(self, block: int) -> fcl.CollisionObject:
        return self._object if self._blocks is None else self._blocks.object_of(block)

    def _meeting(self, other: "MeshCollider") -> list[tuple[int, int]]:
        """Returns the pairs of blocks whose boxes meet."""
        return [(i, j) for i, j in meeting_boxes(self._ends, other._ends).tolist()]

    def _is_divided(self, other: "MeshCollider") -> bool:
        return self._blocks is not None or other._blocks is not None

    @property
    def is_prepared(self) -> bool:
        """Whether the BVH is there."""
        return self._made is not None or self.__dict__.get("_blocks") is not None

    def place(self, T: Mat4, shift: Vec3 | None = None) -> None:
        """Poses the mesh at T, then moved by `shift` metres."""
        offset = T[:3, 3] if shift is None else T[:3, 3] + shift
        self._pose, self._is_at_rest = (T[:3, :3], offset), False
        key = T[:3, :3].tobytes()  # what slides is not turned anew at each pose
        if self._turned is None or self._turned[0] != key:
            x, y, z = zip(*(self._corners @ T[:3, :3].T).tolist(), strict=True)
            self._turned = key, (min(x), min(y), min(z)), (max(x), max(y), max(z))
        (_, low, high), (x, y, z) = self._turned, offset.tolist()  # plain numbers, as in `is_apart`
        self._low, self._high = [low[0] + x, low[1] + y, low[2] + z], [high[0] + x, high[1] + y, high[2] + z]

    def posed(self, T: Mat4) -> "MeshCollider":
        """Returns another collider of the same mesh, posed at T."""
        found = MeshCollider(self._mesh)
        found.place(T)
        return found

    def intersects(self, other: "MeshCollider") -> bool:
        """Whether the two, as posed, share a point."""
        return not self.is_apart(other) and self.hits(other)

    def hits(self, other: "MeshCollider") -> bool:
        """Whether the two, whose boxes meet, share a point."""
        require_time()
        if self._is_divided(other):
            return any(_collide(self._part(i), other._part(j)) for i, j in self._meeting(other))
        return _collide(self._object, other._object)

    def is_apart(self, other: "MeshCollider") -> bool:
        """Whether the boxes of the two, as posed, share no point."""
        # Plain numbers are quicker than numpy: most of the many pairs asked for are apart.
        (x, y, z), (x_end, y_end, z_end) = self._low, other._high
        if x > x_end or y > y_end or z > z_end:
            return True
        (x, y, z), (x_end, y_end, z_end) = other._low, self._high
        return bool(x > x_end or y > y_end or z > z_end)

    def faces_in_contact(self, other: "MeshCollider") -> set[int]:
        """Returns the numbers of this mesh's faces that intersect the other as posed."""
        if self.is_apart(other):
            return set()
        require_time()
        if self._is_divided(other):
            return set().union(*(self._touched(i, other._part(j)) for i, j in self._meeting(other)))
        return self._touched(0, other._object)

    def _touched(self, block: int, other: fcl.CollisionObject) -> set[int]:
        """Returns the numbers of the mesh's faces in a block that intersect another object."""
        request = fcl.CollisionRequest(num_max_contacts=_MOST_CONTACTS, enable_contact=True)
        result = fcl.CollisionResult()
        fcl.collide(self._part(block), other, request, result)
        hit = {int(contact.b1) for contact in result.contacts}
        if self._blocks is None:
            return model_of(self._mesh).faces(hit)
        own = self._blocks.blocks
        return set(own.faces[block][list(own.tree(block).faces(hit))].tolist())

    def box_gap(self, other: "MeshCollider") -> float:
        """Returns the distance in metres between the boxes of the two as posed: at most that of the meshes."""
        low, high, their_low, their_high = map(np.asarray, (self._low, self._high, other._low, other._high))
        return float(np.linalg.norm(np.maximum(np.maximum(low - their_high, their_low - high), 0.0)))

    def is_within(self, reach: float, other: "MeshCollider") -> bool:
        """Whether the two, as posed, come within `reach` metres of one another."""
        return self.box_gap(other) <= reach and self.distance(other) <= reach

    def distance(self, other: "MeshCollider") -> float:
        """Returns the distance in metres between the two as posed, 0 where they intersect."""
        require_time()
        if not self._is_divided(other):
            return _distance(self._object, other._object)
        least = np.inf
        gaps = gaps_between(self._ends, other._ends)
        for k in np.argsort(gaps, axis=None).tolist():
            if gaps.flat[k] >= least:
                break
            i, j = divmod(k, gaps.shape[1])
            least = min(least, _distance(self._part(i), other._part(j)))
        return float(least)


def _collide(one: fcl.CollisionObject, other: fcl.CollisionObject) -> bool:
    return bool(fcl.collide(one, other, _ANY_CONTACT, fcl.CollisionResult()) > 0)


def _distance(one: fcl.CollisionObject, other: fcl.CollisionObject) -> float:
    return max(float(fcl.distance(one, other, fcl.DistanceRequest(), fcl.DistanceResult())), 0.0)
