"""Which joint must be open before which: a drawer behind a door, a door under another's overlap. It builds no hardware.

A joint that runs into a closed neighbour waits for it, if the neighbour, open, lets it open far enough, or much
farther than closed, and does not itself wait; else its opening ends where the neighbour begins, and the report states
it. Beyond a quarter turn a door opens only as far as it blocks no open neighbour, unless a wider opening was chosen.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import final

from grafu.articulation.kinematics import all_before
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.budget import require_time
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.swept_body import SweptBody
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import PoseFunction, in_the_way, is_free, sweep, swept_box
from grafu.scene.border import part_axes
from grafu.scene.obstacles import Obstacle
from grafu.scene.scene import Scene

_RATIOS = (1.0, 0.75, 0.5, 0.25, 0.0)  # of what a door opens beyond its least, in the order tried


@final
@dataclass(frozen=True, eq=False)
class BuiltJoint:
    """A joint as built so far: the moving body, its motion, its opening, and the moving bodies that it meets at rest.

    `least` is the opening that it keeps, whatever it blocks.
    """

    moving: str
    motion: PoseFunction
    upper: float
    least: float
    in_way: tuple[str, ...]


@final
@dataclass(frozen=True, slots=True)
class OpeningOrder:
    """What one joint waits for, how far it may open, and what else is to be said of that."""

    after: tuple[str, ...]
    upper: float
    note: str = ""


@final
class Meetings:
    """What was found of each two joints of a scene at some openings, each worked out once; not a value.

    It holds for the joints of one scene as long as they differ in nothing but how far they open.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self._boxes: dict[tuple[str, float], Box] = {}
        self._beside: dict[tuple[str, float, str, float], float] = {}
        self._until: dict[tuple[str, float, str], float] = {}
        self._free: dict[tuple[str, float, str, float], bool] = {}

    def path_box(self, joint: BuiltJoint, reach: float) -> Box:
        """Returns the box around the path of a joint up to `reach`."""
        key = joint.moving, reach
        if key not in self._boxes:
            require_time()
            self._boxes[key] = swept_box(self.scene.moving_mesh(joint.moving).box, joint.motion, reach)
        return self._boxes[key]

    def beside_open(self, joint: BuiltJoint, other: BuiltJoint, config: RealizationConfig) -> float:
        """Returns how far a moving body opens before it meets a neighbour that stands open: a seat, against its lid."""
        key = joint.moving, joint.upper, other.moving, other.upper
        if key not in self._beside:
            self._beside[key] = _beside_open(joint, other, self.scene, config)
        return self._beside[key]

    def until(self, joint: BuiltJoint, name: str, config: RealizationConfig) -> float:
        """Returns how far a moving body opens before it meets a neighbour that stays closed."""
        key = joint.moving, joint.upper, name
        if key not in self._until:
            self._until[key] = _until(joint, self.scene.moving_mesh(name), self.scene, config)
        return self._until[key]

    def leaves_free(
        self,
        door: BuiltJoint,
        upper: float,
        reaches: Mapping[str, float],
        joints: Sequence[BuiltJoint],
        config: RealizationConfig,
    ) -> bool:
        """Whether no body that opens up to its reach hits a door that stands open by `upper`."""
        scene, obstacle = self.scene, list[Obstacle]()
        for other in (joint for joint in joints if joint is not door):
            key = door.moving, upper, other.moving, reaches[other.moving]
            if key not in self._free:
                obstacle = obstacle or [_open(door, upper, scene)]
                reach, met = key[3], in_the_way(obstacle, self.path_box(other, key[3]))
                self._free[key] = not met or _is_free_of(other, reach, obstacle[0], scene, config)
            if not self._free[key]:
                return False
        return True


