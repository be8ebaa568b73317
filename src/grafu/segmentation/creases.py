"""What is cut where no front is a shell: fronts drawn on a welded surface, and the lid of what is called a chest.

A groove, a step or another material parts a drawn front from its case.

The foot of a groove around a door, or the corner where a raised or sunk front meets its frame, is an inner corner; the
outer edges of a case and of a front are none. So a surface that is parted at its inner corners, and where its material
changes, has each front as a patch, with the edges that it has.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Faces, Indices, Vec3
from grafu.geometry.components import linked, welded
from grafu.geometry.mesh import TriangleMesh
from grafu.segmentation.config import SegmentationConfig
from grafu.segmentation.division import FacePiece, FoundFronts, fronts_by_object
from grafu.segmentation.fronts import FrontShells
from grafu.segmentation.hidden_fronts import outline
from grafu.segmentation.mesh_shells import MeshShells, axes_from
from grafu.segmentation.surface_config import CreaseConfig
from grafu.segmentation.surroundings import within
from grafu.segmentation.view import ShellsView
from grafu.shapes import Bool, Float, Int

OfFaces = Int[np.ndarray, " faces"]
_SAME_UV = 1e-4  # of a texture's side: coordinates nearer to each other are one point of it
Members = Int[np.ndarray, " members"]
Edges = Int[np.ndarray, " edges"]
MaskOfFaces = Bool[np.ndarray, " faces"]
MaskOfEdges = Bool[np.ndarray, " edges"]


def drawn_fronts(
    meshes: Sequence[TriangleMesh],
    open_to: Sequence[bool],
    materials: Sequence[Indices],
    config: SegmentationConfig = SegmentationConfig(),
    shells: MeshShells | None = None,
) -> dict[int, list[FacePiece]]:
    """Returns for each mesh on which fronts are drawn what it is cut into, as it is seen from its best side.

    Only clear fronts count: several of one mesh, or one with a handle. `FacePiece.towards` is where they look.

    Args:
        meshes: the objects of an input, Z up, their front most likely at -Y; any unit.
        open_to: which of them may be cut.
        materials: for each mesh the number of each face's material.
        config: the thresholds.
        shells: those of the meshes, where they are known.
    """
    if not any(len(mesh.faces) and is_open for mesh, is_open in zip(meshes, open_to, strict=True)):
        return {}
    whole = shells or MeshShells.of(meshes)
    surfaces = [CreasedSurface.of(mesh, m, config.creases) for mesh, m in zip(meshes, materials, strict=True)]
    most = 0.0
    pieces: dict[int, list[FacePiece]] = {}
    for turn in range(4):
        axes = axes_from(turn)
        patches = [surface.patches(axes[2], config.creases) for surface in surfaces]
        parted = whole.parted(patches)
        view = parted.seen(axes)
        may = np.asarray(open_to)[parted.owner] & ~_is_in_edge(view, whole, config)
        found = fronts_by_object(view, may, [False] * len(meshes), config)
        clear = found.clear(config.division)
        area = sum(outline(view, front) for fronts in clear.values() for front in fronts)
        if area > most:
            most = area
            pieces = FoundFronts(_trimmed(clear, view, config.creases), {}, turn=turn).pieces(parted)
        if pieces:
            break  # the front is most likely at -Y: other sides count only where it shows none
    return {k: [replace(p, is_sheet=p.role == "front") for p in found] for k, found in sorted(pieces.items())}


def _is_in_edge(view: ShellsView, whole: MeshShells, config: SegmentationConfig) -> Bool[np.ndarray, " shells"]:
    """Whether each patch is too thick for a front, and a piece of the edge of a lying board: a lid or a worktop.

    A drawer that is drawn as one body is as low, and its patch has most of its outline.
    """
    of = np.zeros(len(view.owner), np.int64)
    of[view.shell] = whole.shell
    low, high = np.full((len(whole.owner), 3), np.inf), np.full((len(whole.owner), 3), -np.inf)
    np.minimum.at(low, of, view.low)
    np.maximum.at(high, of, view.high)
    size, plate = (high - low)[of], config.candidates.plate
    lies = size[:, 1] <= plate * size[:, ::2].min(axis=1)
    is_piece = view.size[:, :2].prod(axis=1) < config.creases.main * size[:, :2].prod(axis=1)
    return np.asarray(lies & is_piece & (view.size[:, 2] > plate * view.size[:, :2].min(axis=1)))


def drawn_handles(
    meshes: Sequence[TriangleMesh],
    plates: Sequence[bool],
    materials: Sequence[Indices],
    config: SegmentationConfig = SegmentationConfig(),
    shells: MeshShells | None = None,
) -> dict[int, list[FacePiece]]:
    """Returns for each plate with a handle drawn on its surface, or two, that plate without them, and these.

    They stand out farther than mouldings do. See `drawn_fronts`; `plates` tells which meshes may be such, `shells` are
    those of all.
    """
    if not any(plates):
        return {}
    kept, found = np.asarray(plates), dict[int, list[FacePiece]]()
    whole = shells or MeshShells.of(meshes)
    surfaces = {k: CreasedSurface.of(meshes[k], materials[k], config.creases) for k in np.flatnonzero(kept).tolist()}
    for turn in range(4):
        axes = axes_from(turn)
        patches = [np.zeros(len(mesh.faces), np.int64) for mesh in meshes]
        for k, surface in surfaces.items():
            patches[k] = surface.patches(axes[2], config.creases)
        if not any(patch.any() for patch in patches):
            continue
        parted = whole.parted(patches)
        view = parted.seen(axes)
        single = fronts_by_object(view, kept[parted.owner], [False] * len(meshes), config).with_handles
        single = {k: front for k, front in single.items() if _stand_out(view, front, config.creases)}
        found |= FoundFronts({}, single).pieces(parted)
        if found:
            break
    return found


def _stand_out(view: ShellsView, front: FrontShells, config: CreaseConfig) -> bool:
    """Whether all handles of a front stand out of it far enough."""
    for handle in front.handles:
        low, high = view.low[[*handle]].min(axis=0), view.high[[*handle]].max(axis=0)
        out = float(high[2] - view.high[front.shells[0], 2])
        if out < config.stand_out * float((high - low)[:2].min()):
            return False
    return True


def _trimmed(
    found: Mapping[int, tuple[FrontShells, ...]], view: ShellsView, config: CreaseConfig
) -> dict[int, tuple[FrontShells, ...]]:
    """Returns fronts without what reaches beyond the outline of their plate: the groove around it stays in its case."""
    near = config.near * float((view.high.max(axis=0) - view.low.min(axis=0)).max())
    return {
        owner: tuple(
            replace(front, shells=tuple(s for s in front.shells if s == front.shells[0] or inner[s]))
            for front in fronts
            for inner in (within(view, front.shells[0], near),)
        )
        for owner, fronts in found.items()
    }


@final
@dataclass(frozen=True, eq=False, slots=True)
class CreasedSurface:
    """A mesh, the pairs of faces that meet within a patch, and for each face the number of its patch.

    Patches end at inner corners of the surface, and where the number of the material changes.
    """

    mesh: TriangleMesh
    first: Edges
    second: Edges
    patch: OfFaces

    @classmethod
    def of(cls, mesh: TriangleMesh, material: OfFaces, config: CreaseConfig) -> "CreasedSurface":
        """Returns a mesh with its patches; `material` is the number of each face's material."""
        if not len(mesh.faces):
            none = np.zeros(0, np.int64)
            return cls(mesh, none, none, none)
        first, second, is_corner = _edges(mesh, config)
        inside = ~is_corner & (material[first] == material[second])
        first, second = first[inside], second[inside]
        return cls(mesh, first, second, linked(len(mesh.faces), first, second))

    def patches(self, towards: Vec3, config: CreaseConfig) -> OfFaces:
        """Returns for each face the number of its patch, as a viewer sees them from the unit direction `towards`.

        One that shows several faces to the viewer is parted between them: each takes what lies behind its own outline.
        """
        mesh, patch = self.mesh, self.patch
        if not len(mesh.faces):
            return patch
        ahead = mesh.face_normals @ towards > config.facing
        both = ahead[self.first] & ahead[self.second]
        facet = linked(len(mesh.faces), self.first[both], self.second[both])
        shown = np.unique(np.column_stack([patch[ahead], facet[ahead]]), axis=0)
        counts = np.bincount(shown[:, 0], minlength=int(patch.max()) + 1)
        number, order = patch.copy(), np.argsort(patch, kind="stable")
        ends = np.searchsorted(patch[order], np.flatnonzero(counts > 1), "right")
        starts = np.searchsorted(patch[order], np.flatnonzero(counts > 1), "left")
        for start, end in zip(starts.tolist(), ends.tolist(), strict=True):
            _part(number, order[start:end], facet, ahead, mesh, towards, config)
        return np.unique(number, return_inverse=True)[1].reshape(-1).astype(np.int64)


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
