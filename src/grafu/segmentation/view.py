"""Shells as they are seen from one side: bounding boxes, areas and what hides what. It decides nothing.

Coordinates are those of the viewer: x to the right, y up, z towards the viewer.
"""

from collections.abc import Iterator
from functools import cached_property
from typing import Any, Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Faces, Indices, Mat3, Points, cross, freeze_arrays, frozen_array
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.geometry.raycast import RayCaster
from grafu.geometry.remembered import RememberedByContent
from grafu.shapes import Bool, Float, Int

OfShells = Int[np.ndarray, " shells"]
MaskOfShells = Bool[np.ndarray, " shells"]
ScalarsOfShells = Float[np.ndarray, " shells"]
PointsOfShells = Float[np.ndarray, "shells 3"]

_RAYS = 288  # along the longer side of what is seen
_FAR = 2.0  # fractions of the largest side that rays begin in front
_MANY = 100_000  # faces, of which most are smaller than the distance between rays
_TOGETHER = 200_000  # faces that are looked at in one step: arrays of all of a large mesh take much room
_ROOM = 400_000  # faces of the meshes whose rays are kept
_FEW = 100_000  # faces that those of one mesh count at least: its rays take room, too
_SPARE = 0.01  # of that distance: rays are traced in single precision


@final
class RayGrid:
    """Parallel rays towards a mesh, along -z, rows from the bottom up; they are traced when first asked. Not a value.

    Rays stand `cell` apart, the first at `origin`; `shape` are their rows and columns.
    """

    def __init__(self, mesh: TriangleMesh, axes: Mat3) -> None:
        """Takes a mesh, and the viewer's right, up and the direction towards the viewer as rows."""
        self._mesh, self._axes = mesh, axes
        self._box = Box.around(np.stack([mesh.box.low, mesh.box.high]) @ axes.T)
        self.cell = float(max(self._box.size[:2].max(), 1e-12)) / _RAYS
        # off the middle of cells: no ray runs along the edge where boards meet
        self.origin = self._box.low[:2] + self.cell * np.array([0.4871, 0.5113])
        columns, rows = np.maximum(np.ceil((self._box.high[:2] - self.origin) / self.cell).astype(int), 1).tolist()
        self.shape = rows, columns

    @property
    def face(self) -> Int[np.ndarray, "r c"]:
        """The face that each ray meets first, -1 where it meets none."""
        return self._met[0]

    @property
    def depth(self) -> Float[np.ndarray, "r c"]:
        """How high each ray meets that face (z); minus infinity where it meets none."""
        return self._met[1]

    def corners(self, faces: Bool[np.ndarray, " faces"]) -> Float[np.ndarray, "n 3 3"]:
        """Returns the corners of some faces of the mesh, in the viewer's coordinates."""
        return np.asarray(self._mesh.vertices[self._mesh.faces[faces]] @ self._axes.T)

    @cached_property
    def _met(self) -> tuple[Int[np.ndarray, "r c"], Float[np.ndarray, "r c"]]:
        x, y = np.meshgrid(*(self.origin[k] + self.cell * np.arange(self.shape[1 - k]) for k in (0, 1)))
        top = float(self._box.high[2]) + _FAR * float(self._box.size.max())
        starts = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, top)])
        vertices = self._mesh.vertices @ self._axes.T
        met = _may_be_met(vertices, self._mesh.faces, self.origin, self.cell)
        caster = RayCaster(TriangleMesh(vertices, self._mesh.faces[met]))
        found, distance = caster.first_faces(starts, np.array([0.0, 0.0, -1.0]))
        face = np.where(found >= 0, met[found], -1) if len(met) else found
        return face.reshape(x.shape), (top - distance).reshape(x.shape)


