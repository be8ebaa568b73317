"""Materials of OpenUSD scenes: the surface shader's colour, image, opacity, metallic and roughness."""

import zipfile
from pathlib import Path
from typing import Any, Final, final

from grafu.asset.resources import ModelFiles
from grafu.asset.scan_files import library_call
from grafu.geometry.appearance import Material, Texture

EXPECTED: Final = "an OpenUSD scene with meshes; export it again"
_COLOURS = ("diffuseColor", "diffuse_color_constant", "base_color")  # UsdPreviewSurface, OmniPBR
_IMAGES = ("diffuse_texture", "base_color_texture")
_RATIOS = {"opacity": 1.0, "metallic": 0.0, "roughness": 0.5}  # and what they usually are
_NONE = (None, None)


@final
class UsdMaterials:
    """Reads the materials of one scene, each once. Not a value: notes gather."""

    def __init__(self, path: Path, files: ModelFiles, notes: list[str]) -> None:
        self._path, self._files, self._notes = path, files, notes
        self._made: dict[str, Material] = {}

    def of(self, prim: Any, shape: Any = None) -> Material:
        """Returns the material that is bound to a prim, a shape or a part of `shape`; its colour where none is."""
        from pxr import UsdGeom, UsdShade

        with library_call(self._path, EXPECTED):
            bound = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
            shown = None if bound else UsdGeom.Gprim(shape or prim).GetDisplayColorAttr().Get()
            colour = _rgb(shown[0]) if shown is not None and len(shown) else None
        if not bound:
            return Material() if colour is None else Material(base_color=(*colour, 1.0))
        place = str(bound.GetPath())
        if place not in self._made:
            self._made[place] = self._painted(str(bound.GetPrim().GetName()), self._inputs(bound))
        return self._made[place]

    def _inputs(self, material: Any) -> dict[str, tuple[Any, Any]]:
        """Returns value and connected image of each input that is read, of the surface shader of any renderer."""
        with library_call(self._path, EXPECTED):
            for context in ("", "mdl"):
                shader = material.ComputeSurfaceSource(context)[0]
                if shader:
                    return {key: _value(shader, key) for key in (*_COLOURS, *_IMAGES, *_RATIOS)}
        return {}

    def _painted(self, name: str, inputs: dict[str, tuple[Any, Any]]) -> Material:
        colours = [rgb for key in _COLOURS if (rgb := _rgb(inputs.get(key, _NONE)[0])) is not None]
        images = [inputs.get(key, _NONE) for key in (*_IMAGES, *_COLOURS)]
        image = next((i for value, connected in images for i in (connected, value) if hasattr(i, "path")), None)
        texture = None if image is None else self._image(image)
        alpha, metallic, roughness = (_ratio(inputs.get(key, _NONE)[0], usual) for key, usual in _RATIOS.items())
        plain = (1.0, 1.0, 1.0)
        return Material(
            name=name,
            base_color=(*(colours[0] if colours and texture is None else plain), alpha),
            metallic=metallic,
            roughness=roughness,
            base_color_texture=texture,
            alpha_mode="BLEND" if alpha < 0.999 else "OPAQUE",
            double_sided=True,
        )

    def _image(self, named: Any) -> Texture | None:
        """Returns the image at an asset path, None and a note where it cannot be had."""
        resolved, name = str(named.resolvedPath), str(named.path)
        package, _, inside = resolved.partition("[")
        if inside and Path(package) == self._path.absolute():
            found = self._packed(inside.rstrip("]"))
        else:
            sought = self._files.seek(name, self._path.parent)
            found = self._files.texture(sought.path) if sought.path is not None else sought.why
        if isinstance(found, Texture):
            return found
        self._notes.append(f"texture {name.rpartition('/')[2]} {found} and was left out")
        return None

    def _packed(self, name: str) -> Texture | str:
        with library_call(self._path, EXPECTED), zipfile.ZipFile(self._path) as package:
            entry = package.getinfo(name)
            if entry.compress_type != zipfile.ZIP_STORED:
                return "is compressed"
            data = package.read(entry)
        return self._files.image(data, name.rpartition("/")[2])


def _value(shader: Any, key: str) -> tuple[Any, Any]:
    """Returns the value of a shader's input, and the asset path of the image that is connected to it."""
    found = shader.GetInput(key)
    if not found:
        return None, None
    sources = found.GetConnectedSources()[0] if found.HasConnectedSource() else []
    for source in sources:
        file = source.source.GetPrim().GetAttribute("inputs:file")
        if file and file.Get():
            return None, file.Get()
    return found.Get(), None


def _rgb(value: Any) -> tuple[float, float, float] | None:
    """Returns a linear colour, None where the value is none."""
    try:
        red, green, blue = (min(max(float(v), 0.0), 1.0) for v in value)
    except (TypeError, ValueError):
        return None
    return (red, green, blue)


def _ratio(value: Any, default: float) -> float:
    try:
        return min(max(float(value), 0.0), 1.0)
    except (TypeError, ValueError):
        return default
