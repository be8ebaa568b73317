"""The shapes of URDF visuals: mesh files, boxes, cylinders, spheres, with their materials. It knows no joints."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, final

import numpy as np

from grafu.asset.gltf import read_surfaces
from grafu.asset.mesh_files import MESH_SUFFIXES, check_faces, read_bytes, read_mesh_file
from grafu.asset.mtl import texture_from
from grafu.asset.options import Limits
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.mesh import TriangleMesh


@final
@dataclass(frozen=True)
class Shape:
    """The surfaces of one visual in its own coordinates, and the file that they come from."""

    surfaces: tuple[Surface, ...]
    file: str = ""


class ShapeReader:
    """Reads the shapes of one URDF; each mesh file is read once. What cannot be read is a note."""

    def __init__(self, path: Path, limits: Limits, materials: dict[str, Any]) -> None:
        self.path, self.limits, self.materials = path, limits, materials
        self.notes: list[str] = []
        self._read: dict[Path, tuple[Surface, ...]] = {}
        self._faces = 0

    def read(self, visual: Any) -> Shape | None:
        """Returns the shape of a `<visual>` element, or None (and a note) where there is none to be had.

        Raises:
            UnreadableAsset: if a mesh file is there but damaged, or a size is no number.
        """
        geometry = visual.find("geometry")
        element = next((e for e in (geometry if geometry is not None else ()) if isinstance(e.tag, str)), None)
        if element is None:
            return None
        shape = self._mesh(element) if element.tag == "mesh" else self._primitive(element)
        if shape is None:
            return None
        self._faces += sum(len(s.mesh.faces) for s in shape.surfaces)
        check_faces(self._faces, str(self.path), self.limits)
        return self._painted(shape, visual.find("material"))

    def _mesh(self, element: Any) -> Shape | None:
        name = element.get("filename", "")
        path = self._resolve(name)
        if path is None:
            self.notes.append(f"mesh {name} is missing and was left out")
            return None
        if path not in self._read:
            surfaces = self._load(path)
            if surfaces is None:
                return None
            self._read[path] = surfaces
        scale = np.diag([*self._floats(element.get("scale", "1 1 1"), 3), 1.0])
        identity = np.array_equal(scale, np.eye(4))
        surfaces = self._read[path]
        return Shape(surfaces if identity else tuple(s.transformed(scale) for s in surfaces), name)

    def _load(self, path: Path) -> tuple[Surface, ...] | None:
        if path.suffix.lower() in (".glb", ".gltf"):
            return read_surfaces(path, self.limits)
        if path.suffix.lower() not in MESH_SUFFIXES:
            self.notes.append(f"mesh {path.name} is of a kind that is not read and was left out; convert it to OBJ")
            return None
        found = read_mesh_file(path, self.limits, split=False)
        self.notes += found.notes
        return found.surfaces

    def _resolve(self, name: str) -> Path | None:
        """Returns the file that a mesh name means: `package://` and stale absolute paths are sought upwards."""
        _, scheme, rest = name.rpartition("://")
        tries = [rest.lstrip("/"), rest.partition("/")[2]] if scheme else [rest]
        folder = self.path.resolve().parent
        for tail in filter(None, tries):
            for base in (folder, *folder.parents) if scheme else (folder,):
                if (base / tail).is_file():
                    return base / tail
        return None

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
        return Shape((Surface(TriangleMesh.from_trimesh(made)),))

    def _floats(self, text: str, count: int) -> list[float]:
        try:
            values = [float(v) for v in text.split()]
        except ValueError:
            values = []
        if len(values) != count or not np.isfinite(values).all() or 0 in values:
            raise UnreadableAsset(
                f"{self.path}: expected {count} finite sizes other than 0, got {text!r}; mend the URDF"
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
        path = self._resolve(texture.get("filename", "")) if texture is not None else None
        image = texture_from(read_bytes(path, self.limits), path.name) if path is not None else None
        material = Material(full.get("name") or "default", rgba, base_color_texture=image)
        plain = Material()
        return replace(
            shape,
            surfaces=tuple(replace(s, material=material) if s.material == plain else s for s in shape.surfaces),
        )

    def _rgba(self, color: Any) -> tuple[float, float, float, float]:
        try:
            r, g, b, a = (min(max(float(v), 0.0), 1.0) for v in color.get("rgba", "").split())
        except (ValueError, AttributeError):
            return (1.0, 1.0, 1.0, 1.0)
        return (r, g, b, a)
