"""Visuals as glTF tables: meshes, materials and images.

A visual is one mesh with one primitive per surface; each material and each image is written once. Arrays become
accessors over one aligned buffer, or a primitive of them is compressed.
"""

from collections.abc import Mapping
from typing import Any, final

import numpy as np

from grafu.articulation.articulated_object import Visual
from grafu.export.gltf_buffer import VERTEX_DATA, GltfBuffer
from grafu.export.gltf_packing import DracoConfig, add_packed
from grafu.export.shading import corner_normals
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import Points, Vec3, first_of_each

_REPEATING = {"wrapS": 10497, "wrapT": 10497}


@final
class GltfMaterialWriter:
    """Gives every distinct material an index; images go into the buffer byte for byte."""

    def __init__(self, buffer: GltfBuffer) -> None:
        self.materials: list[dict[str, Any]] = []
        self.images: list[dict[str, Any]] = []
        self._buffer = buffer
        self._material_index: dict[tuple[Material, bool], int] = {}
        self._image_index: dict[tuple[bytes, str], int] = {}

    @property
    def tables(self) -> dict[str, list[dict[str, Any]]]:
        """The glTF tables that are not empty."""
        textures = [{"source": k, "sampler": 0} for k in range(len(self.images))]
        samplers: list[dict[str, Any]] = [dict(_REPEATING)] if textures else []
        tables = {"materials": self.materials, "textures": textures, "samplers": samplers, "images": self.images}
        return {name: table for name, table in tables.items() if table}

    def index_of(self, material: Material, textured: bool) -> int:
        """Returns the index of a material; without texture coordinates (`textured` false) it has no textures."""
        key = (material, textured)
        if key not in self._material_index:
            self._material_index[key] = len(self.materials)
            self.materials.append(self._described(material, textured))
        return self._material_index[key]

    def _described(self, material: Material, textured: bool) -> dict[str, Any]:
        def slot(texture: Texture | None) -> dict[str, int] | None:
            return {"index": self._image(texture)} if textured and texture is not None else None

        metallic_roughness = {
            "baseColorFactor": [_ratio(c) for c in material.base_color],
            "metallicFactor": _ratio(material.metallic),
            "roughnessFactor": _ratio(material.roughness),
            "baseColorTexture": slot(material.base_color_texture),
            "metallicRoughnessTexture": slot(material.metallic_roughness_texture),
        }
        described = {
            "name": material.name,
            "pbrMetallicRoughness": _given(metallic_roughness),
            "normalTexture": slot(material.normal_texture),
            "occlusionTexture": slot(material.occlusion_texture),
            "emissiveTexture": slot(material.emissive_texture),
            "emissiveFactor": [_ratio(c) for c in material.emissive] if any(material.emissive) else None,
            "alphaMode": material.alpha_mode if material.alpha_mode != "OPAQUE" else None,
            "alphaCutoff": max(float(material.alpha_cutoff), 0.0) if material.alpha_mode == "MASK" else None,
            "doubleSided": True if material.double_sided else None,
        }
        return _given(described)

    def _image(self, texture: Texture) -> int:
        key = (texture.data, texture.mime)
        if key not in self._image_index:
            self._image_index[key] = len(self.images)
            view = self._buffer.add_bytes(texture.data)
            self.images.append({"name": texture.name, "mimeType": texture.mime, "bufferView": view})
        return self._image_index[key]


def _ratio(value: float) -> float:
    return min(max(float(value), 0.0), 1.0)


def _given(table: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in table.items() if value is not None}


def to_y_up(vectors: Points) -> Points:
    """Returns vectors of the object frame (Z up, front -Y) in glTF's (Y up, front +Z); exact in every digit."""
    return np.column_stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]])


def mesh_of(
    visual: Visual,
    origin: Vec3,
    writer: tuple[GltfBuffer, GltfMaterialWriter],
    crease: float,
    draco: DracoConfig | None = None,
) -> dict[str, Any]:
    """Returns the glTF mesh of a visual relative to `origin` (metres, object frame); it may have no primitives.

    With `draco` its primitives are compressed.
    """
    primitives = [_primitive(s, origin, writer, crease, draco) for s in visual.surfaces if not s.is_empty]
    return {"name": visual.name, "primitives": primitives}


def _primitive(
    surface: Surface,
    origin: Vec3,
    writer: tuple[GltfBuffer, GltfMaterialWriter],
    crease: float,
    draco: DracoConfig | None,
) -> dict[str, Any]:
    buffer, materials = writer
    shading = corner_normals(surface, crease)
    vertex, normal, corners = _split(surface, np.asarray(shading.corners), len(shading.normals))
    arrays = {
        "POSITION": _floats(to_y_up(surface.mesh.vertices[vertex] - origin)),
        "NORMAL": _floats(to_y_up(shading.normals[normal])),
    }
    if surface.uv is not None:
        uv = np.clip(np.nan_to_num(surface.uv[vertex], posinf=0.0, neginf=0.0), -1e6, 1e6)
        arrays["TEXCOORD_0"] = _floats(uv * [1.0, -1.0] + [0.0, 1.0])  # glTF's origin is the top left
    if surface.colors is not None:
        arrays["COLOR_0"] = np.ascontiguousarray(surface.colors[vertex])
    packed = None if draco is None else add_packed(arrays, corners, buffer, draco)
    return {
        **(_plain(arrays, corners, buffer) if packed is None else packed),
        "material": materials.index_of(surface.material, surface.uv is not None),
    }


def _plain(arrays: Mapping[str, np.ndarray], corners: np.ndarray, buffer: GltfBuffer) -> dict[str, Any]:
    attributes = {name: buffer.add_array(values, VERTEX_DATA, name == "POSITION") for name, values in arrays.items()}
    return {"attributes": attributes, "indices": buffer.add_indices(corners.ravel())}


def _split(surface: Surface, corners: np.ndarray, normals: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Splits vertices so that each has one normal: the old vertex and the normal of each new one, and the new faces.

    Faces that name one vertex twice are left out: they have no area in any pose and validators refuse them.
    """
    faces = surface.mesh.faces
    whole = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    faces, corners = (faces, corners) if whole.all() or not whole.any() else (faces[whole], corners[whole])
    each = faces.ravel() * normals + corners.ravel()
    first, index = first_of_each(each)
    keys = each[first]
    return keys // normals, keys % normals, index.reshape(faces.shape)


def _floats(values: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(values, dtype=np.float32)
