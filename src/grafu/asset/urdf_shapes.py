"""The shapes of URDF visuals: mesh files, boxes, cylinders, spheres, with their materials; and where their names lead.

XML is read with care: no entities, no network, no document types, no endless nesting. Names are relative paths, or lie
in ROS packages (`package://NAME/meshes/door.obj`). A package is a folder with a `package.xml` at most four levels above
the URDF, or the folder that the user gave. Where neither is known and the URDF lies in a folder called `urdf` or
`robots`, its package is the folder above, and of that only the folders that packages keep meshes and images in.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, Final, final

import numpy as np

from grafu.asset.collada import read_collada_surfaces
from grafu.asset.gltf import read_surfaces
from grafu.asset.json_files import spelled
from grafu.asset.mesh_files import MESH_SUFFIXES, read_mesh_file
from grafu.asset.resources import MISSING, OUTSIDE, ModelFiles, Sought
from grafu.asset.scan_files import parse_xml
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import Mat4
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import euler_matrix, from_rotation


def numbers(text: str | None, default: tuple[float, ...], path: Path) -> tuple[float, ...]:
    """Returns as many finite numbers as the default has, or the default where there is no text.

    Raises:
        UnreadableAsset: if the text holds something else.
    """
    if text is None:
        return default
    try:
        values = tuple(float(v) for v in text.split())
    except ValueError:
        values = ()
    if len(values) != len(default) or not all(math.isfinite(v) for v in values):
        raise UnreadableAsset(f"{path}: expected {len(default)} finite numbers, got {spelled(text)}; mend the URDF")
    return values


def origin_of(element: Any, path: Path) -> Mat4:
    """Returns the transform of an element's `<origin>` (identity where there is none): fixed-axis roll, pitch, yaw."""
    origin = element.find("origin")
    if origin is None:
        return np.eye(4)
    R = euler_matrix(numbers(origin.get("rpy"), (0.0, 0.0, 0.0), path))
    return from_rotation(R, np.array(numbers(origin.get("xyz"), (0.0, 0.0, 0.0), path)))


def read_xml(path: Path, files: ModelFiles) -> Any:
    """Returns the root element of a URDF of a model; see `parse_xml`."""
    return parse_xml(files.read(path), path, "a URDF", files.limits)


_LEVELS = 4
_URDF_FOLDERS = frozenset({"urdf", "robots"})
_BESIDE = ("meshes", "mesh", "visual", "textures", "materials", "images", "media")


def package_files(urdf: Path, files: ModelFiles) -> ModelFiles:
    """Returns the files of a model that may also be read from the package around its URDF."""
    package = _package(urdf)
    if package is not None:
        return files.with_roots(package)
    folder = urdf.absolute().parent
    if folder.name.lower() not in _URDF_FOLDERS:
        return files
    return files.with_roots(*(folder.parent / name for name in _BESIDE))


def find_in_package(name: str, urdf: Path, files: ModelFiles) -> Sought:
    """Returns the file that a URDF means by a name, or in words why there is none; see the module."""
    _, scheme, rest = name.rpartition("://")
    if not scheme:
        return files.seek(name, urdf.parent)
    tails = [tail for tail in dict.fromkeys((rest.lstrip("/"), rest.partition("/")[2].lstrip("/"))) if tail]
    if name.lower().startswith("file:"):
        tails.insert(0, f"/{rest.lstrip('/')}")
    tried = [files.seek(tail, folder) for tail in tails for folder in _bases(urdf, files)]
    found = next((sought for sought in tried if sought.path is not None), None)
    # that a name leads out at one of several places states nothing while it leads nowhere at the others
    return found or Sought(None, OUTSIDE if tried and all(s.why == OUTSIDE for s in tried) else MISSING)


def _bases(urdf: Path, files: ModelFiles) -> list[Path]:
    folder = urdf.absolute().parent
    above = [p for p in folder.parents if files.holds(p)][:_LEVELS]
    package = _package(urdf)
    beside = [folder.parent] if folder.name.lower() in _URDF_FOLDERS else []
    return list(dict.fromkeys([folder, *above, *([package] if package else []), *beside]))


def _package(urdf: Path) -> Path | None:
    folder = urdf.absolute().parent
    return next((p for p in (folder, *folder.parents)[:_LEVELS] if (p / "package.xml").is_file()), None)


