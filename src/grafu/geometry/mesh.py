"""Triangle meshes as values, and how they stand turned about Z; no materials.

Heavy queries live in `raycast`, `intersection` and `solids`.
"""

from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import (
    ArrayValue,
    Faces,
    Mat3,
    Mat4,
    Points,
    Scalars,
    Vec3,
    cross,
    frozen_array,
    renumbered,
    row_keys,
)
from grafu.geometry.box import Box, yaw_of
from grafu.geometry.transform import is_mirror, transform_points

if TYPE_CHECKING:
    import trimesh

_UPRIGHT = 0.1  # most of a unit normal that may point up or down in an upright face
_BINS = 90  # of one degree each
_SCATTER = np.radians(6.0)  # how far normals of a scanned or generated wall lie off its direction, most of them
_AS_WELL = 0.6  # of the largest area must lie along the axes for those to serve: a room's corner has two such pairs
_PLACES = 1e8  # of one metre: vertices that round to the same of them are one
_CACHED_FACES = 20_000  # meshes of up to so many faces cache what is computed from the faces


@final
@dataclass(frozen=True, eq=False)
class TriangleMesh(ArrayValue):
    """Vertices in metres and triangles as counter-clockwise index triples.

    It need not be closed, connected or consistently oriented: real furniture is not.

    Raises:
        ValueError: if a vertex is not finite or a face names a vertex that is not there.
    """

    vertices: Points
    faces: Faces

    def __post_init__(self) -> None:
        vertices, faces = frozen_array(self.vertices), frozen_array(self.faces, np.int64)
        if not np.isfinite(vertices).all():
            raise ValueError("`TriangleMesh.vertices` must be finite numbers: got NaN or infinity")
        if len(faces) and (faces.min() < 0 or faces.max() >= len(vertices)):
            found = f"{faces.min()}..{faces.max()}"
            raise ValueError(f"`TriangleMesh.faces` must index {len(vertices)} vertices: got {found}")
        object.__setattr__(self, "vertices", vertices)
        object.__setattr__(self, "faces", faces)

    @cached_property
    def box(self) -> Box:
        """The axis-aligned box around the vertices that a face uses (all vertices, where there is no face)."""
        if not len(self.faces):
            return Box.around(self.vertices)
        used = np.zeros(len(self.vertices), dtype=bool)
        used[self.faces] = True
        return Box.around(self.vertices[used])

    @cached_property
    def yaw(self) -> float:
        """The rotation about Z, radians, in which the vertices fill the smallest rectangle (see `yaw_of`)."""
        return yaw_of(self.vertices)

    @property
    def triangles(self) -> np.ndarray:
        """The corners of each face, (faces, 3, 3); not cached for large meshes, they take more than the mesh."""
        return self._triangles if len(self.faces) <= _CACHED_FACES else self._gathered

    @cached_property
    def _triangles(self) -> np.ndarray:
        return self._gathered

    @property
    def _gathered(self) -> np.ndarray:
        corners = self.vertices[self.faces]
        corners.setflags(write=False)
        return corners

    @cached_property
    def area(self) -> float:
        """The surface area, square metres."""
        return float(self.face_areas.sum())

    @property
    def _face_cross(self) -> np.ndarray:
        return self._cached_cross if len(self.faces) <= _CACHED_FACES else _cross(self.triangles)

    @cached_property
    def _cached_cross(self) -> np.ndarray:
        return _cross(self.triangles)

    @property
    def face_areas(self) -> Scalars:
        """The area of each face."""
        return np.linalg.norm(self._face_cross, axis=1) / 2

    @property
    def face_normals(self) -> Points:
        """The unit normal of each face; zero where the face has no area."""
        return self._cached_normals if len(self.faces) <= _CACHED_FACES else _unit(self._face_cross)

    @cached_property
    def _cached_normals(self) -> Points:
        return _unit(self._face_cross)

    @cached_property
    def is_watertight(self) -> bool:
        """Whether every edge, vertices merged by position, is shared by two oppositely directed faces."""
        if not len(self.faces):
            return False
        place = np.unique(row_keys(np.round(self.vertices * _PLACES).astype(np.int64)), return_inverse=True)[1]
        start = place.reshape(-1)[self.faces]
        end = np.roll(start, -1, axis=1).ravel()
        return _meet_in_pairs(start.ravel(), end)

    def transformed(self, T: Mat4) -> "TriangleMesh":
        """Returns the mesh mapped by T; a mirror image keeps its faces' outward sides outward."""
        vertices = transform_points(T, self.vertices)
        if is_mirror(T):
            return TriangleMesh(vertices, self.faces[:, ::-1])
        return self._with_vertices(vertices)

    def translated(self, offset: Vec3) -> "TriangleMesh":
        """Returns the mesh shifted by `offset`."""
        return self._with_vertices(self.vertices + offset)

    def _with_vertices(self, vertices: Points) -> "TriangleMesh":
        """Returns the mesh with as many other vertices, a new array that is not copied; its faces are known to fit."""
        if vertices.dtype != np.float64 or not vertices.flags.c_contiguous or not np.isfinite(vertices).all():
            return TriangleMesh(vertices, self.faces)  # which states what is wrong
        vertices.setflags(write=False)
        made = object.__new__(TriangleMesh)
        made.__dict__.update(vertices=vertices, faces=self.faces)
        return made

    def with_faces(self, keep: np.ndarray) -> "TriangleMesh":
        """Returns the mesh of the selected faces (mask or indices), unused vertices dropped."""
        faces = self.faces[keep]
        used, index = renumbered(faces, len(self.vertices))
        return TriangleMesh(self.vertices[used], index)

    def to_trimesh(self) -> "trimesh.Trimesh":
        """Returns a new, unprocessed trimesh copy."""
        import trimesh  # local: it takes half a second, and furniture is read and written without it

        return trimesh.Trimesh(self.vertices.copy(), self.faces.copy(), process=False, validate=False)

    @classmethod
    def from_trimesh(cls, mesh: "trimesh.Trimesh") -> "TriangleMesh":
        """Returns the value of a trimesh."""
        return cls(np.asarray(mesh.vertices, dtype=np.float64), np.asarray(mesh.faces, dtype=np.int64))

    @classmethod
    def box_mesh(cls, box: Box) -> "TriangleMesh":
        """Returns the watertight mesh of a box, 12 faces."""
        return cls(box.corners(), np.array(_BOX_FACES))


