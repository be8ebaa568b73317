"""glTF mesh primitives to surfaces: triangles, strips and fans, with texture coordinates, normals, colours, materials.

Materials and textures stay as they are: metallic-roughness, image bytes untouched.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from grafu.asset.gltf_buffers import GltfFile
from grafu.asset.gltf_draco import decoded, is_compressed_alone
from grafu.asset.json_files import JsonObject
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.mesh import TriangleMesh

_DEFAULT = Material(base_color=(1.0, 1.0, 1.0, 1.0), metallic=1.0, roughness=1.0)


class GltfMaterials:
    """The materials of one document by index, each made once; what is left out is a note."""

    def __init__(self, file: GltfFile) -> None:
        self.file = file
        self.notes: list[str] = []
        self._made: dict[int, Material] = {}
        self._textures: dict[int, Texture | None] = {}

    def get(self, index: Any) -> Material:
        """Returns the material with this index, glTF's default for None.

        Raises:
            UnreadableAsset: if there is no such material.
        """
        if index is None:
            return _DEFAULT
        if index not in self._made:
            self._made[index] = self._material(self.file.item("materials", index), index)
        return self._made[index]

    def uv_set(self, index: Any) -> int:
        """Returns which set of texture coordinates the material's base colour uses."""
        if index is None:
            return 0
        info = self.file.item("materials", index).member("pbrMetallicRoughness").member("baseColorTexture")
        return info.whole("texCoord", 0)

    def _material(self, source: JsonObject, index: int) -> Material:
        pbr = source.member("pbrMetallicRoughness")
        color, base = pbr.numbers("baseColorFactor", 4), pbr.member("baseColorTexture")
        metallic, roughness = pbr.number("metallicFactor", 1.0), pbr.number("roughnessFactor", 1.0)
        extensions = source.member("extensions")
        if "KHR_materials_pbrSpecularGlossiness" in extensions and "pbrMetallicRoughness" not in source:
            specular = extensions.member("KHR_materials_pbrSpecularGlossiness")
            color, base = specular.numbers("diffuseFactor", 4), specular.member("diffuseTexture")
            metallic, roughness = 0.0, 1.0 - specular.number("glossinessFactor", 1.0)
        mode = source.get("alphaMode")
        return Material(
            name=source.text("name", f"material_{index}"),
            base_color=_clip4(color or (1.0, 1.0, 1.0, 1.0)),
            metallic=metallic,
            roughness=roughness,
            emissive=_clip3(source.numbers("emissiveFactor", 3, (0.0, 0.0, 0.0))),
            base_color_texture=self._texture(base),
            metallic_roughness_texture=self._texture(pbr.member("metallicRoughnessTexture")),
            normal_texture=self._texture(source.member("normalTexture")),
            occlusion_texture=self._texture(source.member("occlusionTexture")),
            emissive_texture=self._texture(source.member("emissiveTexture")),
            alpha_mode=mode if mode in ("MASK", "BLEND") else "OPAQUE",
            alpha_cutoff=source.number("alphaCutoff", 0.5),
            double_sided=bool(source.get("doubleSided")),
        )

    def _texture(self, info: JsonObject) -> Texture | None:
        """Returns the texture that a material names; one that cannot be had costs no model, but is noted."""
        if not info.data:
            return None
        if "KHR_texture_transform" in info.member("extensions"):
            self.notes.append("a texture transform (KHR_texture_transform) is not applied")
        try:
            source = self.file.item("textures", info.get("index")).whole("source")
        except UnreadableAsset as error:
            self.notes.append(f"a texture was left out: {error}")
            return None
        if source is None:
            self.notes.append("a texture in a format other than PNG and JPEG was left out")
            return None
        if source not in self._textures:
            self._textures[source] = self._image(source)
        return self._textures[source]

    def _image(self, index: int) -> Texture | None:
        try:
            found = self.file.image(index)
        except UnreadableAsset as error:
            found = f"cannot be read: {error}"
        if isinstance(found, Texture):
            return found
        self.notes.append(f"image {index} {found} and was left out")
        return None


def _clip4(values: tuple[float, ...]) -> tuple[float, float, float, float]:
    r, g, b, a = (min(max(v, 0.0), 1.0) for v in values)
    return (r, g, b, a)


def _clip3(values: tuple[float, ...]) -> tuple[float, float, float]:
    r, g, b = (min(max(v, 0.0), 1.0) for v in values)
    return (r, g, b)


_TRIANGLES, _STRIP, _FAN = 4, 5, 6


