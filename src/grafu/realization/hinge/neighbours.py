"""The other moving bodies around a joint: what they are at rest, and whether they run into hardware along their path.

It chooses nothing; the scene states which motions are built and which are expected.
"""

from functools import cached_property
from typing import final

import numpy as np

from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider, SweptBody
from grafu.geometry.mesh import TriangleMesh
from grafu.realization.hinge.border import part_axes
from grafu.realization.limits import PoseFunction, is_free, pose_function, swept_box
from grafu.realization.scene import JointMotion, Obstacle, Scene

_POSES = 19


@final
class Neighbour:
    """Another moving body with what rides on it and its hardware, prepared for queries; not a value.

    `joint_motion` is None where its motion is unknown; `depth` is the tolerated penetration in metres.
    """

    def __init__(self, moving_id: str, scene: Scene, depth: float) -> None:
        self.id = moving_id
        self.joint_motion: JointMotion | None = scene.joint_motions.get(moving_id)
        self.mesh: TriangleMesh = scene.equipped_mesh(moving_id)
        self.at_rest = MeshCollider(self.mesh)
        self._part, self._depth, self._scene = scene.parts[moving_id].mesh, depth, scene

    def runs_into(self, *standing: TriangleMesh) -> bool:
        """Whether it cuts into standing meshes, taken together, anywhere along its path."""
        if self.joint_motion is None:
            return False
        near = [Obstacle(self.id, MeshCollider(mesh)) for mesh in standing if self._swept.overlaps(mesh.box)]
        return bool(near) and not is_free(self._body, self._motion, self.joint_motion.upper, near, _POSES)

    @cached_property
    def _motion(self) -> PoseFunction:
        assert self.joint_motion is not None
        return pose_function(self.joint_motion.axis, self.joint_motion.type)

    @cached_property
    def _swept(self) -> Box:
        assert self.joint_motion is not None
        motion, upper = self._motion, self.joint_motion.upper
        return self._scene.path_box(
            self.id, self.mesh, self.joint_motion, lambda: swept_box(self.mesh.box, motion, upper)
        )

    @cached_property
    def _body(self) -> SweptBody:
        return SweptBody(self.mesh, self._depth, np.asarray(part_axes(self._part)))


def neighbours_of(moving_id: str, scene: Scene, depth: float) -> tuple[Neighbour, ...]:
    """Returns all other moving bodies; `depth` is the tolerated penetration in metres."""
    return tuple(Neighbour(other, scene, depth) for other in scene.moving_bodies if other != moving_id)
