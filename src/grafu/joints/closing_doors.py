"""How far doors, flaps and lids stand open as they are drawn, found from the meshes, and about which axis they close.

A door stands open where it is turned against the furniture, or free of it, and fits where it is turned back to: the
way is free, and on most of its sides something stands beside it or lies behind its border. A door that fits as it is
drawn is closed, at whatever angle: fronts of corner cabinets. A flap or a lid, which turns about a level axis, closes
upright or level, and is seen from outside where it does.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from math import atan2, cos, pi, sin
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4, Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import heading_of, mesh_near
from grafu.geometry.raycast import RayCaster
from grafu.geometry.swept_body import SweptBody
from grafu.geometry.transform import transform_points
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import blockers_at, in_the_way, is_free, swept_box
from grafu.joints.plan import JointRequest
from grafu.joints.rail_config import ClosingConfig
from grafu.scene.border import BorderFrame, border_frame, part_axes, pitched_border_frame
from grafu.scene.obstacles import Obstacle
from grafu.scene.scene import Scene

_ALONG = np.linspace(0.15, 0.85, 5)


@final
@dataclass(frozen=True, slots=True)
class DrawnAngle:
    """How far a door stands open as it is drawn, radians, and the axis about which it closes."""

    angle: float
    axis: Axis


@final
@dataclass(frozen=True, eq=False)
class _Door:
    """A door as it is drawn."""

    request: JointRequest
    scene: Scene
    config: RealizationConfig
    frame: BorderFrame
    body: SweptBody

    @property
    def closing(self) -> ClosingConfig:
        return self.config.closing

    @property
    def is_upright(self) -> bool:
        """Whether it turns about an upright axis: a flap or a lid turns about a level one."""
        return abs(float(self.frame.rotation[2, 2])) >= self.config.level_axis

    @cached_property
    def around(self) -> RayCaster:
        """What stands around it: static parts, and other moving bodies as they are drawn."""
        scene, own = self.scene, self.request.moving
        meshes = [part.mesh for part in scene.static_parts]
        meshes += [scene.moving_mesh(name) for name in scene.moving_bodies if name != own]
        return RayCaster(mesh_near(meshes, scene.moving_mesh(own).box.grown(self.frame.width)))

    @cached_property
    def fronts(self) -> RayCaster:
        """The other moving bodies around it, as they are drawn."""
        scene, own = self.scene, self.request.moving
        meshes = [scene.moving_mesh(name) for name in scene.moving_bodies if name != own]
        return RayCaster(mesh_near(meshes, scene.moving_mesh(own).box.grown(self.frame.width)))

    def is_in_row(self) -> bool:
        """Whether another front continues it on the left or right, in one plane: doors that stand open do not."""
        frame, closing = self.frame, self.closing
        for across in (-1, 1):
            levels = []
            for offset in closing.offsets:
                origins = frame.to_object(_beside(frame, across, 0, offset) + np.array([0.0, frame.width, 0.0]))
                levels.append(frame.width - self.fronts.along(origins, frame.direction(0.0, -1.0, 0.0)))
            if np.median((np.abs(np.array(levels)) <= closing.plane).any(axis=0)) == 1.0:
                return True
        return False

    @cached_property
    def near(self) -> list[Obstacle]:
        """What stands where it may be turned to."""
        box = self.scene.moving_mesh(self.request.moving).box.grown(self.frame.width)
        return in_the_way(self.scene.static_obstacles, box)

    def sides(self, frame: BorderFrame) -> Sequence[bool]:
        """Whether something stands beside or lies behind a door: at its hinges, its free edge, below and above it."""
        return [self._is_held(frame, across, up) for across, up in ((-1, 0), (1, 0), (0, -1), (0, 1))]

    def _is_held(self, frame: BorderFrame, across: int, up: int) -> bool:
        """Whether on one side of a door what stands beside it is level with it, or something lies behind its border."""
        closing, start = self.closing, frame.width
        levels = []
        for offset in (*closing.offsets, *(-offset for offset in closing.offsets)):
            points = _beside(frame, across, up, offset)
            origins = frame.to_object(points + np.array([0.0, start, 0.0]))
            levels.append(start - self.around.along(origins, frame.direction(0.0, -1.0, 0.0)))
        beside, behind = np.split(np.array(levels), 2)
        back = -frame.thickness - closing.behind
        is_level = (beside >= back) & (beside <= closing.proud)
        lies_on = (behind >= back) & (behind <= -frame.thickness + closing.flush)
        return bool(np.median((is_level | lies_on).any(axis=0)) == 1.0) or self._closes_a_wall(frame, across, up)

    def _closes_a_wall(self, frame: BorderFrame, across: int, up: int) -> bool:
        """Whether a wall runs back from one side of a door: one without thickness ends at its border, not behind it."""
        closing = self.closing
        inside = max(closing.offsets)
        points = _beside(frame, across, up, -inside) - np.array([0.0, frame.thickness + closing.behind / 2, 0.0])
        away = self.around.along(frame.to_object(points), frame.direction(float(across), 0.0, float(up)))
        return bool(np.median(away <= inside + closing.flush) == 1.0)

    def is_seen(self, frame: BorderFrame) -> bool:
        """Whether nothing covers the outer side of a flap or a lid: one that is turned into its case lies in that."""
        x, z = (side.ravel() for side in np.meshgrid(_ALONG * frame.width, (_ALONG - 0.5) * frame.length))
        points = np.column_stack([x, np.full(len(x), self.closing.flush), z])
        return bool(self.around.is_clear(frame.to_object(points), frame.direction(0.0, 1.0, 0.0)).all())

    def is_free(self, angle: Axis, opening: float) -> bool:
        """Whether it can be turned back about an axis by an opening, radians."""

        def inwards(value: float) -> Mat4:
            return angle.rotation(-value)

        at_rest = blockers_at(self.body, inwards(0.0), self.near)
        obstacles = [o for o in self.near if o.id not in at_rest]
        near = in_the_way(obstacles, swept_box(self.scene.moving_mesh(self.request.moving).box, inwards, opening))
        return is_free(self.body, inwards, opening, near, self.config.coarse_poses)


def drawn_angles(requests: Iterable[JointRequest], scene: Scene, config: RealizationConfig) -> dict[str, DrawnAngle]:
    """Returns how far those doors stand open that do, by the id of the moving part.

    The config is in the scale of the scene (`at_scale`).
    """
    found = {}
    for request in requests:
        is_stated = request.drawn_at > 0 or request.coupling is not None or request.parent
        if is_stated or not request.kind.turns or request.moving not in scene.parts:
            continue
        door = _door(request, scene, config)
        if door.frame.width < config.closing.shallowest:
            continue
        angle = _drawn_angle(door)
        if angle is None and sum(door.sides(door.frame)) < config.closing.sides:
            angle = _drawn_angle(_door(replace(request, axis=request.axis.reversed()), scene, config))
        if angle is not None:
            found[request.moving] = angle
    return found


def _door(request: JointRequest, scene: Scene, config: RealizationConfig) -> _Door:
    mesh = scene.parts[request.moving].mesh
    is_upright = abs(float(request.axis.direction[2])) >= config.level_axis
    frame = (border_frame if is_upright else pitched_border_frame)(mesh, request.axis)
    axes = part_axes(mesh) if is_upright else frame.rotation
    return _Door(request, scene, config, frame, scene.swept_body(request.moving, config.closing.flush, axes))


def _drawn_angle(door: _Door) -> DrawnAngle | None:
    """Returns how far a door stands open, by the least turn that closes it; None where none does."""
    if sum(door.sides(door.frame)) >= door.closing.door_sides or door.is_in_row():
        return None
    fits: list[tuple[float, int, DrawnAngle]] = []
    for angle, axis in _ways_back(door):
        frame = _turned(door.frame, axis.rotation(-angle))
        sides = sum(door.sides(frame))
        fits_there = sides >= door.closing.door_sides and (door.is_upright or door.is_seen(frame))
        if fits_there and door.is_free(axis, angle):
            fits.append((round(angle, 3), -sides, DrawnAngle(angle, axis)))
    return min(fits, key=lambda fit: fit[:2])[2] if fits else None


def _ways_back(door: _Door) -> Iterator[tuple[float, Axis]]:
    """Yields the angles by which a door comes to stand along the furniture, about each border of its hinge side."""
    frame, config = door.frame, door.closing
    leaf, about = frame.direction(1.0, 0.0, 0.0), frame.rotation[:, 2]
    heading = heading_of(part.mesh for part in door.scene.static_parts) if door.is_upright else 0.0
    ahead = np.array([cos(heading), sin(heading), 0.0]) if door.is_upright else np.array([0.0, 0.0, 1.0])
    turned = atan2(float(leaf @ np.cross(about, ahead)), float(leaf @ ahead))
    for quarter in range(4):
        angle = (turned - quarter * pi / 2) % (2 * pi)
        if config.least_turn <= angle <= config.widest_turn:
            for y in (0.0, -frame.thickness):
                yield angle, frame.axis_at(0.0, y)


def _turned(frame: BorderFrame, T: Mat4) -> BorderFrame:
    origin: Vec3 = transform_points(T, frame.origin[None])[0]
    return replace(frame, origin=origin, rotation=T[:3, :3] @ frame.rotation)


def _beside(frame: BorderFrame, across: int, up: int, offset: float) -> np.ndarray:
    """Returns points in a row along one side of a door, so far outside it, in the frame of its border."""
    x = _ALONG * frame.width if not across else (frame.width + offset if across > 0 else -offset)
    z = (_ALONG - 0.5) * frame.length if not up else up * (frame.length / 2 + offset)
    return np.column_stack(np.broadcast_arrays(x, 0.0, z)).reshape(len(_ALONG), 3)
