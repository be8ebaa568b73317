"""Links, joints, and the articulated object that is checked to be a tree.

Everything is in the object frame (metres, Z up, front -Y) at rest, which is closed: exporters choose link frames.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from typing import final

import numpy as np

from grafu.errors import ArticulationError
from grafu.geometry.appearance import Surface
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.vocabulary import JointType, PartLabel


class VisualRole(StrEnum):
    """Where a visual comes from."""

    PART = "part"  # a part of the input
    ADDED = "added"  # a part that was added: a handle, a top, a shelf
    HARDWARE = "hardware"  # a hinge, a rail or a support block


@final
@dataclass(frozen=True, repr=False)
class Visual:
    """One part or piece of hardware in its rest pose. `name` is the part id, or begins with hinge_, rail_, support_."""

    name: str
    surfaces: tuple[Surface, ...]
    role: VisualRole = VisualRole.PART
    label: PartLabel = PartLabel.UNKNOWN

    def __repr__(self) -> str:
        return f"<Visual {self.name}: {self.role}, {sum(len(s.mesh.faces) for s in self.surfaces):,} faces>"

    @cached_property
    def mesh(self) -> TriangleMesh:
        """All surfaces as one mesh."""
        return merge_meshes([s.mesh for s in self.surfaces])


@final
@dataclass(frozen=True, repr=False)
class Link:
    """A rigid body: what moves together."""

    id: str
    visuals: tuple[Visual, ...]

    def __repr__(self) -> str:
        return f"<Link {self.id}: {len(self.visuals)} visuals>"

    @cached_property
    def mesh(self) -> TriangleMesh:
        """Parts, additions and hardware as one mesh."""
        return merge_meshes([v.mesh for v in self.visuals])

    @cached_property
    def body_mesh(self) -> TriangleMesh:
        """Parts and additions without hardware."""
        return merge_meshes([v.mesh for v in self.visuals if v.role is not VisualRole.HARDWARE])

    @cached_property
    def hardware_mesh(self) -> TriangleMesh:
        """The hardware alone."""
        return merge_meshes([v.mesh for v in self.visuals if v.role is VisualRole.HARDWARE])


@final
@dataclass(frozen=True, slots=True)
class JointLimits:
    """The range of a joint: radians or metres; 0 is closed, positive opens, never negative.

    Raises:
        ArticulationError: if not 0 <= lower <= upper, both finite.
    """

    lower: float
    upper: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.lower) and np.isfinite(self.upper) and 0 <= self.lower <= self.upper):
            raise ArticulationError(f"limits must satisfy 0 <= lower <= upper: got {self.lower} .. {self.upper}")

    @property
    def range(self) -> float:
        """The opening from lower to upper."""
        return self.upper - self.lower


@final
@dataclass(frozen=True)
class Joint:
    """A revolute or prismatic joint: `axis` in the object frame at rest, positive values open.

    `after` names the joints that must be open before this one can move (a door in front of a drawer).
    """

    id: str
    type: JointType
    parent: str
    child: str
    axis: Axis
    limits: JointLimits
    after: tuple[str, ...] = ()

    def motion(self, value: float) -> np.ndarray:
        """Returns the 4x4 motion of the child from rest, at a joint value."""
        if self.type is JointType.REVOLUTE:
            return self.axis.rotation(value)
        if self.type is JointType.PRISMATIC:
            return self.axis.shift(value)
        return np.eye(4)


@final
@dataclass(frozen=True, repr=False)
class ArticulatedObject:
    """A tree of links under one static root.

    Raises:
        ArticulationError: if ids repeat, a joint names a link that is not there, a link has two parents, a cycle
            exists, or a link cannot be reached from the root.
    """

    name: str
    root: str
    links: tuple[Link, ...]
    joints: tuple[Joint, ...] = ()

    def __repr__(self) -> str:
        return f"<ArticulatedObject {self.name}: {len(self.links)} links, {len(self.joints)} joints>"

    def __post_init__(self) -> None:
        ids = [link.id for link in self.links]
        _require_unique("link", ids)
        _require_unique("joint", [joint.id for joint in self.joints])
        if self.root not in ids:
            raise ArticulationError(f"the root must be one of the links: got `{self.root}`, links are {ids}")
        known, children = set(ids), [joint.child for joint in self.joints]
        _require_unique("child link", children)
        for joint in self.joints:
            if not {joint.parent, joint.child} <= known:
                raise ArticulationError(f"joint `{joint.id}` must join known links: got {joint.parent}, {joint.child}")
        reached = {link.id for link in self._walk()}
        if self.root in children or reached != known:
            lost = sorted(known - reached) or [self.root]
            raise ArticulationError(f"every link must hang on the root `{self.root}`, without a cycle: {lost} do not")

    def _walk(self) -> Iterator[Link]:
        by_id = {link.id: link for link in self.links}
        below: dict[str, list[str]] = {}
        for joint in self.joints:
            below.setdefault(joint.parent, []).append(joint.child)
        queue = [self.root]
        while queue:
            link = queue.pop(0)
            yield by_id[link]
            queue += below.get(link, [])

    @cached_property
    def links_from_root(self) -> tuple[Link, ...]:
        """All links, every parent before its children."""
        return tuple(self._walk())

    def link(self, link_id: str) -> Link:
        """Returns the link with this id. Raises KeyError where there is none."""
        return self._links_by_id[link_id]

    @cached_property
    def _links_by_id(self) -> dict[str, Link]:
        return {link.id: link for link in self.links}

    @cached_property
    def joint_of(self) -> dict[str, Joint]:
        """The joint above each link; the root has none."""
        return {joint.child: joint for joint in self.joints}

    @property
    def moving_joints(self) -> tuple[Joint, ...]:
        """The joints that are not fixed."""
        return tuple(joint for joint in self.joints if joint.type is not JointType.FIXED)


def _require_unique(what: str, ids: list[str]) -> None:
    repeated = sorted({i for i in ids if ids.count(i) > 1}) if len(set(ids)) < len(ids) else []
    if repeated:
        raise ArticulationError(f"{what} ids must be unique: got {repeated} more than once")
