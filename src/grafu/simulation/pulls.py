"""One joint pulled open and pushed shut by a hand at its grip, and a cube dropped into a drawer."""

from dataclasses import field
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.simulation.config import CheckConfig
from grafu.simulation.record import JointCheck
from grafu.simulation.world import SimJoint, World

_HANDLE = "handle"  # with this the names of handles begin
_EDGE = 0.02  # of the greatest distance from the axis: what is as far belongs to the free edge
_CONTROL = 0.01  # seconds between two looks at the speed
_FULL = 0.9  # of the hand's speed: below it all the force is used
_SLOT = 0.2  # seconds between two poses for the clip
_ABOVE = 0.01  # metres above a drawer from where rays look into it


@final
@dataclass(slots=True)
class Recording:
    """The poses of all bodies that a clip shows, in order; it grows."""

    poses: list[dict[str, np.ndarray]] = field(default_factory=list)

    def take(self, world: World) -> None:
        """Adds where all bodies are now."""
        bodies = range(1, world.model.nbody)
        self.poses.append({world.model.body(k).name: world.pose(k) for k in bodies})


def grip_of(world: World, joint: SimJoint, meshes: dict[str, TriangleMesh]) -> Vec3:
    """Returns where a hand pulls a joint, in its body's frame: the middle of its handles, else of its free edge."""
    handles = [mesh.vertices for name, mesh in meshes.items() if name.startswith(_HANDLE)]
    vertices = np.vstack(handles or [mesh.vertices for mesh in meshes.values()] or [np.zeros((1, 3))])
    if not handles:
        axis, anchor = world.model.jnt_axis[joint.index], world.model.jnt_pos[joint.index]
        reach = vertices - anchor
        far = reach @ axis if joint.slides else np.linalg.norm(np.cross(reach, axis), axis=1)
        vertices = vertices[far >= far.max() - _EDGE * max(float(np.ptp(far)), 1e-9)]
    return np.asarray((vertices.min(axis=0) + vertices.max(axis=0)) / 2)


def check_joint(
    world: World,
    joint: SimJoint,
    before: tuple[SimJoint, ...],
    meshes: dict[str, TriangleMesh],
    config: CheckConfig,
    recording: Recording,
) -> JointCheck:
    """Returns what a joint does when it is pulled and pushed, joints `before` it open. The world is reset first."""
    _made_ready(world, before)
    grip, force = grip_of(world, joint, meshes), config.sliding_pull if joint.slides else config.turning_pull
    free = [o for o in world.joints if o is not joint and o not in before and o.index not in world.coupled(joint)]
    start = {other: world.value(other) for other in free}
    opened, moved = _pulled(world, joint, grip, force, start, config, recording)
    closed, also = _pulled(world, joint, grip, -force, start, config, recording)
    carries = _carries(world, joint, before, meshes, grip, config) if joint.slides else None
    alone = tuple(sorted(moved | also))
    works = opened >= config.opened and closed < config.closed and not alone and carries is not False
    return JointCheck(
        joint=joint.name,
        force=force,
        opened=round(opened, 4),
        closed=round(closed, 4),
        moved=alone,
        carries=carries,
        works=works and world.is_stable,
    )


def _made_ready(world: World, before: tuple[SimJoint, ...]) -> None:
    world.reset()
    for other in before:
        world.set_open(other)


def _pulled(
    world: World,
    joint: SimJoint,
    grip: Vec3,
    force: float,
    others: dict[SimJoint, float],
    config: CheckConfig,
    recording: Recording,
) -> tuple[float, set[str]]:
    """Returns where a joint is after a pull with at most `force` (N; negative closes), and the others that moved."""
    moved: set[str] = set()
    sense = 1.0 if force > 0 else -1.0
    best, start, shown = world.value(joint), float(world.data.time), 0.0
    while (elapsed := float(world.data.time) - start) < config.longest_pull:
        if elapsed >= shown:
            recording.take(world)
            shown += _SLOT
        speed = sense * world.push(joint, grip, 0.0) / config.hand_speed
        world.push(joint, grip, force * float(np.clip((1.0 - speed) / (1.0 - _FULL), 0.0, 1.0)))
        world.step(_CONTROL)
        value = world.value(joint)
        best = max(best, value) if force > 0 else min(best, value)
        moved |= {other.name for other, at in others.items() if abs(world.value(other) - at) >= config.closed}
        if (force > 0 and value >= 1.0 - config.closed / 2) or (force < 0 and value <= config.closed / 2):
            break
    world.let_go()
    return best, moved


def _carries(
    world: World,
    joint: SimJoint,
    before: tuple[SimJoint, ...],
    meshes: dict[str, TriangleMesh],
    grip: Vec3,
    config: CheckConfig,
) -> bool | None:
    """Returns whether a cube dropped into an open drawer rests there and is carried shut; None: it is not hollow."""
    axis = world.model.jnt_axis[joint.index]
    place = hollow_place([mesh for name, mesh in meshes.items() if not name.startswith(_HANDLE)], axis, config)
    if place is None:
        return None
    _made_ready(world, before)
    world.set_open(joint)
    let_go = place + np.array([0.0, 0.0, config.cube / 2 + config.drop_height])
    T = world.pose(joint.body)
    world.place_cube(T[:3, :3] @ let_go + T[:3, 3])
    world.step(config.falling)
    rests = _is_in(world, joint, place, config)
    _pulled(world, joint, grip, -(config.sliding_pull), {}, config, Recording())
    return rests and _is_in(world, joint, place, config) and world.value(joint) < config.closed


def _is_in(world: World, joint: SimJoint, place: Vec3, config: CheckConfig) -> bool:
    """Whether the cube lies near where it was dropped, on the floor of the drawer."""
    T = world.pose(joint.body)
    off = T[:3, :3].T @ (world.cube - T[:3, 3]) - place
    near = float(np.linalg.norm(off[:2])) < 2.0 * config.cube
    return near and -config.cube / 2 < float(off[2]) < 1.5 * config.cube


def hollow_place(meshes: list[TriangleMesh], axis: Vec3, config: CheckConfig) -> Vec3 | None:
    """Returns a point on the floor of a drawer with room around it, in the drawer's frame; None: it is not hollow.

    Of several the foremost along the axis is taken, so that it is out of the case when the drawer is open.
    """
    if not meshes or abs(float(axis[2])) > 0.5:
        return None
    mesh = merge_meshes(meshes)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    xs, ys = (np.linspace(low[k], high[k], config.rays) for k in (0, 1))
    grid = np.stack(np.meshgrid(xs, ys, indexing="ij"), axis=-1).reshape(-1, 2)
    origins = np.column_stack([grid, np.full(len(grid), high[2] + _ABOVE)])
    found = RayCaster(mesh).along(origins, np.array([0.0, 0.0, -1.0]))
    depth = np.where(np.isfinite(found), found - _ABOVE, 0.0)
    near = np.abs(grid[:, None] - grid[None]).max(axis=2) <= config.beside
    inside = np.all((grid - config.beside >= low[:2]) & (grid + config.beside <= high[:2]), axis=1)
    deep = np.where(near, depth[None], np.inf).min(axis=1)
    level = np.where(near, depth[None], -np.inf).max(axis=1) - deep <= config.room / 2
    places = np.flatnonzero(inside & (deep >= config.room) & level)
    if not len(places):
        return None
    ahead = grid @ axis[:2]
    aside = np.abs((grid - (low + high)[:2] / 2) @ np.array([-axis[1], axis[0]]))
    best = places[int(np.argmax((ahead - 0.5 * aside)[places]))]
    return np.array([*grid[best], high[2] - depth[best]])
