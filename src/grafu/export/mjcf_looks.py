"""Materials and images as MuJoCo takes them: one colour or one PNG image each. It knows no meshes.

Metallic-roughness, normal, occlusion and emissive images are left out: MuJoCo's own renderer has no use for them.
"""

import xml.etree.ElementTree as ET
from dataclasses import dataclass
from io import BytesIO
from typing import final

import numpy as np
from PIL import Image

from grafu.export.names import NameBook, printable
from grafu.export.obj import ObjFolder
from grafu.export.xml_numbers import number, numbers
from grafu.geometry.appearance import Material, Surface, Texture

_WHITE = (1.0, 1.0, 1.0, 1.0)


@final
@dataclass(frozen=True, slots=True)
class Look:
    """What one mesh looks like: a material, whether its image can be laid on, and a factor for its colour.

    The factor stands for colours of vertices, which MuJoCo does not have: it is their mean.
    """

    material: Material
    textured: bool
    tint: tuple[float, ...] = _WHITE


def look_of(surface: Surface) -> Look:
    """Returns the look of a surface; without coordinates in the image it has no image."""
    textured = surface.uv is not None and surface.material.base_color_texture is not None
    if surface.colors is None or not len(surface.colors):
        return Look(surface.material, textured)
    used = surface.colors[np.unique(surface.mesh.faces)]
    return Look(surface.material, textured, tuple(np.round(used.mean(axis=0) / 255.0, 6).tolist()))


@final
class MjcfLooks:
    """Writes each look, and each image, once into an `asset` element; images go into a folder beside it."""

    def __init__(self, asset: ET.Element, folder: ObjFolder) -> None:
        self.images: dict[str, bytes] = {}
        self._asset = asset
        self._folder = folder
        self._names = NameBook(case_counts=True)
        self._materials: dict[Look, str] = {}
        self._textures: dict[str, str | None] = {}

    def name_of(self, look: Look) -> str:
        """Returns the name of the material that shows a look."""
        if look not in self._materials:
            self._materials[look] = self._names.unique(printable(look.material.name) or "material")
            self._add(look)
        return self._materials[look]

    def _add(self, look: Look) -> None:
        material, image = look.material, look.material.base_color_texture
        texture = self._texture(image) if look.textured and image is not None else None
        alpha = material.base_color[3] * look.tint[3] if material.alpha_mode != "OPAQUE" else 1.0
        color = [_display(c * t) for c, t in zip(material.base_color[:3], look.tint, strict=False)]
        smooth = 1.0 - material.roughness
        attributes = {"name": self._materials[look], "rgba": numbers([*color, alpha])}
        attributes |= {"texture": texture} if texture is not None else {}
        attributes |= {"specular": number(0.5 * smooth + 0.5 * material.metallic * smooth), "shininess": number(smooth)}
        attributes |= {"metallic": number(material.metallic), "roughness": number(material.roughness)}
        if any(material.emissive):
            attributes["emission"] = number(max(material.emissive))
        ET.SubElement(self._asset, "material", attributes)

    def _texture(self, texture: Texture) -> str | None:
        """Returns the name of an image's texture element; None where nobody could read the image."""
        file = self._folder.add_texture(texture)
        if file not in self._textures:
            data = _as_png(texture)
            self._textures[file] = None
            if data is not None:
                name = file.rsplit(".", 1)[0].rsplit("/", 1)[-1]
                target = f"{file.rsplit('.', 1)[0]}.png"
                self.images[target] = data
                self._textures[file] = name
                ET.SubElement(self._asset, "texture", name=name, type="2d", file=target)
        return self._textures[file]


def _as_png(texture: Texture) -> bytes | None:
    """Returns an image as MuJoCo reads it: PNG, which it may be already; None where it is damaged."""
    try:
        with Image.open(BytesIO(texture.data)) as image:
            image.load()
            if texture.mime == "image/png" and image.format == "PNG":
                return texture.data
            stream = BytesIO()
            image.convert("RGB").save(stream, "PNG")
            return stream.getvalue()
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError):
        return None


def _display(linear: float) -> float:
    """Returns a linear share of light as screens take it (sRGB): MuJoCo shows its colours as they are."""
    x = min(max(linear, 0.0), 1.0)
    return round(12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055, 6)
