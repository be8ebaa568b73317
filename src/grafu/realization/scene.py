"""The parts as they stand during realization: static body, movers, installed hardware, and their colliders.

A scene is never changed: replacing a part or adding hardware returns a new scene, which shares the colliders of whatever
stayed the same.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual
from grafu.asset.part import Part
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes


@final
@dataclass(frozen=True)
class Mover:
    """What moves as one: the part's id, then those that ride on it."""

    id: str
    members: tuple[str, ...]


@final
@dataclass(frozen=True, eq=False)
class Obstacle:
    """Something that a moving part may run into."""

    id: str
    collider: MeshCollider


@final
@dataclass(frozen=True, eq=False)
class Scene:
    """All parts in their rest pose. `hardware` holds installed visuals by the id of the mover, or "" for static."""

    parts: Mapping[str, Part]
    movers: Mapping[str, Mover]
    unit: float
    hardware: tuple[tuple[str, Visual], ...] = ()
    _colliders: dict[int, tuple[TriangleMesh, MeshCollider]] = field(default_factory=dict, repr=False)

    @cached_property
    def moving_ids(self) -> frozenset[str]:
        """The ids of all parts that move."""
        return frozenset(member for mover in self.movers.values() for member in mover.members)

    @cached_property
    def static_parts(self) -> tuple[Part, ...]:
        """The parts that stay where they are."""
        return tuple(part for part in self.parts.values() if part.id not in self.moving_ids)

    def collider(self, mesh: TriangleMesh) -> MeshCollider:
        """Returns the mesh's collider, made once."""
        found = self._colliders.get(id(mesh))
        if found is None:
            found = self._colliders[id(mesh)] = (mesh, MeshCollider(mesh))
        return found[1]

    @cached_property
    def static_obstacles(self) -> tuple[Obstacle, ...]:
        """One obstacle per static part, at rest."""
        return tuple(self._resting(part.id, part.mesh) for part in self.static_parts if len(part.mesh.faces))

    @cached_property
    def static_hardware(self) -> tuple[Obstacle, ...]:
        """One obstacle per installed static piece of hardware."""
        return tuple(self._resting(v.name, v.mesh) for owner, v in self.hardware if not owner)

    def _resting(self, name: str, mesh: TriangleMesh) -> Obstacle:
        collider = self.collider(mesh)
        collider.place(np.eye(4))
        return Obstacle(name, collider)

    def moving_mesh(self, mover_id: str) -> TriangleMesh:
        """Returns the mover with all that rides on it, without hardware, as one mesh."""
        return self._moving_meshes[mover_id]

    @cached_property
    def _moving_meshes(self) -> dict[str, TriangleMesh]:
        return {
            mover.id: merge_meshes([self.parts[m].mesh for m in mover.members]) for mover in self.movers.values()
        }

    def hardware_of(self, mover_id: str) -> tuple[Visual, ...]:
        """Returns the hardware installed on a mover."""
        return tuple(visual for owner, visual in self.hardware if owner == mover_id)

    def replaced(self, parts: Iterable[Part]) -> "Scene":
        """Returns the scene with some parts in a new shape."""
        return replace(self, parts={**self.parts, **{part.id: part for part in parts}})

    def with_hardware(self, mover_id: str, dynamic: Iterable[Visual], static: Iterable[Visual]) -> "Scene":
        """Returns the scene with hardware added to a mover and to the static body."""
        added = [(mover_id, v) for v in dynamic] + [("", v) for v in static]
        return replace(self, hardware=(*self.hardware, *added))

    def static_mesh_near(self, box: Box, margin: float) -> TriangleMesh:
        """Returns the static triangles whose own boxes come within `margin` of a box."""
        near = []
        for part in self.static_parts:
            if not part.box.overlaps(box, margin):
                continue
            corners = part.mesh.triangles
            grown = box.grown(margin)
            keep = np.all((corners.min(axis=1) <= grown.high) & (corners.max(axis=1) >= grown.low), axis=1)
            near.append(part.mesh.with_faces(keep))
        return merge_meshes(near)
