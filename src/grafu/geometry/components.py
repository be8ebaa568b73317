"""Triangles sorted into connected patches: doubled faces once, closed or open, turned one way. No materials.

Real furniture is modelled with vertices split at seams, every face drawn twice, and normals at random; what bounds a
solid must be found from positions alone.
"""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import (
    ArrayValue,
    Faces,
    Indices,
    Mat3,
    Points,
    Scalars,
    cross,
    first_of_each,
    freeze_arrays,
    renumbered,
    row_keys,
)
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.shapes import Bool, Float, Int

OF_PIECE = 0x7F4A7C159E3779B9  # an odd multiplier of no pattern, as in `row_keys`
BoxEnds = Float[np.ndarray, "n 2 3"]  # lowest and highest corner of each of n boxes


@final
@dataclass(frozen=True, eq=False, slots=True)
class Patches(ArrayValue):
    """Every distinct face of a mesh and its patch; `closed` tells for each patch whether it bounds a solid.

    Faces of one patch are connected across edges that exactly two faces share, and turned one way; a closed patch's
    normals point outwards. `faces` index the mesh's own vertices.
    """

    faces: Faces
    patch: Int[np.ndarray, " m"]
    closed: Bool[np.ndarray, " k"]

    def __post_init__(self) -> None:
        freeze_arrays(self, "faces", "patch", dtype=np.int64)
        freeze_arrays(self, "closed", dtype=np.bool_)


def welded(points: Points, tolerance: float = 1e-6) -> Indices:
    """Returns for each point the number of its position; points within about `tolerance` metres share one.

    Numbers run from 0 in no particular order.
    """
    return np.unique(cells_of(points, tolerance), return_inverse=True)[1].reshape(-1)


def linked(count: int, first: np.ndarray, second: np.ndarray) -> Indices:
    """Returns for each of `count` things the number of its group: each `first` is in one with its `second`.

    Groups are numbered in the order of their first members.
    """
    root = np.arange(count)
    low, high = np.minimum(first, second), np.maximum(first, second)
    root[high] = low  # each thing hangs below another; the first of its group, in the end, below none
    while len(low):
        while not np.array_equal(root, upper := root[root]):
            root = upper
        first, second = root[low], root[high]
        apart = first != second
        low, high = np.minimum(first, second)[apart], np.maximum(first, second)[apart]
        np.minimum.at(root, high, low)
    return (np.cumsum(root == np.arange(count)) - 1)[root]


def patches_of(mesh: TriangleMesh) -> Patches:
    """Returns the distinct faces of a mesh, sorted into patches.

    Faces with two corners at one position are left out; of faces with the same three corners one is kept.
    """
    position = welded(mesh.vertices)[mesh.faces] if len(mesh.faces) else np.zeros((0, 3), np.int64)
    keep = _distinct(position)
    position, faces = position[keep], mesh.faces[keep]
    if not len(faces):
        return Patches(np.zeros((0, 3), np.int64), np.zeros(0, np.int64), np.zeros(0, np.bool_))
    edges = edge_numbers(position)
    patch, turned, orientable = _oriented_patches(position, edges)
    faces = np.where(turned[:, None], faces[:, ::-1], faces)
    closed = orientable & _without_border(edges, patch, len(orientable))
    volume = np.bincount(patch, _tetrahedra(mesh.vertices[faces]), len(closed))
    inverted = (closed & (volume < 0))[patch]
    return Patches(np.where(inverted[:, None], faces[:, ::-1], faces), patch, closed)


def part_numbers(mesh: TriangleMesh) -> Indices:
    """Returns for each face the number of the piece it belongs to, in order of first faces (see `connected_parts`)."""
    if not len(mesh.faces):
        return np.zeros(0, np.int64)
    position = welded(mesh.vertices)[mesh.faces]
    count = int(position.max()) + 1
    ends = (np.concatenate([position[:, 0], position[:, 1]]), np.concatenate([position[:, 1], position[:, 2]]))
    label = linked(count, *ends)[position[:, 0]]
    first, number = first_of_each(label)
    return np.argsort(np.argsort(first))[number].astype(np.int64)


