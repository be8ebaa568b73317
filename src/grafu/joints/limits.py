"""The widest opening free of collision, found by sweeping real meshes."""

from collections.abc import Callable, Sequence
from functools import cache
from itertools import pairwise
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4, Scalars, frozen_array
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.swept_body import SweptBody
from grafu.geometry.transform import transform_points
from grafu.scene.obstacles import Obstacle, Obstacles

_DIP = 1e-6  # metres below the floor that rounding alone makes
_REST_DENSITY = 1.5  # exponent that brings the poses of a sweep closer together near rest
_BOX_POSES = 9  # poses around which the box of a path is drawn
_BETWEEN = 0.02  # of the body's largest side: what lies between these poses stands out of their box by less
_HALVINGS = 6  # of the last step of a sweep: to a sixty-fourth of it

PoseFunction = Callable[[float], Mat4]


@final
@dataclass(frozen=True, slots=True)
class SweepVerdict:
    """How far a body moves freely: the free opening, the fraction of poses that collide, and what it ran into first."""

    free: float
    ratio: float
    blockers: tuple[str, ...]


def opening_values(reach: float, poses: int) -> Scalars:
    """Returns joint values from 0 to `reach`, closer together near rest, where parts lie nearest to one another."""
    return reach * _ratios(poses)


@cache
def _ratios(poses: int) -> Scalars:
    return frozen_array(np.linspace(0.0, 1.0, poses) ** _REST_DENSITY)


def swept_box(box: Box, motion: PoseFunction, reach: float, poses: int = _BOX_POSES) -> Box:
    """Returns a box around a box's whole path from 0 to `reach` (slightly grown for what lies between poses)."""
    corners = np.vstack([transform_points(motion(v), box.corners()) for v in np.linspace(0.0, reach, poses)])
    return Box.around(corners).grown(_BETWEEN * float(box.size.max()))


def in_the_way(obstacles: Obstacles | Sequence[Obstacle], box: Box) -> list[Obstacle]:
    """Returns the obstacles whose boxes meet a box."""
    if isinstance(obstacles, Obstacles):
        return obstacles.near(box)
    return [o for o in obstacles if o.collider.box.overlaps(box)]


def sweep(
    body: SweptBody, motion: PoseFunction, reach: float, obstacles: Sequence[Obstacle], poses: int
) -> SweepVerdict:
    """Returns the verdict over evenly spaced poses from 0 to `reach`; the first blocked pose ends the free opening.

    A part that already collides at rest has a free opening of 0, and `ratio` tells whether that passes.
    """
    values = opening_values(reach, poses)
    blocked = [blockers_at(body, motion(v), obstacles) for v in values]
    hits = [k for k, names in enumerate(blocked) if names]
    free = reach if not hits else float(values[hits[0] - 1]) if hits[0] else 0.0
    names = tuple(sorted({name for found in blocked for name in found}))
    return SweepVerdict(free, len(hits) / poses, names)


def free_opening(
    body: SweptBody, motion: PoseFunction, reach: float, obstacles: Sequence[Obstacle], poses: int
) -> tuple[float, float]:
    """Returns the opening before the first blocked pose, and for a body blocked at rest the fraction of such poses.

    It stops at the first blocked pose, unless that is the first of all.
    """
    values = opening_values(reach, poses)
    if blockers_at(body, motion(0.0), obstacles):
        hits = [bool(blockers_at(body, motion(v), obstacles)) for v in values]
        return 0.0, sum(hits) / poses
    first = next((k for k, v in enumerate(values) if blockers_at(body, motion(v), obstacles)), None)
    return (reach, 0.0) if first is None else (float(values[first - 1]), 0.0)


def all_blockers(
    body: SweptBody, motion: PoseFunction, reach: float, obstacles: Sequence[Obstacle], poses: int
) -> tuple[str, ...]:
    """Returns the ids of the obstacles that the body cuts into anywhere from 0 to `reach`, sorted."""
    return sweep(body, motion, reach, obstacles, poses).blockers


def is_free(body: SweptBody, motion: PoseFunction, reach: float, obstacles: Sequence[Obstacle], poses: int) -> bool:
    """Whether no pose from 0 to `reach` collides; stops at the first that does (far poses, then near ones)."""
    return not any(blockers_at(body, motion(v), obstacles) for v in opening_values(reach, poses)[::-1])


def widest_free(
    body: SweptBody, motion: PoseFunction, reach: float, obstacles: Sequence[Obstacle], poses: int, short: float = 0.0
) -> float:
    """Returns the widest opening in [0, reach] before the first collision, the last step refined by bisection.

    It stays `short` of the collision, a fraction of `reach`: at its limit a part touches nothing. A collision at rest
    does not count: it cannot be avoided by opening less.
    """
    free = _before_first(lambda value: bool(blockers_at(body, motion(value), obstacles)), reach, poses)
    return free if free == reach else max(free - short * reach, 0.0)


def _before_first(is_blocked: Callable[[float], bool], reach: float, poses: int) -> float:
    """Returns the widest opening before the first pose after rest that is blocked."""
    for before, after in pairwise(opening_values(reach, poses)):
        if not is_blocked(after):
            continue
        for _ in range(_HALVINGS):
            middle = (before + after) / 2
            if is_blocked(middle):
                after = middle
            else:
                before = middle
        return float(before)
    return float(reach)


def widest_above(mesh: TriangleMesh, axis: Axis, reach: float, floor: float, poses: int) -> float:
    """Returns the widest opening in [0, reach] before a mesh that turns about an axis dips below the height `floor`.

    What lies lower at rest may stay as low. The last step is refined by bisection, as in `widest_free`.
    """
    from_axis = mesh.vertices - axis.point
    along = float(axis.direction[2]) * (from_axis @ axis.direction)
    ahead = np.cross(axis.direction, from_axis)[:, 2]
    beside = from_axis[:, 2] - along
    allowed = min(floor, float(mesh.vertices[:, 2].min())) - float(axis.point[2])

    def dips(value: float) -> bool:
        return float((along + np.cos(value) * beside + np.sin(value) * ahead).min()) < allowed - _DIP

    return _before_first(dips, reach, poses)


def blockers_at(body: SweptBody, T: Mat4, obstacles: Sequence[Obstacle]) -> list[str]:
    """Returns the ids of what the body, posed at T, cuts into."""
    body.place(T)
    return [obstacles[k].id for k in body.penetrated([o.collider for o in obstacles])]
