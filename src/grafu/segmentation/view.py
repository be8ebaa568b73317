"""Shells as they are seen from one side: bounding boxes, areas and what hides what. It decides nothing.

Coordinates are those of the viewer: x to the right, y up, z towards the viewer.
"""

from dataclasses import dataclass
from typing import final

import numpy as np
from jaxtyping import Bool, Float, Int

from grafu.geometry.arrays import ArrayValue, Indices, Mat3, Points, freeze_arrays
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.geometry.raycast import RayCaster

OfShells = Int[np.ndarray, " shells"]
MaskOfShells = Bool[np.ndarray, " shells"]
ScalarsOfShells = Float[np.ndarray, " shells"]
PointsOfShells = Float[np.ndarray, "shells 3"]

_RAYS = 288  # along the longer side of what is seen
_FAR = 2.0  # fractions of the largest side that rays begin in front
_MANY = 100_000  # faces, of which most are smaller than the distance between rays
_SPARE = 0.01  # of that distance: rays are traced in single precision


@final
@dataclass(frozen=True, eq=False, slots=True)
class ShellsView(ArrayValue):
    """Shells seen from one side, in the viewer's coordinates and the unit of the meshes.

    `owner` is the number of the mesh that holds each shell; `low` and `high` are the ends of its box; `faced` is the
    area of its projection along each axis (the greater of both sides). `seen` is the number of the shell that each ray
    meets first, -1 where it meets none, rows from the bottom up; rays stand `cell` apart, the first at `origin`.
    """

    owner: OfShells
    low: PointsOfShells
    high: PointsOfShells
    faced: PointsOfShells
    seen: Int[np.ndarray, "r c"]
    depth: Float[np.ndarray, "r c"]
    origin: Float[np.ndarray, "2"]
    cell: float

    def __post_init__(self) -> None:
        freeze_arrays(self)

    @property
    def size(self) -> PointsOfShells:
        """The extents of the shells."""
        return self.high - self.low

    def of_shells(self, shells: Indices) -> "ShellsView":
        """Returns the view of some shells, numbered in their order; what rays meet keeps its number."""
        owner, low, high, faced = (a[shells] for a in (self.owner, self.low, self.high, self.faced))
        return ShellsView(owner, low, high, faced, self.seen, self.depth, self.origin, self.cell)

    def window(self, shell: int) -> tuple[slice, slice]:
        """Returns the rows and columns of the rays within the outline of a shell's box, at least one of each."""
        first = np.ceil((self.low[shell, :2] - self.origin) / self.cell - 1e-9).astype(int)
        last = np.floor((self.high[shell, :2] - self.origin) / self.cell + 1e-9).astype(int)
        ends = np.array(self.seen.shape[::-1]) - 1  # a speck at the very border lies beyond the last ray
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
    `face` is the face that each ray meets first; rays are those of `ShellsView`.
    """

    low: Points
    high: Points
    cross: Points
    face: Int[np.ndarray, "r c"]
    depth: Float[np.ndarray, "r c"]
    origin: Float[np.ndarray, "2"]
    cell: float

    @classmethod
    def of(cls, mesh: TriangleMesh, axes: Mat3) -> "SeenFaces":
        """Returns a mesh as it is seen along the third row of `axes`; see `view_of`."""
        turned = TriangleMesh(mesh.vertices @ axes.T, mesh.faces)
        corners = turned.triangles
        low, high = triangle_bounds(corners)
        cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        whole = turned.box
        cell = float(max(whole.size[:2].max(), 1e-12)) / _RAYS
        # off the middle of cells: no ray runs along the edge where boards meet
        origin = whole.low[:2] + cell * np.array([0.4871, 0.5113])
        counts = np.maximum(np.ceil((whole.high[:2] - origin) / cell).astype(int), 1)
        x, y = np.meshgrid(*(origin[k] + cell * np.arange(counts[k]) for k in (0, 1)))
        top = float(whole.high[2]) + _FAR * float(whole.size.max())
        starts = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, top)])
        met = _may_be_met(low, high, origin, cell)
        away = np.array([0.0, 0.0, -1.0])
        found, distance = RayCaster(TriangleMesh(turned.vertices, turned.faces[met])).first_faces(starts, away)
        face = np.where(found >= 0, met[found], -1) if len(met) else found
        return cls(low, high, cross, face.reshape(x.shape), (top - distance).reshape(x.shape), origin, cell)

    def view(self, shell: Indices, owner: OfShells) -> ShellsView:
        """Returns the shells, from the number of each face's shell and of the object that holds each shell."""
        order = np.argsort(shell, kind="stable")
        starts = np.searchsorted(shell[order], np.arange(len(owner)))
        low = np.minimum.reduceat(self.low[order], starts, axis=0)
        high = np.maximum.reduceat(self.high[order], starts, axis=0)
        cross = self.cross[order] / 2
        sides = [np.add.reduceat(np.maximum(sign * cross, 0.0), starts, axis=0) for sign in (1.0, -1.0)]
        seen = np.where(self.face >= 0, shell[self.face], -1)
        return ShellsView(owner, low, high, np.maximum(*sides), seen, self.depth, self.origin, self.cell)


def _may_be_met(low: Points, high: Points, origin: np.ndarray, cell: float) -> Int[np.ndarray, " _"]:
    """Returns the faces that a ray may meet; of few faces all, since sorting them out takes longer than it saves."""
    if len(low) <= _MANY:
        return np.arange(len(low))
    first = np.ceil((low[:, :2] - origin) / cell - _SPARE)
    last = np.floor((high[:, :2] - origin) / cell + _SPARE)
    return np.flatnonzero((first <= last).all(axis=1))
