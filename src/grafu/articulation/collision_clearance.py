"""Collision shapes trimmed until no joint is jammed: shapes of different links that meet along a motion give way.

Boxes and hulls stand for meshes that pass one another by a hair; where the stand-ins overlap, a simulator would push
doors open or stop drawers. They are cut back where it takes the least surface away.
"""

from collections.abc import Iterator, Mapping
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.articulation.collision_paths import JointPath, ShapeRows
from grafu.articulation.collision_shapes import CollisionShape, ShapeBody, corners_of, extent_of
from grafu.articulation.kinematics import REST, link_poses
from grafu.articulation.sweep import ratios_of_range, rest_to_full, values_before
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4, Points
from grafu.geometry.box import OrientedBox
from grafu.geometry.budget import require_time
from grafu.geometry.config_checks import require_positive
from grafu.geometry.solids import ConvexSolid
from grafu.geometry.transform import invert, transform_points

Shapes = dict[str, tuple[CollisionShape, ...]]


@final
@dataclass(frozen=True, slots=True)
class ShapeClearanceConfig:
    """How shapes give way; lengths in metres.

    Of a pair that cannot be cut the static one is left out: a drawer without a bottom is worse than a frame
    without a rail.

    Raises:
        ValueError: if a number is not above 0.
    """

    poses: int = 25
    """In how many poses each motion is looked at."""
    crowding: float = 2.0
    """Poses lie closer near rest, where parts fit tightly: the first of 25 is at a sixth of a percent of the way, the
    last step is 8 % (power of even steps)."""
    margin: float = 0.0005
    """What a cut leaves between two shapes ..."""
    least_ratio: float = 0.25
    """... a shape is not cut where it would keep less of a side than this part ..."""
    least_thickness: float = 0.002
    """... or become thinner than this."""
    moving_ratio: float = 0.1
    """Where a moving shape would lose more of its surface than this part ..."""
    moving_counts: float = 3.0
    """... its loss counts this many times: a drawer is there to be filled, and what is static is often a hull around
    more than its part."""
    rounds: int = 4
    """How often cuts are repeated; in the last round what still meets is left out."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


DEFAULT_CLEARANCE_CONFIG = ShapeClearanceConfig()


@final
@dataclass(frozen=True, slots=True)
class _Conflict:
    """Two bodies that meet, and the pose of the second against the first in each pose where they do.

    `still_moves` states that the second moves with another joint.
    """

    moving: ShapeBody
    still: ShapeBody
    still_moves: bool
    Ts_moving_still: tuple[Mat4, ...]


def cleared(
    articulated: ArticulatedObject,
    shapes: Mapping[str, tuple[CollisionShape, ...]],
    config: ShapeClearanceConfig = DEFAULT_CLEARANCE_CONFIG,
) -> Shapes:
    """Returns the shapes of each link, cut back or left out so that no joint's motion makes two links meet.

    Joints move one at a time from rest to full, those they wait for open; shapes are in the object frame at rest.
    """
    bodies = [ShapeBody(link, shape) for link, held in shapes.items() for shape in held]
    motions = [_motion(articulated, joint, config) for joint in articulated.moving_joints]
    settled: frozenset[ShapeBody] = frozenset()
    for left in reversed(range(config.rounds)):
        rows = ShapeRows.of(bodies)
        conflicts = [found for motion in motions for found in _conflicts(motion, rows, settled, articulated.root)]
        if not conflicts:
            break
        settled = frozenset(bodies)
        bodies = _resolved(bodies, conflicts, config if left else None)
    return {link: tuple(body.shape for body in bodies if body.link == link) for link in shapes}


def _motion(articulated: ArticulatedObject, joint: Joint, config: ShapeClearanceConfig) -> JointPath:
    """Returns the path of a joint: what hangs on it moves as one body with its child, unless joints are coupled."""
    if any(articulated.leader_of(other) is articulated.leader_of(joint) for other in _others(articulated, joint)):
        return _coupled_motion(articulated, joint, config)
    start = link_poses(articulated, values_before(articulated, joint.id))
    T_object_parent, T_child_object = start[joint.parent], invert(start[joint.child])
    values = joint.limits.lower + joint.limits.range * ratios_of_range(config.poses, config.crowding)
    Ts = np.stack([T_object_parent @ joint.motion(float(value)) @ T_child_object for value in values])
    carried = _carried(articulated, joint)
    still = {link: T for link, T in start.items() if link not in carried and T is not REST}
    return JointPath({link: Ts @ start[link] for link in carried}, still, {})


def _others(articulated: ArticulatedObject, joint: Joint) -> list[Joint]:
    return [other for other in articulated.moving_joints if other is not joint]


def _coupled_motion(articulated: ArticulatedObject, joint: Joint, config: ShapeClearanceConfig) -> JointPath:
    """Returns the path of a joint that moves together with others."""
    values = rest_to_full(articulated, joint.id, config.poses, config.crowding)
    frames = [link_poses(articulated, at) for at in values]
    Ts = {link.id: np.stack([frame[link.id] for frame in frames]) for link in articulated.links}
    carried = _carried(articulated, joint)
    others = {link: Ts_link for link, Ts_link in Ts.items() if link not in carried}
    moved = {link: Ts_link for link, Ts_link in others.items() if not np.allclose(Ts_link, REST)}
    return JointPath({link: Ts[link] for link in carried}, {}, moved)


def _carried(articulated: ArticulatedObject, joint: Joint) -> set[str]:
    found = {joint.child}
    for link in articulated.links_from_root:
        above = articulated.joint_of.get(link.id)
        if above is not None and above.parent in found:
            found.add(link.id)
    return found


def _conflicts(motion: JointPath, rows: ShapeRows, settled: frozenset[ShapeBody], root: str) -> Iterator[_Conflict]:
    """Yields the pairs that meet along one joint's path, except those of which both are settled: they were tested."""
    moving, still, meetings = rows.near(motion)
    met: dict[tuple[ShapeBody, ShapeBody], list[Mat4]] = {}
    require_time()
    for pose, a, b in meetings:
        require_time()
        body, other = moving[a], still[b]
        if body in settled and other in settled:
            continue
        T_object_body = motion.Ts_object_carried[body.link][pose]
        T_object_other = motion.pose_of_other(other.link, int(pose))
        body.place(T_object_body)
        other.place(T_object_other)
        if body.meets(other):
            met.setdefault((body, other), []).append(invert(T_object_body) @ T_object_other)
    for (body, other), Ts in met.items():
        yield _Conflict(body, other, other.link != root, tuple(Ts))


