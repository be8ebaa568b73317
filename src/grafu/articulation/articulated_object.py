"""Links, joints, and the articulated object that is checked to be a tree.

Everything is in the object frame (metres, Z up, front -Y) at rest, which is closed: exporters choose link frames.
"""

from collections.abc import Iterator
from dataclasses import replace
from enum import StrEnum
from functools import cached_property
from typing import final

import numpy as np

from grafu.articulation.base import BaseKind
from grafu.articulation.catch_kind import CatchKind
from grafu.articulation.grasp_frame import GraspFrame
from grafu.articulation.joint_values import Coupling as Coupling
from grafu.articulation.joint_values import JointLimits as JointLimits
from grafu.articulation.motion_kind import MotionKind, motion_kind
from grafu.articulation.slip import Slip
from grafu.articulation.swing import Swing
from grafu.articulation.tree_checks import require_driven, require_unique
from grafu.dataclass import dataclass
from grafu.errors import ArticulationError
from grafu.geometry.appearance import Surface
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.transform import translation
from grafu.vocabulary import JointType, PartLabel

_ALIKE = 1e-6  # radians or metres: limits that differ by less are the same


class VisualRole(StrEnum):
    """Where a visual comes from: the input, what was added (a handle, a top, a shelf), or hinges, rails and blocks."""

    PART = "part"
    ADDED = "added"
    HARDWARE = "hardware"


@final
@dataclass(frozen=True, repr=False)
class Visual:
    """One part or piece of hardware in its rest pose. `name` is the part id, or begins with hinge_, rail_, support_.

    With a `swing` it turns against its link as a joint moves; formats of simulators leave such pieces out.
    """

    name: str
    surfaces: tuple[Surface, ...]
    role: VisualRole = VisualRole.PART
    label: PartLabel = PartLabel.UNKNOWN
    swing: Swing | None = None

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

    @property
    def rigid_visuals(self) -> tuple[Visual, ...]:
        """What moves as one with the link: all but hardware that turns against it."""
        return tuple(visual for visual in self.visuals if visual.swing is None)

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
@dataclass(frozen=True)
class Joint:
    """How a child link moves against its parent: `axis` in the object frame at rest, positive values open.

    `after` names the joints that must be open before this one can move (a door in front of a drawer). With a `coupling`
    the joint does not move by itself: it follows another. A `slip` is what the child is shown to do beside the motion.
    A `catch` keeps it closed.
    """

    id: str
    type: JointType
    parent: str
    child: str
    axis: Axis
    limits: JointLimits
    after: tuple[str, ...] = ()
    coupling: Coupling | None = None
    slip: Slip | None = None
    catch: CatchKind = CatchKind.NONE

    @property
    def kind(self) -> MotionKind:
        """How it moves, and what everyone asks about it."""
        return motion_kind(self.type)

    def motion(self, value: float) -> np.ndarray:
        """Returns the 4x4 motion of the child from rest, at a joint value."""
        return self.kind.transform(self.axis, value)

    def shown_motion(self, value: float) -> np.ndarray:
        """Returns the motion as it is shown: the joint's own, and its slip."""
        motion = self.motion(value)
        return motion if self.slip is None else translation(self.slip.shift(value)) @ motion

    def following(self, leader: "Joint", multiplier: float = 1.0, offset: float = 0.0) -> "Joint":
        """Returns this joint coupled to another, with the limits that follow from it.

        Values of a joint are never negative: where they would be, the axis is reversed, and with it both numbers.

        Raises:
            ArticulationError: if the values are negative for some values of the leader and positive for others.
        """
        coupling, axis = Coupling(leader.id, multiplier, offset), self.axis
        if min(coupling.ends(leader.limits)) < -_ALIKE:
            coupling, axis = Coupling(leader.id, -multiplier, -offset), self.axis.reversed()
        low, high = coupling.ends(leader.limits)
        limits = JointLimits(max(low, 0.0) if low > -_ALIKE else low, high)
        return replace(self, axis=axis, limits=limits, after=(), coupling=coupling)