def triangle_bounds(triangles: np.ndarray) -> tuple[Points, Points]:
    """Returns the lowest and the highest corner of the box around each triangle, (n, 3, 3)."""
    first, second, third = triangles[:, 0], triangles[:, 1], triangles[:, 2]  # quicker than numpy along the middle
    return np.minimum(np.minimum(first, second), third), np.maximum(np.maximum(first, second), third)


def merge_meshes(meshes: Sequence[TriangleMesh]) -> TriangleMesh:
    """Returns one mesh of all faces, in order; no vertex is welded."""
    if not meshes:
        return TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64))
    if len(meshes) == 1:
        return meshes[0]
    starts = np.cumsum([0] + [len(m.vertices) for m in meshes[:-1]])
    return TriangleMesh(
        np.vstack([m.vertices for m in meshes]),
        np.vstack([m.faces + start for m, start in zip(meshes, starts, strict=True)]),
    )


def mesh_near(meshes: Iterable[TriangleMesh], box: Box) -> TriangleMesh:
    """Returns one mesh of the faces whose own boxes meet a box, in order."""
    near = []
    for mesh in meshes:
        if len(mesh.faces) and mesh.box.overlaps(box):
            low, high = triangle_bounds(mesh.triangles)
            keep = np.all((low <= box.high) & (high >= box.low), axis=1)
            near.append(mesh if keep.all() else mesh.with_faces(keep))
    return merge_meshes(near)


def heading_of(meshes: Iterable[TriangleMesh], upright: Mat3 | None = None, least: float = 0.0) -> float:
    """Returns the rotation about Z, radians in (-pi/4, pi/4], that lays an axis along most of the upright area.

    It is 0 where the axes serve nearly as well, and for angles below one degree: walls that are a little askew; and
    where less than the fraction `least` of the upright area lies along one direction or across it, as nearly as the
    normals of a scanned wall do. The rows of `upright` are the axes, Z last, where they are not those of the meshes.
    """
    crosses = [_cross(mesh.triangles) for mesh in meshes if len(mesh.faces)]
    cross = np.concatenate(crosses) if crosses else np.zeros((0, 3))
    cross = cross if upright is None else cross @ upright.T
    area = np.linalg.norm(cross, axis=1)
    upright = (area > 0) & (np.abs(cross[:, 2]) <= _UPRIGHT * area)
    if not upright.any():
        return 0.0
    cross, area = cross[upright], area[upright]
    angles = np.mod(np.arctan2(cross[:, 1], cross[:, 0]), np.pi / 2)
    bins = np.bincount((angles / (np.pi / 2) * _BINS).round().astype(int) % _BINS, area, _BINS)
    near = bins + np.roll(bins, 1) + np.roll(bins, -1)
    best = int(np.argmax(near))
    apart = np.mod(angles - best * np.pi / 2 / _BINS + np.pi / 4, np.pi / 2) - np.pi / 4
    if near[0] >= _AS_WELL * near[best] or area[np.abs(apart) <= _SCATTER].sum() < least * area.sum():
        return 0.0
    close = np.abs(apart) <= 1.5 * np.pi / 2 / _BINS
    angle = best * np.pi / 2 / _BINS + float(np.average(apart[close], weights=area[close]))
    return angle if angle <= np.pi / 4 else angle - np.pi / 2


# The corners come as Box.corners(): bit 0 is x, bit 1 is y, bit 2 is z.
_BOX_FACES = [
    [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
    [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5],
]  # fmt: skip


def _cross(t: np.ndarray) -> np.ndarray:
    return cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])


def _meet_in_pairs(start: np.ndarray, end: np.ndarray) -> bool:
    """Whether directed edges come in twos that run along the same line, there and back."""
    if len(start) % 2:
        return False
    low, high = np.minimum(start, end), np.maximum(start, end)
    order = np.argsort(low * (int(high.max()) + 1) + high)
    first, second = order[::2], order[1::2]
    are_two = (low[first] == low[second]) & (high[first] == high[second])
    are_more = (low[second[:-1]] == low[first[1:]]) & (high[second[:-1]] == high[first[1:]])
    return bool(are_two.all() and not are_more.any() and (end[first] == start[second]).all())


def _unit(vectors: np.ndarray) -> np.ndarray:
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-300))
