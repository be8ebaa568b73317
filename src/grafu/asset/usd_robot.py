"""An articulated OpenUSD scene as a robot: its rigid bodies are links, and its joints form a tree from the world on.

What belongs to no rigid body stands in the world. The shapes of a body below a prim that is named as a collision shape
are left out where the body has others. Which body of a joint carries the other is decided by which is nearer to the
world, or else to where an articulation starts.
"""

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final, final

import numpy as np

from grafu.articulation.motion_kind import kind_named
from grafu.asset.mjcf_text import COLLISION
from grafu.asset.robot_document import RobotDocument, RobotJoint
from grafu.asset.scene_nodes import SceneNode, telling_name, with_split_meshes_whole
from grafu.asset.usd_physics import PhysicsJoint, body_above
from grafu.dataclass import dataclass

_WORLD: Final = "world"


@final
@dataclass(frozen=True)
class UsdRobot:
    """The rigid bodies of a scene by path, each with whether an articulation starts there, and its joints."""

    bodies: dict[str, bool]
    joints: tuple[PhysicsJoint, ...]


@final
@dataclass(frozen=True)
class _Step:
    """A joint of the tree, and which of its bodies it moves: 0 or 1."""

    joint: PhysicsJoint
    moved: int

    @property
    def sense(self) -> float:
        """1, or -1 where the moved body is `body0`, which moves against the other the other way round."""
        return 1.0 if self.moved else -1.0

    @property
    def child(self) -> str:
        return self.joint.bodies[self.moved]

    @property
    def parent(self) -> str:
        return self.joint.bodies[1 - self.moved]


def is_robot(robot: UsdRobot) -> bool:
    """Whether joints of a scene let bodies move."""
    return any(kind_named("urdf", joint.kind) is not None for joint in robot.joints)


def document_of(robot: UsdRobot, nodes: Sequence[tuple[str, SceneNode]], path: Path) -> RobotDocument:
    """Returns the robot, in the coordinates of the scene's world.

    Args:
        robot: bodies and joints.
        nodes: each shape that is shown, in the coordinates of the world, with the path of its prim.
        path: the file.
    """
    document = RobotDocument(path)
    steps = tuple(_tree(robot))
    names = _names_of(robot.bodies)
    document.add_link(_WORLD, np.eye(4))
    above = {step.child: step for step in steps}
    for body in robot.bodies:
        step = above.get(body)
        document.add_link(names[body], np.eye(4) if step is None else step.joint.frames[step.moved])
    shapes: dict[str, list[SceneNode]] = {body: [] for body in names}
    for place, node in nodes:
        body, own = _in_its_body(place, node, robot)
        shapes[body].append(own)
    for body, name in names.items():
        for node in _shown(shapes[body]):
            document.add_surfaces(name, telling_name(node), node.surfaces)
    by_path = {step.joint.path: step for step in steps}
    for step in steps:
        document.add_joint(_robot_joint(step, names, by_path))
    document.notes += _left_out(robot, steps)
    return document


def _tree(robot: UsdRobot) -> Iterator[_Step]:
    """Yields the joints that form a tree, each after the one that carries it, from the world on."""
    at: dict[str, list[PhysicsJoint]] = {}
    for joint in sorted(robot.joints, key=lambda joint: joint.is_apart):  # stable: else in the order of the scene
        for end in joint.bodies:
            at.setdefault(end, []).append(joint)
    moved_once = {joint.bodies[1] for joint in robot.joints}
    starts = sorted(robot.bodies, key=lambda body: (not robot.bodies[body], body in moved_once))
    reached: set[str] = set()
    for start in ("", *starts):
        waiting = deque([] if start in reached else [start])
        reached.add(start)
        while waiting:
            above = waiting.popleft()
            for joint in at.get(above, ()):
                ends = joint.bodies
                if (child := ends[1 - ends.index(above)]) not in reached:
                    reached.add(child)
                    waiting.append(child)
                    yield _Step(joint, ends.index(child))


def _names_of(bodies: dict[str, bool]) -> dict[str, str]:
    """Returns a name of its own for each body, by its path, and for the world, whose path is empty."""
    names, taken = {"": _WORLD}, {_WORLD}
    for body in bodies:
        plain = name = body.rpartition("/")[2]
        number = 2
        while name in taken:
            name, number = f"{plain}_{number}", number + 1
        names[body] = name
        taken.add(name)
    return names


def _in_its_body(place: str, node: SceneNode, robot: UsdRobot) -> tuple[str, SceneNode]:
    """Returns the path of a shape's body, and the shape with that body and what lies between both as its chain."""
    body = body_above(place, robot.bodies)
    if not body:
        return body, node
    count = place.count("/") - body.count("/") + 1
    return body, replace(node, chain=node.chain[-count:])


def _shown(nodes: list[SceneNode]) -> list[SceneNode]:
    """Returns the shapes of one body without its collision shapes, those that an exporter parted as one."""
    visible = [node for node in nodes if not any(COLLISION.search(name) for _, name in node.chain)]
    return with_split_meshes_whole(visible or nodes)


def _robot_joint(step: _Step, names: dict[str, str], steps: dict[str, _Step]) -> RobotJoint:
    joint = step.joint
    limits = joint.limits and _limits(step, joint.limits)
    axis = np.eye(3)[joint.axis].tolist()
    mimic = _mimic(step, steps)
    return RobotJoint(joint.path, joint.kind, names[step.parent], names[step.child], axis, limits, mimic)


def _limits(step: _Step, limits: tuple[float, float]) -> tuple[float, float]:
    """Returns the limits from where the joint is drawn, in the sense in which the moved body moves."""
    lower, upper = sorted(step.sense * (value - step.joint.drawn) for value in limits)
    return lower, upper


def _mimic(step: _Step, steps: dict[str, _Step]) -> tuple[str, float, float] | None:
    """Returns which joint of the tree a joint follows; both count from where they are drawn."""
    mimic = step.joint.mimic
    if mimic is None or mimic[0] not in steps or not np.isfinite(mimic[1:]).all():
        return None
    path, multiplier, offset = mimic
    leader = steps[path]
    drawn = offset + multiplier * leader.joint.drawn - step.joint.drawn
    return path, step.sense * leader.sense * multiplier, step.sense * drawn


def _left_out(robot: UsdRobot, steps: Sequence[_Step]) -> list[str]:
    used = {step.joint.path for step in steps}
    left = [joint for joint in robot.joints if joint.path not in used]
    return [f"joint {joint.name} closes a loop and is left out" for joint in left]