def order_joints(
    joints: Sequence[BuiltJoint], meetings: Meetings, config: RealizationConfig
) -> dict[str, OpeningOrder]:
    """Returns for each moving body the moving bodies that must be open first, and its opening."""
    by_id = {joint.moving: joint for joint in joints}
    orders: dict[str, OpeningOrder] = {}
    waits: dict[str, set[str]] = {}
    for joint in sorted(joints, key=lambda m: len(m.in_way)):
        after, upper = [], joint.upper
        for name in joint.in_way:
            other = by_id.get(name)
            waits_for_us = joint.moving in all_before(name, waits)
            beyond = 0.0 if other is None or waits_for_us else meetings.beside_open(joint, other, config)
            until = joint.upper
            if beyond < config.restricted * joint.upper:
                until = meetings.until(joint, name, config)
            waits_for = beyond >= config.restricted * joint.upper or (
                beyond >= config.waits * joint.upper and until <= config.waits * beyond
            )
            after += [name] if waits_for else []
            upper = min(upper, beyond if waits_for else until)
        waits[joint.moving] = set(after)
        orders[joint.moving] = OpeningOrder(tuple(after), upper)
    return orders


def stand_aside(
    orders: Mapping[str, OpeningOrder], joints: Sequence[BuiltJoint], meetings: Meetings, config: RealizationConfig
) -> dict[str, OpeningOrder]:
    """Returns the orders in which doors open no wider than leaves their open neighbours free, if they must.

    A door that blocks another however little it opens, down to its `least`, opens as wide as before.
    """
    settled = {m.moving: orders[m.moving].upper for m in joints}
    reaches = settled | {m.moving: min(settled[m.moving], m.least) for m in joints}  # of doors to come: what they keep
    for door in joints:
        widest, least = settled[door.moving], reaches[door.moving]
        ratios = _RATIOS if least < widest else ()
        uppers = (least + ratio * (widest - least) for ratio in ratios)
        found = (upper for upper in uppers if meetings.leaves_free(door, upper, reaches, joints, config))
        reaches[door.moving] = next(found, widest)
    return {name: replace(order, upper=reaches[name]) for name, order in orders.items()}


def _open(other: BuiltJoint, upper: float, scene: Scene) -> Obstacle:
    """Returns a neighbour as an obstacle in its open pose, its hardware counted in."""
    meshes = [scene.moving_mesh(other.moving), *(v.mesh for v in scene.hardware_of(other.moving))]
    return Obstacle(other.moving, MeshCollider(merge_meshes(meshes).transformed(other.motion(upper))))


def _body(joint: BuiltJoint, scene: Scene, config: RealizationConfig) -> SweptBody:
    axes = part_axes(scene.parts[joint.moving].mesh)
    return scene.swept_body(joint.moving, config.depth * scene.extent, axes)


def _is_free_of(joint: BuiltJoint, upper: float, obstacle: Obstacle, scene: Scene, config: RealizationConfig) -> bool:
    return is_free(_body(joint, scene, config), joint.motion, upper, [obstacle], config.coarse_poses)


def _beside_open(joint: BuiltJoint, other: BuiltJoint, scene: Scene, config: RealizationConfig) -> float:
    """Returns how far a moving body opens before it meets a neighbour that stands open: a seat, against its lid."""
    obstacle = _open(other, other.upper, scene)
    if _is_free_of(joint, joint.upper, obstacle, scene, config):
        return joint.upper
    free = sweep(_body(joint, scene, config), joint.motion, joint.upper, [obstacle], config.fine_poses).free
    return max(free - config.short * joint.upper, 0.0)


def _until(joint: BuiltJoint, mesh: TriangleMesh, scene: Scene, config: RealizationConfig) -> float:
    """Returns how far a moving body opens before it meets a neighbour that stays closed."""
    obstacle = Obstacle("", MeshCollider(mesh))
    path = swept_box(scene.moving_mesh(joint.moving).box, joint.motion, joint.upper)
    verdict = sweep(
        _body(joint, scene, config), joint.motion, joint.upper, in_the_way([obstacle], path), config.fine_poses
    )
    # What overlaps at rest already cannot be avoided by opening less.
    return max(verdict.free - config.short * joint.upper, 0.0) if verdict.ratio and verdict.free > 0 else joint.upper
