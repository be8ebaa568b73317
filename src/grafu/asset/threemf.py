"""3MF files (.3mf): objects with meshes are parts, in the file's own coordinates. It settles no frame.

The package is a ZIP archive; of it the model is unpacked, within the limit of bytes. Colours of base materials and
colour groups are read, one for each triangle; textures, slices and lattices are not.
"""

import re
import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import field
from io import BytesIO
from pathlib import Path
from typing import Any, Final, final

import numpy as np

from grafu.asset.drafts import drafts_of_nodes, parts_of_drafts
from grafu.asset.mesh_files import linear_channel, surface_of_corners
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.scan_files import parse_xml
from grafu.asset.scene_nodes import Chain, SceneNode
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import Mat4

_METRES: Final = {
    "micron": 1e-6,
    "millimeter": 1e-3,
    "centimeter": 1e-2,
    "inch": 0.0254,
    "foot": 0.3048,
    "meter": 1.0,
}
_EXPECTED = "a 3MF package with a model in it; export it again"
_MODEL = re.compile(r"^3D/[^/]+\.model$", re.IGNORECASE)
_COLOUR = re.compile(r"#([0-9a-fA-F]{2})([0-9a-fA-F]{2})([0-9a-fA-F]{2})([0-9a-fA-F]{2})?")
_LARGEST = 1e12  # of a coordinate: products of some of them stay finite
# RuntimeError: a member that is encrypted, or packed by a method or version of ZIP that `zipfile` does not unpack.
_BROKEN = (zipfile.BadZipFile, zlib.error, ValueError, KeyError, RuntimeError, EOFError, OSError)


