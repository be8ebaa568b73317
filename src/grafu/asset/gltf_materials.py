"""glTF materials and textures as they are: metallic-roughness, image bytes untouched. It knows no geometry."""

from typing import Any

from grafu.asset.gltf_buffers import GltfFile
from grafu.asset.mtl import texture_from
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
        source = self.file.item("materials", index)
        info = source.get("pbrMetallicRoughness", {}).get("baseColorTexture", {})
        return int(info.get("texCoord", 0))

    def _material(self, source: dict[str, Any], index: int) -> Material:
        extensions = source.get("extensions", {})
        pbr = source.get("pbrMetallicRoughness", {})
        color, metallic, roughness = (
            pbr.get("baseColorFactor"),
            pbr.get("metallicFactor", 1.0),
            pbr.get("roughnessFactor", 1.0),
        )
        base = pbr.get("baseColorTexture")
        specular = extensions.get("KHR_materials_pbrSpecularGlossiness")
        if specular is not None and not pbr:
            color, base = specular.get("diffuseFactor"), specular.get("diffuseTexture")
            metallic, roughness = 0.0, 1.0 - specular.get("glossinessFactor", 1.0)
        mode = source.get("alphaMode", "OPAQUE")
        return Material(
            name=str(source.get("name", f"material_{index}")),
            base_color=_clip4(color),
            metallic=float(metallic),
            roughness=float(roughness),
            emissive=_clip3(source.get("emissiveFactor")),
            base_color_texture=self._texture(base),
            metallic_roughness_texture=self._texture(pbr.get("metallicRoughnessTexture")),
            normal_texture=self._texture(source.get("normalTexture")),
            occlusion_texture=self._texture(source.get("occlusionTexture")),
            emissive_texture=self._texture(source.get("emissiveTexture")),
            alpha_mode=mode if mode in ("OPAQUE", "MASK", "BLEND") else "OPAQUE",
            alpha_cutoff=float(source.get("alphaCutoff", 0.5)),
            double_sided=bool(source.get("doubleSided", False)),
        )

    def _texture(self, info: dict[str, Any] | None) -> Texture | None:
        if not info:
            return None
        if "KHR_texture_transform" in info.get("extensions", {}):
            self.notes.append("a texture transform (KHR_texture_transform) is not applied")
        source = self.file.item("textures", info.get("index")).get("source")
        if source is None:
            self.notes.append("a texture in a format other than PNG and JPEG was left out")
            return None
        if source not in self._textures:
            self._textures[source] = self._image(source)
        return self._textures[source]

    def _image(self, index: int) -> Texture | None:
        found = self.file.image(index)
        texture = texture_from(found[0], found[1]) if found is not None else None
        if texture is None:
            self.notes.append(f"image {index} is missing or neither PNG nor JPEG and was left out")
        return texture


def _clip4(values: Any) -> tuple[float, float, float, float]:
    r, g, b, a = (min(max(float(v), 0.0), 1.0) for v in (values or (1.0, 1.0, 1.0, 1.0)))
    return (r, g, b, a)


def _clip3(values: Any) -> tuple[float, float, float]:
    r, g, b = (min(max(float(v), 0.0), 1.0) for v in (values or (0.0, 0.0, 0.0)))
    return (r, g, b)