def _resolved(
    bodies: list[ShapeBody], conflicts: list[_Conflict], config: ShapeClearanceConfig | None
) -> list[ShapeBody]:
    """Returns the bodies after one cut per conflict; with no config one of the two is left out instead.

    A body that has been cut already waits for the next round: the cut may have settled its other conflicts.
    """
    changed: dict[ShapeBody, CollisionShape | None] = {}
    for conflict in conflicts:
        if conflict.moving in changed or conflict.still in changed:
            continue
        body, shape = _cut(conflict, config) if config is not None else (_left_out(conflict), None)
        changed[body] = shape
    kept = ((body, changed[body]) if body in changed else (body, body.shape) for body in bodies)
    return [body if body.shape is shape else ShapeBody(body.link, shape) for body, shape in kept if shape is not None]


def _left_out(conflict: _Conflict) -> ShapeBody:
    if not conflict.still_moves:
        return conflict.still
    return min(conflict.moving, conflict.still, key=lambda body: extent_of(body.shape))


def _cut(conflict: _Conflict, config: ShapeClearanceConfig) -> tuple[ShapeBody, CollisionShape | None]:
    """Returns the body that gives way and what is left of it: whatever takes the least surface away."""
    moving, still = conflict.moving, conflict.still
    onto_moving = np.vstack([transform_points(T, still.corners) for T in conflict.Ts_moving_still])
    onto_still = np.vstack([transform_points(invert(T), moving.corners) for T in conflict.Ts_moving_still])
    options: list[tuple[ShapeBody, CollisionShape | None]] = [(_left_out(conflict), None)]
    for body, obstacle in ((moving, onto_moving), (still, onto_still)):
        rest = _cut_back(body.shape, obstacle, config)
        options += [(body, rest)] if rest is not None else []
    guarded = None if conflict.still_moves else moving
    return min(options, key=lambda option: _loss(option[0], option[1], config, option[0] is guarded))


def _loss(body: ShapeBody, rest: CollisionShape | None, config: ShapeClearanceConfig, guarded: bool) -> float:
    """Returns the surface that a body loses, square metres; counted several times where a guarded one loses much."""
    whole = extent_of(body.shape)
    loss = whole - (0.0 if rest is None else extent_of(rest))
    return loss * (config.moving_counts if guarded and loss > config.moving_ratio * whole else 1.0)


def _cut_back(shape: CollisionShape, obstacle: Points, config: ShapeClearanceConfig) -> CollisionShape | None:
    """Returns the largest rest of a shape on one side of the box around the obstacle, if it is worth keeping."""
    R = shape.rotation if isinstance(shape, OrientedBox) else np.eye(3)
    own, local = corners_of(shape) @ R, obstacle @ R
    low, high = own.min(axis=0), own.max(axis=0)
    below = local.min(axis=0) - config.margin - low
    above = high - (local.max(axis=0) + config.margin)
    room = np.stack([below, above], axis=1)
    ratio = room / np.maximum(high - low, 1e-12)[:, None]
    axis, side = np.unravel_index(int(np.argmax(ratio)), ratio.shape)
    if room[axis, side] < config.least_thickness or ratio[axis, side] < config.least_ratio:
        return None
    normal = R[:, axis] * (1.0 if side == 0 else -1.0)
    offset = float(low[axis] + room[axis, 0]) if side == 0 else -float(high[axis] - room[axis, 1])
    return halved(shape, normal, offset, int(axis))


def halved(shape: CollisionShape, normal: np.ndarray, offset: float, axis: int) -> CollisionShape | None:
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
