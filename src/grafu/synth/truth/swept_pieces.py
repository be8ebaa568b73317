"""The surfaces of synthetic furniture as boxes and meshes, and the paths of what moves: what sweeps are made of."""

from collections.abc import Callable, Iterable
from functools import cached_property
from typing import Final, final

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import AnnotatedJoint, Asset
from grafu.geometry.arrays import Mat4, Scalars
from grafu.geometry.box_stack import BoxStack, box_frames, stacked
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.swept_body import SweptBody
from grafu.synth.noise.tessellation import is_two_sided
from grafu.synth.pieces.riding import bodies_of

DEPTH: Final = 0.001  # metres that parts may sink into one another: below what a modeller sees, above rounding
POSES: Final = 10  # of a turning part; a part that slides along its own edges is followed without gaps
_NEAR_REST = 1.5  # poses lie closer together near rest, where neighbours are nearest
_BOX_FACES = 12


def near_path(boxes: BoxStack, rows: np.ndarray, path: "SweptPath") -> np.ndarray:
    """Returns the rows of the boxes that lie near a path."""
    reach = boxes.reaches[rows]
    low, high = boxes.centers[rows] - reach, boxes.centers[rows] + reach
    return rows[((low < path.high - DEPTH) & (high > path.low + DEPTH)).all(axis=1)]


@final
class SweptPieces:
    """All surfaces of an asset: the box of each, whether it is that box, the part it belongs to; not a value."""

    def __init__(self, asset: Asset) -> None:
        self.body_of = bodies_of(asset)
        self._ids = [part.id for part in asset.parts]
        self._numbers = {part_id: number for number, part_id in enumerate(self._ids)}
        owned = [(n, s.mesh) for n, part in enumerate(asset.parts) for s in part.surfaces if not s.is_empty]
        self._meshes = [mesh for _, mesh in owned]
        self._parts = np.array([number for number, _ in owned], dtype=np.int64)
        self.bodies = np.array([self._numbers[self.body_of[i]] for i in self._ids], dtype=np.int64)[self._parts]
        self.is_box, self.boxes = _boxes(self._meshes)
        self._bodies: dict[int, SweptBody] = {}
        self._colliders: dict[int, MeshCollider] = {}

    def number(self, part: str) -> int:
        """Returns the place of a part among the asset's."""
        return self._numbers[part]

    def part_of(self, row: int) -> str:
        """Returns the id of the part that a piece belongs to."""
        return self._ids[self._parts[row]]

    def rows_of(self, moving: str) -> np.ndarray:
        """Returns the pieces of a moving part and of what moves as one with it."""
        return np.flatnonzero(self.bodies == self._numbers[moving])

    def posed(self, poses: dict[str, Mat4]) -> BoxStack:
        """Returns the boxes of all pieces, some moving parts posed."""
        if not poses:
            return self.boxes
        centers, rotations = self.boxes.centers.copy(), self.boxes.rotations.copy()
        for moving, T in poses.items():
            rows = self.rows_of(moving)
            there = self.boxes[rows].moved(T)
            centers[rows], rotations[rows] = there.centers, there.rotations
        return BoxStack(centers, self.boxes.halves, rotations)

    def body(self, row: int) -> SweptBody:
        """Returns a piece as a moving body."""
        if row not in self._bodies:
            self._bodies[row] = SweptBody(self._meshes[row], DEPTH, np.asarray(self.boxes.rotations[row]))
        return self._bodies[row]

    def collider(self, row: int) -> MeshCollider:
        """Returns a piece as an obstacle."""
        if row not in self._colliders:
            self._colliders[row] = MeshCollider(self._meshes[row])
        return self._colliders[row]


@final
class SweptPath:
    """The boxes of a moving part along its path: each box's piece (`rows`) and pose (-1: all of it); not a value."""

    def __init__(self, joint: AnnotatedJoint, boxes: BoxStack, motion: Callable[[float], Mat4] | None = None) -> None:
        """Takes the joint's own motion where none is given."""
        slides = np.zeros(len(boxes), dtype=bool)
        if motion_kind(joint.type).slides and motion is None:
            along = np.abs(np.einsum("nij,i->nj", boxes.rotations, joint.axis.direction))
            slides = along.max(axis=1) > 1.0 - 1e-9
        turning = np.flatnonzero(~slides)
        self._joint, self._motion = joint, motion
        stacks = [boxes[turning].moved(T) for T in self.motions] if len(turning) else []
        count = len(stacks)
        if slides.any():
            stacks.append(_drawn_out(boxes[slides], joint))
        self.boxes = stacked(stacks)
        self.rows = np.concatenate([np.tile(turning, count), np.flatnonzero(slides)]).astype(np.int64)
        self.poses = np.concatenate([np.repeat(np.arange(count), len(turning)), np.full(slides.sum(), -1)])

    @cached_property
    def motions(self) -> list[Mat4]:
        """Where it is in each pose, from rest to the upper limit."""
        motion = self._motion or motion_kind(self._joint.type).along(self._joint.axis)
        return [motion(float(value)) for value in _values(self._joint)]

    @cached_property
    def low(self) -> np.ndarray:
        """The lowest corner of all boxes along the path."""
        return (self.boxes.centers - self.boxes.reaches).min(axis=0)

    @cached_property
    def high(self) -> np.ndarray:
        """The highest corner of all boxes along the path."""
        return (self.boxes.centers + self.boxes.reaches).max(axis=0)


def _drawn_out(boxes: BoxStack, joint: AnnotatedJoint) -> BoxStack:
    """Returns boxes lengthened along one of their own axes to all that they pass through."""
    along = np.abs(np.einsum("nij,i->nj", boxes.rotations, joint.axis.direction))
    centers = boxes.centers + joint.axis.direction * joint.upper / 2
    return BoxStack(centers, boxes.halves + along * joint.upper / 2, boxes.rotations)


def _values(joint: AnnotatedJoint) -> Scalars:
    return joint.upper * np.linspace(0.0, 1.0, POSES) ** _NEAR_REST


def _boxes(meshes: Iterable[TriangleMesh]) -> tuple[np.ndarray, BoxStack]:
    """Returns which meshes are boxes, and the boxes of all: their own, or the axis-aligned ones around them."""
    meshes = list(meshes)
    maybe = np.array([_may_be_box(mesh) for mesh in meshes], dtype=bool)
    lows, highs = np.array([mesh.box.low for mesh in meshes]), np.array([mesh.box.high for mesh in meshes])
    around = BoxStack.aligned(lows.reshape(-1, 3), highs.reshape(-1, 3))
    if not maybe.any():
        return maybe, around
    rows = np.flatnonzero(maybe)
    is_box, boxes = box_frames(np.stack([meshes[k].vertices[meshes[k].faces[:_BOX_FACES]] for k in rows]))
    parts = [np.array(getattr(around, name)) for name in ("centers", "halves", "rotations")]
    for values, name in zip(parts, ("centers", "halves", "rotations"), strict=True):
        values[rows] = getattr(boxes, name)
    maybe[rows] = is_box
    return maybe, BoxStack(*parts)


def _may_be_box(mesh: TriangleMesh) -> bool:
    """Whether a mesh has as many faces as a box, or as many again turned over."""
    count = len(mesh.faces)
    return count == _BOX_FACES or (count == 2 * _BOX_FACES and is_two_sided(mesh.faces))