class GltfMeshes:
    """The meshes of one document as surfaces, each made once; lines and points are left out with a note."""

    def __init__(self, file: GltfFile) -> None:
        self.file = file
        self.materials = GltfMaterials(file)
        self._own_notes: list[str] = []
        self._made: dict[int, tuple[Surface, ...]] = {}
        self._sizes: dict[int, dict[str, int]] = {}

    @property
    def notes(self) -> list[str]:
        """What was left out, in words."""
        return self._own_notes + self.materials.notes

    def count(self, index: Any) -> None:
        """Counts what a mesh will take wherever it is placed, before anything is made of it; once for each place.

        Raises:
            UnreadableAsset: if the mesh is not there or damaged.
            AssetTooLarge: if the model has more of something than is read.
        """
        if index not in self._sizes:
            primitives = self.file.item("meshes", index).objects("primitives")
            # of a mesh that lists one primitive many times no more is looked at than may be read
            self.file.files.limits.require("primitives", len(primitives), self.file.path)
            self._sizes[index] = _sum([self._size(p) for p in primitives])
        self.file.files.tally.add(self.file.path, **self._sizes[index])

    def get(self, index: Any) -> tuple[Surface, ...]:
        """Returns the surfaces of the mesh with this index, which was counted before (here, where it was not).

        Raises:
            UnreadableAsset: if the mesh is not there or damaged.
            AssetTooLarge: if the model has more of something than is read.
        """
        if index not in self._sizes:
            self.count(index)
        if index not in self._made:
            found = [self._surface(p) for p in self.file.item("meshes", index).objects("primitives")]
            self._made[index] = tuple(s for s in found if s is not None and not s.is_empty)
        return self._made[index]

    def _size(self, primitive: JsonObject) -> dict[str, int]:
        attributes, mode = primitive.member("attributes"), primitive.whole("mode", _TRIANGLES)
        if mode not in (_TRIANGLES, _STRIP, _FAN) or "POSITION" not in attributes:
            return {"primitives": 1, "faces": 0, "vertices": 0}
        vertices = self.file.count(attributes.get("POSITION"))
        corners = self.file.count(primitive.get("indices")) if "indices" in primitive else vertices
        return {"primitives": 1, "faces": corners // 3 if mode == _TRIANGLES else corners, "vertices": vertices}

    def _surface(self, primitive: JsonObject) -> Surface | None:
        mode, attributes = primitive.whole("mode", _TRIANGLES), primitive.member("attributes")
        if mode not in (_TRIANGLES, _STRIP, _FAN) or "POSITION" not in attributes:
            self._own_notes.append("points or lines were left out")
            return None
        draco = decoded(self.file, primitive) if is_compressed_alone(self.file, primitive) else None
        arrays = {} if draco is None else draco.attributes
        positions = self._values(attributes, "POSITION", arrays).astype(np.float64)
        if positions.shape[1] != 3 or not np.isfinite(positions).all():
            raise self.file.damaged("positions are not three finite numbers each")
        corners = self._indices(primitive, len(positions), None if draco is None else draco.indices)
        faces = _faces(corners, _TRIANGLES if draco is not None else mode)
        material = primitive.get("material")
        uv = self._attribute(attributes, f"TEXCOORD_{self.materials.uv_set(material)}", len(positions), 2, arrays)
        if uv is not None:
            uv = np.column_stack([uv[:, 0], 1.0 - uv[:, 1]])  # glTF counts v downwards from the top
        normals = self._attribute(attributes, "NORMAL", len(positions), 3, arrays)
        colors = self._colors(attributes, len(positions), arrays)
        return Surface(TriangleMesh(positions, faces), self.materials.get(material), uv, normals, colors)

    def _values(self, attributes: JsonObject, key: str, arrays: Mapping[str, np.ndarray]) -> np.ndarray:
        return arrays[key] if key in arrays else self.file.accessor(attributes.get(key))

    def _indices(self, primitive: JsonObject, count: int, decoded_indices: np.ndarray | None) -> np.ndarray:
        if decoded_indices is None and "indices" not in primitive:
            return np.arange(count)
        stated = self.file.accessor(primitive.get("indices")) if decoded_indices is None else decoded_indices
        indices = stated.ravel().astype(np.int64)
        if len(indices) and (indices.min() < 0 or indices.max() >= count):
            raise self.file.damaged(f"a face names vertex {indices.max()} of {count}")
        return indices

    def _attribute(
        self, attributes: JsonObject, key: str, count: int, width: int, arrays: Mapping[str, np.ndarray]
    ) -> np.ndarray | None:
        if key not in attributes:
            return None
        # asked before memory is taken for it
        fits = key in arrays or self.file.count(attributes.get(key)) == count
        values = self._values(attributes, key, arrays).astype(np.float64) if fits else np.zeros((0, 0))
        if values.shape != (count, width) or not np.isfinite(values).all():
            self._own_notes.append(f"damaged {key} values were left out")
            return None
        return values

    def _colors(self, attributes: JsonObject, count: int, arrays: Mapping[str, np.ndarray]) -> np.ndarray | None:
        fits = "COLOR_0" in arrays or ("COLOR_0" in attributes and self.file.count(attributes.get("COLOR_0")) == count)
        values = self._values(attributes, "COLOR_0", arrays) if fits else np.zeros((0, 0))
        if values.shape not in ((count, 3), (count, 4)):
            return None
        rgba = np.ones((count, 4))
        rgba[:, : values.shape[1]] = values
        return np.clip(np.round(np.nan_to_num(rgba) * 255), 0, 255).astype(np.uint8)


def _sum(sizes: list[dict[str, int]]) -> dict[str, int]:
    return {name: sum(size[name] for size in sizes) for name in ("primitives", "faces", "vertices")}


def _faces(indices: np.ndarray, mode: int) -> np.ndarray:
    if mode == _TRIANGLES:
        return indices[: len(indices) // 3 * 3].reshape(-1, 3)
    if len(indices) < 3:
        return np.zeros((0, 3), np.int64)
    if mode == _FAN:
        return np.column_stack([np.full(len(indices) - 2, indices[0]), indices[1:-1], indices[2:]])
    strip = np.column_stack([indices[:-2], indices[1:-1], indices[2:]])
    strip[1::2] = strip[1::2, [1, 0, 2]]
    return strip
