"""An articulated object as data for the browser: tables of links, joints, items and looks, and one packed buffer.

Everything is at rest in the object frame (metres, Z up, front -Y). The form is ours and private to the page: the
scripts beside this module read it, docs/pages.md describes it.
"""

import zlib
from base64 import b64encode
from typing import Any, final

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Visual
from grafu.articulation.sweep import opening_stages
from grafu.articulation.swing import Swing
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import Mat4
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.budget import require_time
from grafu.geometry.mesh import TriangleMesh
from grafu.pipeline.report_schema import Report
from grafu.processes.cache import NO_CACHE, Cache
from grafu.render.picture import CATEGORY_COLORS, box_of, opened_values, placed_visuals
from grafu.viewer.packed_surface import PackedMesh, pack_surface
from grafu.viewer.pictures import texture_uris

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
        closed, opened = self._box_at({}), self._box_at(opened_values(self._object))
        tables = {
            "name": self._object.name,
            "closed": _corners(closed),
            "reach": _corners(closed.union(opened)),
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

    def _box_at(self, values: dict[str, float]) -> Box:
        """Returns the box around all at joint values; that of a piece which stays where it was is known."""
        boxes = [
            self._cache.value("posed box", _posed_box, visual.mesh, T)
            for visual, T in placed_visuals(self._object, values)
            if len(visual.mesh.faces)
        ]
        return Box.enclosing(boxes) if boxes else box_of([])

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


def _posed_box(mesh: TriangleMesh, T: Mat4) -> Box:
    return mesh.transformed(T).box


def _corners(box: Box) -> list[list[float]]:
    return [box.low.tolist(), box.high.tolist()]


def _line(axis: Axis) -> list[list[float]]:
    return [axis.point.tolist(), axis.direction.tolist()]
