"""glTF materials and textures as they are: metallic-roughness, image bytes untouched. It knows no geometry."""

from typing import Any

from grafu.asset.gltf_buffers import GltfFile
from grafu.asset.json_shapes import JsonObject
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Material, Texture

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
