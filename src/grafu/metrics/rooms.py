"""Whether an articulated object holds empty rooms that shelves or dividers could furnish, measured by rays.

It shares nothing with what finds compartments: points in a grid look along the axes at what is at rest. A room has
walls on both sides, a floor, a ceiling and a back that stand still; in front of it is nothing, or a door. Its middle, a
cube, must be empty, and half of all faces but the front be covered. What a drawer takes of a room, with all that lies
behind it, is no room.
"""

from typing import Any

import numpy as np
import trimesh

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.geometry.arrays import Points
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.metrics.bodies import largest_side
from grafu.vocabulary import JointType

_MANAGER: Any = trimesh.collision.CollisionManager  # untyped
_STEPS = 30  # points along the object's longest side
LEAST = 0.25  # metres, each way: smaller rooms are pigeonholes
LEAST_SHARE = 0.2  # of the largest side: no room needs to be larger in a model of another scale
_MOST_TRIED = 40  # candidates that are looked at one by one
_ACROSS, _COVERED = 7, 0.5  # rays along each side of a face, and the share of them that meets a wall there
_LEAF = 0.15  # of the next longer side: thinner sliders are doors


def empty_rooms(articulated: ArticulatedObject) -> list[Box]:
    """Returns rooms that nothing furnishes, as boxes in metres (object frame), the largest first; none overlap."""
    unit = largest_side(articulated)
    still = articulated.link(articulated.root).mesh
    moving = [articulated.link(joint.child).mesh for joint in articulated.joints]
    if unit <= 0 or not len(still.faces):
        return []
    least = min(LEAST, LEAST_SHARE * unit)
    whole = merge_meshes([still, *moving])
    points = _points(whole.box, unit / _STEPS)
    points = points[~_taken(points, articulated)]
    rooms = _seen_from(points, RayCaster(still), RayCaster(merge_meshes(moving)), whole.box, least)
    manager, everything = _MANAGER(), RayCaster(whole)
    manager.add_object("", whole.to_trimesh())
    found: list[Box] = []
    for room in sorted(rooms, key=lambda box: -float(box.size.prod()))[:_MOST_TRIED]:
        if any(room.overlaps(other) for other in found) or _taken(room.center[None], articulated).any():
            continue
        half = np.full(3, 0.45 * least)
        cube = TriangleMesh.box_mesh(Box.from_center(room.center, half)).to_trimesh()
        if not manager.in_collision_single(cube) and _is_enclosed(room, everything):
            found.append(room)
    return found


def _is_enclosed(room: Box, everything: RayCaster) -> bool:
    """Whether surfaces cover at least half of five faces of a room: posts and rails are no walls."""
    steps = np.linspace(-0.8, 0.8, _ACROSS)
    covered = []
    for axis in range(3):
        shares = np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1).reshape(-1, 2)
        origins = np.tile(room.center, (len(shares), 1))
        origins[:, [k for k in range(3) if k != axis]] += shares * np.delete(room.half, axis)
        for sign in (-1.0, 1.0):
            found = everything.along(origins, sign * np.eye(3)[axis])
            covered.append(float((found <= 1.1 * room.half[axis]).mean()))
    return sum(share >= _COVERED for share in covered) >= len(covered) - 1


def _points(box: Box, step: float) -> Points:
    axes = [np.arange(box.low[k] + step / 2, box.high[k], step) for k in range(3)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def _taken(points: Points, articulated: ArticulatedObject) -> np.ndarray:
    zones = [_taken_by(points, joint, articulated.link(joint.child).mesh) for joint in articulated.joints]
    return np.any(zones, axis=0) if zones else np.zeros(len(points), dtype=bool)


def _taken_by(points: Points, joint: Joint, mesh: TriangleMesh) -> np.ndarray:
    """Returns which points lie in a drawer or anywhere before or behind it; none for doors, sliding ones too."""
    if joint.type is not JointType.PRISMATIC or not len(mesh.faces):
        return np.zeros(len(points), dtype=bool)
    axis = int(np.abs(joint.axis.direction).argmax())
    size = mesh.box.size
    across = [k for k in range(3) if k != axis]
    is_leaf = min(size[across]) < _LEAF * np.sort(size)[1] and int(np.argmin(size)) in across
    if is_leaf:
        return np.zeros(len(points), dtype=bool)
    inside = (points[:, across] >= mesh.box.low[across]) & (points[:, across] <= mesh.box.high[across])
    return np.asarray(inside.all(axis=1))


def _seen_from(points: Points, still: RayCaster, moving: RayCaster, box: Box, least: float) -> list[Box]:
    """Returns the boxes that points see around them, those that are rooms."""
    directions = [sign * np.eye(3)[axis] for axis in range(3) for sign in (-1.0, 1.0)]
    at_still = np.stack([still.along(points, d) for d in directions], axis=1)
    at_moving = np.stack([moving.along(points, d) for d in directions], axis=1)
    nearest = np.minimum(at_still, at_moving)
    walled = np.isfinite(at_still) & (at_still <= at_moving)
    doored = np.isfinite(at_moving) & (at_moving < at_still)
    fronted = ~walled
    level = walled[:, 4] & walled[:, 5]
    opens = [
        walled[:, 0] & walled[:, 1] & level & ((walled[:, 3] & fronted[:, 2]) | (walled[:, 2] & fronted[:, 3])),
        walled[:, 2] & walled[:, 3] & level & ((walled[:, 1] & doored[:, 0]) | (walled[:, 0] & doored[:, 1])),
    ]
    kept = opens[0] | opens[1]
    ends = np.stack([points - box.low, box.high - points], axis=2).reshape(len(points), 6)
    reach = np.minimum(nearest, ends)[kept]
    low, high = points[kept] - reach[:, 0::2], points[kept] + reach[:, 1::2]
    large = (high - low >= least).all(axis=1)
    unique = np.unique(np.round(np.hstack([low[large], high[large]]) / least, 2) * least, axis=0)
    return [Box(row[:3], row[3:]) for row in unique]
