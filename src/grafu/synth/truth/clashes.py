"""What the moving parts of synthetic furniture run into along their path: boxes by arithmetic, all else by meshes.

Most of synthetic furniture is boards, so that nearly every question is one of two boxes, and all poses and pairs are
asked at once. A solid box has an inside: what lies wholly within another counts; meshes have none, as in
`grafu.geometry.intersection`.

Synthetic furniture as an articulated object: its true joints as links, joints and limits, and which opens before which.

It moves nothing and draws nothing: the joints are those that the asset states.
"""

from collections.abc import Collection, Iterable, Mapping
from functools import cached_property
from typing import final
from weakref import finalize

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.kinematics import all_before
from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import AnnotatedJoint, Asset, Part
from grafu.geometry.arrays import Mat4, Scalars
from grafu.geometry.box_stack import BoxStack, box_frames, overlapping, penetrations, stacked
from grafu.geometry.intersection import MeshCollider, SweptBody
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.noise.tessellation import is_two_sided

DEPTH = 0.001  # metres that parts may sink into one another: below what a modeller sees, above rounding
POSES = 10  # of a turning part; a part that slides along its own edges is followed without gaps
_NEAR_REST = 1.5  # poses lie closer together near rest, where neighbours are nearest
_BOX_FACES = 12


def joint_motion(joint: AnnotatedJoint, value: float) -> Mat4:
    """Returns the 4x4 motion of a part from rest at a joint value, radians or metres."""
    return motion_kind(joint.type).transform(joint.axis, value)


def clashes_of(asset: Asset) -> "Clashes":
    """Returns what is worked out about an asset's collisions, once in the asset's life."""
    key = id(asset)
    if key not in _known:
        _known[key] = Clashes(asset)
        finalize(asset, _known.pop, key, None)
    return _known[key]


@final
class Clashes:
    """An asset's surfaces as boxes and meshes, ready for sweeps of its joints; not a value."""

    def __init__(self, asset: Asset) -> None:
        self._joints = {joint.part: joint for joint in asset.joints}
        self._pieces = _Pieces(asset)
        self._swept: dict[tuple[str, frozenset[str]], frozenset[str]] = {}

    def hits(self, part: str, opened: Collection[str] = ()) -> frozenset[str]:
        """Returns the ids of the parts that a moving part, or what rides on it, cuts into by more than `DEPTH`.

        It goes from rest to its upper limit. The moving parts in `opened` stand fully open, all others closed.
        """
        key = (part, frozenset(opened))
        if key not in self._swept:
            self._swept[key] = self._sweep(self._joints[part], key[1])
        return self._swept[key]

    def bodies_hit(self, part: str) -> tuple[str, ...]:
        """Returns the other moving parts that a moving part hits, attached parts included, where all are closed."""
        return tuple(sorted({self.carrier(other) for other in self.hits(part)} & self._joints.keys()))

    def carrier(self, part: str) -> str:
        """Returns the id of the part that a part rides on, or its own."""
        return self._pieces.carrier_of[part]

    def _sweep(self, joint: AnnotatedJoint, opened: frozenset[str]) -> frozenset[str]:
        pieces = self._pieces
        own = pieces.rows_of(joint.part)
        poses = {other: joint_motion(self._joints[other], self._joints[other].upper) for other in opened}
        boxes, rows = pieces.posed(poses), np.flatnonzero(pieces.carriers != pieces.number(joint.part))
        path = _Path(joint, pieces.boxes[own])
        reach = boxes.reaches[rows]
        near = (
            (boxes.centers[rows] - reach < path.high - DEPTH) & (boxes.centers[rows] + reach > path.low + DEPTH)
        ).all(axis=1)
        rows = rows[near]
        if not len(rows):
            return frozenset()
        moving, others = overlapping(path.boxes, boxes[rows], DEPTH)
        deep = penetrations(path.boxes[moving], boxes[rows[others]]) > DEPTH
        moving, others = moving[deep], rows[others[deep]]
        mine = own[path.rows[moving]]
        sure = pieces.is_box[mine] & pieces.is_box[others]
        found = {pieces.part_of(row) for row in np.unique(others[sure]).tolist()}
        doubtful = np.unique(np.stack([mine[~sure], others[~sure], path.poses[moving[~sure]]], axis=1), axis=0)
        return frozenset(found | self._hit_by_mesh(joint, doubtful, poses, found))

    def _hit_by_mesh(
        self, joint: AnnotatedJoint, doubtful: np.ndarray, poses: dict[str, Mat4], found: set[str]
    ) -> set[str]:
        """Returns the parts that are hit among (own piece, other piece, pose) rows; a pose of -1 stands for all."""
        pieces, hit = self._pieces, set(found)
        for mine, other, pose in doubtful.tolist():
            part = pieces.part_of(other)
            if part in hit:
                continue
            body, obstacle = pieces.body(mine), pieces.collider(other)
            obstacle.place(poses.get(pieces.carrier_of[part], np.eye(4)))
            for value in _values(joint) if pose < 0 else _values(joint)[[pose]]:
                body.place(joint_motion(joint, float(value)))
                if body.penetrates(obstacle):
                    hit.add(part)
                    break
        return hit - found


