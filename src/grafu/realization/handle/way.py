"""Whether a new handle stays clear of everything: on its own mover's way, and while the others take theirs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from grafu.geometry.arrays import Mat4
from grafu.geometry.intersection import MeshCollider, MovingBody
from grafu.geometry.mesh import TriangleMesh
from grafu.realization.handle.front import Front
from grafu.realization.handle.relief import stands_before
from grafu.realization.limits import Motion, in_the_way, motion_about, opening_values, swept_box
from grafu.realization.scene import Obstacle, Scene

_TOUCH = 0.0002  # of the object's largest side: how deep a handle may touch something


@final
@dataclass(frozen=True, eq=False)
class Surroundings:
    """All parts and hardware at rest, the still ones and those of each mover."""

    scene: Scene
    still: tuple[Obstacle, ...]
    moving: Mapping[str, tuple[Obstacle, ...]]

    def with_handle(self, mover_id: str, handle: TriangleMesh) -> "Surroundings":
        """Returns the surroundings with a handle that was added to a mover."""
        grown = (*self.moving[mover_id], Obstacle(mover_id, MeshCollider(handle)))
        return replace(self, moving={**self.moving, mover_id: grown})

    def blocker(self, mover_id: str, front: Front, handle: TriangleMesh, poses: int) -> str:
        """Returns the id of something that a handle on a mover runs into, or that runs into it; empty: it is clear.

        Movers that stand before the front (a closed door before a drawer) open first: they are met at rest only.
        """
        body = MovingBody(handle, _TOUCH * self.scene.unit)
        others = [other for other in self.moving if other != mover_id]
        at_rest = [*self.still, *self._own_hardware(mover_id), *(o for other in others for o in self.moving[other])]
        found = _met(body, _closed, 0.0, in_the_way(at_rest, handle.box), 1)
        if found:
            return found
        motion, upper = self._way(mover_id)
        after = [other for other in others if not stands_before(self.scene, other, front)]
        fixed = [*self.still, *(o for other in after for o in self.moving[other])]
        found = _met(body, motion, upper, in_the_way(fixed, swept_box(handle.box, motion, upper)), poses)
        return found or next((other for other in others if self._runs_into(other, body, handle, poses)), "")

    def _own_hardware(self, mover_id: str) -> list[Obstacle]:
        return [Obstacle(v.name, MeshCollider(v.mesh)) for v in self.scene.hardware_of(mover_id)]

    def _way(self, mover_id: str) -> tuple[Motion, float]:
        way = self.scene.ways[mover_id]
        return motion_about(way.axis, way.type), way.upper

    def _runs_into(self, other: str, body: MovingBody, handle: TriangleMesh, poses: int) -> bool:
        """Whether a mover runs into a handle at rest: seen from that mover, the handle takes the way backwards."""
        motion, upper = self._way(other)

        def backwards(value: float) -> Mat4:
            return motion(-value)

        near = in_the_way(self.moving[other], swept_box(handle.box, backwards, upper))
        return bool(_met(body, backwards, upper, near, poses))


def _closed(_: float) -> Mat4:
    return np.eye(4)


def surroundings_of(scene: Scene) -> Surroundings:
    """Returns the surroundings of all handles of a scene."""
    moving = {
        mover.id: (
            *(Obstacle(m, MeshCollider(scene.parts[m].mesh)) for m in mover.members if len(scene.parts[m].mesh.faces)),
            *(Obstacle(v.name, MeshCollider(v.mesh)) for v in scene.hardware_of(mover.id)),
        )
        for mover in scene.movers.values()
    }
    return Surroundings(scene, (*scene.static_obstacles, *scene.static_hardware), moving)


def _met(body: MovingBody, motion: Motion, upper: float, near: Sequence[Obstacle], poses: int) -> str:
    """Returns the id of an obstacle that the body meets on its way; empty: none."""
    colliders = [obstacle.collider for obstacle in near]
    for value in opening_values(upper, poses)[::-1] if near else ():
        body.place(motion(float(value)))
        met = body.penetrated(colliders)
        if met:
            return near[met[0]].id
    return ""
