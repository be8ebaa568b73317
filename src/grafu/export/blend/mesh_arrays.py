"""One visual as the arrays that Blender wants of a mesh. It does not know Blender, and no links.

Blender refuses two faces with the same corners; doubled faces, which real models have, get corners of their own.
"""

from dataclasses import dataclass
from functools import partial
from typing import final

import numpy as np
from jaxtyping import Float, Int

from grafu.articulation.articulated_object import Visual
from grafu.export.shading import CREASE_ANGLE, corner_normals
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import ArrayValue, Vec3, freeze_arrays


@final
@dataclass(frozen=True, slots=True)
class Look:
    """A material, and whether the surface that wears it has texture coordinates and vertex colours."""

    material: Material
    textured: bool
    colored: bool


@final
@dataclass(frozen=True, eq=False, slots=True)
class MeshArrays(ArrayValue):
    """A mesh in metres, parallel to the object frame, around its link's origin.

    `look` indexes `looks` for each face. `normals` are unit vectors, one per corner of each face, in order; so are `uv`
    (origin bottom left; None where no surface has any). `colors` are linear RGBA in 0..1 per vertex, or None.
    """

    vertices: Float[np.ndarray, "vertex 3"]
    faces: Int[np.ndarray, "face 3"]
    look: Int[np.ndarray, " face"]
    looks: tuple[Look, ...]
    normals: Float[np.ndarray, "corner 3"]
    uv: Float[np.ndarray, "corner 2"] | None = None
    colors: Float[np.ndarray, "vertex 4"] | None = None

    def __post_init__(self) -> None:
        freeze_arrays(self)


def mesh_arrays(visual: Visual, origin: Vec3) -> MeshArrays:
    """Returns the mesh of a visual; `origin` (object frame, metres) becomes zero. It may have no faces."""
    surfaces = [surface for surface in visual.surfaces if not surface.is_empty]
    pieces = [_piece(surface, origin) for surface in surfaces]
    looks = tuple(dict.fromkeys(_look(surface) for surface in surfaces))
    starts = np.cumsum([0, *(len(vertices) for vertices, *_ in pieces)])[:-1]
    counts = [len(faces) for _, faces, *_ in pieces]
    faces = [faces + start for (_, faces, *_), start in zip(pieces, starts, strict=True)]
    return MeshArrays(
        _stacked([vertices for vertices, *_ in pieces], 3),
        _stacked(faces, 3).astype(np.int64),
        np.repeat(np.array([looks.index(_look(s)) for s in surfaces], dtype=np.int64), counts),
        looks,
        _stacked([normals for *_, normals in pieces], 3),
        _corner_uv(surfaces, pieces) if any(s.uv is not None for s in surfaces) else None,
        _colors(surfaces, pieces) if any(s.colors is not None for s in surfaces) else None,
    )


_Piece = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]
"""Vertices, faces, the surface's own vertex behind each vertex, and the normal of each corner."""


def _look(surface: Surface) -> Look:
    return Look(surface.material, surface.uv is not None, surface.colors is not None)


def _piece(surface: Surface, origin: Vec3) -> _Piece:
    shading = corner_normals(surface, CREASE_ANGLE)
    faces, corners = np.asarray(surface.mesh.faces), np.asarray(shading.corners)
    whole = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    faces, normals = faces[whole], shading.normals[corners[whole]].reshape(-1, 3)
    used, index = np.unique(faces, return_inverse=True)
    faces, own = _apart(index.reshape(-1, 3), used)
    return surface.mesh.vertices[own] - origin, faces, own, normals


def _apart(faces: np.ndarray, own: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns faces of which no two have the same three corners, and the surface's own vertex behind each vertex."""
    _, first = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    again = np.setdiff1d(np.arange(len(faces)), first)
    if not len(again):
        return faces, own
    fresh = len(own) + np.arange(3 * len(again)).reshape(-1, 3)
    own = np.concatenate([own, own[faces[again]].ravel()])
    faces = faces.copy()
    faces[again] = fresh
    return faces, own


def _corner_uv(surfaces: list[Surface], pieces: list[_Piece]) -> np.ndarray:
    rows = []
    for surface, (_, faces, own, _) in zip(surfaces, pieces, strict=True):
        uv = np.zeros((len(surface.mesh.vertices), 2)) if surface.uv is None else surface.uv
        rows.append(_tame(uv)[own[faces.ravel()]])
    return _stacked(rows, 2)


def _colors(surfaces: list[Surface], pieces: list[_Piece]) -> np.ndarray:
    rows = []
    for surface, (_, _, own, _) in zip(surfaces, pieces, strict=True):
        white = np.full((len(surface.mesh.vertices), 4), 255.0)
        rows.append((white if surface.colors is None else surface.colors)[own] / 255.0)
    return _stacked(rows, 4)


_finite = partial(np.nan_to_num, nan=0.0, posinf=0.0, neginf=0.0)


def _tame(uv: np.ndarray) -> np.ndarray:
    return np.clip(_finite(uv), -1e6, 1e6)


def _stacked(rows: list[np.ndarray], width: int) -> np.ndarray:
    return np.concatenate(rows) if rows else np.zeros((0, width))
