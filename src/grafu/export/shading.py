"""Normals for files that need them: kept where a surface has them, else smooth up to a crease angle."""

from typing import Final, final
from weakref import finalize

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import ArrayValue, Faces, Indices, Mask, Points, Scalars, cross
from grafu.geometry.components import linked, welded
from grafu.geometry.mesh import TriangleMesh

CREASE_ANGLE = float(np.radians(30.0))  # Blender's "shade auto smooth" default: panels stay flat, round knobs smooth


@final
@dataclass(frozen=True, eq=False, slots=True)
class CornerNormals(ArrayValue):
    """Unit normals, and for each face the normal of each of its corners."""

    normals: Points
    corners: Faces


_ROOM: Final = 600_000  # faces whose normals are kept: 60 MB; those of larger models are worked out for each file
_kept: dict[tuple[int, float], CornerNormals] = {}
_taken = [0]  # faces of those


def corner_normals(surface: Surface, crease_angle: float = CREASE_ANGLE) -> CornerNormals:
    """Returns the surface's own normals, or new ones that are smooth across edges bent by less than `crease_angle`.

    Angles are radians. Faces meet across vertices of equal position, whether or not they share an index. A normal
    without length is replaced by that of a face. As far as there is room they are found once in the surface's life:
    files in several formats, and the page, ask for the same.
    """
    key = id(surface), crease_angle
    if (known := _kept.get(key)) is not None:
        return known
    found = _corner_normals(surface, crease_angle)
    if _taken[0] + len(found.corners) <= _ROOM:
        _kept[key] = found
        _taken[0] += len(found.corners)
        finalize(surface, _forget, key)
    return found


def _forget(key: tuple[int, float]) -> None:
    _taken[0] -= len(_kept.pop(key).corners)


def _corner_normals(surface: Surface, crease_angle: float) -> CornerNormals:
    mesh = surface.mesh
    if surface.normals is not None:
        return CornerNormals(_mended(surface.normals, mesh), np.asarray(mesh.faces))
    flat = mesh.face_normals  # once: a large mesh does not keep them
    groups, corner_group = _smooth_groups(mesh, flat, crease_angle)
    weights, flat = _corner_angles(mesh).ravel(), np.repeat(flat, 3, axis=0)
    summed = np.column_stack([np.bincount(corner_group, flat[:, k] * weights, groups) for k in range(3)])
    fallback = np.zeros((groups, 3))
    fallback[corner_group] = flat
    return CornerNormals(_unit(summed, fallback), corner_group.reshape(-1, 3))


def _mended(normals: Points, mesh: TriangleMesh) -> Points:
    fallback = np.zeros_like(normals)
    fallback[mesh.faces.ravel()] = np.repeat(mesh.face_normals, 3, axis=0)
    return _unit(np.nan_to_num(normals, posinf=0.0, neginf=0.0), fallback)


def _unit(vectors: Points, fallback: Points) -> Points:
    """Returns unit vectors; where one has no length its fallback's, and up where that has none either."""
    result = np.where(np.linalg.norm(vectors, axis=1, keepdims=True) > 1e-9, vectors, fallback)
    lengths = np.linalg.norm(result, axis=1, keepdims=True)
    return np.where(lengths > 1e-12, result / np.maximum(lengths, 1e-12), [0.0, 0.0, 1.0])


def _corner_angles(mesh: TriangleMesh) -> np.ndarray:
    """Returns the inner angle at each corner, (faces, 3): a weight that does not depend on how faces are cut."""
    t = mesh.triangles
    ahead, back = np.roll(t, -1, axis=1) - t, np.roll(t, 1, axis=1) - t
    across = np.linalg.norm(cross(ahead, back), axis=2)
    return np.arctan2(across, np.einsum("fkd,fkd->fk", ahead, back))


def _smooth_groups(mesh: TriangleMesh, normals: np.ndarray, crease_angle: float) -> tuple[int, Indices]:
    """Returns how many groups of corners share a normal, and the group of each corner (face by face)."""
    position = welded(mesh.vertices)[mesh.faces]
    start, end = position.ravel(), np.roll(position, -1, axis=1).ravel()
    low, high = np.minimum(start, end), np.maximum(start, end)
    order = np.argsort(low * (len(mesh.vertices) + 1) + high, kind="stable")
    links = [_joined_corners(order, low, high, lag, normals, crease_angle) for lag in (1, 2, 3)]
    a, b = (np.concatenate([link[k] for link in links]) for k in range(2))
    # a corner belongs to one position only: the two ends of an edge are joined each with its own partner
    first, second = _partners(a, b, start)
    count = 3 * len(mesh.faces)
    group = linked(count, first, second)
    return int(group.max(initial=-1)) + 1, group


def _joined_corners(
    order: Indices, low: Indices, high: Indices, lag: int, normals: np.ndarray, crease_angle: float
) -> tuple[np.ndarray, np.ndarray]:
    """Returns pairs of half-edges on one edge, `lag` apart in `order`, whose faces bend by less than the angle.

    Lags up to 3 find every pair where four faces meet in an edge, as doubled faces do.
    """
    a, b = order[:-lag], order[lag:]
    same: Mask = (low[a] == low[b]) & (high[a] == high[b])
    a, b = a[same], b[same]
    cosine: Scalars = np.einsum("nd,nd->n", normals[a // 3], normals[b // 3])
    smooth = cosine > np.cos(crease_angle)
    return a[smooth], b[smooth]


def _partners(a: np.ndarray, b: np.ndarray, start: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the pairs of corners that lie at one position, for pairs of half-edges (named by their first corner)."""
    next_a, next_b = a - a % 3 + (a + 1) % 3, b - b % 3 + (b + 1) % 3
    opposite = start[a] != start[b]
    first_b, last_b = np.where(opposite, next_b, b), np.where(opposite, b, next_b)
    return np.concatenate([a, next_a]), np.concatenate([first_b, last_b])
