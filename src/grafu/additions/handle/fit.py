"""Sets a handle on a front: its foot flush with the real surface, as rays find it.

A foot lies on wood or metal, never on a pane, and where the surface is bowed or slants it leans with it.

Whether a new handle stays clear of everything: along the path of its moving body, and while others move.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import final

import numpy as np

from grafu.additions.handle.config import HandleConfig
from grafu.additions.handle.relief import Relief
from grafu.additions.handle.spots import Spot
from grafu.articulation.kinematics import all_before
from grafu.dataclass import dataclass
from grafu.geometry.appearance import OPAQUE_ALPHA, Surface
from grafu.geometry.arrays import Mat4, Points
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.swept_body import SweptBody
from grafu.geometry.transform import from_rotation
from grafu.joints.limits import PoseFunction, in_the_way, opening_values, swept_box
from grafu.scene.obstacles import Obstacle, Obstacles
from grafu.scene.scene import Scene

SAME_SURFACE = 1e-4
"""Distance between two hits of rays on one surface, metres."""
MOST_FOOT_POINTS = 400
"""Points under a foot that are looked at."""


@final
@dataclass(frozen=True, eq=False)
class HandleObstacles:
    """All parts and hardware at rest, the still ones and those of each moving body."""

    scene: Scene
    still: Obstacles
    moving: Mapping[str, tuple[Obstacle, ...]]

    def with_handle(self, moving_id: str, handle: TriangleMesh) -> "HandleObstacles":
        """Returns the obstacles with a handle that was added to a moving body."""
        grown = (*self.moving[moving_id], Obstacle(moving_id, MeshCollider(handle)))
        return replace(self, moving={**self.moving, moving_id: grown})

    def blocker(self, moving_id: str, handle: TriangleMesh, config: HandleConfig) -> str:
        """Returns the id of something that a handle on a moving body hits, or that hits the handle; empty: nothing.

        At rest it is clear of everything; along its path, what opens before it (a door before a drawer) stands wide
        open.
        """
        body, poses = SweptBody(handle, config.touch * self.scene.metre), config.poses
        others = [other for other in self.moving if other != moving_id]
        at_rest = [*self.scene.hardware_obstacles(moving_id), *(o for other in others for o in self.moving[other])]
        found = _met(body, _closed, 0.0, self._near(handle.box, at_rest), 1)
        if found:
            return found
        motion, upper = self._motion_of(moving_id)
        opened = [other for other in others if other in self._before(moving_id)]
        closed = [o for other in others if other not in opened for o in self.moving[other]]
        fixed = self._near(swept_box(handle.box, motion, upper), closed)
        fixed += [obstacle for other in opened for obstacle in self._opened(other)]
        found = _met(body, motion, upper, fixed, poses)
        return found or next((o for o in others if self._runs_into(o, moving_id, body, handle, poses)), "")

    def _near(self, box: Box, others: Sequence[Obstacle]) -> list[Obstacle]:
        """Returns what is still and meets a box, then those of others that do."""
        return [*in_the_way(self.still, box), *in_the_way(others, box)]

    def _motion_of(self, moving_id: str) -> tuple[PoseFunction, float]:
        joint_motion = self.scene.joint_motions[moving_id]
        return joint_motion.kind.along(joint_motion.axis), joint_motion.upper

    def _before(self, moving_id: str) -> set[str]:
        """Returns the moving bodies that stand open before a moving body can move."""
        return all_before(
            moving_id, {name: joint_motion.after for name, joint_motion in self.scene.joint_motions.items()}
        )

    def _opened(self, moving_id: str) -> list[Obstacle]:
        motion, upper = self._motion_of(moving_id)
        return [Obstacle(o.id, o.collider.posed(motion(upper))) for o in self.moving[moving_id]]

    def _runs_into(self, other: str, moving_id: str, body: SweptBody, handle: TriangleMesh, poses: int) -> bool:
        """Whether a moving body runs into a handle at rest, or wide open where that moving body waits for the handle's.

        Seen from the moving body, the handle moves along the path in reverse.
        """
        motion, upper = self._motion_of(other)
        start = np.eye(4)
        if moving_id in self._before(other):
            opening, widest = self._motion_of(moving_id)
            start = opening(widest)

        def backwards(value: float) -> Mat4:
            return np.asarray(motion(-value) @ start)

        near = in_the_way(self.moving[other], swept_box(handle.box, backwards, upper))
        return bool(_met(body, backwards, upper, near, poses))


def _closed(_: float) -> Mat4:
    return np.eye(4)


def handle_obstacles(scene: Scene) -> HandleObstacles:
    """Returns the obstacles to all handles of a scene."""
    return HandleObstacles(
        scene, scene.still_obstacles, {name: scene.body_obstacles(name) for name in scene.moving_bodies}
    )


def _met(body: SweptBody, motion: PoseFunction, upper: float, near: Sequence[Obstacle], poses: int) -> str:
    """Returns the id of an obstacle that the body meets along its path; empty: none."""
    colliders = [obstacle.collider for obstacle in near]
    for value in opening_values(upper, poses)[::-1] if near else ():
        body.place(motion(float(value)))
        met = body.penetrated(colliders)
        if met:
            return near[met[0]].id
    return ""


@final
@dataclass(frozen=True, eq=False)
class HandleGround:
    """The relief of a front, and what of it can carry a handle."""

    relief: Relief
    solid: RayCaster

    def depths(self, points: Points) -> Points:
        """Returns points, (u, any, v), moved onto the front's first surface; NaN where that is a pane or nothing."""
        lead = points.copy()
        lead[:, 1] = -self.relief.config.foot_lead * self.relief.factor
        origins, inwards = self.relief.front.to_object(lead), self.relief.front.inwards
        seen, solid = self.relief.moving.along(origins, inwards), self.solid.along(origins, inwards)
        good = np.isfinite(seen) & (solid <= seen + SAME_SURFACE)
        found = lead.copy()
        found[:, 1] = np.where(good, lead[:, 1] + np.where(good, seen, 0.0), np.nan)
        return found


