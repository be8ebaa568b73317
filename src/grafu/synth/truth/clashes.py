"""What the moving parts of synthetic furniture run into along their path: boxes by arithmetic, all else by meshes.

Most of synthetic furniture is boards, so that nearly every question is one of two boxes, and all poses and pairs are
asked at once. A solid box has an inside: what lies wholly within another counts; meshes have none, as in
`grafu.geometry.intersection`.

Synthetic furniture as an articulated object: its true joints as links, joints and limits, and which opens before which.

It moves nothing and draws nothing: the joints are those that the asset states.
"""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from typing import final
from weakref import finalize

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.kinematics import all_before
from grafu.asset.part import AnnotatedJoint, Asset, Part
from grafu.geometry.arrays import Mat4
from grafu.geometry.box_stack import overlapping, penetrations
from grafu.synth.pieces.riding import bodies_of, carriers_of, led_by, poses_at
from grafu.synth.truth.swept_pieces import DEPTH, SweptPath, SweptPieces, near_path


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
        self._carriers = carriers_of(asset)
        self._followers = {part: led_by(asset.joints, part) for part in self._joints}
        self._pieces = SweptPieces(asset)
        self._swept: dict[tuple[str, frozenset[str]], frozenset[str]] = {}

    def hits(self, part: str, opened: Collection[str] = ()) -> frozenset[str]:
        """Returns the ids of the parts that a moving part, or what rides on it, cuts into by more than `DEPTH`.

        It goes from rest to its upper limit, and with it what it carries and what follows it there. The moving parts in
        `opened`, and what follows them, stand fully open, all others closed. What follows its own carrier is swept with
        that one alone.
        """
        key = (part, frozenset(opened))
        if key not in self._swept:
            led = any(part in self._followers[other] for other in self._above(part))
            self._swept[key] = frozenset() if led else self._sweep(self._joints[part], key[1])
        return self._swept[key]

    def bodies_hit(self, part: str) -> tuple[str, ...]:
        """Returns the other moving parts that a moving part hits, attached parts included, where all are closed."""
        return tuple(sorted({self.carrier(other) for other in self.hits(part)} & self._joints.keys()))

    def carrier(self, part: str) -> str:
        """Returns the id of the moving part that a part moves as one with, or its own."""
        return self._pieces.body_of[part]

    def _above(self, part: str) -> list[str]:
        """Returns the moving parts that carry a moving part, the nearest first."""
        above = self._carriers[part]
        return [above, *self._above(above)] if above else []

    def _sweep(self, joint: AnnotatedJoint, opened: frozenset[str]) -> frozenset[str]:
        pieces, part = self._pieces, joint.part
        open_too = {follower for other in opened for follower in self._followers[other]}
        values = {other: self._joints[other].upper for other in opened | open_too}
        poses = poses_at(self._joints, self._carriers, values)
        boxes = pieces.posed(poses)
        carried = [part, *(other for other in self._joints if part in self._above(other))]
        others = np.flatnonzero(~np.isin(pieces.bodies, [pieces.number(body) for body in carried]))
        found: set[str] = set()
        for motion, own in self._paths(joint, carried, poses.get(self._carriers[part])):
            path = SweptPath(joint, pieces.boxes[own], motion)
            near = near_path(boxes, others, path)
            if not len(near):
                continue
            moving, hit = overlapping(path.boxes, boxes[near], DEPTH)
            deep = penetrations(path.boxes[moving], boxes[near[hit]]) > DEPTH
            moving, hit = moving[deep], near[hit[deep]]
            mine = own[path.rows[moving]]
            sure = pieces.is_box[mine] & pieces.is_box[hit]
            found |= {pieces.part_of(row) for row in np.unique(hit[sure]).tolist()}
            doubtful = np.unique(np.stack([mine[~sure], hit[~sure], path.poses[moving[~sure]]], axis=1), axis=0)
            found |= self._hit_by_mesh(path, doubtful, poses, found)
        return frozenset(found)

    def _paths(
        self, joint: AnnotatedJoint, carried: Sequence[str], base: Mat4 | None
    ) -> Iterator[tuple[Callable[[float], Mat4] | None, np.ndarray]]:
        """Yields what moves as one with its pieces: None where it follows the joint alone, from rest."""
        led = {other: value for other, value in self._followers[joint.part].items() if other in carried}
        groups: dict[str, list[str]] = {}
        for body in carried:
            chain = [body, *self._above(body)]
            groups.setdefault(next((part for part in chain if part in led), joint.part), []).append(body)
        for leading, bodies in groups.items():
            own = np.flatnonzero(np.isin(self._pieces.bodies, [self._pieces.number(body) for body in bodies]))
            if not len(own):
                continue
            yield None if leading == joint.part and base is None else self._motion(joint, leading, led, base), own

    def _motion(
        self, joint: AnnotatedJoint, body: str, led: Mapping[str, Callable[[float], float]], base: Mat4 | None
    ) -> Callable[[float], Mat4]:
        """Returns where a body is at a value of a joint that carries it."""
        carriers = self._carriers | {joint.part: ""}
        chain = {part: self._joints[part] for part in (body, *self._above(body))}

        def motion(value: float) -> Mat4:
            values = {joint.part: value, **{part: led[part](value) for part in chain if part in led}}
            pose = poses_at(chain, carriers, values)[body]
            return pose if base is None else base @ pose

        return motion

    def _hit_by_mesh(
        self, path: "SweptPath", doubtful: np.ndarray, poses: dict[str, Mat4], found: set[str]
    ) -> set[str]:
        """Returns the parts that are hit among (own piece, other piece, pose) rows; a pose of -1 stands for all."""
        pieces, hit = self._pieces, set(found)
        for mine, other, pose in doubtful.tolist():
            part = pieces.part_of(other)
            if part in hit:
                continue
            body, obstacle = pieces.body(mine), pieces.collider(other)
            obstacle.place(poses.get(pieces.body_of[part], np.eye(4)))
            for T in path.motions if pose < 0 else path.motions[pose : pose + 1]:
                body.place(T)
                if body.penetrates(obstacle):
                    hit.add(part)
                    break
        return hit - found


