"""Shapes that simulators collide with: boxes for boards, convex hulls for the rest, so that a drawer stays open on top.

Hinges and rails carry no shape: their knuckles and channels interlock, and only their joint may hold them. As bodies
they can be posed and asked whether they meet.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import final

import fcl
import numpy as np

from grafu.articulation.articulated_object import Link, Visual, VisualRole
from grafu.articulation.convex_pieces import (
    DEFAULT_PIECE_CONFIG,
    ConvexPieceConfig,
    convex_pieces,
    few_corners,
    hull_of,
)
from grafu.geometry.arrays import Mat3, Mat4, Points, Vec3
from grafu.geometry.box import Box, OrientedBox, yaw_of
from grafu.geometry.components import clustered
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.solids import ConvexSolid
from grafu.geometry.transform import rotation_matrix
from grafu.vocabulary import PartLabel

CollisionShape = OrientedBox | ConvexSolid
_DENSE = 500  # faces: fewer are not worth simplifying


@final
@dataclass(frozen=True, slots=True)
class CollisionShapeConfig:
    """How collision shapes are made; lengths in metres.

    Every side of a shape moves in by `margin`, so that parts that touch at rest do not push one another. No shape is
    thinner than `least_thickness`: thin hulls fall through in PhysX. A hull that fills its box to `box_ratio` becomes
    that box. What is finer than `resolution` is left out of dense meshes. Gaps in handles are kept down to a depth of
    `grip`, so that a finger fits. A link has at most `most_shapes`, a hull at most `most_corners` (PhysX allows 64).
    """

    margin: float = 0.0005
    least_thickness: float = 0.004
    box_ratio: float = 0.85
    grip: float = 0.008
    resolution: float = 0.001
    most_shapes: int = 48
    most_corners: int = 48
    pieces: ConvexPieceConfig = DEFAULT_PIECE_CONFIG


DEFAULT_COLLISION_CONFIG = CollisionShapeConfig()


def shapes_of(visual: Visual, config: CollisionShapeConfig = DEFAULT_COLLISION_CONFIG) -> list[CollisionShape]:
    """Returns the collision shapes of one part in the object frame at rest; none of hardware that carries none."""
    mesh = visual.mesh
    if not len(mesh.faces) or not _collides(visual):
        return []
    if len(mesh.faces) > _DENSE:
        mesh = clustered(mesh, config.resolution)
    R = _yaw_rotation(mesh.vertices)
    pieces = convex_pieces(TriangleMesh(mesh.vertices @ R, mesh.faces), _fineness(visual.label, config))
    made = (_shape_around(piece.vertices @ R.T, R, config) for piece in pieces)
    return [shape for shape in made if shape is not None]


def box_of(visual: Visual, config: CollisionShapeConfig = DEFAULT_COLLISION_CONFIG) -> list[CollisionShape]:
    """Returns one box around a part, turned about Z as it is: its shape where there is no time to look at it."""
    if not len(visual.mesh.faces) or not _collides(visual):
        return []
    box = OrientedBox.around(visual.mesh.vertices, _yaw_rotation(visual.mesh.vertices))
    return [OrientedBox(box.center, _smaller(box.half, config), box.rotation)]


def collision_shapes(
    link: Link,
    config: CollisionShapeConfig = DEFAULT_COLLISION_CONFIG,
    of_part: Callable[[Visual, CollisionShapeConfig], list[CollisionShape]] = shapes_of,
) -> tuple[CollisionShape, ...]:
    """Returns the collision shapes of a link in the object frame at rest, the largest first.

    `of_part` finds those of one part.
    """
    shapes = [shape for visual in link.visuals for shape in of_part(visual, config)]
    shapes.sort(key=lambda shape: -extent_of(shape))
    kept: list[CollisionShape] = []
    boxes: list[OrientedBox] = []
    for shape in shapes:
        if len(kept) < config.most_shapes and not _within_any(shape, boxes):
            kept.append(shape)
            boxes += [shape] if isinstance(shape, OrientedBox) else []
    return tuple(kept)


def corners_of(shape: CollisionShape) -> Points:
    """Returns the corners of a shape in the object frame."""
    return shape.corners() if isinstance(shape, OrientedBox) else shape.vertices


def extent_of(shape: CollisionShape) -> float:
    """Returns half the surface of the box around a shape, square metres: how much it can be touched."""
    a, b, c = np.ptp(corners_of(shape), axis=0) if isinstance(shape, ConvexSolid) else 2 * shape.half
    return float(a * b + b * c + c * a)


def _collides(visual: Visual) -> bool:
    return visual.role is not VisualRole.HARDWARE or visual.name.startswith("support_")


def _fineness(label: PartLabel, config: CollisionShapeConfig) -> ConvexPieceConfig:
    if label in (PartLabel.LEG, PartLabel.BAR):  # nothing reaches inside, and turned legs would fall into many slices
        return replace(config.pieces, cuts=False)
    tolerance = min(config.pieces.tolerance, config.grip) if label is PartLabel.HANDLE else config.pieces.tolerance
    return replace(config.pieces, tolerance=tolerance)


def _yaw_rotation(points: Points) -> Mat3:
    return rotation_matrix(np.array([0.0, 0.0, 1.0]), yaw_of(points))


def _shape_around(points: Points, R: Mat3, config: CollisionShapeConfig) -> CollisionShape | None:
    """Returns the box or hull around points; boxes are tried along `R` and along the points' own yaw."""
    hull = hull_of(points, config.least_thickness)
    if hull is None:
        return None
    volume = _volume(hull)
    for rotation in _rotations(R, points):
        box = OrientedBox.around(hull.vertices, rotation)
        if volume >= config.box_ratio * 8.0 * float(np.prod(box.half)):
            return OrientedBox(box.center, _smaller(box.half, config), rotation)
    return _smaller_hull(hull, R, config)