@final
class _Pieces:
    """All surfaces of an asset: the box of each, whether it is that box, the part it belongs to; not a value."""

    def __init__(self, asset: Asset) -> None:
        self.carrier_of = {part.id: part.carried_by or part.id for part in asset.parts}
        self._ids = [part.id for part in asset.parts]
        self._numbers = {part_id: number for number, part_id in enumerate(self._ids)}
        owned = [(n, s.mesh) for n, part in enumerate(asset.parts) for s in part.surfaces if not s.is_empty]
        self._meshes = [mesh for _, mesh in owned]
        self._parts = np.array([number for number, _ in owned], dtype=np.int64)
        self.carriers = np.array([self._numbers[self.carrier_of[i]] for i in self._ids], dtype=np.int64)[self._parts]
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
        """Returns the pieces of a moving part and of what rides on it."""
        return np.flatnonzero(self.carriers == self._numbers[moving])

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
class _Path:
    """The boxes of a moving part along its path: each box's piece (`rows`) and pose (-1: all of it); not a value."""

    def __init__(self, joint: AnnotatedJoint, boxes: BoxStack) -> None:
        slides = np.zeros(len(boxes), dtype=bool)
        if motion_kind(joint.type).slides:
            along = np.abs(np.einsum("nij,i->nj", boxes.rotations, joint.axis.direction))
            slides = along.max(axis=1) > 1.0 - 1e-9
        turning = np.flatnonzero(~slides)
        Ts = [joint_motion(joint, float(value)) for value in _values(joint)] if len(turning) else []
        stacks = [boxes[turning].moved(T) for T in Ts]
        if slides.any():
            stacks.append(_drawn_out(boxes[slides], joint))
        self.boxes = stacked(stacks)
        self.rows = np.concatenate([np.tile(turning, len(Ts)), np.flatnonzero(slides)]).astype(np.int64)
        self.poses = np.concatenate([np.repeat(np.arange(len(Ts)), len(turning)), np.full(slides.sum(), -1)])

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


_known: dict[int, Clashes] = {}


def articulated_of(whole: Asset) -> ArticulatedObject:
    """Returns one static root link with all still parts, and a link for each joint with what rides on its part.

    Joints open from 0 to their upper limit. A joint waits (`after`) for each moving part that it would run into where
    that part is closed, but not where it is open: a drawer waits for the doors before it.

    Raises:
        ArticulationError: if an upper limit is negative or not finite.
        ValueError: if two joints name one part, or one names a part that rides on another.
    """
    moving_bodies = {joint.part for joint in whole.joints}
    riding = sorted(i for i in moving_bodies if whole.part(i).carried_by)
    if len(moving_bodies) < len(whole.joints) or riding:
        raise ValueError(f"each joint of `{whole.name}` must have a part of its own that rides on nothing: {riding}")
    root = _free_name("body", {part.id for part in whole.parts})
    still = [part for part in whole.parts if (part.carried_by or part.id) not in moving_bodies]
    links = [Link(root, tuple(_visual(part) for part in still))]
    clashes, waits = clashes_of(whole), dict[str, tuple[str, ...]]()
    for joint in sorted(whole.joints, key=lambda j: len(clashes.bodies_hit(j.part))):
        waits[joint.part] = _waits_for(joint.part, clashes, waits)
    for joint in whole.joints:
        members = [part for part in whole.parts if joint.part in (part.id, part.carried_by)]
        links.append(Link(joint.part, tuple(_visual(part) for part in members)))
    joints = tuple(_joint(joint, root, waits[joint.part]) for joint in whole.joints)
    return ArticulatedObject(whole.name, root, tuple(links), joints)


def _waits_for(part: str, clashes: Clashes, waits: Mapping[str, tuple[str, ...]]) -> tuple[str, ...]:
    """Returns the moving parts that must be open before a part moves, none of which waits for that part itself."""
    others = [other for other in clashes.bodies_hit(part) if part not in all_before(other, waits)]
    if not others:
        return ()
    still_hit = {clashes.carrier(hit) for hit in clashes.hits(part, others)}
    return tuple(other for other in others if other not in still_hit)


def _joint(joint: AnnotatedJoint, root: str, after: tuple[str, ...]) -> Joint:
    limits = JointLimits(0.0, joint.upper)
    return Joint(_joint_id(joint.part), joint.type, root, joint.part, joint.axis, limits, tuple(map(_joint_id, after)))


def _joint_id(part: str) -> str:
    return f"{part}_joint"


def _visual(part: Part) -> Visual:
    return Visual(part.id, part.surfaces, label=part.label)


def _free_name(wanted: str, taken: set[str]) -> str:
    return wanted if wanted not in taken else _free_name(f"{wanted}_", taken)
