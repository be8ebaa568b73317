"""What a picture is taken of: all triangles with their looks in flat arrays, and rays against them (Embree).

Everything is 32-bit: pictures need no more and twice as much would be slow.
"""

from collections.abc import Callable, Sequence
from functools import lru_cache
from io import BytesIO
from typing import final

import numpy as np
from PIL import Image

from grafu.articulation.articulated_object import Visual
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.budget import require_time
from grafu.geometry.raycast import embree_scene
from grafu.shapes import Bool, Float32, Int, Int32

Rays = Float32[np.ndarray, "n 3"]
Values = Float32[np.ndarray, " n"]
_GREY = 0.5  # what stands for an image that cannot be decoded
_TEXTURE_LIMIT = 512  # pixels a side: a picture of a whole piece of furniture shows no more


@final
@dataclass(frozen=True, eq=False, slots=True)
class Hits:
    """Where rays met surfaces, one row per ray that did.

    `ray` is the row of the ray, `visual` the index of the visual, `normal` the shading normal towards the viewer,
    `color` linear RGB without light, `alpha` opacity.
    """

    ray: Int[np.ndarray, " n"]
    distance: Values
    visual: Int[np.ndarray, " n"]
    normal: Rays
    flat_normal: Rays
    color: Rays
    alpha: Values
    metallic: Values
    roughness: Values

    def chosen(self, rows: np.ndarray) -> "Hits":
        """Returns the hits in some rows, given by number or by a mask."""
        return Hits(*(getattr(self, name)[rows] for name in self.__dataclass_fields__))


@final
class RayScene:
    """Triangles ready for rays, and the ends of the box around them. Built once per pose; it never changes after."""

    def __init__(self, visuals: Sequence[Visual]) -> None:
        rows = [(k, s) for k, v in enumerate(visuals) for s in v.surfaces if not s.is_empty]
        self._materials: list[Material] = list(dict.fromkeys(s.material for _, s in rows))
        index = {m: k for k, m in enumerate(self._materials)}
        counts = [len(s.mesh.faces) for _, s in rows]
        self._visual = np.repeat(np.array([k for k, _ in rows], np.int32), counts)
        self._material = np.repeat(np.array([index[s.material] for _, s in rows], np.int32), counts)
        surfaces = [s for _, s in rows]
        textured = any(material.base_color_texture for material in self._materials)
        self._colored = any(s.colors is not None for s in surfaces)
        boxes = [surface.mesh.box for surface in surfaces]
        self.is_empty = not boxes
        self.low: np.ndarray = np.min([box.low for box in boxes] or [np.zeros(3)], axis=0).astype(np.float32)
        self.high: np.ndarray = np.max([box.high for box in boxes] or [np.ones(3)], axis=0).astype(np.float32)
        self._flat: np.ndarray = _stacked(surfaces, lambda s: s.mesh.face_normals, 3)
        self._is_shaded = any(s.normals is not None for s in surfaces)
        self._normals: np.ndarray = _stacked(surfaces if self._is_shaded else [], _corner_normals, 3, 3)
        self._colors: np.ndarray = _stacked(surfaces if self._colored else [], _corner_colors, 3, 4)
        self._uvs: np.ndarray = _stacked(surfaces if textured else [], _corner_uvs, 3, 2)
        self._table = _material_table(self._materials)
        self._images = {k: _decode(m.base_color_texture) for k, m in enumerate(self._materials) if m.base_color_texture}
        vertices, faces = _mesh_of(surfaces)
        self._embree = embree_scene(vertices, faces)
        solid = self._table[self._material, 6] >= 0  # light goes through what is blended: glass casts no shadow
        self._solid = self._embree if solid.all() else embree_scene(vertices, faces[solid])

    def cast(self, origins: Rays, directions: Rays) -> Hits:
        """Returns what each ray meets first; directions are unit vectors."""
        found = self._embree.run(origins, directions, query="INTERSECT", output=True)
        ray = np.flatnonzero(found["primID"] >= 0) if not self.is_empty else np.zeros(0, np.int64)
        face = found["primID"][ray]
        u, v = found["u"][ray], found["v"][ray]
        weights = np.stack([1 - u - v, u, v], axis=1)
        flat = _toward(-directions[ray], self._flat[face])
        corners = self._normals[face] if self._is_shaded else np.repeat(self._flat[face][:, None], 3, axis=1)
        normal = _unit(_toward(flat, _blend(weights, corners)))
        rgba = self._rgba(face, weights)
        table = self._table[self._material[face]]
        parts = (flat, rgba[:, :3], rgba[:, 3], table[:, 4], table[:, 5])
        return Hits(ray, found["tfar"][ray], self._visual[face], normal, *parts)

    def blocked(self, origins: Rays, directions: Rays, reach: float) -> Bool[np.ndarray, " n"]:
        """Whether something lies on each ray within `reach` times its direction's length."""
        if self.is_empty:
            return np.zeros(len(origins), bool)
        limit = np.full(len(origins), reach, np.float32)
        return self._solid.run(origins, directions, limit, query="OCCLUDED") == 0

    def _rgba(self, face: np.ndarray, weights: np.ndarray) -> np.ndarray:
        material = self._material[face]
        rgba = self._table[material, :4]
        if self._colored:
            rgba *= _blend(weights, self._colors[face])
        for k, image in self._images.items():
            rows = np.flatnonzero(material == k)
            rgba[rows] *= _sample(image, _blend(weights[rows], self._uvs[face[rows]]))
        cutoff = self._table[material, 6]
        rgba[:, 3] = np.where(cutoff >= 0, rgba[:, 3] >= cutoff, rgba[:, 3])
        return rgba


