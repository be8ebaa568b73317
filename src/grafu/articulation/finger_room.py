"""Collision shapes that leave a gripper's fingers room wherever the surfaces as drawn do.

Hulls and boxes stand for what is drawn, and may fill the space behind a bar. What of a shape lies where a fingertip
goes (see `GraspFrame.fingers`) is cut out of it.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import final

import numpy as np

from grafu.articulation.collision_clearance import Shapes, halved
from grafu.articulation.collision_shapes import CollisionShape, ShapeBody, corners_of
from grafu.articulation.grasp_frame import GraspFrame
from grafu.dataclass import dataclass
from grafu.geometry.box import OrientedBox
from grafu.geometry.budget import require_time
from grafu.geometry.config_checks import require_positive
from grafu.geometry.solids import ConvexSolid


@final
@dataclass(frozen=True, slots=True)
class FingerRoomCutConfig:
    """How shapes are cut for fingers; lengths in metres.

    Raises:
        ValueError: if a number is not above 0.
    """

    margin: float = 0.0005
    """What a cut leaves between a fingertip and a shape."""
    least_thickness: float = 0.002
    """Pieces that are thinner are left out."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


DEFAULT_ROOM_CONFIG = FingerRoomCutConfig()


def with_finger_room(
    shapes: Mapping[str, tuple[CollisionShape, ...]],
    grasps: Sequence[GraspFrame],
    config: FingerRoomCutConfig = DEFAULT_ROOM_CONFIG,
) -> Shapes:
    """Returns the shapes of each link without what lies where a fingertip goes, at rest."""
    bodies = [ShapeBody(link, shape) for link, held in shapes.items() for shape in held]
    for grasp in grasps:
        for finger in grasp.fingers:
            require_time()
            bodies = _all_cut(bodies, finger, config)
    return {link: tuple(body.shape for body in bodies if body.link == link) for link in shapes}


def _all_cut(bodies: list[ShapeBody], finger: OrientedBox, config: FingerRoomCutConfig) -> list[ShapeBody]:
    """Returns the bodies without what lies where a finger goes, in their order; the same list where none is in the way.

    The bounds of all are compared at once: a piece has hundreds of shapes, and few are near a finger.
    """
    if not bodies:
        return bodies
    room = OrientedBox(finger.center, finger.half + config.margin, finger.rotation)
    body = ShapeBody("", room)
    bounds = np.stack([one.bounds for one in bodies])
    near = np.all((bounds[:, 0] <= body.bounds[1]) & (bounds[:, 1] >= body.bounds[0]), axis=1)
    met = {k for k in np.flatnonzero(near).tolist() if bodies[k].meets(body)}
    if not met:
        return bodies
    found: list[ShapeBody] = []
    for k, one in enumerate(bodies):
        found += [ShapeBody(one.link, left) for left in _outside(one.shape, room, config)] if k in met else [one]
    return found


def _outside(shape: CollisionShape, room: OrientedBox, config: FingerRoomCutConfig) -> Iterator[CollisionShape]:
    """Yields convex pieces of a shape that fill it but for a box: what lies beyond each face of the box, in turn."""
    rest: CollisionShape | None = shape if isinstance(shape, ConvexSolid) else ConvexSolid.around(shape.corners())
    for axis, sign in ((1, 1.0), (1, -1.0), (2, 1.0), (2, -1.0), (0, 1.0), (0, -1.0)):
        if rest is None:
            return
        normal = sign * room.rotation[:, axis]
        offset = float(normal @ room.center) + float(room.half[axis])
        heights = corners_of(rest) @ normal - offset
        if heights.max() > 0:
            beyond = halved(rest, -normal, -offset, axis) if heights.min() < 0 else rest
            if beyond is not None and _thickness(beyond, room) >= config.least_thickness:
                yield beyond
        rest = (halved(rest, normal, offset, axis) if heights.max() > 0 else rest) if heights.min() < 0 else None


def _thickness(shape: CollisionShape, room: OrientedBox) -> float:
    return float(np.ptp(corners_of(shape) @ room.rotation, axis=0).min())
