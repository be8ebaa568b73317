"""Fraction of the poses between rest and full opening in which a moving body cuts into what is static.

The paper counts, of 50 frames from rest to full extent, those in which moving and static parts intersect, and states no
tolerance. Touching counts there, so a door that lies flush on its carcass collides at rest: `tolerance=0` is that
definition. With a tolerance a frame counts only where the body cuts deeper than a fraction of the object's largest
side. docs/metrics.md compares the two.

Does a moving body stay connected: the largest gap over its whole motion between it and the static body or, where a
moving one carries it, the nearer of both.

The paper counts a part as connected while its distance to the static parts never exceeds 5 mm in a unit cube. Hardware
belongs to the body that it is anchored to; a hinge that floats beside its door connects nothing (docs/metrics.md).
"""

from collections.abc import Iterable
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, VisualRole
from grafu.articulation.kinematics import link_poses
from grafu.articulation.sweep import rest_to_full
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.swept_body import SweptBody
from grafu.metrics.bodies import anchored_mesh, largest_side, parts_mesh, rigid_body


@final
@dataclass(frozen=True, slots=True)
class ConnectivityConfig:
    """How connection is measured; `tolerance` is a fraction of the object's largest side.

    `extent` is the side in metres to use instead of the object's own: that of the input, where parts were added to it.

    Raises:
        ValueError: if there is no pose, the tolerance is negative or the unit is not positive.
    """

    poses: int = 50  # as for collisions
    tolerance: float = 0.005  # the paper's 5 mm in a unit cube
    extent: float | None = None

    def __post_init__(self) -> None:
        if self.poses < 1 or self.tolerance < 0:
            raise ValueError(f"connectivity needs poses and a tolerance >= 0: got {self.poses}, {self.tolerance}")
        if self.extent is not None and not self.extent > 0:
            raise ValueError(f"`ConnectivityConfig.extent` must be above 0: got {self.extent}")

    def allowed(self, articulated: ArticulatedObject) -> float:
        """Returns the widest gap in metres that still counts as connected."""
        return self.tolerance * (self.extent or largest_side(articulated))


DEFAULT = ConnectivityConfig()


def largest_gaps(articulated: ArticulatedObject, config: ConnectivityConfig = DEFAULT) -> dict[str, float]:
    """Returns for each moving joint the largest distance, metres, of its body from what carries it over its motion.

    That is the static body; where a moving one carries it, the nearer of both counts. Where it or the static body has
    no faces the gap is infinite.
    """
    tolerance = config.allowed(articulated)
    static = anchored_mesh(rigid_body(articulated, articulated.root), tolerance)
    if not len(static.faces):
        return {joint.id: float("inf") for joint in articulated.moving_joints}
    held = MeshCollider(static)
    return {j.id: _largest_gap(articulated, j, held, (tolerance, config.poses)) for j in articulated.moving_joints}


def connected_joints(articulated: ArticulatedObject, config: ConnectivityConfig = DEFAULT) -> dict[str, bool]:
    """Returns for each moving joint whether its body stays within the tolerance of what carries it."""
    allowed = config.allowed(articulated)
    return {joint: gap <= allowed for joint, gap in largest_gaps(articulated, config).items()}


def connectivity(articulated: ArticulatedObject, config: ConnectivityConfig = DEFAULT) -> float:
    """Returns the fraction of moving joints that stay connected (the paper's figure per object), 1 without joints."""
    found = connected_joints(articulated, config)
    return float(np.mean(list(found.values()))) if found else 1.0


def _largest_gap(
    articulated: ArticulatedObject, joint: Joint, static: MeshCollider, settings: tuple[float, int]
) -> float:
    tolerance, poses = settings
    mesh = anchored_mesh(rigid_body(articulated, joint.child), tolerance)
    if not len(mesh.faces):
        return float("inf")
    body, largest, carrier = MeshCollider(mesh), 0.0, None
    if joint.parent != articulated.root:
        on = anchored_mesh(rigid_body(articulated, joint.parent), tolerance)
        carrier = MeshCollider(on) if len(on.faces) else None
    for frame in rest_to_full(articulated, joint.id, poses):
        at = link_poses(articulated, frame)
        body.place(at[joint.child])
        gap = body.distance(static)
        if carrier is not None:
            carrier.place(at[joint.parent])
            gap = min(gap, body.distance(carrier))
        largest = max(largest, gap)
    return largest


@final
@dataclass(frozen=True, slots=True)
class CollisionConfig:
    """How a collision is counted.

    `tolerance` is a fraction of the object's largest side (0: strict). `hardware` counts hinges and rails on both
    sides; `moving_bodies` also counts the other moving bodies, at rest or where they must be open first. `extent` is
    the side in metres to use instead of the object's own: that of the input, where parts were added to it.

    Raises:
        ValueError: if there is no pose, the tolerance is negative or the unit is not positive.
    """

    poses: int = 50  # the paper's number
    tolerance: float = 0.0
    hardware: bool = False
    moving_bodies: bool = False
    extent: float | None = None

    def __post_init__(self) -> None:
        if self.poses < 1 or self.tolerance < 0:
            raise ValueError(f"a collision needs poses and a tolerance >= 0: got {self.poses}, {self.tolerance}")
        if self.extent is not None and not self.extent > 0:
            raise ValueError(f"`CollisionConfig.extent` must be above 0: got {self.extent}")


