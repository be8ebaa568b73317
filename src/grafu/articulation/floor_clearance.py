"""Collision shapes of moving links kept off the floor on which a piece stands, over their whole motion.

A door that is drawn down to the floor would carry the piece, and drag on it.
"""

from collections.abc import Mapping
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.articulation.collision_clearance import Shapes, halved
from grafu.articulation.collision_shapes import CollisionShape, corners_of
from grafu.articulation.kinematics import moved_poses
from grafu.articulation.sweep import rest_to_full
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4
from grafu.geometry.box import OrientedBox
from grafu.geometry.budget import require_time
from grafu.geometry.config_checks import require_positive
from grafu.geometry.solids import ConvexSolid
from grafu.vocabulary import PartLabel

_FRONTS = frozenset((PartLabel.DOOR, PartLabel.DRAWER))
_LEVEL = 1e-6  # of a unit vector: what rises by less neither rises nor falls
_NOTHING = 1e-9  # metres


@final
@dataclass(frozen=True, slots=True)
class FloorConfig:
    """How far moving shapes stand off the floor; lengths in metres.

    Raises:
        ValueError: if a number is not above 0.
    """

    gap: float = 0.003
    """Moving shapes keep this distance from the floor: floors are uneven, and solvers let feet sink in."""
    on_floor: float = 0.005
    """Static shapes that reach no higher than this above the lowest one carry the piece; else wheels do."""
    most: float = 0.03
    """Fronts that reach farther below all else hang in the air: the piece does not stand on a floor."""
    poses: int = 25
    """In how many poses a motion that rises or falls is looked at."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


DEFAULT_FLOOR_CONFIG = FloorConfig()


def off_floor(
    articulated: ArticulatedObject,
    shapes: Mapping[str, tuple[CollisionShape, ...]],
    config: FloorConfig = DEFAULT_FLOOR_CONFIG,
) -> Shapes:
    """Returns the shapes of each link, those of moving links cut where they come too near to the floor.

    The floor is as high as the lowest shape of what is neither a door nor a drawer, or as its lowest mesh, where shapes
    reach below that (a thin sheet's does). Where moving links alone stand on it, as on casters, these are left as they
    are. Shapes are in the object frame at rest.
    """
    floor = _floor(articulated, shapes, config)
    if floor is None:
        return dict(shapes)
    lowest = floor + config.gap
    feet = carrying_links(articulated, shapes, floor, config)
    found: Shapes = dict(shapes)
    for link, Ts in _poses(articulated, config).items():
        if link not in feet:
            cut = (_above(shape, Ts, lowest) for shape in shapes[link])
            found[link] = tuple(shape for shape in cut if shape is not None)
    return found


def lowest_of(*shapes: CollisionShape) -> float:
    """Returns the height of the lowest corner of shapes (metres); infinite where there is none."""
    return min((float(corners_of(shape)[:, 2].min()) for shape in shapes), default=np.inf)


def floor_below(shapes: Mapping[str, tuple[CollisionShape, ...]]) -> float:
    """Returns the height of the floor that a piece stands on as drawn: its lowest corner; infinite without shapes."""
    return min((lowest_of(*held) for held in shapes.values()), default=np.inf)


def _floor(
    articulated: ArticulatedObject, shapes: Mapping[str, tuple[CollisionShape, ...]], config: FloorConfig
) -> float | None:
    """Returns the height of the floor; None: nothing stands on one."""
    fronts = {link.id for link in articulated.links if any(visual.label in _FRONTS for visual in link.visuals)}
    others = floor_below({link: held for link, held in shapes.items() if link not in fronts})
    if not np.isfinite(others) or others - floor_below(shapes) > config.most:
        return None
    drawn = (link.mesh for link in articulated.links if link.id not in fronts)
    return max(others, min((float(mesh.box.low[2]) for mesh in drawn if len(mesh.vertices)), default=others))


def carrying_links(
    articulated: ArticulatedObject,
    shapes: Mapping[str, tuple[CollisionShape, ...]],
    floor: float,
    config: FloorConfig = DEFAULT_FLOOR_CONFIG,
) -> set[str]:
    """Returns the links that carry a piece: the root, or what moves and stands on the floor where it does not.

    `floor` is the height of the floor (metres); shapes are in the object frame at rest.
    """
    if lowest_of(*shapes[articulated.root]) <= floor + config.on_floor:
        return {articulated.root}
    return {link for link, held in shapes.items() if floor <= lowest_of(*held) <= floor + config.on_floor}


def _poses(articulated: ArticulatedObject, config: FloorConfig) -> dict[str, list[Mat4]]:
    """Returns the poses of all moving links in which they may be lower than elsewhere."""
    found: dict[str, list[Mat4]] = {joint.child: [np.eye(4)] for joint in articulated.joints}
    for joint in articulated.free_joints:
        led = [other for other in articulated.moving_joints if articulated.leader_of(other) is joint]
        if all(_keeps_height(other) for other in led):
            continue
        require_time()
        for values in rest_to_full(articulated, joint.id, config.poses):
            for link, T in moved_poses(articulated, values).items():
                if not np.allclose(T[2], np.eye(4)[2], atol=_NOTHING):
                    found[link].append(T)
    return found


def _keeps_height(joint: Joint) -> bool:
    upright = abs(float(joint.axis.direction[2]))
    return upright >= 1.0 - _LEVEL if joint.kind.turns else upright <= _LEVEL


def _above(shape: CollisionShape, Ts: list[Mat4], lowest: float) -> CollisionShape | None:
    """Returns the part of a shape that no pose brings below a height; None: nothing is left."""
    rest: CollisionShape | None = shape
    for T in Ts:
        if rest is None:
            return None
        normal, offset = -T[2, :3], float(T[2, 3]) - lowest
        if float((corners_of(rest) @ normal).max()) > offset + _NOTHING:
            rest = _kept(rest, normal, offset)
    return rest


def _kept(shape: CollisionShape, normal: np.ndarray, offset: float) -> CollisionShape | None:
    corners = corners_of(shape)
    if float((corners @ normal).min()) >= offset - _NOTHING:
        return None
    if isinstance(shape, OrientedBox):
        along = shape.rotation.T @ normal
        axis = int(np.argmax(np.abs(along)))
        if abs(along[axis]) >= 1.0 - _LEVEL:
            return halved(shape, normal, offset, axis)
        solid = ConvexSolid.around(corners)
        return None if solid is None else halved(solid, normal, offset, axis)
    return halved(shape, normal, offset, 0)
