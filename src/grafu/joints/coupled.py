"""Joints that follow others: how far both can go together, and when they cannot be coupled. It builds no hardware."""

from collections.abc import Mapping, Sequence
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Coupling
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4
from grafu.geometry.budget import require_time
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.swept_body import SweptBody
from grafu.joints.build import Built
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import opening_values
from grafu.joints.nesting import ParentOf, above, bodies_on
from grafu.scene.border import part_axes
from grafu.scene.scene import Scene

_ALIKE = 1e-6  # radians or metres: values of joints that count as the same


@final
@dataclass(frozen=True, eq=False)
class Coupled:
    """A joint that follows another in a scene where both stand: its coupling, and what carries what."""

    follower: Built
    coupling: Coupling
    built: Mapping[str, Built]
    couplings: Mapping[str, Coupling]
    parent_of: ParentOf
    scene: Scene

    @property
    def moving(self) -> str:
        """The moving body that follows."""
        return self.follower.request.moving

    def starts_within(self, follower_upper: float) -> bool:
        """Whether the follower is within its limits while the leader is closed."""
        return -_ALIKE <= self.coupling.value(0.0) <= follower_upper + _ALIKE

    def common_opening(self, leader_upper: float, follower_upper: float, config: RealizationConfig) -> float:
        """Returns how far the leader opens, at most `leader_upper`, while both stay free and within their limits.

        The two are swept together: past the static body, and past one another unless the leader carries the follower.
        What meets at rest counts as free: it cannot be avoided by opening less.
        """
        if not self.starts_within(follower_upper):
            return 0.0
        reached = opening_values(self._end(leader_upper, follower_upper), config.fine_poses)
        return self._free([float(value) for value in reached], config)

    def _end(self, leader_upper: float, follower_upper: float) -> float:
        """Returns the leader's value at which the follower comes to an end of its range."""
        ends = (self.coupling.leader_value(value) for value in (0.0, follower_upper))
        return min([leader_upper, *(end for end in ends if end > _ALIKE)])

    def _free(self, values: Sequence[float], config: RealizationConfig) -> float:
        """Returns the last of ascending values before the follower runs into something."""
        depth = config.depth * self.scene.extent
        own = (self.moving, *bodies_on(self.moving, self.parent_of))
        axes = part_axes(self.scene.parts[self.moving].mesh)
        body = SweptBody(self._mesh(own), depth, np.asarray(axes))
        leader, apart = self.coupling.leader, [MeshCollider(part.mesh) for part in self.scene.static_parts]
        beside = None if leader in above(self.moving, self.parent_of) else MeshCollider(self._mesh((leader,)))
        met_at_rest: set[int] = set()
        free = 0.0
        for number, value in enumerate(values):
            require_time()
            obstacles = [*apart, *([beside.posed(self._pose(leader, value))] if beside else [])]
            body.place(self._pose(self.moving, value))
            met = set(body.penetrated([o for k, o in enumerate(obstacles) if k not in met_at_rest]))
            if number == 0:
                met_at_rest = met
            elif met:
                return free
            free = value
        return free

    def _mesh(self, bodies: Sequence[str]) -> TriangleMesh:
        members = (member for body in bodies for member in self.scene.moving_bodies[body].members)
        return merge_meshes([self.scene.parts[member].mesh for member in members])

    def _pose(self, moving: str, value: float) -> Mat4:
        """Returns the motion of a moving body from rest, with all that carries it, at a value of the leader."""
        T, values = np.eye(4), self._led(value)
        for body in (moving, *above(moving, self.parent_of)):
            made = self.built[body]
            T = made.request.kind.along(made.placement.axis)(self._value(body, values)) @ T
        return T

    def _led(self, value: float) -> dict[str, float]:
        """Returns the values of the leader, of those that it follows in turn, and of the follower."""
        leader = self.coupling.leader
        values = {self.moving: self.coupling.value(value), leader: value}
        while leader in self.couplings:
            own = self.couplings[leader]
            values[own.leader] = own.leader_value(values[leader])
            leader = own.leader
        return values

    def _value(self, moving: str, values: Mapping[str, float]) -> float:
        """Returns the value of a joint: a known one, one that follows from these, or closed."""
        if moving in values or moving not in self.couplings:
            return values.get(moving, 0.0)
        own = self.couplings[moving]
        return own.value(self._value(own.leader, values))
