"""A surface parted at its inner corners, where its material changes, and between the faces that a viewer sees of it."""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Faces, Vec3, distinct
from grafu.geometry.components import drawn_once, linked, repeated_faces, welded
from grafu.geometry.mesh import TriangleMesh
from grafu.segmentation.surface_config import CreaseConfig
from grafu.shapes import Bool, Float, Int

OfFaces = Int[np.ndarray, " faces"]
OfDrawn = Int[np.ndarray, " drawn"]
_SAME_UV = 1e-4  # of a texture's side: coordinates nearer to each other are one point of it
Members = Int[np.ndarray, " members"]
Edges = Int[np.ndarray, " edges"]
MaskOfFaces = Bool[np.ndarray, " faces"]
MaskOfEdges = Bool[np.ndarray, " edges"]


@final
@dataclass(frozen=True, eq=False, slots=True)
class CreasedSurface:
    """A mesh, the pairs of faces that meet within a patch, and for each face the number of its patch.

    Patches end at inner corners of the surface, and where the number of the material changes. A surface that is drawn
    twice, from both sides, is looked at once: `drawn` has for each face that was given the face of `mesh` it repeats.
    """

    mesh: TriangleMesh
    first: Edges
    second: Edges
    patch: OfFaces
    drawn: OfDrawn

    @classmethod
    def of(cls, mesh: TriangleMesh, material: OfDrawn, config: CreaseConfig) -> "CreasedSurface":
        """Returns a mesh with its patches; `material` is the number of each face's material."""
        if not len(mesh.faces):
            none = np.zeros(0, np.int64)
            return cls(mesh, none, none, none, none)
        mesh, drawn = _once(mesh)
        of_once = np.zeros(len(mesh.faces), np.int64)
        of_once[drawn[::-1]] = material[::-1]  # that of the first face of equal ones
        first, second, is_corner = _edges(mesh, config)
        inside = ~is_corner & (of_once[first] == of_once[second])
        first, second = first[inside], second[inside]
        return cls(mesh, first, second, linked(len(mesh.faces), first, second), drawn)

    def patches(self, towards: Vec3, config: CreaseConfig) -> OfDrawn:
        """Returns for each face the number of its patch, as a viewer sees them from the unit direction `towards`.

        One that shows several faces to the viewer is parted between them: each takes what lies behind its own outline.
        A surface in very many patches is loose triangles, on which nothing is drawn: it stays whole.
        """
        mesh, patch = self.mesh, self.patch
        if not len(mesh.faces):
            return np.zeros(len(self.drawn), np.int64)
        ahead = mesh.face_normals @ towards > config.facing
        both = ahead[self.first] & ahead[self.second]
        facet = linked(len(mesh.faces), self.first[both], self.second[both])
        most = len(mesh.faces)  # facets
        shown = distinct(patch[ahead] * most + facet[ahead]) // most
        counts = np.bincount(shown, minlength=int(patch.max()) + 1)
        number, order = patch.copy(), np.argsort(patch, kind="stable")
        ends = np.searchsorted(patch[order], np.flatnonzero(counts > 1), "right")
        starts = np.searchsorted(patch[order], np.flatnonzero(counts > 1), "left")
        for start, end in zip(starts.tolist(), ends.tolist(), strict=True):
            _part(number, order[start:end], facet, ahead, mesh, towards, config)
        numbers = np.unique(number[self.drawn], return_inverse=True)[1].reshape(-1).astype(np.int64)
        return numbers if int(numbers.max()) < config.most else np.zeros_like(numbers)


def _once(mesh: TriangleMesh) -> tuple[TriangleMesh, OfDrawn]:
    """Returns a mesh without repeated faces, and for each of its faces which of these it repeats.

    What has no area belongs to the first face.
    """
    count = np.arange(len(mesh.faces))
    if np.array_equal(repeated_faces(mesh), count):
        return mesh, count
    once, drawn = drawn_once(mesh)
    return (once, np.maximum(drawn, 0)) if len(once.faces) else (mesh, count)


def uv_islands(mesh: TriangleMesh, uv: Float[np.ndarray, "n 2"]) -> OfFaces:
    """Returns for each face the number of its island: faces that meet in texture space as they do in space."""
    if not len(mesh.faces):
        return np.zeros(0, np.int64)
    corners = np.column_stack([welded(mesh.vertices), np.round(uv / _SAME_UV).astype(np.int64)])
    position = np.unique(corners, axis=0, return_inverse=True)[1].reshape(-1)[mesh.faces]
    first, second, _ = _shared_edges(position)
    return linked(len(mesh.faces), first, second)