MADE: Final = "surfaces"
"""The tag of a shape that another reader made: its number among the surfaces that it hands over."""
_LARGEST = 1e9  # of a shape's size: squares and products of such stay finite


@final
@dataclass(frozen=True)
class VisualShape:
    """The surfaces of one visual in its own coordinates, and the file that they come from."""

    surfaces: tuple[Surface, ...]
    file: str = ""


@cache
def _unit(form: str) -> TriangleMesh:
    """Returns a solid whose sides, radius and length are 1; a capsule's length is 2."""
    import trimesh

    if form == "box":
        return TriangleMesh.from_trimesh(trimesh.creation.box((1.0, 1.0, 1.0)))
    if form == "cylinder":
        return TriangleMesh.from_trimesh(trimesh.creation.cylinder(1.0, 1.0, sections=24))
    if form == "capsule":
        return TriangleMesh.from_trimesh(trimesh.creation.capsule(2.0, 1.0, count=(12, 24)))
    return TriangleMesh.from_trimesh(trimesh.creation.icosphere(2, 1.0))


class ShapeReader:
    """Reads the shapes of one URDF; each mesh file is read once. What cannot be read is a note.

    `made` are surfaces that were read before, for the shapes of a robot that no URDF describes (`MADE`).
    """

    def __init__(
        self, path: Path, files: ModelFiles, materials: dict[str, Any], made: Sequence[tuple[Surface, ...]] = ()
    ) -> None:
        self.path, self.files, self.materials = path, package_files(path, files), materials
        self._made = made
        self.notes: list[str] = []
        self._read: dict[Path, tuple[Surface, ...] | None] = {}

    def read(self, visual: Any) -> VisualShape | None:
        """Returns the shape of a `<visual>` element, or None (and a note) where there is none to be had.

        Raises:
            UnreadableAsset: if a mesh file is there but damaged, or a size is no number.
            AssetTooLarge: if the model has more of something than the limits allow.
        """
        geometry = visual.find("geometry")
        element = next((e for e in (geometry if geometry is not None else ()) if isinstance(e.tag, str)), None)
        if self._made and element is not None and element.tag == MADE:  # counted when it was read
            return VisualShape(self._made[int(element.get("number"))])
        self.files.tally.add(self.path, primitives=1)
        if element is None:
            return None
        shape = self._mesh(element) if element.tag == "mesh" else self._primitive(element)
        return None if shape is None else self._painted(shape, visual.find("material"))

    def _mesh(self, element: Any) -> VisualShape | None:
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
        return VisualShape(surfaces if identity else tuple(s.transformed(scale) for s in surfaces), name)

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
        if path.suffix.lower() == ".dae":
            surfaces, notes = read_collada_surfaces(path, self.files)
            self.notes += notes
            return surfaces
        if path.suffix.lower() not in MESH_SUFFIXES:
            self.notes.append(f"mesh {path.name} is of a kind that is not read and was left out; convert it to OBJ")
            return None
        found = read_mesh_file(path, self.files, split=False)
        self.notes += found.notes
        return found.surfaces

    def _primitive(self, element: Any) -> VisualShape | None:
        if element.tag == "box":
            form, size = "box", self._floats(element.get("size", ""), 3)
        elif element.tag == "sphere":
            form, size = "sphere", 3 * self._floats(element.get("radius", ""), 1)
        elif element.tag == "ellipsoid":
            form, size = "sphere", self._floats(element.get("radii", ""), 3)
        elif element.tag in ("cylinder", "capsule"):
            radius, length = (self._floats(element.get(k, ""), 1)[0] for k in ("radius", "length"))
            form, size = element.tag, [radius, radius, length if element.tag == "cylinder" else radius]
        else:
            self.notes.append(f"shape <{element.tag}> is not read and was left out")
            return None
        unit = _unit(form)
        self.files.tally.add(self.path, faces=len(unit.faces), vertices=len(unit.vertices))
        vertices = unit.vertices * np.abs(size)
        if form == "capsule":
            vertices[:, 2] += np.sign(vertices[:, 2]) * (abs(length) / 2 - abs(radius))
        return VisualShape((Surface(TriangleMesh(vertices, unit.faces)),))

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

    def _painted(self, shape: VisualShape, element: Any) -> VisualShape:
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