STRICT = CollisionConfig()
# Half a millimetre in a unit cube. There, real furniture that moves as it was annotated collides about as often as is
# published for annotations; a strict count is far above that, and a hundredth calls no door that jams a collision.
TOLERANT = CollisionConfig(tolerance=0.0005)


def collision_shares(articulated: ArticulatedObject, config: CollisionConfig = STRICT) -> dict[str, float]:
    """Returns for each moving joint the fraction (0..1) of poses in which its body collides."""
    scene = _Scene(articulated, config)
    return {joint.id: scene.ratio(joint) for joint in articulated.moving_joints}


def mean_collision(articulated: ArticulatedObject, config: CollisionConfig = STRICT) -> float:
    """Returns the mean fraction over the object's moving joints (the paper's figure per object), 0 without joints."""
    ratios = collision_shares(articulated, config)
    return float(np.mean(list(ratios.values()))) if ratios else 0.0


@final
@dataclass(frozen=True, slots=True)
class FirstCollision:
    """The first pose of a joint in which its body collides: its value (radians or metres), and what it cuts into."""

    value: float
    others: tuple[str, ...]


def first_collisions(
    articulated: ArticulatedObject, joints: Iterable[str], config: CollisionConfig = TOLERANT
) -> dict[str, FirstCollision]:
    """Returns for each of these joints that collides the first pose in which it does; `others` are names of visuals."""
    scene = _Scene(articulated, config)
    wanted = set(joints)
    found = {joint.id: scene.first(joint) for joint in articulated.moving_joints if joint.id in wanted}
    return {joint: first for joint, first in found.items() if first is not None}


@final
class _Scene:
    """An object prepared for many queries: its static body, and the moving bodies that count as obstacles."""

    def __init__(self, articulated: ArticulatedObject, config: CollisionConfig) -> None:
        self._articulated, self._config = articulated, config
        self._depth = config.tolerance * (config.extent or largest_side(articulated))
        moving_bodies = [joint.child for joint in articulated.moving_joints] if config.moving_bodies else []
        meshes = {link: self._mesh(link) for link in (articulated.root, *moving_bodies)}
        self._obstacles = {link: MeshCollider(mesh) for link, mesh in meshes.items() if len(mesh.faces)}

    def ratio(self, joint: Joint) -> float:
        """Returns the fraction of poses of one joint in which its body collides."""
        mesh = self._mesh(joint.child)
        if not len(mesh.faces):
            return 0.0
        body = SweptBody(mesh, self._depth)
        frames = rest_to_full(self._articulated, joint.id, self._config.poses)
        hits = [self._collides(link_poses(self._articulated, frame), joint.child, body) for frame in frames]
        return float(np.mean(hits))

    def first(self, joint: Joint) -> FirstCollision | None:
        """Returns the first pose of one joint in which its body collides; None where it never does."""
        mesh = self._mesh(joint.child)
        if not len(mesh.faces):
            return None
        body = SweptBody(mesh, self._depth)
        for frame in rest_to_full(self._articulated, joint.id, self._config.poses):
            poses = link_poses(self._articulated, frame)
            if self._collides(poses, joint.child, body):
                return FirstCollision(frame[joint.id], self._met(poses, joint.child, body))
        return None

    def _met(self, poses: dict[str, Mat4], child: str, body: SweptBody) -> tuple[str, ...]:
        """Returns the visuals of other bodies that a body, as posed, touches."""
        own = {link.id for link in rigid_body(self._articulated, child)}
        others = [(link.id, v) for link in self._articulated.links if link.id not in own for v in link.visuals]
        met = []
        for link, visual in others:
            if len(visual.mesh.faces) and (self._config.hardware or visual.role is not VisualRole.HARDWARE):
                collider = MeshCollider(visual.mesh)
                collider.place(poses[link])
                met += [visual.name] if body.touches(collider) else []
        return tuple(met)

    def _mesh(self, link_id: str) -> TriangleMesh:
        links = rigid_body(self._articulated, link_id)
        return merge_meshes([link.mesh for link in links]) if self._config.hardware else parts_mesh(links)

    def _collides(self, poses: dict[str, Mat4], child: str, body: SweptBody) -> bool:
        body.place(poses[child])
        others = [link for link in self._obstacles if link != child]
        for link in others:
            self._obstacles[link].place(poses[link])
        obstacles = [self._obstacles[link] for link in others]
        if self._depth > 0:  # together: a body wedged between two of them comes free of either, not of both
            return bool(body.penetrated(obstacles))
        return any(body.touches(obstacle) for obstacle in obstacles)
