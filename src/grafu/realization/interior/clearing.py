"""Whether a panel stands free: at rest of all parts and hardware, and of everything that moves along its whole path."""

from functools import cached_property
from typing import final

import numpy as np

from grafu.geometry.intersection import MeshCollider, SweptBody
from grafu.geometry.mesh import TriangleMesh
from grafu.realization.config import RealizationConfig
from grafu.realization.hinge.border import part_axes
from grafu.realization.limits import in_the_way, opening_values, pose_function, swept_box
from grafu.realization.scene import Obstacle, Scene

_POSES = 41


@final
class Clearing:
    """A scene prepared for trying panels in it; not a value."""

    def __init__(self, scene: Scene, depth: float) -> None:
        self._scene = scene
        self._depth = depth
        self._panels: list[Obstacle] = []

    def add(self, name: str, mesh: TriangleMesh) -> None:
        """Makes a panel stand in the way of those that follow."""
        self._panels.append(Obstacle(name, MeshCollider(mesh)))

    def blocker(self, mesh: TriangleMesh) -> str:
        """Returns the id of something that a panel would cut into or stop along its path; empty: it stands free."""
        for other in self._panels:  # alike and in one place, two panels would not cut each other's surface
            if (mesh.box.axis_gaps(other.collider.box) < -self._depth).all():
                return other.id
        body = SweptBody(mesh, self._depth)
        body.place(np.eye(4))
        still = [*self._scene.static_obstacles, *self._panels, *self._hardware, *self._at_rest]
        near = in_the_way(still, mesh.box)
        met = body.penetrated([obstacle.collider for obstacle in near])
        if met:
            return near[met[0]].id
        panel = MeshCollider(mesh)
        return next((moving for moving in self._scene.joint_motions if self._stops(panel, body, moving)), "")

    @cached_property
    def _hardware(self) -> list[Obstacle]:
        return [Obstacle(v.name, MeshCollider(v.mesh)) for _, v in self._scene.hardware if len(v.mesh.faces)]

    @cached_property
    def _at_rest(self) -> list[Obstacle]:
        return [Obstacle(moving, MeshCollider(self._scene.moving_mesh(moving))) for moving in self._scene.moving_bodies]

    def _stops(self, panel: MeshCollider, body: SweptBody, moving: str) -> bool:
        """Whether a panel stands in the way of a moving body or of the hardware that it carries."""
        joint_motion = self._scene.joint_motions[moving]
        motion = pose_function(joint_motion.axis, joint_motion.type)
        values = opening_values(joint_motion.upper, _POSES)
        mesh = self._scene.moving_mesh(moving)
        if swept_box(mesh.box, motion, joint_motion.upper).overlaps(panel.box):
            swept = self._scene.swept_body(moving, self._depth, part_axes(self._scene.parts[moving].mesh))
            for value in values:
                swept.place(motion(value))
                if swept.penetrates(panel):
                    return True
        for visual in self._scene.hardware_of(moving):
            if not swept_box(visual.mesh.box, motion, joint_motion.upper).overlaps(panel.box):
                continue
            collider = MeshCollider(visual.mesh)
            for value in values:
                collider.place(motion(value))
                if body.penetrates(collider):
                    return True
        return False


def clearing_of(scene: Scene) -> Clearing:
    """Returns the scene prepared, with the depth of realization's own sweeps."""
    return Clearing(scene, RealizationConfig().depth * scene.unit)