def _mesh_of(surfaces: Sequence[Surface]) -> tuple[Rays, Int32[np.ndarray, "m 3"]]:
    """Returns the vertices and faces of all surfaces as one mesh; one triangle without area, where there is none."""
    meshes = [surface.mesh for surface in surfaces]
    if not meshes:
        return np.zeros((3, 3), np.float32), np.arange(3, dtype=np.int32)[None]
    first = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes[:-1])])
    vertices = np.concatenate([mesh.vertices for mesh in meshes], dtype=np.float32, casting="same_kind")
    faces = np.concatenate([mesh.faces + start for mesh, start in zip(meshes, first.tolist(), strict=True)])
    return vertices, faces.astype(np.int32)


def _stacked(surfaces: Sequence[Surface], values: Callable[[Surface], np.ndarray], *tail: int) -> np.ndarray:
    """Returns the values of each face of all surfaces as one array of 32 bits, filled one surface after the other."""
    made = np.empty((sum(len(surface.mesh.faces) for surface in surfaces), *tail), np.float32)
    start = 0
    for surface in surfaces:
        require_time()
        end = start + len(surface.mesh.faces)
        made[start:end] = values(surface)
        start = end
    return made


def _corner_normals(surface: Surface) -> np.ndarray:
    if surface.normals is None:
        return np.repeat(surface.mesh.face_normals[:, None], 3, axis=1)
    return surface.normals[surface.mesh.faces]


def _corner_colors(surface: Surface) -> np.ndarray:
    if surface.colors is None:
        return np.ones((len(surface.mesh.faces), 3, 4))
    return surface.colors[surface.mesh.faces] / 255.0


def _corner_uvs(surface: Surface) -> np.ndarray:
    if surface.uv is None:
        return np.zeros((len(surface.mesh.faces), 3, 2))
    return surface.uv[surface.mesh.faces]


def _material_table(materials: list[Material]) -> np.ndarray:
    """Returns per material: RGBA, metallic, roughness, alpha cutoff (-1: alpha is blended, 0: it is opaque)."""
    rows = []
    for m in materials:
        cutoff = {"OPAQUE": 0.0, "MASK": m.alpha_cutoff, "BLEND": -1.0}[m.alpha_mode]
        rows.append([*m.base_color, m.metallic, m.roughness, cutoff])
    return np.array(rows, dtype=np.float32).reshape(-1, 7)


_RATIO = np.arange(256, dtype=np.float32) / np.float32(255.0)
_LINEAR = _RATIO**2.2


@lru_cache(maxsize=8)  # the pictures of a page show the same images
def _decode(texture: Texture) -> np.ndarray:
    """Returns an image as linear RGBA in 0..1, at most `_TEXTURE_LIMIT` pixels a side; one that is broken is grey.

    Readers let no broken image in (`asset/resources.py`); who makes an object by hand may.
    """
    try:
        with Image.open(BytesIO(texture.data)) as image:
            rgba = image.convert("RGBA")
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError):
        return np.array([[[_GREY, _GREY, _GREY, 1.0]]], dtype=np.float32)
    rgba.thumbnail((_TEXTURE_LIMIT, _TEXTURE_LIMIT))
    values = np.asarray(rgba)
    return np.concatenate([_LINEAR[values[..., :3]], _RATIO[values[..., 3:]]], axis=-1)


def _sample(image: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """Returns the nearest texel; coordinates repeat, and v = 0 is the image's bottom."""
    height, width = image.shape[:2]
    column = np.floor(np.mod(uv[:, 0], 1.0) * width).astype(int).clip(0, width - 1)
    row = np.floor(np.mod(-uv[:, 1], 1.0) * height).astype(int).clip(0, height - 1)
    return image[row, column]


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.sqrt(np.maximum(np.einsum("nk,nk->n", vectors, vectors), 1e-30))[:, None]


def _toward(reference: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Returns the vectors, turned round where they point away from the reference."""
    return vectors * np.where(np.einsum("nk,nk->n", vectors, reference) < 0, np.float32(-1), np.float32(1))[:, None]


def _blend(weights: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Returns the barycentric mean of corner values, (n, 3 corners, k)."""
    return sum(weights[:, c, None] * corners[:, c] for c in range(3))