def faces_of_parts(numbers: Indices) -> list[Int[np.ndarray, " _"]]:
    """Returns for each piece the indices of its faces, from the number of each face's piece."""
    order = np.argsort(numbers, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(numbers[order])) + 1) if len(numbers) else []


def repeated_faces(mesh: TriangleMesh) -> Indices:
    """Returns for each face the index of the first face with the same three corners, which may be itself."""
    if not len(mesh.faces):
        return np.zeros(0, np.int64)
    return first_alike(welded(mesh.vertices)[mesh.faces])


def first_alike(position: Faces) -> Indices:
    """Returns for each face the first with the same three corners, from the numbers of their positions."""
    corners = np.sort(position, axis=1)
    first, number = first_of_each(row_keys(corners))
    return first[number]


def drawn_once(mesh: TriangleMesh) -> tuple[TriangleMesh, Indices]:
    """Returns the distinct faces of a mesh, turned outwards, and for each face of the mesh which of these it repeats.

    They are turned one way as in `patches_of`; a patch that bounds no solid is turned so that the volume below it,
    seen from its middle, is above 0. -1 stands for a face without area.
    """
    patches = patches_of(mesh)
    corners, lies_on = mesh.vertices[patches.faces], patches.patch
    count = np.maximum(np.bincount(lies_on, minlength=len(patches.closed)), 1)[:, None]
    middle = np.stack([np.bincount(lies_on, corners.mean(axis=1)[:, k], len(count)) for k in range(3)], axis=1) / count
    volume = np.bincount(lies_on, _tetrahedra(corners - middle[lies_on][:, None]), len(count))
    faces = np.where((volume < 0)[lies_on][:, None], patches.faces[:, ::-1], patches.faces)
    place = welded(mesh.vertices) if len(mesh.vertices) else np.zeros(0, np.int64)
    keys = row_keys(np.sort(np.vstack([place[faces], place[mesh.faces]]), axis=1))
    first, number = first_of_each(keys)
    found = first[number][len(faces) :]
    return TriangleMesh(mesh.vertices, faces), np.where(found < len(faces), found, -1)


def connected_parts(mesh: TriangleMesh) -> list[TriangleMesh]:
    """Returns the pieces of a mesh that share no position with one another, in order of their first face."""
    faces = faces_of_parts(part_numbers(mesh))
    return [mesh] if len(faces) == 1 else [mesh.with_faces(chosen) for chosen in faces]


def part_boxes(mesh: TriangleMesh, axes: Mat3) -> BoxEnds:
    """Returns lowest and highest corner of the boxes around the pieces, in the coordinates of the columns of `axes`."""
    faces = faces_of_parts(part_numbers(mesh))
    if not faces:
        return np.zeros((0, 2, 3))
    low, high = triangle_bounds((mesh.vertices @ axes)[mesh.faces[np.concatenate(faces)]])
    start = np.cumsum([0, *(len(chosen) for chosen in faces[:-1])])
    return np.stack([np.minimum.reduceat(low, start), np.maximum.reduceat(high, start)], axis=1)


def tidy_parts(mesh: TriangleMesh) -> list[tuple[TriangleMesh, bool]]:
    """Returns the pieces of a mesh without repeated faces, turned one way, and whether each bounds a solid."""
    patches = patches_of(mesh)
    whole = TriangleMesh(mesh.vertices, patches.faces)
    numbers = part_numbers(whole)
    faces = faces_of_parts(numbers)
    closed = np.ones(len(faces), dtype=bool)
    np.logical_and.at(closed, numbers, patches.closed[patches.patch])
    return [(whole if len(faces) == 1 else whole.with_faces(chosen), bool(closed[k])) for k, chosen in enumerate(faces)]