def _part(
    number: OfFaces,
    members: Members,
    facet: OfFaces,
    ahead: MaskOfFaces,
    mesh: TriangleMesh,
    towards: Vec3,
    config: CreaseConfig,
) -> None:
    """Gives new numbers to the faces of a patch that shows several faces; what is behind none of them keeps its own."""
    across = mesh.vertices[mesh.faces[members]] @ np.stack([np.cross((0.0, 0.0, 1.0), towards), (0.0, 0.0, 1.0)]).T
    low, high = across.min(axis=1), across.max(axis=1)
    near = config.near * float(mesh.box.size.max())
    is_ahead = ahead[members]
    own = facet[members[is_ahead]]
    number[members[is_ahead]] = len(mesh.faces) + own
    order = np.argsort(own, kind="stable")
    facets, begin = np.unique(own[order], return_index=True)
    left = np.minimum.reduceat(low[is_ahead][order], begin, axis=0) - near
    right = np.maximum.reduceat(high[is_ahead][order], begin, axis=0) + near
    behind = np.flatnonzero(~is_ahead)
    behind = behind[np.argsort(low[behind, 0], kind="stable")]  # so that what may lie in an outline is found at once
    low, high = low[behind], high[behind]
    starts, ends = np.searchsorted(low[:, 0], left[:, 0], "left"), np.searchsorted(low[:, 0], right[:, 0], "right")
    for k, (one, start, end) in enumerate(zip(facets.tolist(), starts.tolist(), ends.tolist(), strict=True)):
        inside = (low[start:end, 1] >= left[k, 1]) & (high[start:end] <= right[k]).all(axis=1)
        number[members[behind[start:end][inside]]] = len(mesh.faces) + one


def _edges(mesh: TriangleMesh, config: CreaseConfig) -> tuple[Edges, Edges, MaskOfEdges]:
    """Returns the pairs of faces that share an edge which no third has, and whether an inner corner runs along it.

    A surface whose normals point inwards as a whole is read inside out; two faces turned opposite ways have no corner.
    """
    position = welded(mesh.vertices)[mesh.faces]
    first, second, agree = _shared_edges(position)
    normals, apart = mesh.face_normals, _reach(mesh, position, first, second)
    outwards = 1.0 if _volume(mesh) >= 0 else -1.0
    rises = outwards * np.einsum("ij,ij->i", apart, normals[first]) > config.rise * np.linalg.norm(apart, axis=1)
    turns = np.einsum("ij,ij->i", normals[first], normals[second]) < np.cos(config.corner)
    return first, second, agree & turns & rises


def _reach(mesh: TriangleMesh, position: Faces, first: Edges, second: Edges) -> Float[np.ndarray, "edges 3"]:
    """Returns how the second face of each pair reaches away from the edge that it shares, at right angles to that.

    Middles of faces would not tell: those of a wide frame lie far from the low wall of a front raised on it.
    """
    shared = (position[second][:, :, None] == position[first][:, None, :]).any(axis=2)
    ahead = np.argmin(shared, axis=1)
    corners, row = mesh.triangles[second], np.arange(len(second))
    tip, start, end = (corners[row, (ahead + k) % 3] for k in range(3))
    along = end - start
    ratio = np.einsum("ij,ij->i", tip - start, along) / np.maximum(np.einsum("ij,ij->i", along, along), 1e-300)
    return tip - start - ratio[:, None] * along


def _shared_edges(position: Faces) -> tuple[Edges, Edges, MaskOfEdges]:
    """Returns the pairs of faces that share an edge which no third has, and whether the two are turned one way."""
    start, end = position.ravel(), np.roll(position, -1, axis=1).ravel()
    low, high = np.minimum(start, end), np.maximum(start, end)
    key = low * (int(high.max()) + 1) + high
    order = np.argsort(key, kind="stable")
    begin = np.flatnonzero(np.r_[True, np.diff(key[order]) != 0])
    pairs = begin[np.diff(np.r_[begin, len(key)]) == 2]
    one, other = order[pairs], order[pairs + 1]
    return one // 3, other // 3, start[one] != start[other]


def _volume(mesh: TriangleMesh) -> float:
    corners = mesh.triangles - mesh.box.center
    a, b, c = (corners[:, k] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum())
