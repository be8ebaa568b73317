"""An articulated object as data for the browser: tables of links, joints, items and looks, and one packed buffer.

Everything is at rest in the object frame (metres, Z up, front -Y). The form is ours and private to the page: the
scripts beside this module read it, docs/pages.md describes it.

Surfaces take few bytes, each corner stored once. A vertex is 8 bytes: three unsigned 16-bit fractions of the mesh's box
and a normal as two signed bytes (octahedral).
"""

import zlib
from base64 import b64encode
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Visual
from grafu.articulation.sweep import opening_stages
from grafu.articulation.swing import Swing
from grafu.export.shading import corner_normals
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import Points, extremes
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.budget import require_time
from grafu.pipeline.report_schema import Report
from grafu.processes.cache import NO_CACHE, Cache
from grafu.render.picture import CATEGORY_COLORS, box_of, opened_values, posed_visuals
from grafu.viewer.pictures import texture_uris

_STEPS = 65535  # of 16 bits
_NORMAL_STEPS = 127  # of a signed byte


@final
@dataclass(frozen=True)
class PackedMesh:
    """The bytes of one mesh: `vertices` (8 bytes each), `indices` (16 or 32 bits each), `uv` and `colors` (4 bytes).

    Two surfaces that are the same but for their place and size are equal here.
    """

    vertices: bytes
    indices: bytes
    wide: bool
    uv: bytes = b""
    colors: bytes = b""

    @property
    def count(self) -> int:
        """The number of indices."""
        return len(self.indices) // (4 if self.wide else 2)


@final
@dataclass(frozen=True)
class PackedSurface:
    """A packed mesh and where it lies: low corner and size of its box, metres, and of its texture coordinates."""

    mesh: PackedMesh
    low: tuple[float, float, float]
    size: tuple[float, float, float]
    uv_low: tuple[float, float] = (0.0, 0.0)
    uv_size: tuple[float, float] = (1.0, 1.0)


def pack_surface(surface: Surface, textured: bool) -> PackedSurface:
    """Returns a surface that has faces, packed; texture coordinates (origin top left) only where `textured`."""
    faces, shading = surface.mesh.faces, corner_normals(surface)
    used = surface.mesh.vertices[faces.ravel()]
    low, high = extremes(used)
    size = high - low
    vertices = np.zeros((len(used), 4), np.uint16)
    vertices[:, :3] = _ratios(used, low, size)
    vertices[:, 3] = _octahedral(np.asarray(shading.normals)).view(np.uint16)[:, 0][shading.corners.ravel()]
    keys = [vertices.view(np.uint64)[:, 0]]
    uv, uv_low, uv_size = np.zeros((0, 2), np.uint16), np.zeros(2), np.ones(2)
    if textured and surface.uv is not None:
        flipped = np.nan_to_num(surface.uv, posinf=0.0, neginf=0.0)[faces.ravel()] * [1.0, -1.0] + [0.0, 1.0]
        flipped = flipped - np.floor(extremes(flipped)[0])  # textures repeat: whole turns change nothing
        uv_low, uv_high = extremes(flipped)
        uv_size = uv_high - uv_low
        uv = _ratios(flipped, uv_low, uv_size)
        keys.append(uv.view(np.uint32)[:, 0].astype(np.uint64))
    colors = np.zeros((0, 4), np.uint8) if surface.colors is None else surface.colors[faces.ravel()]
    if len(colors):
        keys.append(np.ascontiguousarray(colors).view(np.uint32)[:, 0].astype(np.uint64))
    first, index = _distinct(keys)
    indices = _whole_triangles(index)
    wide = len(first) > _STEPS
    mesh = PackedMesh(
        vertices[first].tobytes(),
        indices.astype(np.uint32 if wide else np.uint16).tobytes(),
        wide,
        uv[first].tobytes() if len(uv) else b"",
        colors[first].tobytes() if len(colors) else b"",
    )
    (x, y, z), (dx, dy, dz) = low.tolist(), size.tolist()
    (u, v), (du, dv) = uv_low.tolist(), uv_size.tolist()
    return PackedSurface(mesh, (x, y, z), (dx, dy, dz), (u, v), (du, dv))


