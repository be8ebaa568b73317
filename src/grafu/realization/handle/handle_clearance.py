"""Whether a new handle stays clear of everything: along the path of its moving body, and while others move."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from grafu.articulation.kinematics import all_before
from grafu.geometry.arrays import Mat4
from grafu.geometry.intersection import MeshCollider, SweptBody
from grafu.geometry.mesh import TriangleMesh
from grafu.realization.limits import PoseFunction, in_the_way, opening_values, pose_function, swept_box
from grafu.realization.scene import Obstacle, Scene

_TOUCH = 0.0002  # of the object's largest side: how deep a handle may touch something


@final
@dataclass(frozen=True, eq=False)
class Surroundings:
    """All parts and hardware at rest, the still ones and those of each moving body."""

    scene: Scene
    still: tuple[Obstacle, ...]
    moving: Mapping[str, tuple[Obstacle, ...]]

    def with_handle(self, moving_id: str, handle: TriangleMesh) -> "Surroundings":
        """Returns the surroundings with a handle that was added to a moving body."""
        grown = (*self.moving[moving_id], Obstacle(moving_id, MeshCollider(handle)))
        return replace(self, moving={**self.moving, moving_id: grown})

    def blocker(self, moving_id: str, handle: TriangleMesh, poses: int) -> str:
        """Returns the id of something that a handle on a moving body hits, or that hits the handle; empty: nothing.

        At rest it is clear of everything; along its path, what opens before it (a door before a drawer) stands wide
        open.
        """
        body = SweptBody(handle, _TOUCH * self.scene.unit)
        others = [other for other in self.moving if other != moving_id]
        at_rest = [*self.still, *self._own_hardware(moving_id), *(o for other in others for o in self.moving[other])]
        found = _met(body, _closed, 0.0, in_the_way(at_rest, handle.box), 1)
        if found:
            return found
        motion, upper = self._motion_of(moving_id)
        opened = [other for other in others if other in self._before(moving_id)]
        closed = [*self.still, *(o for other in others if other not in opened for o in self.moving[other])]
        fixed = in_the_way(closed, swept_box(handle.box, motion, upper))
        fixed += [obstacle for other in opened for obstacle in self._opened(other)]
        found = _met(body, motion, upper, fixed, poses)
        return found or next((o for o in others if self._runs_into(o, moving_id, body, handle, poses)), "")

    def _own_hardware(self, moving_id: str) -> list[Obstacle]:
        return [Obstacle(v.name, MeshCollider(v.mesh)) for v in self.scene.hardware_of(moving_id)]

    def _motion_of(self, moving_id: str) -> tuple[PoseFunction, float]:
        joint_motion = self.scene.joint_motions[moving_id]
        return pose_function(joint_motion.axis, joint_motion.type), joint_motion.upper

    def _before(self, moving_id: str) -> set[str]:
        """Returns the moving bodies that stand open before a moving body can move."""
        return all_before(
            moving_id, {name: joint_motion.after for name, joint_motion in self.scene.joint_motions.items()}
        )

    def _opened(self, moving_id: str) -> list[Obstacle]:
        motion, upper = self._motion_of(moving_id)
        return [Obstacle(o.id, o.collider.posed(motion(upper))) for o in self.moving[moving_id]]

    def _runs_into(self, other: str, moving_id: str, body: SweptBody, handle: TriangleMesh, poses: int) -> bool:
        """Whether a moving body runs into a handle at rest, or wide open where that moving body waits for the handle's.

        Seen from the moving body, the handle takes the way backwards.
        """
        motion, upper = self._motion_of(other)
        start = np.eye(4)
        if moving_id in self._before(other):
            opening, widest = self._motion_of(moving_id)
            start = opening(widest)

        def backwards(value: float) -> Mat4:
            return np.asarray(motion(-value) @ start)

        near = in_the_way(self.moving[other], swept_box(handle.box, backwards, upper))
        return bool(_met(body, backwards, upper, near, poses))


def _closed(_: float) -> Mat4:
    return np.eye(4)


def surroundings_of(scene: Scene) -> Surroundings:
    """Returns the surroundings of all handles of a scene."""
    moving = {
        moving.id: (
            *(Obstacle(m, MeshCollider(scene.parts[m].mesh)) for m in moving.members if len(scene.parts[m].mesh.faces)),
            *(Obstacle(v.name, MeshCollider(v.mesh)) for v in scene.hardware_of(moving.id)),
        )
        for moving in scene.moving_bodies.values()
    }
    return Surroundings(scene, (*scene.static_obstacles, *scene.static_hardware), moving)


def _met(body: SweptBody, motion: PoseFunction, upper: float, near: Sequence[Obstacle], poses: int) -> str:
    """Returns the id of an obstacle that the body meets along its path; empty: none."""
    colliders = [obstacle.collider for obstacle in near]
    for value in opening_values(upper, poses)[::-1] if near else ():
        body.place(motion(float(value)))
        met = body.penetrated(colliders)
        if met:
            return near[met[0]].id
    return ""
