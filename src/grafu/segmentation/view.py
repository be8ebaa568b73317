"""Shells as they are seen from one side: bounding boxes, areas and what hides what. It decides nothing.

Coordinates are those of the viewer: x to the right, y up, z towards the viewer.
"""

from dataclasses import dataclass
from typing import final

import numpy as np
from jaxtyping import Bool, Float, Int

from grafu.geometry.arrays import ArrayValue, Indices, Mat3, freeze_arrays
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster

OfShells = Int[np.ndarray, " shells"]
MaskOfShells = Bool[np.ndarray, " shells"]
ScalarsOfShells = Float[np.ndarray, " shells"]
PointsOfShells = Float[np.ndarray, "shells 3"]

_RAYS = 288  # along the longer side of what is seen
_FAR = 2.0  # fractions of the largest side that rays begin in front


@final
@dataclass(frozen=True, eq=False, slots=True)
class View(ArrayValue):
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

    def window(self, shell: int) -> tuple[slice, slice]:
        """Returns the rows and columns of the rays within the outline of a shell's box, at least one of each."""
        first = np.ceil((self.low[shell, :2] - self.origin) / self.cell - 1e-9).astype(int)
        last = np.floor((self.high[shell, :2] - self.origin) / self.cell + 1e-9).astype(int)
        ends = np.array(self.seen.shape[::-1]) - 1  # a speck at the very border lies beyond the last ray
        first = np.clip(first, 0, ends)
        last = np.clip(last, first, ends)
        return slice(first[1], last[1] + 1), slice(first[0], last[0] + 1)


def view_of(mesh: TriangleMesh, shell: Indices, owner: OfShells, axes: Mat3) -> View:
    """Returns the shells of a mesh as they are seen along the third row of `axes`.

    Args:
        mesh: all faces.
        shell: the number of each face's shell.
        owner: for each shell the number of the object that holds it.
        axes: the viewer's right, up and the direction towards the viewer, unit rows.
    """
    turned = TriangleMesh(mesh.vertices @ axes.T, mesh.faces)
    corners = turned.triangles
    order = np.argsort(shell, kind="stable")
    starts = np.searchsorted(shell[order], np.arange(len(owner)))
    low = np.minimum.reduceat(corners.min(axis=1)[order], starts, axis=0)
    high = np.maximum.reduceat(corners.max(axis=1)[order], starts, axis=0)
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[order] / 2
    sides = [np.add.reduceat(np.maximum(sign * cross, 0.0), starts, axis=0) for sign in (1.0, -1.0)]
    return _looked_at(turned, shell, owner, low, high, np.maximum(*sides))


def _looked_at(
    mesh: TriangleMesh,
    shell: Indices,
    owner: OfShells,
    low: PointsOfShells,
    high: PointsOfShells,
    faced: PointsOfShells,
) -> View:
    whole = mesh.box
    cell = float(max(whole.size[:2].max(), 1e-12)) / _RAYS
    # off the middle of cells: no ray runs along the edge where boards meet
    origin = whole.low[:2] + cell * np.array([0.4871, 0.5113])
    counts = np.maximum(np.ceil((whole.high[:2] - origin) / cell).astype(int), 1)
    x, y = np.meshgrid(*(origin[k] + cell * np.arange(counts[k]) for k in (0, 1)))
    top = float(whole.high[2]) + _FAR * float(whole.size.max())
    starts = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, top)])
    face, distance = RayCaster(mesh).first_faces(starts, np.array([0.0, 0.0, -1.0]))
    seen = np.where(face >= 0, shell[face], -1).reshape(x.shape)
    return View(owner, low, high, faced, seen, (top - distance).reshape(x.shape), origin, cell)
