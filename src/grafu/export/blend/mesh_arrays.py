"""One visual as the arrays that Blender wants of a mesh. It does not know Blender, and no links.

Many models hold every face twice, back to back, so that it shows from both sides. Cycles renders such faces black, each
in the other's shadow: here they are one face, of a material that shows from both sides. Other faces with the same
corners get corners of their own, for Blender refuses two faces that share all.
"""

from functools import partial
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual
from grafu.dataclass import dataclass
from grafu.export.shading import CREASE_ANGLE, corner_normals
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import ArrayValue, Vec3, freeze_arrays
from grafu.geometry.components import welded
from grafu.shapes import Float, Int


@final
@dataclass(frozen=True, slots=True)
class BlendMaterial:
    """A material, whether its images can be seen (there are texture coordinates), and whether vertices have colours."""

    material: Material
    textured: bool
    colored: bool


@final
@dataclass(frozen=True, eq=False, slots=True)
class MeshArrays(ArrayValue):
    """A mesh in metres, parallel to the object frame, around its link's origin.

    `material_index` indexes `materials` for each face. `normals` are unit vectors, one per corner of each face, in
    order; so are `uv` (origin bottom left; None where no surface has any). `colors` are linear RGBA in 0..1 per vertex,
    or None. Materials in `doubled` are of faces that the visual holds back to back: they must show from both sides.
    """

    vertices: Float[np.ndarray, "vertex 3"]
    faces: Int[np.ndarray, "face 3"]
    material_index: Int[np.ndarray, " face"]
    materials: tuple[BlendMaterial, ...]
    normals: Float[np.ndarray, "corner 3"]
    uv: Float[np.ndarray, "corner 2"] | None = None
    colors: Float[np.ndarray, "vertex 4"] | None = None
    doubled: frozenset[BlendMaterial] = frozenset()

    def __post_init__(self) -> None:
        freeze_arrays(self)


def mesh_arrays(visual: Visual, origin: Vec3) -> MeshArrays:
    """Returns the mesh of a visual; `origin` (object frame, metres) becomes zero. It may have no faces."""
    surfaces = [surface for surface in visual.surfaces if not surface.is_empty]
    materials = tuple(dict.fromkeys(_material_of(surface) for surface in surfaces))
    pieces = [_piece(surface, materials.index(_material_of(surface))) for surface in surfaces]
    whole = _joined(pieces)
    kept, doubled = _single(whole)
    own, faces = _apart(whole.faces[kept])
    colored, mapped = any(s.colors is not None for s in surfaces), any(s.uv is not None for s in surfaces)
    return MeshArrays(
        whole.vertices[own] - origin,
        faces,
        whole.material_index[kept],
        materials,
        whole.normals[kept].reshape(-1, 3),
        whole.uv[whole.faces[kept]].reshape(-1, 2) if mapped else None,
        whole.colors[own] if colored else None,
        frozenset(materials[k] for k in doubled),
    )


@dataclass(frozen=True, eq=False, slots=True)
class _Piece:
    """What belongs to each vertex, each face (`material_index`) and its corners (`normals`: face, corner, 3)."""

    vertices: np.ndarray
    faces: np.ndarray
    material_index: np.ndarray
    normals: np.ndarray
    uv: np.ndarray
    colors: np.ndarray


def _material_of(surface: Surface) -> BlendMaterial:
    material = surface.material
    images = (
        material.base_color_texture,
        material.metallic_roughness_texture,
        material.normal_texture,
        material.occlusion_texture,
        material.emissive_texture,
    )
    return BlendMaterial(material, surface.uv is not None and any(images), surface.colors is not None)


def _piece(surface: Surface, index: int) -> _Piece:
    mesh, shading = surface.mesh, corner_normals(surface, CREASE_ANGLE)
    faces, count = np.asarray(mesh.faces), len(mesh.vertices)
    whole = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    return _Piece(
        mesh.vertices,
        faces[whole],
        np.full(int(whole.sum()), index, dtype=np.int64),
        shading.normals[np.asarray(shading.corners)[whole]],
        np.zeros((count, 2)) if surface.uv is None else _tame(surface.uv),
        np.ones((count, 4)) if surface.colors is None else surface.colors / 255.0,
    )


def _joined(pieces: list[_Piece]) -> _Piece:
    starts = np.cumsum([0, *(len(piece.vertices) for piece in pieces)])
    return _Piece(
        np.concatenate([np.zeros((0, 3)), *(piece.vertices for piece in pieces)]),
        np.concatenate([_NO_FACES, *(p.faces + start for p, start in zip(pieces, starts[:-1], strict=True))]),
        np.concatenate([_NO_FACES[:, 0], *(piece.material_index for piece in pieces)]),
        np.concatenate([np.zeros((0, 3, 3)), *(piece.normals for piece in pieces)]),
        np.concatenate([np.zeros((0, 2)), *(piece.uv for piece in pieces)]),
        np.concatenate([np.zeros((0, 4)), *(piece.colors for piece in pieces)]),
    )


_NO_FACES = np.zeros((0, 3), dtype=np.int64)


def _single(whole: _Piece) -> tuple[np.ndarray, set[int]]:
    """Returns the faces to keep, in order, one of each place and material; and the materials of pairs back to back.

    Of two back to back the one is kept whose like face outward on the whole.
    """
    if not len(whole.faces):
        return np.zeros(0, dtype=np.int64), set()
    place = np.sort(welded(whole.vertices)[whole.faces], axis=1)
    _, index = np.unique(np.c_[place, whole.material_index], axis=0, return_inverse=True)
    index = index.reshape(-1)
    first, last = np.full(index.max() + 1, len(index)), np.zeros(index.max() + 1, dtype=np.int64)
    np.minimum.at(first, index, np.arange(len(index)))
    np.maximum.at(last, index, np.arange(len(index)))
    corners = whole.vertices[whole.faces]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    opposite = np.einsum("fd,fd->f", cross[first], cross[last]) < 0
    outward = np.einsum("fd,fd->f", corners.mean(axis=1) - corners.mean(axis=(0, 1)), cross)
    turn = opposite & (outward[first][opposite].sum() < 0)
    return np.sort(np.where(turn, last, first)), set(whole.material_index[first[opposite]].tolist())


def _apart(faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the vertices that are used, some repeatedly, and faces of them no two of which share all corners."""
    own, index = np.unique(faces, return_inverse=True)
    apart = index.reshape(-1, 3)
    _, first = np.unique(np.sort(apart, axis=1), axis=0, return_index=True)
    again = np.setdiff1d(np.arange(len(faces)), first)
    apart[again] = len(own) + np.arange(3 * len(again)).reshape(-1, 3)
    return np.concatenate([own, faces[again].ravel()]), apart


_finite = partial(np.nan_to_num, nan=0.0, posinf=0.0, neginf=0.0)


def _tame(uv: np.ndarray) -> np.ndarray:
    return np.clip(_finite(uv), -1e6, 1e6)