def ground_of(scene: Scene, moving_id: str, relief: Relief) -> HandleGround:
    """Returns the ground for handles on a moving body."""
    members = [scene.parts[m] for m in scene.moving_bodies[moving_id].members]
    solid = [s for p in members for s in p.surfaces if not _is_pane(s)]
    clear = any(_is_pane(s) for p in members for s in p.surfaces)
    return HandleGround(relief, RayCaster(merge_meshes([s.mesh for s in solid])) if clear else relief.moving)


def _is_pane(surface: Surface) -> bool:
    material = surface.material
    return material.base_color[3] < OPAQUE_ALPHA or material.alpha_mode == "BLEND"


@final
@dataclass(frozen=True, eq=False)
class HandleShape:
    """A handle at one size in its own frame, see `grafu.templates.template`.

    Its feet are what lies within `foot_depth` metres of the foot plane.
    """

    meshes: tuple[TriangleMesh, ...]
    foot_depth: float

    @cached_property
    def mesh(self) -> TriangleMesh:
        """All meshes as one."""
        return merge_meshes(self.meshes)

    @cached_property
    def foot(self) -> Points:
        """Points of the foot plane under the handle's feet."""
        points = self.mesh.vertices
        near = points[points[:, 1] > -self.foot_depth]
        near = near if len(near) else points[points[:, 1] >= points[:, 1].max() - 1e-9]
        return near[:: max(len(near) // MOST_FOOT_POINTS, 1)] * (1.0, 0.0, 1.0)


def fitted(
    ground: HandleGround, shape: HandleShape, spot: Spot, place: tuple[float, float], config: HandleConfig
) -> Mat4 | None:
    """Returns the pose, in the object frame, in which a handle sits flush at a place; None: there it cannot sit."""
    u, v = place
    feet = shape.foot @ spot.turn.T
    on = ground.depths(feet + np.array([u, 0.0, v]))
    if not np.isfinite(on).all():
        return None
    across = feet[:, [0, 2]]
    slope, level = _plane_through(across, on[:, 1])
    off = on[:, 1] - level - across @ slope
    if np.ptp(off) > config.uneven * max(ground.relief.factor, 1e-9) or float(np.linalg.norm(slope)) > config.steepest:
        return None
    lean = _leaning(slope)
    T = from_rotation(lean @ spot.turn, np.array([u, level + float(off.min()), v]))
    front = ground.relief.front
    return from_rotation(front.rotation, front.origin) @ T


def _plane_through(across: np.ndarray, depth: np.ndarray) -> tuple[np.ndarray, float]:
    """Returns the slopes along u and v, and the depth in the middle, of the plane nearest to some depths."""
    if np.ptp(depth) < 1e-6:
        return np.zeros(2), float(depth.mean())
    rows = np.column_stack([across, np.ones(len(across))])
    found = np.linalg.lstsq(rows, depth, rcond=1e-6)[0]
    return found[:2], float(found[2])


def _leaning(slope: np.ndarray) -> np.ndarray:
    """Returns the rotation of (u, b, v) that lays a level foot on a surface with these slopes."""
    if not slope.any():
        return np.eye(3)
    x = np.array([1.0, slope[0], 0.0])
    x /= np.linalg.norm(x)
    y = np.array([-slope[0], 1.0, -slope[1]])
    y /= np.linalg.norm(y)
    return np.column_stack([x, y, np.cross(x, y)])