def clustered(mesh: TriangleMesh, cell: float) -> TriangleMesh:
    """Returns a mesh of fewer faces: vertices of one cell (metres) and one piece become the outermost of them.

    Faces that collapse or repeat others are left out; the box around the mesh stays, and no hole opens.
    """
    if not len(mesh.faces):
        return mesh
    used, faces = renumbered(mesh.faces, len(mesh.vertices))
    points, piece = mesh.vertices[used], np.empty(len(used), np.int64)
    piece[faces] = part_numbers(mesh)[:, None]
    outwards = (np.abs(points - mesh.box.center) / np.maximum(mesh.box.half, 1e-12)).max(axis=1)
    order = np.argsort(-outwards, kind="stable")
    keys = cells_of(points, cell) + piece * OF_PIECE
    first, number = first_of_each(keys[order])
    position = np.empty(len(used), np.int64)
    position[order] = number
    corners = position[faces]
    return TriangleMesh(points[order[first]], corners[_distinct(corners)])


def cells_of(points: Points, size: float) -> Int[np.ndarray, " n"]:
    """Returns one key for each point's cell of a grid."""
    return row_keys(np.round(points / size).astype(np.int64))


def _distinct(position: Faces) -> Indices:
    """Returns the indices of faces with three different corners, one for each set of corners, in order."""
    corners = np.sort(position, axis=1)
    whole = np.flatnonzero((corners[:, 0] != corners[:, 1]) & (corners[:, 1] != corners[:, 2]))
    first = first_of_each(row_keys(corners[whole]))[0]
    return whole[np.sort(first)]


def edge_numbers(position: Faces) -> np.ndarray:
    """Returns the number of the undirected edge that starts at each corner, (faces, 3)."""
    end = np.roll(position, -1, axis=1)
    low, high = np.minimum(position, end), np.maximum(position, end)
    return np.unique((low * (int(high.max()) + 1) + high).ravel(), return_inverse=True)[1].reshape(position.shape)


def _oriented_patches(position: Faces, edges: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns each face's patch, whether it must be turned to agree with its patch, and which patches can be oriented.

    Each face stands in the graph twice, as it is and turned. Neighbours that agree are joined like with like, others
    crosswise; a patch can be oriented where its two copies stay apart.
    """
    count, flat = len(position), edges.ravel()
    order = np.argsort(flat, kind="stable")
    shared_twice = np.bincount(flat)[flat[order]] == 2
    first, second = order[shared_twice].reshape(-1, 2).T
    start = position.ravel()
    agree = start[first] != start[second]
    f, g = first // 3, second // 3
    crossed = np.where(agree, 0, count)
    rows, columns = np.concatenate([f, f + count]), np.concatenate([g + crossed, g + count - crossed])
    label = linked(2 * count, rows, columns).reshape(2, count)
    patch = np.unique(label.min(axis=0), return_inverse=True)[1].reshape(-1)
    orientable = np.ones(int(patch.max()) + 1, dtype=bool)
    orientable[patch[label[0] == label[1]]] = False
    return patch, label[0] > label[1], orientable


def _without_border(edges: np.ndarray, patch: np.ndarray, patches: int) -> np.ndarray:
    """Returns for each patch whether its own faces meet in pairs along every edge."""
    # where exactly two faces meet they belong to one patch and close it; only other edges need a look
    flat = edges.ravel()
    odd = np.flatnonzero(np.bincount(flat)[flat] != 2)
    keys, counts = np.unique(flat[odd] * patches + patch[odd // 3], return_counts=True)
    whole = np.ones(patches, dtype=bool)
    whole[keys[counts % 2 == 1] % patches] = False
    return whole


def _tetrahedra(triangles: np.ndarray) -> Scalars:
    """Returns the signed volume between the origin and each triangle."""
    return np.einsum("nd,nd->n", triangles[:, 0], cross(triangles[:, 1], triangles[:, 2])) / 6.0
