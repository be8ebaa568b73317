"""FBX scenes (.fbx, binary): models with meshes are parts, in the file's own coordinates. It settles no frame.

Names, hierarchies, pivots, units, axes, diffuse colours and images are read; skins, animations and light are not.
"""

import math
from collections.abc import Iterator
from dataclasses import field
from pathlib import Path, PureWindowsPath
from typing import final

import numpy as np

from grafu.asset.drafts import drafts_of_nodes, parts_of_drafts
from grafu.asset.fbx_document import FbxArray, FbxRecord, damaged, read_records
from grafu.asset.mesh_files import linear_channel, named_texture, surface_of_corners
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.polygons import triangulate
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.scene_nodes import Chain, SceneNode
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import Mat4
from grafu.geometry.transform import euler_matrix, from_rotation

_ORDERS = ("xyz", "xzy", "yzx", "yxz", "zxy", "zyx")  # about fixed axes, the first turn first
_LARGEST = 1e12  # of a number in a transform or a position: products of some of them stay finite
_BASE_COLOURS = ("diffusecolor", "basecolor", "base_color", "base_color_map", "basecolormap", "tex_color_map")
_NOTHING = (0.0, 0.0, 0.0)

Properties = dict[str, tuple[float, ...]]


def read_fbx(path: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the scene of a .fbx file in its own coordinates.

    Raises:
        UnreadableAsset: if the file is missing or damaged, text, or older than FBX 7.0.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    files = files or ModelFiles(path, options.limits)
    scene = _Scene(path, files, read_records(files.read(path), path, files.limits))
    nodes = list(scene.nodes())
    check_parts(len(nodes), path, options.limits)
    metres, up = _unit_and_up(scene.document.first("GlobalSettings").properties())
    convention = Convention(f"the file (FBX: {metres:g} m per unit, {up[1]} up)", up=up, unit=metres)
    parts = parts_of_drafts(drafts_of_nodes(nodes, path.name))
    return Reading("mesh file", parts, convention, notes=tuple(dict.fromkeys(scene.notes)))


def _unit_and_up(settings: Properties) -> tuple[float, str]:
    """Returns metres for each unit and the axis that points up; FBX counts in centimetres, Y up, where it is silent."""
    centimetres = settings.get("UnitScaleFactor", (1.0,))[0]
    axis, sign = (settings.get(name, (1.0,))[0] for name in ("UpAxis", "UpAxisSign"))
    letter = "XYZ"[int(axis)] if axis in (0.0, 1.0, 2.0) else "Y"
    return centimetres / 100.0 if 1e-4 < centimetres < 1e8 else 0.01, f"{'-' if sign < 0 else '+'}{letter}"


@final
@dataclass
class _Scene:
    """The document while it is read. Not a value: notes gather."""

    path: Path
    files: ModelFiles
    document: FbxRecord
    notes: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._objects = {record.number(): record for record in self.document.first("Objects").records}
        self._below: dict[int, list[tuple[int, str]]] = {}  # of each object, what is connected to it, and to what of it
        for link in self.document.first("Connections").all("C"):
            below, above = link.number(1), link.number(2)
            if below in self._objects:
                self._below.setdefault(above, []).append((below, link.text(3)))
        self._materials: dict[int, Material] = {}
        # Blender writes colours as it counts in them, others as they are shown
        self._is_linear = self.document.first("Creator").text().startswith("Blender")

    def nodes(self) -> Iterator[SceneNode]:
        """Yields the models with faces, each in the coordinates of the scene."""
        stack: list[tuple[int, Mat4, Chain]] = [(i, np.eye(4), ()) for i in reversed(self._of(0, "Model"))]
        seen: set[int] = set()
        while stack:
            index, above, chain = stack.pop()
            model = self._objects[index]
            if index in seen:
                raise damaged(self.path, f"model {model.text(1)!r} has two parents or lies in a cycle")
            seen.add(index)
            self.files.limits.require("nodes", len(seen), self.path)
            self.files.limits.require("depth", len(chain) + 1, self.path)
            properties, name = model.properties(), model.text(1) or f"node_{len(seen)}"
            T, here = above @ _local(properties), (*chain, (len(seen), name))
            if not np.abs(T).max() < _LARGEST:
                raise damaged(self.path, "a transform holds numbers that no furniture has")
            surfaces = self._surfaces(index, T @ _geometric(properties))
            if surfaces and properties.get("Visibility", (1.0,))[0] == 0.0:
                self.notes.append(f"{name} is hidden and was left out")
            elif surfaces:
                yield SceneNode(name, here, surfaces)
            stack += [(child, T, here) for child in reversed(self._of(index, "Model"))]

    def _of(self, index: int, kind: str) -> list[int]:
        """Returns the objects of a kind that are connected to another, in the order of the file."""
        found = (below for below, _ in self._below.get(index, ()) if self._objects[below].name == kind)
        return list(dict.fromkeys(found))

    def _surfaces(self, model: int, T: Mat4) -> tuple[Surface, ...]:
        materials = self._of(model, "Material")
        found: list[Surface] = []
        for index in self._of(model, "Geometry"):
            geometry = self._objects[index]
            if geometry.text(2) != "Mesh":
                self.notes.append(f"{geometry.text(2) or 'a geometry'} has no faces and was left out")
                continue
            found += self._mesh(geometry, materials)
        moved = found if np.array_equal(T, np.eye(4)) else [surface.transformed(T) for surface in found]
        return tuple(surface for surface in moved if not surface.is_empty)

    def _mesh(self, geometry: FbxRecord, materials: list[int]) -> Iterator[Surface]:
        """Yields a mesh as one surface for each of its materials."""
        points, polygons = geometry.first("Vertices").array(), geometry.first("PolygonVertexIndex").array()
        self.files.tally.add(self.path, vertices=max(points.count // 3, polygons.count))
        vertices, stated = self._finite(points, 3), self._whole(polygons)
        ends = np.flatnonzero(stated < 0) + 1
        corners, starts = np.where(stated < 0, ~stated, stated)[: ends[-1] if len(ends) else 0], np.r_[0, ends]
        if len(corners) and not 0 <= corners.min() <= corners.max() < len(vertices):
            raise damaged(self.path, f"a face names vertex {corners.max()} of {len(vertices)}")
        self.files.tally.add(self.path, faces=max(len(corners) - 2 * len(ends), 0))
        self.files.tally.require(self.path, corners=int(np.diff(starts).max(initial=0)))
        triangles, owners = triangulate(vertices, corners, starts)
        uv, at_uv = self._layer(geometry.first("LayerElementUV"), "UV", 2, corners)
        normals, at_normal = self._layer(geometry.first("LayerElementNormal"), "Normals", 3, corners)
        used = self._material_of_faces(geometry, len(ends))[owners]
        keys = np.stack([corners, at_uv, at_normal], axis=1)
        for slot in np.unique(used):
            self.files.tally.add(self.path, primitives=1)
            material = self._material(materials[slot]) if 0 <= slot < len(materials) else Material()
            chosen = keys[triangles[used == slot].ravel()].astype(np.int64)
            yield surface_of_corners(chosen, vertices, uv, normals, None, material)

    def _material_of_faces(self, geometry: FbxRecord, count: int) -> np.ndarray:
        layer = geometry.first("LayerElementMaterial")
        stated = layer.first("Materials").array()
        if layer.first("MappingInformationType").text() == "ByPolygon" and stated.count == count:
            return self._whole(stated)
        return np.full(count, self._whole(stated)[0] if stated.count == 1 else 0)

    def _layer(self, layer: FbxRecord, name: str, width: int, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Returns values for corners and each corner's place among them, -1 where there are none."""
        none = np.zeros((0, width)), np.full(len(corners), -1)
        stated, places = layer.first(name).array(), layer.first(f"{name}Index").array()
        mapping = layer.first("MappingInformationType").text()
        if not stated.count or stated.count > width * max(3 * len(corners), 1):
            return none
        values = self._finite(stated, width)
        at = {"ByPolygonVertex": np.arange(len(corners)), "ByVertice": corners, "ByVertex": corners}.get(mapping)
        if at is not None and layer.first("ReferenceInformationType").text() != "Direct":
            known = self._whole(places) if places.count <= 3 * len(corners) else np.zeros(0, np.int64)
            at = known[at] if at.max(initial=-1) < len(known) else None
        if at is None or (len(at) and not 0 <= at.min() <= at.max() < len(values)):
            self.notes.append(f"{name} of another form or damaged were left out")
            return none
        return values, at

    def _finite(self, array: FbxArray, width: int) -> np.ndarray:
        values = array.values().astype(np.float64)
        if not np.abs(values).max(initial=0.0) < _LARGEST:
            raise damaged(self.path, "it holds numbers that no furniture has")
        return values[: len(values) // width * width].reshape(-1, width)

    def _whole(self, array: FbxArray) -> np.ndarray:
        self.files.tally.require(self.path, vertices=array.count)
        values = array.values()
        if values.dtype.kind not in "iu":
            raise damaged(self.path, "it has fractions where whole numbers belong")
        return values.astype(np.int64)

    def _material(self, index: int) -> Material:
        if index not in self._materials:
            self._materials[index] = self._painted(index)
        return self._materials[index]

    def _painted(self, index: int) -> Material:
        record = self._objects[index]
        properties = record.properties()
        shown = next(
            (properties[n] for n in ("DiffuseColor", "Diffuse") if len(properties.get(n, ())) == 3), (0.8,) * 3
        )
        texture = self._texture(index)
        clear = properties.get("TransparencyFactor", (0.0,))[0]
        alpha = properties.get("Opacity", (1.0 - clear,))[0]
        alpha = alpha if 0.02 < alpha < 1.0 else 1.0
        red, green, blue = (
            (1.0, 1.0, 1.0)
            if texture is not None
            else tuple(min(max(v, 0.0), 1.0) if self._is_linear else linear_channel(v) for v in shown)
        )
        return Material(
            name=record.text(1),
            base_color=(red, green, blue, alpha),
            roughness=0.7,
            base_color_texture=texture,
            alpha_mode="BLEND" if alpha < 0.999 else "OPAQUE",
            double_sided=True,
        )

    def _texture(self, material: int) -> Texture | None:
        """Returns the image of a material's base colour: one within the file, or one of the model's own files."""
        for below, channel in self._below.get(material, ()):
            texture = self._objects[below]
            if texture.name != "Texture" or channel.rpartition("|")[2].lower() not in _BASE_COLOURS:
                continue
            names = [texture.first(key).text() for key in ("RelativeFilename", "FileName")]
            for video in (self._objects[i] for i in self._of(below, "Video")):
                content = video.first("Content").values
                if content and isinstance(content[0], bytes) and content[0]:
                    found = self.files.image(content[0], PureWindowsPath(names[0] or names[1]).name or "image")
                    if isinstance(found, Texture):
                        return found
                    self.notes.append(f"an image within the file {found} and was left out")
            return self._image_file([name for name in names if name])
        return None

    def _image_file(self, names: list[str]) -> Texture | None:
        """Returns the image under one of its names, or of that name beside the file: paths are of another machine."""
        folder = self.path.parent
        last = [PureWindowsPath(name).name for name in names]
        places = [name.replace("\\", "/") for name in names[:1]]
        places += [f"{at}{name}" for name in dict.fromkeys(last) for at in ("", "textures/", f"{self.path.stem}.fbm/")]
        known = next((place for place in places if self.files.seek(place, folder).path is not None), None)
        return named_texture(known or (last or [""])[0], folder, self.files, self.notes) if names else None


def _vector(properties: Properties, name: str, default: tuple[float, ...] = _NOTHING) -> np.ndarray:
    found = properties.get(name, default)
    return np.array(found if len(found) == 3 else default)


def _turn(degrees: np.ndarray, order: str = "xyz") -> Mat4:
    turns = np.radians([degrees["xyz".index(axis)] for axis in order])
    return from_rotation(euler_matrix(turns.tolist(), order), np.zeros(3))


def _shift(by: np.ndarray) -> Mat4:
    return from_rotation(np.eye(3), by)


def _local(p: Properties) -> Mat4:
    """Returns the pose of a model in the one above it: translation, pivots, rotations, scale, in FBX's order."""
    order = p.get("RotationOrder", (0.0,))[0]
    word = _ORDERS[int(order)] if math.isfinite(order) and 0 <= order < len(_ORDERS) else "xyz"
    about, scaled = _vector(p, "RotationPivot"), _vector(p, "ScalingPivot")
    before, after = np.eye(4), np.eye(4)
    if p.get("RotationActive", (0.0,))[0]:  # where it is not, all three are to be ignored
        before, after = _turn(_vector(p, "PreRotation")), _turn(_vector(p, "PostRotation")).T
    else:
        word = "xyz"
    S = np.diag([*_vector(p, "Lcl Scaling", (1.0, 1.0, 1.0)), 1.0])
    T = _shift(_vector(p, "Lcl Translation") + _vector(p, "RotationOffset") + about) @ before
    T = T @ _turn(_vector(p, "Lcl Rotation"), word) @ after @ _shift(_vector(p, "ScalingOffset") + scaled - about)
    return _hidden_if_flat(T @ S @ _shift(-scaled))


def _geometric(p: Properties) -> Mat4:
    """Returns the pose of a model's mesh in the model, which those below it do not share."""
    S = np.diag([*_vector(p, "GeometricScaling", (1.0, 1.0, 1.0)), 1.0])
    return _hidden_if_flat(_shift(_vector(p, "GeometricTranslation")) @ _turn(_vector(p, "GeometricRotation")) @ S)


def _hidden_if_flat(T: Mat4) -> Mat4:
    """Returns a pose as it is; one with a scale of zero as one so small that no face survives."""
    return T if abs(np.linalg.det(T[:3, :3])) > 1e-30 else from_rotation(np.eye(3) * 1e-9, T[:3, 3])
