"""The other moving bodies around a joint: what they are at rest, and whether they run into hardware on their way.

It chooses nothing; whose ways are known, and whose are only expected, the scene says.
"""

from functools import cached_property
from typing import final

import numpy as np

from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider, SweptBody
from grafu.geometry.mesh import TriangleMesh
from grafu.realization.hinge.border import part_axes
from grafu.realization.limits import Motion, is_free, motion_about, swept_box
from grafu.realization.scene import Obstacle, Scene, Way

_POSES = 19


@final
class Neighbour:
    """Another moving body with what rides on it and its hardware, prepared for queries; not a value.

    `way` is None where nobody knows how it moves; `depth` is the tolerated penetration in metres.
    """

    def __init__(self, moving_id: str, scene: Scene, depth: float) -> None:
        self.id = moving_id
        self.way: Way | None = scene.ways.get(moving_id)
        self.mesh: TriangleMesh = scene.equipped_mesh(moving_id)
        self.at_rest = MeshCollider(self.mesh)
        self._part, self._depth, self._scene = scene.parts[moving_id].mesh, depth, scene

    def runs_into(self, *standing: TriangleMesh) -> bool:
        """Whether it cuts into standing meshes, taken together, anywhere on its way."""
        if self.way is None:
            return False
        near = [Obstacle(self.id, MeshCollider(mesh)) for mesh in standing if self._swept.overlaps(mesh.box)]
        return bool(near) and not is_free(self._body, self._motion, self.way.upper, near, _POSES)

    @cached_property
    def _motion(self) -> Motion:
        assert self.way is not None
        return motion_about(self.way.axis, self.way.type)

    @cached_property
    def _swept(self) -> Box:
        assert self.way is not None
        motion, upper = self._motion, self.way.upper
        return self._scene.way_box(self.id, self.mesh, self.way, lambda: swept_box(self.mesh.box, motion, upper))

    @cached_property
    def _body(self) -> SweptBody:
        return SweptBody(self.mesh, self._depth, np.asarray(part_axes(self._part)))


def neighbours_of(moving_id: str, scene: Scene, depth: float) -> tuple[Neighbour, ...]:
    """Returns all other moving bodies; `depth` is the tolerated penetration in metres."""
    return tuple(Neighbour(other, scene, depth) for other in scene.moving_bodies if other != moving_id)
