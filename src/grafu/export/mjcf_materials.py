"""Visuals, materials and images as MuJoCo takes them: meshes of one material each, at least four corners, some area.

A visual of one material is the OBJ file that a URDF names too; others are divided by material into files of their own.
A material is one colour or one PNG image; metallic-roughness, normal, occlusion and emissive images are left out:
MuJoCo's own renderer has no use for them.
"""

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import replace
from io import BytesIO
from typing import final

import numpy as np
from PIL import Image

from grafu.articulation.articulated_object import Visual
from grafu.dataclass import dataclass
from grafu.export.names import NameBook, number, numbers, printable
from grafu.export.obj import ObjFolder
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import Vec3, distinct
from grafu.geometry.mesh import TriangleMesh

_WHITE = (1.0, 1.0, 1.0, 1.0)


@final
@dataclass(frozen=True, slots=True)
class MjcfMaterial:
    """What MuJoCo draws a mesh with: a material, whether its image can be laid on, and a factor for its colour.

    The factor stands for colours of vertices, which MuJoCo does not have: it is their mean.
    """

    material: Material
    textured: bool
    tint: tuple[float, ...] = _WHITE


def material_of(surface: Surface) -> MjcfMaterial:
    """Returns the material of a surface; without coordinates in the image it has no image."""
    textured = surface.uv is not None and surface.material.base_color_texture is not None
    if surface.colors is None or not len(surface.colors):
        return MjcfMaterial(surface.material, textured)
    used = surface.colors[distinct(surface.mesh.faces)]
    return MjcfMaterial(surface.material, textured, tuple(np.round(used.mean(axis=0) / 255.0, 6).tolist()))


@final
class MjcfMaterials:
    """Writes each material, and each image, once into an `asset` element; images go into a folder beside it."""

    def __init__(self, asset: ET.Element, folder: ObjFolder) -> None:
        self.images: dict[str, bytes] = {}
        self._asset = asset
        self._folder = folder
        self._names = NameBook(case_counts=True)
        self._materials: dict[MjcfMaterial, str] = {}
        self._textures: dict[str, str | None] = {}

    def name_of(self, key: MjcfMaterial) -> str:
        """Returns the name of the material of the file for it."""
        if key not in self._materials:
            self._materials[key] = self._names.unique(printable(key.material.name) or "material")
            self._add(key)
        return self._materials[key]

    def _add(self, key: MjcfMaterial) -> None:
        material, image = key.material, key.material.base_color_texture
        texture = self._texture(image) if key.textured and image is not None else None
        alpha = material.base_color[3] * key.tint[3] if material.alpha_mode != "OPAQUE" else 1.0
        color = [_display(c * t) for c, t in zip(material.base_color[:3], key.tint, strict=False)]
        smooth = 1.0 - material.roughness
        attributes = {"name": self._materials[key], "rgba": numbers([*color, alpha])}
        attributes |= {"texture": texture} if texture is not None else {}
        attributes |= {"specular": number(0.5 * smooth + 0.5 * material.metallic * smooth), "shininess": number(smooth)}
        attributes |= {"metallic": number(material.metallic), "roughness": number(material.roughness)}
        if any(material.emissive):
            attributes["emission"] = number(max(material.emissive))
        ET.SubElement(self._asset, "material", attributes)

    def _texture(self, texture: Texture) -> str | None:
        """Returns the name of an image's texture element; None where the image could not be read."""
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
    """Returns a linear fraction of light as screens take it (sRGB): MuJoCo shows its colours as they are."""
    x = min(max(linear, 0.0), 1.0)
    return round(12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055, 6)


_FEWEST_CORNERS = 4
_LEAST_AREA = 1e-10  # square metres: a hundredth of a millimetre each side, invisible and useless to a solver


@final
@dataclass(frozen=True, slots=True)
class DrawnMesh:
    """A mesh of one material: its OBJ file in the folder, and the material."""

    file: str
    material: MjcfMaterial


def drawn_meshes(visual: Visual, shared: str, origin: Vec3, folder: ObjFolder) -> Iterator[DrawnMesh]:
    """Yields the meshes of a visual relative to `origin` (metres); `shared` is the OBJ file of the whole of it.

    What has no area is left out. Files are added to the folder where the whole will not do.
    """
    groups: dict[MjcfMaterial, list[Surface]] = {}
    for surface in visual.surfaces:
        if not surface.is_empty:
            groups.setdefault(material_of(surface), []).append(surface)
    uniform = len(groups) == 1 and len({s.uv is None for s in visual.surfaces if not s.is_empty}) == 1
    for key, surfaces in groups.items():
        if sum(surface.mesh.area for surface in surfaces) < _LEAST_AREA:
            continue
        if uniform and _corners(surfaces) >= _FEWEST_CORNERS:
            yield DrawnMesh(shared, key)
        else:
            drawn = tuple(_plain(surface, key) for surface in surfaces)
            yield DrawnMesh(folder.add_visual(replace(visual, surfaces=_divided(drawn)), origin), key)


def _corners(surfaces: list[Surface] | tuple[Surface, ...]) -> int:
    return len(np.unique(np.vstack([s.mesh.vertices[np.unique(s.mesh.faces)] for s in surfaces]), axis=0))


def _plain(surface: Surface, key: MjcfMaterial) -> Surface:
    """Returns a surface that has coordinates in the image only where the material has one: all or none."""
    return surface if key.textured else replace(surface, uv=None)


def _divided(surfaces: tuple[Surface, ...]) -> tuple[Surface, ...]:
    """Returns the same surfaces; where they have too few corners, the first face gets one more in its middle."""
    if _corners(surfaces) >= _FEWEST_CORNERS:
        return surfaces
    largest = max(range(len(surfaces)), key=lambda k: surfaces[k].mesh.area)
    return (*surfaces[:largest], _with_middle(surfaces[largest]), *surfaces[largest + 1 :])


def _with_middle(surface: Surface) -> Surface:
    """Returns a surface whose largest face is divided into three around its middle."""
    mesh, face = surface.mesh, int(np.argmax(surface.mesh.face_areas))
    a, b, c = (int(corner) for corner in mesh.faces[face])
    new = len(mesh.vertices)
    fan = [[a, b, new], [b, c, new], [c, a, new]]
    faces = np.vstack([np.delete(mesh.faces, face, axis=0), fan])

    def extended(values: np.ndarray) -> np.ndarray:
        return np.vstack([values, values[[a, b, c]].mean(axis=0)]).astype(values.dtype)

    return Surface(
        TriangleMesh(extended(mesh.vertices), faces),
        surface.material,
        None if surface.uv is None else extended(surface.uv),
        None if surface.normals is None else extended(surface.normals),
        None if surface.colors is None else extended(surface.colors),
        surface.name,
    )
