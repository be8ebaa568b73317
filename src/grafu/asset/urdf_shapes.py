"""The shapes of URDF visuals: mesh files, boxes, cylinders, spheres, with their materials. It knows no joints."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, final

import numpy as np

from grafu.asset.gltf import read_surfaces
from grafu.asset.json_shapes import spelled
from grafu.asset.mesh_files import MESH_SUFFIXES, read_mesh_file
from grafu.asset.packages import find_in_package, package_files
from grafu.asset.resources import ModelFiles
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.mesh import TriangleMesh

_LARGEST = 1e9  # of a shape's size: squares and products of such stay finite


@final
@dataclass(frozen=True)
class Shape:
    """The surfaces of one visual in its own coordinates, and the file that they come from."""

    surfaces: tuple[Surface, ...]
    file: str = ""


class ShapeReader:
    """Reads the shapes of one URDF; each mesh file is read once. What cannot be read is a note."""

    def __init__(self, path: Path, files: ModelFiles, materials: dict[str, Any]) -> None:
        self.path, self.files, self.materials = path, package_files(path, files), materials
        self.notes: list[str] = []
        self._read: dict[Path, tuple[Surface, ...] | None] = {}

    def read(self, visual: Any) -> Shape | None:
        """Returns the shape of a `<visual>` element, or None (and a note) where there is none to be had.

        Raises:
            UnreadableAsset: if a mesh file is there but damaged, or a size is no number.
            AssetTooLarge: if the model has more of something than the limits allow.
        """
        self.files.tally.add(self.path, primitives=1)
        geometry = visual.find("geometry")
        element = next((e for e in (geometry if geometry is not None else ()) if isinstance(e.tag, str)), None)
        if element is None:
            return None
        shape = self._mesh(element) if element.tag == "mesh" else self._primitive(element)
        return None if shape is None else self._painted(shape, visual.find("material"))

    def _mesh(self, element: Any) -> Shape | None:
        name = element.get("filename", "")
        sought = find_in_package(name, self.path, self.files)
        if sought.path is None:
            self.notes.append(f"mesh {name} {sought.why} and was left out")
            return None
        surfaces = self._surfaces(sought.path)
        if surfaces is None:
            return None
        scale = np.diag([*self._floats(element.get("scale", "1 1 1"), 3), 1.0])
        identity = np.array_equal(scale, np.eye(4))
        return Shape(surfaces if identity else tuple(s.transformed(scale) for s in surfaces), name)

    def _surfaces(self, path: Path) -> tuple[Surface, ...] | None:
        """Returns the surfaces of a mesh file, read once, and counted each time that it is shown."""
        if path not in self._read:
            self._read[path] = self._load(path)
            return self._read[path]
        surfaces = self._read[path] or ()
        faces, vertices = (sum(len(getattr(s.mesh, key)) for s in surfaces) for key in ("faces", "vertices"))
        self.files.tally.add(self.path, faces=faces, vertices=vertices)
        return self._read[path]

    def _load(self, path: Path) -> tuple[Surface, ...] | None:
        if path.suffix.lower() in (".glb", ".gltf"):
            return read_surfaces(path, self.files)
        if path.suffix.lower() not in MESH_SUFFIXES:
            self.notes.append(f"mesh {path.name} is of a kind that is not read and was left out; convert it to OBJ")
            return None
        found = read_mesh_file(path, self.files, split=False)
        self.notes += found.notes
        return found.surfaces

    def _primitive(self, element: Any) -> Shape | None:
        import trimesh

        if element.tag == "box":
            made = trimesh.creation.box(self._floats(element.get("size", ""), 3))
        elif element.tag == "cylinder":
            radius, length = (self._floats(element.get(k, ""), 1)[0] for k in ("radius", "length"))
            made = trimesh.creation.cylinder(radius, length, sections=24)
        elif element.tag == "sphere":
            made = trimesh.creation.icosphere(2, self._floats(element.get("radius", ""), 1)[0])
        else:
            self.notes.append(f"shape <{element.tag}> is not read and was left out")
            return None
        self.files.tally.add(self.path, faces=len(made.faces), vertices=len(made.vertices))
        return Shape((Surface(TriangleMesh.from_trimesh(made)),))

    def _floats(self, text: str, count: int) -> list[float]:
        try:
            values = [float(v) for v in text.split()]
        except ValueError:
            values = []
        if len(values) != count or not all(0 < abs(value) < _LARGEST for value in values):
            raise UnreadableAsset(
                f"{self.path}: expected {count} sizes other than 0 in metres, got {spelled(text)}; mend the URDF"
            )
        return values

    def _painted(self, shape: Shape, element: Any) -> Shape:
        if element is None:
            return shape
        full = element if len(element) else self.materials.get(element.get("name", ""), element)
        color, texture = full.find("color"), full.find("texture")
        if color is None and texture is None:
            return shape
        rgba = self._rgba(color)
        image = self._image(texture.get("filename", "")) if texture is not None else None
        material = Material(full.get("name") or "default", rgba, base_color_texture=image)
        plain = Material()
        return replace(
            shape,
            surfaces=tuple(replace(s, material=material) if s.material == plain else s for s in shape.surfaces),
        )

    def _image(self, name: str) -> Texture | None:
        sought = find_in_package(name, self.path, self.files)
        found = self.files.texture(sought.path) if sought.path is not None else sought.why
        if isinstance(found, Texture):
            return found
        self.notes.append(f"texture {name} {found} and was left out")
        return None

    def _rgba(self, color: Any) -> tuple[float, float, float, float]:
        try:
            r, g, b, a = (min(max(float(v), 0.0), 1.0) for v in color.get("rgba", "").split()[:5])
        except (ValueError, AttributeError):
            return (1.0, 1.0, 1.0, 1.0)
        return (r, g, b, a)