def read_threemf(path: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the objects that a .3mf file builds, in its own coordinates.

    Raises:
        UnreadableAsset: if the file is missing or damaged, or its objects contain themselves.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    files = files or ModelFiles(path, options.limits)
    root = _without_namespaces(parse_xml(_model_text(path, files), path, _EXPECTED, files.limits))
    if root.tag != "model":
        raise UnreadableAsset(f"{path} has the root <{root.tag}>: expected <model>, {_EXPECTED}")
    package = _Package(path, files, root)
    nodes = list(package.nodes())
    check_parts(len(nodes), path, options.limits)
    unit = root.get("unit", "millimeter")
    metres = _METRES.get(unit, 1e-3)
    convention = Convention(f"the file (3MF: {metres:g} m per unit, Z up)", up="+Z", unit=metres)
    parts = parts_of_drafts(drafts_of_nodes(nodes, path.name))
    return Reading("mesh file", parts, convention, notes=tuple(dict.fromkeys(package.notes)))


def _model_text(path: Path, files: ModelFiles) -> bytes:
    """Returns the model in the package; no more of it is unpacked than may be read."""
    try:
        with zipfile.ZipFile(BytesIO(files.read(path))) as package:
            names = [name for name in package.namelist() if _MODEL.match(name.lstrip("/"))]
            if not names:
                raise UnreadableAsset(f"{path} holds no 3D/*.model: expected {_EXPECTED}")
            most = files.tally.left("bytes")
            with package.open(min(names, key=lambda name: "3dmodel" not in name.lower())) as stream:
                data = stream.read(most + 1)
    except _BROKEN as error:
        raise UnreadableAsset(f"{path} is no readable package ({type(error).__name__}): expected {_EXPECTED}") from None
    files.tally.add(path, bytes=len(data))
    return data


def _without_namespaces(root: Any) -> Any:
    for element in root.iter():
        if isinstance(element.tag, str):
            element.tag = element.tag.rpartition("}")[2]
    return root


@final
@dataclass
class _Package:
    """The model while it is read. Not a value: notes gather."""

    path: Path
    files: ModelFiles
    root: Any
    notes: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._objects = {e.get("id", ""): e for e in self.root.iterfind("resources/object")}
        self._materials = {e.get("id", ""): e for e in self.root.iterfind("resources/*") if e.tag != "object"}
        self._made: dict[str, tuple[Surface, ...]] = {}

    def nodes(self) -> Iterator[SceneNode]:
        """Yields the objects with meshes that are built, each in the coordinates of the file."""
        items = self.root.findall("build/item")
        stack: list[tuple[Any, Mat4, Chain]] = [(item, np.eye(4), ()) for item in reversed(items)]
        count = 0
        while stack:
            placed, above, chain = stack.pop()
            count += 1
            self.files.limits.require("nodes", count, self.path)
            self.files.limits.require("depth", len(chain) + 1, self.path)
            key = placed.get("objectid", "")
            found = self._objects.get(key)
            if found is None:
                self.notes.append(f"object {key[:40]} is not in this model and was left out")
                continue
            T = above @ self._transform(placed)
            name = found.get("name") or f"object_{key[:40]}"
            here = (*chain, (count, name))
            surfaces = self._surfaces(key, found)
            if surfaces:
                yield SceneNode(name, here, tuple(surface.transformed(T) for surface in surfaces))
            stack += [(below, T, here) for below in reversed(found.findall("components/component"))]

    def _transform(self, placed: Any) -> Mat4:
        text = placed.get("transform")
        if text is None:
            return np.eye(4)
        rows = self._numbers([text.split()], 12).reshape(4, 3)  # a row for each axis, then the translation
        T = np.eye(4)
        T[:3, :] = rows.T
        return T

    def _surfaces(self, key: str, found: Any) -> tuple[Surface, ...]:
        """Returns the surfaces of an object, made once, and counted each time that it is placed."""
        mesh = found.find("mesh")
        if mesh is None:
            return ()
        points, triangles = mesh.findall("vertices/vertex"), mesh.findall("triangles/triangle")
        self.files.tally.add(self.path, primitives=1, vertices=len(points), faces=len(triangles))
        if key not in self._made:
            self._made[key] = self._mesh(found, points, triangles)
        return self._made[key]

    def _mesh(self, found: Any, points: list[Any], triangles: list[Any]) -> tuple[Surface, ...]:
        vertices = self._numbers([[p.get(k, "") for k in "xyz"] for p in points], 3)
        corners = self._numbers([[t.get(k, "") for k in ("v1", "v2", "v3")] for t in triangles], 3)
        faces = corners.astype(np.int64)
        if len(faces) and not 0 <= faces.min() <= faces.max() < len(vertices):
            wrong = f"a triangle names vertex {faces.max()} of {len(vertices)}"
            raise UnreadableAsset(f"{self.path} is damaged ({wrong}): expected {_EXPECTED}")
        by_look: dict[tuple[str, str], list[int]] = {}
        usual = found.get("pid", ""), found.get("pindex", "0")
        for index, triangle in enumerate(triangles):
            group = triangle.get("pid", usual[0])
            by_look.setdefault((group, triangle.get("p1", usual[1])), []).append(index)
        self.files.tally.add(self.path, primitives=max(len(by_look) - 1, 0))
        made = (_surface(vertices, faces[chosen], self._material(*look)) for look, chosen in by_look.items())
        return tuple(surface for surface in made if not surface.is_empty)

    def _material(self, group: str, place: str) -> Material:
        found = self._materials.get(group)
        rows = [] if found is None else [*found]
        row = rows[int(place)] if place.isdecimal() and len(place) < 10 and int(place) < len(rows) else None
        if row is None:
            return Material()
        match = _COLOUR.fullmatch(row.get("displaycolor") or row.get("color") or "")
        if match is None:
            return Material()
        red, green, blue, alpha = (int(value or "ff", 16) / 255 for value in match.groups())
        return Material(
            name=row.get("name") or f"material_{place}",
            base_color=(linear_channel(red), linear_channel(green), linear_channel(blue), alpha),
            alpha_mode="BLEND" if alpha < 0.999 else "OPAQUE",
        )

    def _numbers(self, rows: list[list[str]], width: int) -> np.ndarray:
        try:
            values = np.array(rows, dtype=np.float64).reshape(-1, width) if rows else np.zeros((0, width))
        except (ValueError, OverflowError):
            values = np.full((1, width), np.nan)
        if not np.abs(values).max(initial=0.0) < _LARGEST:
            raise UnreadableAsset(f"{self.path} holds what is no coordinate of furniture: expected finite numbers")
        return values


def _surface(vertices: np.ndarray, faces: np.ndarray, material: Material) -> Surface:
    """Returns some of a mesh's triangles with the vertices that they use."""
    corners = np.full((faces.size, 3), -1)
    corners[:, 0] = faces.ravel()
    return surface_of_corners(corners, vertices, np.zeros((0, 2)), np.zeros((0, 3)), None, material)
