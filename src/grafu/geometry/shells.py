"""One mesh of many bodies is sorted into shells: boards that only touch stay apart."""

from collections.abc import Sequence

import numpy as np

from grafu.geometry.arrays import Indices, counters, distinct, frozen_array
from grafu.geometry.components import OF_PIECE, cells_of, edge_numbers, first_alike, linked
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.remembered import RememberedByContent
from grafu.shapes import Bool, Int

_REMEMBERED = 3_000_000  # faces whose numbers are kept by content: one stage after another asks for them. 24 MB
_by_content: RememberedByContent[Indices] = RememberedByContent(_REMEMBERED)
_LARGE = 2000  # faces: numbers of larger meshes are kept by themselves, and found again whatever is beside them
_FLAT = 1e-6  # how far normals of one plane differ
_OfFaces = Int[np.ndarray, " _"]
_Sides = Int[np.ndarray, " sides"]
_Edges = Int[np.ndarray, "n 3"]
_Mask = Bool[np.ndarray, " n"]
_OfEdges = Int[np.ndarray, " e"]
_MaskOfEdges = Bool[np.ndarray, " e"]


def shell_numbers(*meshes: TriangleMesh) -> Indices:
    """Returns for each face, mesh after mesh, the number of the shell it belongs to, in order of first faces.

    Vertices within a millionth of the mesh's largest side are one. Faces belong together across edges that exactly two
    of them share, so bodies that have a corner or an edge in common are two shells; faces drawn twice count once.
    """
    apart = [mesh for mesh in meshes if len(mesh.faces) > _LARGE] if len(meshes) > 1 else []
    if not apart:
        return _known_numbers(meshes)
    small = [mesh for mesh in meshes if len(mesh.faces) <= _LARGE]
    ends = np.cumsum([len(mesh.faces) for mesh in small])
    parts = iter(np.split(_known_numbers(small), ends[:-1]) if small else ())
    found, count = [], 0
    for mesh in meshes:
        own = _known_numbers([mesh]) if len(mesh.faces) > _LARGE else next(parts)
        own = own - own.min() if len(own) else own  # those of a mesh follow on those of the mesh before
        found.append(own + count)
        count += int(own.max()) + 1 if len(own) else 0
    return frozen_array(np.concatenate(found), np.int64)


def _known_numbers(meshes: Sequence[TriangleMesh]) -> _OfFaces:
    """Returns the same of meshes whose numbers are kept together."""
    faces = sum(len(mesh.faces) for mesh in meshes)
    if not faces:
        return np.zeros(0, np.int64)
    return _by_content.of(
        lambda: _numbers_of(meshes), faces, *(array for mesh in meshes for array in (mesh.vertices, mesh.faces))
    )


def _numbers_of(meshes: Sequence[TriangleMesh]) -> Indices:
    whole = merge_meshes(meshes)
    position = _welded_apart(meshes)[whole.faces]
    edges, first = edge_numbers(position), first_alike(position)
    distinct = first == np.arange(len(first))
    count = np.bincount(edges[distinct].ravel(), minlength=int(edges.max()) + 1)
    shell = _connected(edges, first, distinct, count)
    shell = _with_caps(whole, edges, shell, (count > 2) & (np.bincount(edges.ravel()) % 2 == 0), count == 2)
    _, begins, number = np.unique(shell, return_index=True, return_inverse=True)
    return frozen_array(np.argsort(np.argsort(begins))[number.reshape(-1)], np.int64)


def _welded_apart(meshes: Sequence[TriangleMesh]) -> Indices:
    """Returns for each vertex, mesh after mesh, the number of its position; two meshes have no position in common."""
    sizes = [float(max(mesh.box.size.max(), 1e-300)) if len(mesh.faces) else 1.0 for mesh in meshes]
    of = np.repeat(np.arange(len(meshes)), [len(mesh.vertices) for mesh in meshes])
    scaled = np.concatenate([mesh.vertices for mesh in meshes]) / np.array(sizes)[of, None]
    return np.unique(cells_of(scaled, 1e-6) + of * OF_PIECE, return_inverse=True)[1].reshape(-1)


def _connected(edges: _Edges, first: Indices, distinct: _Mask, count: _OfEdges) -> Indices:
    """Returns the number of each face's patch: across edges of two distinct faces, a repeated face with its first."""
    owner, edge = np.repeat(np.flatnonzero(distinct), 3), edges[distinct].ravel()
    order = np.argsort(edge, kind="stable")
    pairs = owner[order][count[edge[order]] == 2].reshape(-1, 2)
    ends = np.concatenate([pairs, np.column_stack([np.arange(len(first)), first])])
    return linked(len(first), ends[:, 0], ends[:, 1])


def _with_caps(
    mesh: TriangleMesh, edges: _Edges, shell: Indices, touching: _MaskOfEdges, inner: _MaskOfEdges
) -> Indices:
    """Returns the numbers with flat patches that only lie between touching bodies given to the body around them."""
    if not touching.any():
        return shell
    loose = touching[edges]
    is_cap = np.ones(int(shell.max()) + 1, dtype=np.bool_)
    np.logical_and.at(is_cap, shell, (loose | inner[edges]).all(axis=1))
    bordered = np.bincount(shell, loose.any(axis=1)) > 0
    begins = np.unique(shell, return_index=True)[1]
    turned = np.abs(np.einsum("nk,nk->n", mesh.face_normals, mesh.face_normals[begins][shell]))
    np.logical_and.at(is_cap, shell, turned > 1 - _FLAT)
    is_cap &= bordered
    return _given_to_most(np.repeat(shell, 3)[loose.ravel()], edges[loose], is_cap)[shell]


def _given_to_most(at: _Sides, edge: _Sides, is_cap: _Mask) -> Indices:
    """Returns for each shell itself, for each cap the other shell that has the most sides at its edges.

    `at` and `edge` are the shell and the edge of each side of a face. Of several the first is taken.
    """
    count, given = len(is_cap), np.arange(len(is_cap))
    caps, others = is_cap[at], ~is_cap[at]
    rims = distinct(edge[caps] * count + at[caps])
    sides = edge[others]
    order = np.argsort(sides, kind="stable")
    starts, ends = (np.searchsorted(sides[order], rims // count, side=side) for side in ("left", "right"))
    met = at[others][order[np.repeat(starts, ends - starts) + counters(ends - starts)]]
    pairs, number = np.unique(np.repeat(rims % count, ends - starts) * count + met, return_counts=True)
    best = np.lexsort((pairs, -number, pairs // count))
    cap, first = np.unique(pairs[best] // count, return_index=True)
    given[cap] = pairs[best][first] % count
    return given
