"""How much volume a mesh stands for, and how it lies in space, however untidy the mesh is. It knows no density.

Closed surfaces count by what they enclose. Open ones, and sheets without thickness, count as shells: their area,
doubled faces once, times a board's thickness. Nothing counts for more than the box around it.
"""

from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.geometry.arrays import ArrayValue, Mat3, Vec3, freeze_arrays
from grafu.geometry.box import Box, yaw_of
from grafu.geometry.components import Patches, patches_of
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.geometry.transform import rotation_matrix

BOARD_THICKNESS = 0.015  # metres: furniture boards come in 15 to 19 mm
_FLAT = 0.001  # a box thinner than this (metres) was drawn as a sheet: its thickness is not meant
_TETRAHEDRON = (np.ones((4, 4)) + np.eye(4)) / 20.0  # second moments of a unit tetrahedron in its corners
_TRIANGLE = (np.ones((3, 3)) + np.eye(3)) / 12.0


@final
@dataclass(frozen=True, eq=False, slots=True)
class Moments(ArrayValue):
    """Volume (cubic metres) with its first and second moments about the object frame's origin.

    `first` is the integral of x, `second` of x times x transposed.
    """

    volume: float
    first: Vec3
    second: Mat3

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float64)

    def scaled(self, factor: float) -> "Moments":
        """Returns the moments of `factor` times as much of everything (as by a density)."""
        return Moments(self.volume * factor, self.first * factor, self.second * factor)

    def plus(self, other: "Moments") -> "Moments":
        """Returns the moments of both bodies together."""
        return Moments(self.volume + other.volume, self.first + other.first, self.second + other.second)


NO_MOMENTS = Moments(0.0, np.zeros(3), np.zeros((3, 3)))


def moments_of(mesh: TriangleMesh, thickness: float = BOARD_THICKNESS) -> Moments:
    """Returns the moments of a mesh; `thickness` (metres) is that of open shells and sheets."""
    patches = patches_of(mesh)
    if not len(patches.faces):
        return NO_MOMENTS
    triangles = mesh.vertices[patches.faces]
    R = rotation_matrix(np.array([0.0, 0.0, 1.0]), yaw_of(mesh.vertices[np.unique(patches.faces)]))
    sides = _sides(triangles @ R, patches)
    boxes, shell = _box_volumes(sides, thickness), _shell_thickness(sides, thickness)
    solid = _solid_moments(triangles, patches)
    sheet = _shell_moments(triangles, patches, shell)
    # closed, but as thin as a sheet: front and back of one sheet, cut into triangles differently
    real = patches.closed & (solid[:, 0] > 0.5 * _FLAT * 0.5 * sheet[:, 0] / shell)
    sheet[patches.closed] *= 0.5
    chosen = np.where(real[:, None], solid, sheet)
    chosen *= np.minimum(1.0, boxes / np.maximum(chosen[:, 0], 1e-300))[:, None]
    total = chosen.sum(axis=0)
    whole = _box_volumes(Box.around((triangles @ R).reshape(-1, 3)).size[None], thickness)[0]
    total *= min(1.0, whole / max(total[0], 1e-300))
    return Moments(float(total[0]), total[1:4], total[4:].reshape(3, 3))


def _sides(triangles: np.ndarray, patches: Patches) -> np.ndarray:
    """Returns the side lengths of each patch's box, (patches, 3)."""
    order = np.argsort(patches.patch, kind="stable")
    starts = np.searchsorted(patches.patch[order], np.arange(len(patches.closed)))
    lows, highs = triangle_bounds(triangles)
    low = np.minimum.reduceat(lows[order], starts, axis=0)
    high = np.maximum.reduceat(highs[order], starts, axis=0)
    return high - low


def _shell_thickness(sides: np.ndarray, thickness: float) -> np.ndarray:
    thin = sides.min(axis=1)
    return np.where(thin < _FLAT, thickness, np.minimum(thickness, thin))


def _box_volumes(sides: np.ndarray, thickness: float) -> np.ndarray:
    """Returns the volumes of boxes; one that is flat is taken to be `thickness` thick."""
    return np.prod(np.where(sides < _FLAT, np.minimum(thickness, sides.max(axis=1, keepdims=True)), sides), axis=1)


def _solid_moments(triangles: np.ndarray, patches: Patches) -> np.ndarray:
    """Returns volume, first and second moments of what each patch encloses, (patches, 13); exact where it is closed."""
    volume = np.einsum("nd,nd->n", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])) / 6.0
    first = volume[:, None] * triangles.sum(axis=1) / 4.0
    corners = np.concatenate([triangles, np.zeros((len(triangles), 1, 3))], axis=1)
    second = np.einsum("n,nid,ij,nje->nde", volume, corners, _TETRAHEDRON, corners, optimize=True)
    return _summed(np.column_stack([volume, first, second.reshape(-1, 9)]), patches)


def _shell_moments(triangles: np.ndarray, patches: Patches, thickness: np.ndarray) -> np.ndarray:
    """Returns the moments of each patch as a shell, (patches, 13); its thickness lies half on either side."""
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(cross, axis=1)
    normal = cross / np.maximum(length, 1e-300)[:, None]
    t = thickness[patches.patch]
    volume = length / 2.0 * t
    first = volume[:, None] * triangles.sum(axis=1) / 3.0
    second = np.einsum("n,nid,ij,nje->nde", volume, triangles, _TRIANGLE, triangles, optimize=True)
    second += (volume * t**2 / 12.0)[:, None, None] * normal[:, :, None] * normal[:, None, :]
    return _summed(np.column_stack([volume, first, second.reshape(-1, 9)]), patches)


def _summed(rows: np.ndarray, patches: Patches) -> np.ndarray:
    count = len(patches.closed)
    return np.column_stack([np.bincount(patches.patch, column, count) for column in rows.T])
