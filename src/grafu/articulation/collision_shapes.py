"""Shapes that simulators collide with: boxes for boards, convex hulls for the rest, so that a drawer stays open on top.

Hinges and rails carry no shape: their knuckles and channels interlock, and only their joint may hold them. As bodies
they can be posed and asked whether they meet.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from typing import final

import fcl
import numpy as np

from grafu.articulation.articulated_object import Link, Visual, VisualRole
from grafu.articulation.convex_pieces import (
    DEFAULT_PIECE_CONFIG,
    ConvexPieceConfig,
    convex_pieces,
    hull_of,
)
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3, Mat4, Points, Vec3
from grafu.geometry.box import Box, OrientedBox, yaw_of
from grafu.geometry.components import clustered
from grafu.geometry.config_checks import require_positive
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.simplify import simplified
from grafu.geometry.solids import ConvexSolid, few_corners
from grafu.geometry.transform import rotation_matrix
from grafu.vocabulary import PartLabel

CollisionShape = OrientedBox | ConvexSolid
_DENSE = 500  # faces: fewer are not worth simplifying


@final
@dataclass(frozen=True, slots=True)
class CollisionShapeConfig:
    """How collision shapes are made; lengths in metres.

    Raises:
        ValueError: if a number is not above 0.
    """

    margin: float = 0.0005
    """Every side of a shape moves in by this, so that parts that touch at rest do not push one another."""
    least_thickness: float = 0.004
    """No shape is thinner: thin hulls fall through in PhysX."""
    box_ratio: float = 0.85
    """A hull that fills its box to this part becomes that box."""
    grip: float = 0.008
    """Gaps in handles are kept down to this depth, so that a finger fits."""
    resolution: float = 0.001
    """What is finer is left out of dense meshes."""
    many_faces: int = 5_000
    """A watertight mesh of more faces than this, of a scan or a generated surface, is simplified ..."""
    coarse: float = 0.002
    """... by leaving out what is finer than this, about as much as such surfaces are uneven (metres)."""
    within: float = 0.003
    """A shape that sticks out of another by no more adds nothing; hardware as near as this is carried."""
    on_floor: float = 0.005
    """What reaches below this height stands on the floor."""
    most_shapes: int = 64
    """Most shapes of a link: simulators slow down with them."""
    noticed: float = 0.05
    """Shapes that are left out are reported where one has a diagonal longer than this: a hand or a foot."""
    most_corners: int = 48
    """Most corners of a hull: PhysX allows 64."""
    cuts_of_bars: int = 8
    """Most cuts of a handle, a leg or a bar: frames come apart, turned ones are not sliced."""
    pieces: ConvexPieceConfig = DEFAULT_PIECE_CONFIG
    """How finely a mesh is taken apart."""

    def __post_init__(self) -> None:
        require_positive(self, *(set(self.__dataclass_fields__) - {"pieces"}))


DEFAULT_COLLISION_CONFIG = CollisionShapeConfig()


def shapes_of(visual: Visual, config: CollisionShapeConfig = DEFAULT_COLLISION_CONFIG) -> list[CollisionShape]:
    """Returns the collision shapes of one part in the object frame at rest; none of hardware that carries none."""
    mesh = visual.mesh
    if not len(mesh.faces) or not _collides(visual):
        return []
    if len(mesh.faces) > config.many_faces:
        mesh = simplified(mesh, config.coarse)
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
    """Returns the collision shapes of a link in the object frame at rest, the largest first (see `chosen_shapes`)."""
    return chosen_shapes(link, config, of_part)[0]


def chosen_shapes(
    link: Link,
    config: CollisionShapeConfig = DEFAULT_COLLISION_CONFIG,
    of_part: Callable[[Visual, CollisionShapeConfig], list[CollisionShape]] = shapes_of,
) -> tuple[tuple[CollisionShape, ...], tuple[CollisionShape, ...]]:
    """Returns the collision shapes of a link in the object frame at rest, and those left out because they are too many.

    `of_part` finds those of one part. What stands on the floor or carries a joint is the last to be left out, then the
    largest; both come with the largest first.
    """
    shapes = [shape for visual in link.visuals for shape in of_part(visual, config)]
    shapes.sort(key=lambda shape: -extent_of(shape))
    return as_many_as_allowed(_distinct(shapes, config.within), link, config)


def as_many_as_allowed(
    shapes: Sequence[CollisionShape], link: Link, config: CollisionShapeConfig = DEFAULT_COLLISION_CONFIG
) -> tuple[tuple[CollisionShape, ...], tuple[CollisionShape, ...]]:
    """Returns the shapes of a link that are kept, at most `most_shapes`, and those left out, each in their order.

    What stands on the floor or carries a joint is the last to be left out, then the largest.
    """
    if len(shapes) <= config.most_shapes:
        return tuple(shapes), ()
    order = sorted(range(len(shapes)), key=lambda k: (not _carries(shapes[k], link, config), -extent_of(shapes[k])))
    first = set(order[: config.most_shapes])
    kept = tuple(shape for k, shape in enumerate(shapes) if k in first)
    return kept, tuple(shape for k, shape in enumerate(shapes) if k not in first)


def _distinct(shapes: Sequence[CollisionShape], tolerance: float) -> list[CollisionShape]:
    """Returns the shapes that lie in none before them.

    Of the boxes before it, a shape is compared with those alone whose bounds, grown by twice the tolerance, hold its
    bounds: a turned box that grows by the tolerance grows by less along any axis. A hull may grow by more at a corner.
    """
    corners = [corners_of(shape) for shape in shapes]
    low = np.array([points.min(axis=0) for points in corners]).reshape(-1, 3)
    high = np.array([points.max(axis=0) for points in corners]).reshape(-1, 3)
    is_box = np.array([isinstance(shape, OrientedBox) for shape in shapes], dtype=bool)
    found: list[int] = []
    for k, shape in enumerate(shapes):
        before = np.array(found, dtype=np.int64)
        holds = (low[before] - 2 * tolerance <= low[k]).all(axis=1)
        holds &= (high[before] + 2 * tolerance >= high[k]).all(axis=1)
        near = before[holds | ~is_box[before]]
        if not any(_lies_within(shape, shapes[other], tolerance) for other in near.tolist()):
            found.append(k)
    return [shapes[k] for k in found]


def _carries(shape: CollisionShape, link: Link, config: CollisionShapeConfig) -> bool:
    """Whether a shape stands on the floor, or touches a hinge or rail of its link."""
    corners = corners_of(shape)
    if corners[:, 2].min() <= config.on_floor:
        return True
    box = Box.around(corners)
    mounts = [v.mesh.box for v in link.visuals if v.role is VisualRole.HARDWARE and len(v.mesh.faces)]
    return any(
        bool(np.all(box.low <= mount.high + config.within) and np.all(mount.low <= box.high + config.within))
        for mount in mounts
    )


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
    if label in (PartLabel.LEG, PartLabel.BAR):
        return replace(config.pieces, most_cuts=config.cuts_of_bars)
    if label is PartLabel.HANDLE:
        tolerance = min(config.pieces.tolerance, config.grip)
        return replace(config.pieces, tolerance=tolerance, most_cuts=config.cuts_of_bars)
    return config.pieces


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


def _lies_within(shape: CollisionShape, other: CollisionShape, tolerance: float) -> bool:
    """Whether no corner of a shape lies outside another by more than `tolerance` (metres)."""
    points = corners_of(shape)
    if isinstance(other, OrientedBox):
        return bool(np.all(np.abs((points - other.center) @ other.rotation) <= other.half + tolerance))
    return bool(np.all(points @ other.planes[:, :3].T <= other.planes[:, 3] + tolerance))


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