def _ratios(values: np.ndarray, low: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Returns where values lie between low and low + size, as 16-bit fractions."""
    return np.rint((values - low) / np.where(size > 0, size, 1.0) * _STEPS).astype(np.uint16)


def _octahedral(normals: Points) -> np.ndarray:
    """Returns unit vectors as two signed bytes: folded onto an octahedron, and that onto a square."""
    flat = normals / np.abs(normals).sum(axis=1, keepdims=True)
    sides = np.where(flat[:, :2] >= 0, 1.0, -1.0)
    folded = (1 - np.abs(flat[:, 1::-1])) * sides
    square = np.where(flat[:, 2:] < 0, folded, flat[:, :2])
    return np.ascontiguousarray(np.rint(square * _NORMAL_STEPS).astype(np.int8))


def _distinct(keys: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Returns the first row of each distinct combination of keys, in the order of appearance, and each row's number."""
    combined = keys[0]
    for key in keys[1:]:
        _, left = np.unique(combined, return_inverse=True)
        values, right = np.unique(key, return_inverse=True)
        combined = left * len(values) + right
    _, first, index = np.unique(combined, return_index=True, return_inverse=True)
    order = np.argsort(first)  # neighbours in use are neighbours in memory: it packs better
    number = np.empty_like(order)
    number[order] = np.arange(len(order))
    return first[order], number[index]


def _whole_triangles(index: np.ndarray) -> np.ndarray:
    """Returns the corners of those triangles that still have three corners."""
    t = index.reshape(-1, 3)
    whole = (t[:, 0] != t[:, 1]) & (t[:, 1] != t[:, 2]) & (t[:, 2] != t[:, 0])
    return np.ascontiguousarray(t[whole]).ravel()


Table = dict[str, Any]
_COMPRESSION = 6


@final
@dataclass(frozen=True)
class SceneData:
    """What the page shows: JSON-ready `tables`, and the `buffer` that they point into (uncompressed)."""

    tables: Table
    buffer: bytes

    @property
    def packed(self) -> str:
        """The buffer as text: zlib, then base64."""
        return b64encode(zlib.compress(self.buffer, _COMPRESSION)).decode()


def scene_data(articulated: ArticulatedObject, report: Report, cache: Cache = NO_CACHE) -> SceneData:
    """Returns an object with what its report states about its joints and parts, as data for the page.

    Surfaces that the `cache` holds are not packed again.
    """
    return _Packer(articulated, report, cache).data()


@final
class _Packer:
    """Fills the tables of one scene; equal meshes, materials and images are stored once."""

    def __init__(self, articulated: ArticulatedObject, report: Report, cache: Cache) -> None:
        self._object, self._report, self._cache = articulated, report, cache
        self._sources = {part.id: part.source.name for part in report.parts if part.source.name != part.id}
        self._meshes: dict[PackedMesh, int] = {}
        self._materials: dict[tuple[Material, bool], int] = {}
        self._textures: dict[Texture, int] = {}
        self._mesh_tables: list[Table] = []
        self._chunks: list[bytes] = []
        self._length = 0

    def data(self) -> SceneData:
        links = self._object.links_from_root
        index = {link.id: k for k, link in enumerate(links)}
        joints = self._object.moving_joints
        number = {joint.id: k for k, joint in enumerate(joints)}
        free = {joint.id for joint in self._object.free_joints}
        swinging = [(v, index[link.id]) for link in links for v in link.visuals if v.swing is not None]
        place = {v.name: len(links) + k for k, (v, _) in enumerate(swinging)}
        items = [self._item(v, place.get(v.name, index[link.id])) for link in links for v in link.visuals]
        closed, opened = posed_visuals(self._object), posed_visuals(self._object, opened_values(self._object))
        tables = {
            "name": self._object.name,
            "closed": _corners(box_of(closed)),
            "reach": _corners(box_of([*closed, *opened])),
            "links": [
                *(self._link(link.id, index, number) for link in links),
                *(self._swing(v.name, v.swing, parent, number) for v, parent in swinging if v.swing is not None),
            ],
            "joints": [self._joint(joint, number) for joint in joints],
            "stages": [[number[name] for name in stage if name in free] for stage in opening_stages(self._object)],
            "items": items,
            "meshes": self._mesh_tables,
            "materials": [self._material(*key) for key in self._materials],
            "textures": texture_uris(list(self._textures)),
            "categories": {label.value: color for label, color in CATEGORY_COLORS.items()},
        }
        return SceneData(tables, b"".join(self._chunks))

    def _link(self, link_id: str, index: dict[str, int], number: dict[str, int]) -> Table:
        joint = self._object.joint_of.get(link_id)
        return {
            "id": link_id,
            "parent": None if joint is None else index[joint.parent],
            "joint": None if joint is None else number.get(joint.id),
        }

    def _swing(self, name: str, swing: Swing, parent: int, number: dict[str, int]) -> Table:
        """Returns a piece that turns on its own pin as a row among the links: `swing` has its joint, line and table."""
        joint = number[self._object.joint_of[swing.moving].id]
        table = {"joint": joint, "axis": _line(swing.axis)}
        table |= {"values": swing.values.tolist(), "angles": swing.angles.tolist()}
        return {"id": name, "parent": parent, "joint": None, "swing": table}

    def _joint(self, joint: Joint, number: dict[str, int]) -> Table:
        record = next((r for r in self._report.joints if r.id == joint.id), None)
        return {
            "id": joint.id,
            "part": joint.child,
            "motion": [joint.kind.turn, joint.kind.shift],
            "shown": [joint.kind.shown.factor, joint.kind.shown.digits, joint.kind.shown.suffix],
            "axis": _line(joint.axis),
            "initial": None if record is None else [record.initial_axis.origin, record.initial_axis.direction],
            "lower": joint.limits.lower,
            "upper": joint.limits.upper,
            "slip": None if joint.slip is None else [joint.slip.values.tolist(), joint.slip.shifts.tolist()],
            "after": [number[self._leader(other)] for other in joint.after],
            "coupling": None
            if joint.coupling is None
            else [number[joint.coupling.leader], joint.coupling.multiplier, joint.coupling.offset],
        }

    def _leader(self, joint_id: str) -> str:
        """Returns the joint that moves by itself, where one is named that follows it."""
        return self._object.leader_of(next(j for j in self._object.joints if j.id == joint_id)).id

    def _item(self, visual: Visual, link: int) -> Table:
        require_time()
        pieces = [self._piece(surface) for surface in visual.surfaces if not surface.is_empty]
        box = _corners(visual.mesh.box) if pieces else None
        return {
            "name": visual.name,
            "source": self._sources.get(visual.name, ""),
            "label": visual.label.value,
            "role": visual.role.value,
            "link": link,
            "box": box,
            "pieces": pieces,
        }

    def _piece(self, surface: Surface) -> Table:
        textured = surface.material.base_color_texture is not None and surface.uv is not None
        packed = self._cache.value("surface", pack_surface, surface, textured)
        material = self._materials.setdefault((surface.material, textured), len(self._materials))
        if textured and surface.material.base_color_texture is not None:
            self._textures.setdefault(surface.material.base_color_texture, len(self._textures))
        piece: Table = {"mesh": self._mesh(packed.mesh), "material": material, "low": packed.low, "size": packed.size}
        return piece | ({"uv": [packed.uv_low, packed.uv_size]} if textured else {})

    def _mesh(self, mesh: PackedMesh) -> int:
        if mesh not in self._meshes:
            self._meshes[mesh] = len(self._meshes)
            table = {"vertices": self._store(mesh.vertices), "indices": self._store(mesh.indices)}
            table |= {name: self._store(data) for name, data in (("uv", mesh.uv), ("colors", mesh.colors)) if data}
            self._mesh_tables.append({**table, "bits": 32 if mesh.wide else 16})
        return self._meshes[mesh]

    def _store(self, data: bytes) -> list[int]:
        """Appends bytes at a multiple of four and returns where they begin and how many they are."""
        padded = data + b"\0" * (-len(data) % 4)
        start, self._length = self._length, self._length + len(padded)
        self._chunks.append(padded)
        return [start, len(data)]

    def _material(self, material: Material, textured: bool) -> Table:
        texture = material.base_color_texture if textured else None
        return {
            "color": material.base_color,
            "texture": None if texture is None else self._textures[texture],
            "metallic": material.metallic,
            "roughness": material.roughness,
            "emissive": material.emissive,
            "mode": material.alpha_mode,
            "cutoff": material.alpha_cutoff,
        }


def _corners(box: Box) -> list[list[float]]:
    return [box.low.tolist(), box.high.tolist()]


def _line(axis: Axis) -> list[list[float]]:
    return [axis.point.tolist(), axis.direction.tolist()]