def _rotations(R: Mat3, points: Points) -> Iterator[Mat3]:
    yield R
    yield _yaw_rotation(points)


def _smaller(half: Vec3, config: CollisionShapeConfig) -> Vec3:
    """Returns half sizes less the margin, never below the least thickness."""
    return np.maximum(half - config.margin, config.least_thickness / 2)


def _smaller_hull(hull: ConvexSolid, R: Mat3, config: CollisionShapeConfig) -> ConvexSolid | None:
    local = few_corners(hull.vertices, config.most_corners) @ R
    box = Box.around(local)
    factor = np.minimum(1.0, _smaller(box.half, config) / np.maximum(box.half, 1e-9))
    return ConvexSolid.around(((local - box.center) * factor + box.center) @ R.T)


def _volume(hull: ConvexSolid) -> float:
    triangles = hull.vertices[hull.faces] - hull.vertices.mean(axis=0)
    return float(np.abs(np.linalg.det(triangles)).sum() / 6.0)


def _within_any(shape: CollisionShape, boxes: list[OrientedBox]) -> bool:
    """Whether a shape lies wholly inside one of the boxes."""
    if not boxes:
        return False
    centers, half = np.stack([box.center for box in boxes]), np.stack([box.half for box in boxes])
    local = (corners_of(shape) - centers[:, None]) @ np.stack([box.rotation for box in boxes])
    return bool(np.all(np.abs(local) <= half[:, None] + 1e-9, axis=(1, 2)).any())


@final
class ShapeBody:
    """One shape of one link, with its bounds at rest; its collision object is made when first needed. Not a value."""

    def __init__(self, link: str, shape: CollisionShape) -> None:
        self.link = link
        self.shape = shape
        self.corners: Points = corners_of(shape)
        self.bounds = np.stack([self.corners.min(axis=0), self.corners.max(axis=0)])

    @cached_property
    def _object(self) -> fcl.CollisionObject:
        return fcl.CollisionObject(_geometry(self.corners))

    def place(self, T: Mat4) -> None:
        """Poses the body at T for the queries that follow."""
        self._object.setTransform(fcl.Transform(T[:3, :3], T[:3, 3]))

    def bounds_at(self, Ts: np.ndarray) -> np.ndarray:
        """Returns the axis-aligned bounds in poses (n, 4, 4) as (n, 2, 3)."""
        corners = self.corners @ Ts[:, :3, :3].swapaxes(1, 2) + Ts[:, None, :3, 3]
        return np.stack([corners.min(axis=1), corners.max(axis=1)], axis=1)

    def meets(self, other: "ShapeBody") -> bool:
        """Whether the two, as posed, share a point."""
        return bool(fcl.collide(self._object, other._object, fcl.CollisionRequest(), fcl.CollisionResult()))


def _geometry(corners: Points) -> fcl.CollisionGeometry:
    solid = ConvexSolid.around(corners)
    assert solid is not None, "collision shapes have volume"
    faces = np.column_stack([np.full(len(solid.faces), 3), solid.faces]).ravel()
    return fcl.Convex(solid.vertices, len(solid.faces), faces)
