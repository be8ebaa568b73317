"""Materials and images as glTF tables: each material and each image is written once. It knows no meshes."""

from typing import Any, final

from grafu.export.gltf_buffer import GltfBuffer
from grafu.geometry.appearance import Material, Texture

_REPEATING = {"wrapS": 10497, "wrapT": 10497}


@final
class GltfMaterials:
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
            "baseColorFactor": [_share(c) for c in material.base_color],
            "metallicFactor": _share(material.metallic),
            "roughnessFactor": _share(material.roughness),
            "baseColorTexture": slot(material.base_color_texture),
            "metallicRoughnessTexture": slot(material.metallic_roughness_texture),
        }
        described = {
            "name": material.name,
            "pbrMetallicRoughness": _given(metallic_roughness),
            "normalTexture": slot(material.normal_texture),
            "occlusionTexture": slot(material.occlusion_texture),
            "emissiveTexture": slot(material.emissive_texture),
            "emissiveFactor": [_share(c) for c in material.emissive] if any(material.emissive) else None,
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


def _share(value: float) -> float:
    return min(max(float(value), 0.0), 1.0)


def _given(table: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in table.items() if value is not None}
