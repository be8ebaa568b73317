"""Collision shapes trimmed until no joint is jammed: shapes of different links that meet along a motion give way.

Boxes and hulls stand for meshes that pass one another by a hair; where the stand-ins overlap, a simulator would push
doors open or stop drawers. They are cut back where it takes the least surface away. It knows no file format.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import final

import fcl
import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.articulation.collision_shapes import CollisionShape, corners_of, extent_of
from grafu.articulation.kinematics import link_poses
from grafu.articulation.sweep import rest_to_full
from grafu.geometry.arrays import Mat4, Points
from grafu.geometry.box import OrientedBox
from grafu.geometry.solids import ConvexSolid
from grafu.geometry.transform import invert, transform_points

Shapes = dict[str, tuple[CollisionShape, ...]]


@final
@dataclass(frozen=True, slots=True)
class ClearanceConfig:
    """How shapes give way; lengths in metres.

    Each motion is looked at in `poses` poses. A cut leaves `margin`; where a shape would keep less than `least_share`
    of a side, or become thinner than `least_thickness`, it is not cut. Of a pair that cannot be cut the one that stands
    still is left out: a drawer without a bottom is worse than a frame without a rail. Cuts are repeated `rounds` times.
    """

    poses: int = 9
    margin: float = 0.0005
    least_share: float = 0.25
    least_thickness: float = 0.002
    rounds: int = 4


DEFAULT_CLEARANCE_CONFIG = ClearanceConfig()


@final
class _Body:
    """One shape of one link, with its collision object made once; not a value."""

    def __init__(self, link: str, shape: CollisionShape) -> None:
        self.link = link
        self.shape = shape
        self.corners: Points = corners_of(shape)
        self._object = fcl.CollisionObject(_geometry(self.corners))

    def place(self, T: Mat4) -> np.ndarray:
        """Poses the body at T and returns its axis-aligned bounds, (2, 3)."""
        self._object.setTransform(fcl.Transform(T[:3, :3], T[:3, 3]))
        corners = transform_points(T, self.corners)
        return np.stack([corners.min(axis=0), corners.max(axis=0)])

    def meets(self, other: "_Body") -> bool:
        """Whether the two, as posed, share a point."""
        return bool(fcl.collide(self._object, other._object, fcl.CollisionRequest(), fcl.CollisionResult()))


@final
@dataclass(frozen=True, slots=True)
class _Conflict:
    """Two bodies that meet, and the pose of the second against the first in each pose where they do.

    `still_moves` says that the second moves with another joint.
    """

    moving: _Body
    still: _Body
    still_moves: bool
    Ts_moving_still: tuple[Mat4, ...]


def cleared(
    articulated: ArticulatedObject,
    shapes: Mapping[str, tuple[CollisionShape, ...]],
    config: ClearanceConfig = DEFAULT_CLEARANCE_CONFIG,
) -> Shapes:
    """Returns the shapes of each link, cut back or left out so that no joint's motion makes two links meet.

    Joints move one at a time from rest to full, those they wait for open; shapes are in the object frame at rest.
    """
    bodies = [_Body(link, shape) for link, held in shapes.items() for shape in held]
    for left in reversed(range(config.rounds)):
        conflicts = list(_conflicts(articulated, bodies, config.poses))
        if not conflicts:
            break
        bodies = _resolved(bodies, conflicts, config if left else None)
    return {link: tuple(body.shape for body in bodies if body.link == link) for link in shapes}


def _geometry(corners: Points) -> fcl.CollisionGeometry:
    solid = ConvexSolid.around(corners)
    assert solid is not None, "collision shapes have volume"
    faces = np.column_stack([np.full(len(solid.faces), 3), solid.faces]).ravel()
    return fcl.Convex(solid.vertices, len(solid.faces), faces)


def _conflicts(articulated: ArticulatedObject, bodies: list[_Body], poses: int) -> Iterator[_Conflict]:
    for joint in articulated.moving_joints:
        carried = _carried(articulated, joint)
        moving = [body for body in bodies if body.link in carried]
        still = [body for body in bodies if body.link not in carried]
        met: dict[tuple[int, int], list[Mat4]] = {}
        for values in rest_to_full(articulated, joint.id, poses):
            T_object_link = link_poses(articulated, values)
            for a, b in _meeting(moving, still, T_object_link):
                T = invert(T_object_link[moving[a].link]) @ T_object_link[still[b].link]
                met.setdefault((a, b), []).append(T)
        for (a, b), Ts in met.items():
            yield _Conflict(moving[a], still[b], still[b].link != articulated.root, tuple(Ts))


def _carried(articulated: ArticulatedObject, joint: Joint) -> set[str]:
    found = {joint.child}
    for link in articulated.links_from_root:
        above = articulated.joint_of.get(link.id)
        if above is not None and above.parent in found:
            found.add(link.id)
    return found


def _meeting(moving: list[_Body], still: list[_Body], poses: Mapping[str, Mat4]) -> Iterator[tuple[int, int]]:
    """Yields the index pairs of bodies that meet; bounds are compared first."""
    if not moving or not still:
        return
    a = np.stack([body.place(poses[body.link]) for body in moving])[:, None]
    b = np.stack([body.place(poses[body.link]) for body in still])[None]
    near = np.all((a[..., 0, :] <= b[..., 1, :]) & (b[..., 0, :] <= a[..., 1, :]), axis=-1)
    for first, second in np.argwhere(near):
        if moving[first].meets(still[second]):
            yield int(first), int(second)


def _resolved(bodies: list[_Body], conflicts: list[_Conflict], config: ClearanceConfig | None) -> list[_Body]:
    """Returns the bodies after one cut per conflict; with no config one of the two is left out instead.

    A body that has been cut already waits for the next round: the cut may have settled its other conflicts.
    """
    changed: dict[_Body, CollisionShape | None] = {}
    for conflict in conflicts:
        if conflict.moving in changed or conflict.still in changed:
            continue
        body, shape = _cut(conflict, config) if config is not None else (_left_out(conflict), None)
        changed[body] = shape
    kept = ((body, changed[body]) if body in changed else (body, body.shape) for body in bodies)
    return [body if body.shape is shape else _Body(body.link, shape) for body, shape in kept if shape is not None]


def _left_out(conflict: _Conflict) -> _Body:
    if not conflict.still_moves:
        return conflict.still
    return min(conflict.moving, conflict.still, key=lambda body: extent_of(body.shape))


def _cut(conflict: _Conflict, config: ClearanceConfig) -> tuple[_Body, CollisionShape | None]:
    """Returns the body that gives way and what is left of it: whatever takes the least surface away."""
    moving, still = conflict.moving, conflict.still
    onto_moving = np.vstack([transform_points(T, still.corners) for T in conflict.Ts_moving_still])
    onto_still = np.vstack([transform_points(invert(T), moving.corners) for T in conflict.Ts_moving_still])
    options: list[tuple[_Body, CollisionShape | None]] = [(_left_out(conflict), None)]
    for body, obstacle in ((moving, onto_moving), (still, onto_still)):
        rest = _cut_back(body.shape, obstacle, config)
        options += [(body, rest)] if rest is not None else []
    return min(options, key=lambda option: _loss(*option))


def _loss(body: _Body, rest: CollisionShape | None) -> float:
    return extent_of(body.shape) - (0.0 if rest is None else extent_of(rest))


def _cut_back(shape: CollisionShape, obstacle: Points, config: ClearanceConfig) -> CollisionShape | None:
    """Returns the largest rest of a shape on one side of the box around the obstacle, if it is worth keeping."""
    R = shape.rotation if isinstance(shape, OrientedBox) else np.eye(3)
    own, local = corners_of(shape) @ R, obstacle @ R
    low, high = own.min(axis=0), own.max(axis=0)
    below = local.min(axis=0) - config.margin - low
    above = high - (local.max(axis=0) + config.margin)
    room = np.stack([below, above], axis=1)
    share = room / np.maximum(high - low, 1e-12)[:, None]
    axis, side = np.unravel_index(int(np.argmax(share)), share.shape)
    if room[axis, side] < config.least_thickness or share[axis, side] < config.least_share:
        return None
    normal = R[:, axis] * (1.0 if side == 0 else -1.0)
    offset = float(low[axis] + room[axis, 0]) if side == 0 else -float(high[axis] - room[axis, 1])
    return _halved(shape, normal, offset, int(axis))


def _halved(shape: CollisionShape, normal: np.ndarray, offset: float, axis: int) -> CollisionShape | None:
    """Returns the part of a shape where `normal . x <= offset`; the normal is along `axis` of a box."""
    if isinstance(shape, OrientedBox):
        reach = float(normal @ shape.center) + shape.half[axis]
        half = shape.half.copy()
        half[axis] -= (reach - offset) / 2
        return OrientedBox(shape.center - normal * (reach - offset) / 2, half, shape.rotation)
    height = shape.vertices @ normal - offset
    start, end = shape.faces.ravel(), np.roll(shape.faces, -1, axis=1).ravel()
    crossing = (height[start] < 0) & (height[end] > 0)
    start, end = start[crossing], end[crossing]
    weight = (height[start] / (height[start] - height[end]))[:, None]
    cut = shape.vertices[start] * (1 - weight) + shape.vertices[end] * weight
    return ConvexSolid.around(np.vstack([shape.vertices[height <= 0], cut]))