@final
@dataclass(frozen=True, repr=False)
class ArticulatedObject:
    """A tree of links under one static root. `base` is what holds the root; None: it is not stated.

    Raises:
        ArticulationError: if ids repeat, a joint names a link that is not there, a link has two parents, a cycle
            exists, a link cannot be reached from the root, or hardware swings with one that does not move; if a joint
            follows one that is not there, is static or follows it in turn, waits for others by itself, or has limits
            that do not follow from its leader's; if grasps have one name, or are of links that are not there.
    """

    name: str
    root: str
    links: tuple[Link, ...]
    joints: tuple[Joint, ...] = ()
    grasps: tuple[GraspFrame, ...] = ()
    base: BaseKind | None = None

    def __repr__(self) -> str:
        return f"<ArticulatedObject {self.name}: {len(self.links)} links, {len(self.joints)} joints>"

    def __post_init__(self) -> None:
        ids = [link.id for link in self.links]
        require_unique("link", ids)
        require_unique("joint", [joint.id for joint in self.joints])
        require_unique("grasp", [grasp.name for grasp in self.grasps])
        if lost_grasps := [grasp.name for grasp in self.grasps if grasp.link not in ids]:
            raise ArticulationError(f"grasps must be of known links: {lost_grasps} are not")
        if self.root not in ids:
            raise ArticulationError(f"the root must be one of the links: got `{self.root}`, links are {ids}")
        known, children = set(ids), [joint.child for joint in self.joints]
        require_unique("child link", children)
        for joint in self.joints:
            if not {joint.parent, joint.child} <= known:
                raise ArticulationError(f"joint `{joint.id}` must join known links: got {joint.parent}, {joint.child}")
        reached = {link.id for link in self._walk()}
        if self.root in children or reached != known:
            lost = sorted(known - reached) or [self.root]
            raise ArticulationError(f"every link must hang on the root `{self.root}`, without a cycle: {lost} do not")
        swings = (visual.swing for link in self.links for visual in link.visuals)
        require_driven(swings, {joint.child for joint in self.moving_joints})
        for joint in self.joints:
            if joint.coupling is not None:
                self._check_coupling(joint, joint.coupling)

    def _check_coupling(self, joint: Joint, coupling: Coupling) -> None:
        leader = self.joints_by_id.get(coupling.leader)
        if leader is None or not leader.kind.moves or not joint.kind.moves:
            raise ArticulationError(f"`{joint.id}` must follow a joint that moves: got `{coupling.leader}`")
        if joint.after:
            raise ArticulationError(f"`{joint.id}` follows `{leader.id}` and cannot wait for {list(joint.after)}")
        self.leader_of(joint)
        low, high = coupling.ends(leader.limits)
        if max(abs(low - joint.limits.lower), abs(high - joint.limits.upper)) > _ALIKE:
            found = f"{joint.limits.lower} .. {joint.limits.upper}"
            raise ArticulationError(
                f"the limits of `{joint.id}` must follow from `{leader.id}`: got {found}, not {low} .. {high}"
            )

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

    @cached_property
    def ids_from_root(self) -> tuple[str, ...]:
        """The ids of all links, every parent before its children."""
        return tuple(link.id for link in self.links_from_root)

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

    @cached_property
    def joints_by_id(self) -> dict[str, Joint]:
        """Each joint by its id."""
        return {joint.id: joint for joint in self.joints}

    def leader_of(self, joint: Joint) -> Joint:
        """Returns the joint that moves by itself and that this one follows, over others or not; itself where it is one.

        Raises:
            ArticulationError: if joints follow one another in a circle.
        """
        seen = [joint.id]
        while joint.coupling is not None:
            joint = self.joints_by_id[joint.coupling.leader]
            if joint.id in seen:
                raise ArticulationError(f"joints must not follow one another in a circle: {seen} do")
            seen.append(joint.id)
        return joint

    @cached_property
    def links_below(self) -> dict[str, tuple[str, ...]]:
        """For each link that a joint moves, itself and all that hangs on it, every parent before its children."""
        found: dict[str, list[str]] = {}
        for link in self.links_from_root:
            above: Joint | None = self.joint_of.get(link.id)
            while above is not None:
                found.setdefault(above.child, []).append(link.id)
                above = self.joint_of.get(above.parent)
        return {link: tuple(below) for link, below in found.items()}

    @cached_property
    def couplings(self) -> dict[str, Coupling]:
        """What each coupled joint follows, by its id."""
        return {joint.id: joint.coupling for joint in self.joints if joint.coupling is not None}

    @cached_property
    def free_joints(self) -> tuple[Joint, ...]:
        """The joints that move by themselves: neither fixed nor coupled."""
        return tuple(joint for joint in self.moving_joints if joint.coupling is None)

    @cached_property
    def moving_joints(self) -> tuple[Joint, ...]:
        """The joints that are not fixed."""
        return tuple(joint for joint in self.joints if joint.kind.moves)
