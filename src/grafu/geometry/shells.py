"""One mesh of many bodies sorted into shells, by positions alone: boards that only touch stay apart. No materials."""

import numpy as np
from jaxtyping import Bool, Int
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from grafu.geometry.arrays import Indices
from grafu.geometry.components import repeated_faces, welded
from grafu.geometry.mesh import TriangleMesh

_FLAT = 1e-6  # how far normals of one plane differ
_Edges = Int[np.ndarray, "n 3"]
_Mask = Bool[np.ndarray, " n"]
_OfEdges = Int[np.ndarray, " e"]
_MaskOfEdges = Bool[np.ndarray, " e"]


def shell_numbers(mesh: TriangleMesh) -> Indices:
    """Returns for each face the number of the shell it belongs to, in order of first faces.

    Vertices within a millionth of the mesh's largest side are one. Faces belong together across edges that exactly two
    of them share, so bodies that have a corner or an edge in common are two shells; faces drawn twice count once.
    """
    if not len(mesh.faces):
        return np.zeros(0, np.int64)
    scaled = TriangleMesh(mesh.vertices / float(max(mesh.box.size.max(), 1e-300)), mesh.faces)
    edges, first = _edge_numbers(scaled), repeated_faces(scaled)
    distinct = first == np.arange(len(first))
    count = np.bincount(edges[distinct].ravel(), minlength=int(edges.max()) + 1)
    shell = _connected(edges, first, distinct, count)
    shell = _with_caps(mesh, edges, shell, (count > 2) & (np.bincount(edges.ravel()) % 2 == 0), count == 2)
    _, begins, number = np.unique(shell, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(begins))[number.reshape(-1)].astype(np.int64)


def _edge_numbers(mesh: TriangleMesh) -> _Edges:
    """Returns the number of the undirected edge that starts at each corner."""
    position = welded(mesh.vertices)[mesh.faces]
    end = np.roll(position, -1, axis=1)
    low, high = np.minimum(position, end), np.maximum(position, end)
    keys = (low * (int(position.max()) + 1) + high).ravel()
    return np.unique(keys, return_inverse=True)[1].reshape(position.shape)


def _connected(edges: _Edges, first: Indices, distinct: _Mask, count: _OfEdges) -> Indices:
    """Returns the number of each face's patch: across edges of two distinct faces, a repeated face with its first."""
    owner, edge = np.repeat(np.flatnonzero(distinct), 3), edges[distinct].ravel()
    order = np.argsort(edge, kind="stable")
    pairs = owner[order][count[edge[order]] == 2].reshape(-1, 2)
    ends = np.concatenate([pairs, np.column_stack([np.arange(len(first)), first])])
    graph = coo_matrix((np.ones(len(ends), np.int8), (ends[:, 0], ends[:, 1])), (len(first), len(first)))
    return connected_components(graph, directed=False)[1].astype(np.int64)


def _with_caps(
    mesh: TriangleMesh, edges: _Edges, shell: Indices, touching: _MaskOfEdges, inner: _MaskOfEdges
) -> Indices:
    """Returns the numbers with flat patches that only lie between touching bodies given to the body around them."""
    loose = touching[edges]
    is_cap = np.ones(int(shell.max()) + 1, dtype=np.bool_)
    np.logical_and.at(is_cap, shell, (loose | inner[edges]).all(axis=1))
    bordered = np.bincount(shell, loose.any(axis=1)) > 0
    begins = np.unique(shell, return_index=True)[1]
    turned = np.abs(np.einsum("nk,nk->n", mesh.face_normals, mesh.face_normals[begins][shell]))
    np.logical_and.at(is_cap, shell, turned > 1 - _FLAT)
    is_cap &= bordered
    at, edge = np.repeat(shell, 3)[loose.ravel()], edges[loose]
    given = np.arange(len(is_cap))
    for cap in np.flatnonzero(is_cap):
        around = at[np.isin(edge, edge[at == cap]) & ~is_cap[at]]
        given[cap] = np.bincount(around).argmax() if len(around) else cap
    return given[shell]
