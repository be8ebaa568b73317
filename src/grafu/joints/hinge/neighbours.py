"""The other moving bodies around a joint: what they are at rest, and whether they run into hardware on their path."""

from collections.abc import Sequence
from functools import cached_property
from typing import final

import numpy as np

from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.swept_body import SweptBody
from grafu.joints.limits import PoseFunction, is_free, swept_box
from grafu.scene.border import part_axes
from grafu.scene.obstacles import Obstacle
from grafu.scene.reads import Read, note_box, plain
from grafu.scene.scene import JointMotion, Scene

_POSES_OF_OTHERS = 19


@final
class Neighbour:
    """Another moving body with what rides on it and its hardware, prepared for queries; not a value.

    `joint_motion` is None where its motion is unknown; `depth` is the tolerated penetration in metres.
    """

    def __init__(self, moving_id: str, scene: Scene, depth: float) -> None:
        self.id = moving_id
        self.joint_motion: JointMotion | None = plain(scene.joint_motions).get(moving_id)
        self.box: Box = scene.body_box(moving_id)
        self._depth, self._scene = depth, scene

    @cached_property
    def mesh(self) -> TriangleMesh:
        """The moving body with all that it carries, as one mesh."""
        return self._scene.equipped_mesh(self.id)

    @cached_property
    def at_rest(self) -> MeshCollider:
        """The same at rest."""
        return MeshCollider(self.mesh)

    def is_wedged_by(self, standing: Sequence[TriangleMesh]) -> bool:
        """Whether at rest it cuts into standing meshes, and what is static keeps it from coming free of them.

        A door that fills its opening without a gap is held by what touches its other side.
        """
        note_box(Read.BODIES, self.box)
        meeting = [MeshCollider(mesh) for mesh in standing if self.box.overlaps(mesh.box)]
        if not meeting:
            return False
        self._body.place(np.eye(4))
        around = (obstacle.collider for obstacle in self._scene.static_obstacles.near(self.box))
        return any(k < len(meeting) for k in self._body.penetrated([*meeting, *around]))

    def runs_into(self, *standing: TriangleMesh) -> bool:
        """Whether it cuts into standing meshes, taken together, anywhere along its path."""
        for mesh in standing:
            note_box(Read.PATHS, mesh.box)
        if self.joint_motion is None:
            return False
        near = [Obstacle(self.id, MeshCollider(mesh)) for mesh in standing if self._swept.overlaps(mesh.box)]
        return bool(near) and not is_free(self._body, self._motion, self.joint_motion.upper, near, _POSES_OF_OTHERS)

    @cached_property
    def _motion(self) -> PoseFunction:
        assert self.joint_motion is not None
        return self.joint_motion.kind.along(self.joint_motion.axis)

    @cached_property
    def _swept(self) -> Box:
        assert self.joint_motion is not None
        return path_box_of(self.id, self._scene, self.joint_motion)

    @cached_property
    def _body(self) -> SweptBody:
        axes = part_axes(plain(self._scene.parts)[self.id].mesh)
        return SweptBody(self.mesh, self._depth, np.asarray(axes))


def neighbours_of(moving_id: str, scene: Scene, depth: float) -> tuple[Neighbour, ...]:
    """Returns all other moving bodies; `depth` is the tolerated penetration in metres."""
    return tuple(Neighbour(other, scene, depth) for other in scene.others_than(moving_id))


def path_box_of(moving_id: str, scene: Scene, joint_motion: JointMotion) -> Box:
    """Returns the box around the whole path of a moving body with its hardware."""
    motion = joint_motion.kind.along(joint_motion.axis)
    return scene.path_box(moving_id, joint_motion, lambda box: swept_box(box, motion, joint_motion.upper))
