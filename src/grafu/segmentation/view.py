"""Shells as they are seen from one side: bounding boxes, areas and what hides what. It decides nothing.

Coordinates are those of the viewer: x to the right, y up, z towards the viewer.
"""

from functools import cached_property
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Indices, Mat3, Points, cross, freeze_arrays
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.geometry.raycast import RayCaster
from grafu.shapes import Bool, Float, Int

OfShells = Int[np.ndarray, " shells"]
MaskOfShells = Bool[np.ndarray, " shells"]
ScalarsOfShells = Float[np.ndarray, " shells"]
PointsOfShells = Float[np.ndarray, "shells 3"]

_RAYS = 288  # along the longer side of what is seen
_FAR = 2.0  # fractions of the largest side that rays begin in front
_MANY = 100_000  # faces, of which most are smaller than the distance between rays
_SPARE = 0.01  # of that distance: rays are traced in single precision


@final
class RayGrid:
    """Parallel rays towards a mesh, along -z, rows from the bottom up; they are traced when first asked. Not a value.

    Rays stand `cell` apart, the first at `origin`; `shape` are their rows and columns.
    """

    def __init__(self, mesh: TriangleMesh, low: Points, high: Points) -> None:
        """Takes a mesh in the viewer's coordinates, and the ends of the box of each face."""
        self._mesh, self._low, self._high = mesh, low, high
        size = mesh.box.size
        self.cell = float(max(size[:2].max(), 1e-12)) / _RAYS
        # off the middle of cells: no ray runs along the edge where boards meet
        self.origin = mesh.box.low[:2] + self.cell * np.array([0.4871, 0.5113])
        columns, rows = np.maximum(np.ceil((mesh.box.high[:2] - self.origin) / self.cell).astype(int), 1).tolist()
        self.shape = rows, columns

    @property
    def face(self) -> Int[np.ndarray, "r c"]:
        """The face that each ray meets first, -1 where it meets none."""
        return self._met[0]

    @property
    def depth(self) -> Float[np.ndarray, "r c"]:
        """How high each ray meets that face (z); minus infinity where it meets none."""
        return self._met[1]

    @cached_property
    def _met(self) -> tuple[Int[np.ndarray, "r c"], Float[np.ndarray, "r c"]]:
        x, y = np.meshgrid(*(self.origin[k] + self.cell * np.arange(self.shape[1 - k]) for k in (0, 1)))
        top = float(self._mesh.box.high[2]) + _FAR * float(self._mesh.box.size.max())
        starts = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, top)])
        met = _may_be_met(self._low, self._high, self.origin, self.cell)
        caster = RayCaster(TriangleMesh(self._mesh.vertices, self._mesh.faces[met]))
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

    @property
    def size(self) -> PointsOfShells:
        """The extents of the shells."""
        return self.high - self.low

    def of_shells(self, shells: Indices) -> "ShellsView":
        """Returns the view of some shells, numbered in their order; what rays meet keeps its number."""
        owner, low, high, faced = (a[shells] for a in (self.owner, self.low, self.high, self.faced))
        return ShellsView(owner, low, high, faced, self.shell, self.rays)

    def window(self, shell: int) -> tuple[slice, slice]:
        """Returns the rows and columns of the rays within the outline of a shell's box, at least one of each."""
        origin, cell = self.rays.origin, self.rays.cell
        first = np.ceil((self.low[shell, :2] - origin) / cell - 1e-9).astype(int)
        last = np.floor((self.high[shell, :2] - origin) / cell + 1e-9).astype(int)
        ends = np.array(self.rays.shape[::-1]) - 1  # a speck at the very border lies beyond the last ray
        first = np.clip(first, 0, ends)
        last = np.clip(last, first, ends)
        return slice(first[1], last[1] + 1), slice(first[0], last[0] + 1)


def view_of(mesh: TriangleMesh, shell: Indices, owner: OfShells, axes: Mat3) -> ShellsView:
    """Returns the shells of a mesh as they are seen along the third row of `axes`.

    Args:
        mesh: all faces.
        shell: the number of each face's shell.
        owner: for each shell the number of the object that holds it.
        axes: the viewer's right, up and the direction towards the viewer, unit rows.
    """
    return SeenFaces.of(mesh, axes).view(shell, owner)


@final
@dataclass(frozen=True, eq=False)
class SeenFaces:
    """The faces of a mesh as they are seen from one side, however they are sorted into shells.

    `low` and `high` are the ends of the box of each face, `cross` its normal, twice as long as the face is large.
    """

    low: Points
    high: Points
    cross: Points
    rays: RayGrid

    @classmethod
    def of(cls, mesh: TriangleMesh, axes: Mat3) -> "SeenFaces":
        """Returns a mesh as it is seen along the third row of `axes`; see `view_of`."""
        turned = TriangleMesh(mesh.vertices @ axes.T, mesh.faces)
        corners = turned.triangles
        low, high = triangle_bounds(corners)
        normals = cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        return cls(low, high, normals, RayGrid(turned, low, high))

    def view(self, shell: Indices, owner: OfShells) -> ShellsView:
        """Returns the shells, from the number of each face's shell and of the object that holds each shell."""
        order = np.argsort(shell, kind="stable")
        starts = np.searchsorted(shell[order], np.arange(len(owner)))
        low = np.minimum.reduceat(self.low[order], starts, axis=0)
        high = np.maximum.reduceat(self.high[order], starts, axis=0)
        normals = self.cross[order] / 2
        sides = [np.add.reduceat(np.maximum(sign * normals, 0.0), starts, axis=0) for sign in (1.0, -1.0)]
        return ShellsView(owner, low, high, np.maximum(*sides), shell, self.rays)


def _may_be_met(low: Points, high: Points, origin: np.ndarray, cell: float) -> Int[np.ndarray, " _"]:
    """Returns the faces that a ray may meet; of few faces all, since sorting them out takes longer than it saves."""
    if len(low) <= _MANY:
        return np.arange(len(low))
    first = np.ceil((low[:, :2] - origin) / cell - _SPARE)
    last = np.floor((high[:, :2] - origin) / cell + _SPARE)
    return np.flatnonzero((first <= last).all(axis=1))