@final
@dataclass(frozen=True, eq=False)
class ShellsView(ArrayValue):
    """Shells seen from one side, in the viewer's coordinates and the unit of the meshes.

    `owner` is the number of the mesh that holds each shell; `low` and `high` are the ends of its box; `faced` is the
    area of its projection along each axis (the greater of both sides). `shell` is the number of each face's shell.
    """

    owner: OfShells
    low: PointsOfShells
    high: PointsOfShells
    faced: PointsOfShells
    shell: Indices
    rays: RayGrid

    def __post_init__(self) -> None:
        freeze_arrays(self)

    @cached_property
    def seen(self) -> Int[np.ndarray, "r c"]:
        """The number of the shell that each ray meets first, -1 where it meets none."""
        face = self.rays.face
        return np.where(face >= 0, self.shell[face], -1)

    @property
    def depth(self) -> Float[np.ndarray, "r c"]:
        """How near to the viewer that is (z)."""
        return self.rays.depth

    @cached_property
    def size(self) -> PointsOfShells:
        """The extents of the shells."""
        return frozen_array(self.high - self.low)

    @cached_property
    def remembered(self) -> dict[object, Any]:
        """What was worked out of this view, by what it is: the view stays as it is, and is asked by several."""
        return {}

    def of_shells(self, shells: Indices) -> "ShellsView":
        """Returns the view of some shells, numbered in their order; what rays meet keeps its number."""
        owner, low, high, faced = (a[shells] for a in (self.owner, self.low, self.high, self.faced))
        return ShellsView(owner, low, high, faced, self.shell, self.rays)

    def window(self, shell: int) -> tuple[slice, slice]:
        """Returns the rows and columns of the rays within the outline of a shell's box, at least one of each."""
        (left, bottom), (right, top) = self._windows[0][shell], self._windows[1][shell]
        return slice(bottom, top + 1), slice(left, right + 1)

    @cached_property
    def _windows(self) -> tuple[list[list[int]], list[list[int]]]:
        """The first and the last column and row of the rays within the outline of each shell's box."""
        origin, cell = self.rays.origin, self.rays.cell
        first = np.ceil((self.low[:, :2] - origin) / cell - 1e-9).astype(int)
        last = np.floor((self.high[:, :2] - origin) / cell + 1e-9).astype(int)
        ends = np.array(self.rays.shape[::-1]) - 1  # a speck at the very border lies beyond the last ray
        first = np.clip(first, 0, ends)
        return first.tolist(), np.clip(last, first, ends).tolist()


@final
class RaysFromSides:
    """The rays towards a mesh from each side that is asked for, traced once however the faces are sorted into shells.

    Not a value.
    """

    def __init__(self, mesh: TriangleMesh) -> None:
        self._mesh = mesh
        self._grids: dict[bytes, RayGrid] = {}

    @classmethod
    def towards(cls, mesh: TriangleMesh) -> "RaysFromSides":
        """Returns the rays towards a mesh, those that are known where it, or an equal one, came lately."""
        return _by_content.of(lambda: cls(mesh), len(mesh.faces) + _FEW, mesh.vertices, mesh.faces)

    def along(self, axes: Mat3) -> RayGrid:
        """Returns the rays against the third row of `axes`."""
        key = axes.tobytes()
        if key not in self._grids:
            self._grids[key] = RayGrid(self._mesh, axes)
        return self._grids[key]


_by_content: Final = RememberedByContent["RaysFromSides"](_ROOM)


@final
@dataclass(frozen=True, eq=False)
class ShellBounds(ArrayValue):
    """Where each shell of a mesh begins and ends, and the area of its projection along each axis.

    Of that area the greater of both sides counts: `faced`.
    """

    low: PointsOfShells
    high: PointsOfShells
    faced: PointsOfShells

    def __post_init__(self) -> None:
        freeze_arrays(self)

    @classmethod
    def of(cls, mesh: TriangleMesh, shell: Indices, count: int) -> "ShellBounds":
        """Returns the bounds of `count` shells, from the number of each face's shell; each has a face."""
        order = np.argsort(shell, kind="stable")
        starts = np.searchsorted(shell[order], np.arange(count + 1))
        low, high, faced = np.zeros((3, count, 3))
        for first, last in _few_together(starts):
            corners = mesh.vertices[mesh.faces[order[starts[first] : starts[last]]]]
            begins = starts[first:last] - starts[first]
            ends = triangle_bounds(corners)
            low[first:last] = np.minimum.reduceat(ends[0], begins, axis=0)
            high[first:last] = np.maximum.reduceat(ends[1], begins, axis=0)
            normals = cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
            sides = [np.add.reduceat(np.maximum(sign * normals, 0.0), begins, axis=0) for sign in (1.0, -1.0)]
            faced[first:last] = np.maximum(*sides)
        return cls(low, high, faced)

    def seen(self, axes: Mat3) -> "ShellBounds":
        """Returns the bounds in the coordinates of a viewer whose axes, the rows, run along those of the mesh."""
        ends = self.low @ axes.T, self.high @ axes.T
        return ShellBounds(np.minimum(*ends), np.maximum(*ends), self.faced @ np.abs(axes).T)


def _few_together(starts: Indices) -> Iterator[tuple[int, int]]:
    """Yields ranges of shells that have few faces together, or are one; shell k has those from `starts[k]` on."""
    first, count = 0, len(starts) - 1
    while first < count:
        last = int(np.searchsorted(starts, starts[first] + _TOGETHER, side="right")) - 1
        last = min(max(last, first + 1), count)
        yield first, last
        first = last


def _may_be_met(vertices: Points, faces: Faces, origin: np.ndarray, cell: float) -> Int[np.ndarray, " _"]:
    """Returns the faces that a ray may meet; of few faces all, since sorting them out takes longer than it saves."""
    if len(faces) <= _MANY:
        return np.arange(len(faces))
    low, high = triangle_bounds(((vertices - np.append(origin, 0.0)) / cell)[faces])
    return np.flatnonzero((np.ceil(low - _SPARE) <= np.floor(high + _SPARE))[:, :2].all(axis=1))
