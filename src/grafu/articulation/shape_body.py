"""Collision shapes as bodies that can be posed and asked whether they meet. It knows no joints and no file format."""

from functools import cached_property
from typing import final

import fcl
import numpy as np

from grafu.articulation.collision_shapes import CollisionShape, corners_of
from grafu.geometry.arrays import Mat4, Points
from grafu.geometry.solids import ConvexSolid


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