_known: dict[int, Clashes] = {}


def articulated_of(whole: Asset) -> ArticulatedObject:
    """Returns one static root link with all still parts, and a link for each joint with what moves as one with it.

    Joints open from 0 to their upper limit. A joint waits (`after`) for each moving part that it would run into where
    that part is closed, but not where it is open: a drawer waits for the doors before it. One that follows another
    waits for nothing.

    Raises:
        ArticulationError: if an upper limit is negative or not finite.
        ValueError: if two joints name one part.
    """
    bodies, carriers = bodies_of(whole), carriers_of(whole)
    if len(carriers) < len(whole.joints):
        raise ValueError(f"each joint of `{whole.name}` must have a part of its own")
    root = _free_name("body", {part.id for part in whole.parts})
    links = [Link(root, tuple(_visual(part) for part in whole.parts if bodies[part.id] not in carriers))]
    clashes, waits = clashes_of(whole), dict[str, tuple[str, ...]]()
    free = (joint for joint in whole.joints if joint.coupling is None)
    for joint in sorted(free, key=lambda j: len(clashes.bodies_hit(j.part))):
        waits[joint.part] = _waits_for(joint.part, frozenset(led_by(whole.joints, joint.part)), clashes, waits)
    links += [Link(j.part, tuple(_visual(p) for p in whole.parts if bodies[p.id] == j.part)) for j in whole.joints]
    made: dict[str, Joint] = {}
    for joint in _leaders_first(whole.joints):
        plain = _joint(joint, carriers[joint.part] or root, waits.get(joint.part, ()))
        if joint.coupling is not None:
            plain = plain.following(made[joint.coupling.leader], joint.coupling.multiplier, joint.coupling.offset)
        made[joint.part] = plain
    return ArticulatedObject(whole.name, root, tuple(links), tuple(made[joint.part] for joint in whole.joints))


def _leaders_first(joints: Sequence[AnnotatedJoint]) -> Iterator[AnnotatedJoint]:
    """Yields each joint after the one that it follows."""
    for joint in joints:
        if joint.coupling is None:
            yield joint
            led = led_by(joints, joint.part)
            by_part = {one.part: one for one in joints}
            yield from (by_part[part] for part in led)


def _waits_for(
    part: str, led: frozenset[str], clashes: Clashes, waits: Mapping[str, tuple[str, ...]]
) -> tuple[str, ...]:
    """Returns the moving parts that must be open before a part moves, none of which waits for it or is `led` by it."""
    hit = (other for other in clashes.bodies_hit(part) if other not in led)
    others = [other for other in hit if part not in all_before(other, waits)]
    if not others:
        return ()
    still_hit = {clashes.carrier(hit) for hit in clashes.hits(part, others)}
    return tuple(other for other in others if other not in still_hit)


def _joint(joint: AnnotatedJoint, parent: str, after: tuple[str, ...]) -> Joint:
    limits, waits = JointLimits(0.0, joint.upper), tuple(map(_joint_id, after))
    return Joint(_joint_id(joint.part), joint.type, parent, joint.part, joint.axis, limits, waits)


def _joint_id(part: str) -> str:
    return f"{part}_joint"


def _visual(part: Part) -> Visual:
    return Visual(part.id, part.surfaces, label=part.label)


def _free_name(wanted: str, taken: set[str]) -> str:
    return wanted if wanted not in taken else _free_name(f"{wanted}_", taken)
