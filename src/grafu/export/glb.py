"""An articulated object as one animated GLB: every part its own node, one animation of all joints, one of each.

Coordinates are baked to glTF's frame (Y up, front +Z). Each link has a node whose origin lies on its joint's axis; its
parts, its hardware and the links it carries are the children. Node `extras.grafu` say what glTF cannot: the joint's
type, axis (in the node's frame), limits and order, and each part's role and label. The writer is our own: trimesh
exports no animation, and the Khronos validator reports hints on its files.
"""

import json
import struct
from collections.abc import Iterator
from dataclasses import asdict, replace
from typing import Any, final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Link, Visual
from grafu.articulation.catch_kind import CatchKind
from grafu.articulation.grasp_frame import GraspFrame
from grafu.articulation.kinematics import link_origins
from grafu.articulation.sweep import JointTrack, cycle_tracks, opening_tracks
from grafu.articulation.swing import Swing
from grafu.dataclass import dataclass
from grafu.errors import ExportError
from grafu.export.files import ExportFiles
from grafu.export.gltf_buffer import GltfBuffer
from grafu.export.gltf_mesh import GltfMaterialWriter, mesh_of, to_y_up
from grafu.export.gltf_packing import EXTENSION, DracoConfig
from grafu.export.merged_visuals import merged_visuals
from grafu.export.names import NameBook
from grafu.export.shading import CREASE_ANGLE
from grafu.geometry.arrays import Scalars, Vec3
from grafu.geometry.transform import quaternions_about
from grafu.version import __version__
from grafu.visible import writable

ANIMATION_NAME = "open_close"
_JSON_CHUNK = 0x4E4F534A
_BINARY_CHUNK = 0x004E4942


@final
@dataclass(frozen=True, slots=True)
class GlbConfig:
    """How a GLB is written; times in seconds, the crease angle in radians.

    `stage_seconds` is how long what opens together takes; `pause` how long all stays open. With `merge`
    each link is one mesh, with one primitive per material: fewer draw calls, and no nodes of parts. With `draco`
    meshes are compressed.
    """

    animate: bool = True
    stage_seconds: float = 1.5
    pause: float = 0.5
    crease_angle: float = CREASE_ANGLE
    merge: bool = False
    draco: DracoConfig | None = None

    def __post_init__(self) -> None:
        if self.stage_seconds <= 0 or self.pause <= 0:
            raise ValueError(f"times must be positive seconds: got {self.stage_seconds} and {self.pause}")


DEFAULT_GLB_CONFIG = GlbConfig()


def export_glb(articulated: ArticulatedObject, config: GlbConfig = DEFAULT_GLB_CONFIG) -> ExportFiles:
    """Returns `model.glb`, the same bytes for the same object.

    Raises:
        ExportError: if the file would exceed the 4 GiB of the format.
    """
    return ExportFiles({"model.glb": _GlbWriter(articulated, config).to_bytes()})


def export_merged_glb(articulated: ArticulatedObject, config: GlbConfig = DEFAULT_GLB_CONFIG) -> ExportFiles:
    """Returns `model_merged.glb`, as `export_glb` does, with one mesh per link.

    Raises:
        ExportError: if the file would exceed the 4 GiB of the format.
    """
    return ExportFiles({"model_merged.glb": _GlbWriter(articulated, replace(config, merge=True)).to_bytes()})


@final
class _GlbWriter:
    """Fills the tables of one glTF file."""

    def __init__(self, articulated: ArticulatedObject, config: GlbConfig) -> None:
        self._object = articulated
        self._config = config
        self._origins = link_origins(articulated)
        self._buffer = GltfBuffer()
        self._materials = GltfMaterialWriter(self._buffer)
        self._names = _reserved_names(articulated)
        self._nodes: list[dict[str, Any]] = []
        self._meshes: list[dict[str, Any]] = []
        self._swings: list[tuple[int, Swing]] = []

    def to_bytes(self) -> bytes:
        link_nodes = {link.id: self._add_link(link) for link in self._object.links_from_root}
        for link, node in link_nodes.items():
            joint = self._object.joint_of.get(link)
            if joint is not None:
                self._nodes[link_nodes[joint.parent]].setdefault("children", []).append(node)
        animations = self._animations(link_nodes) if self._config.animate else []
        return _packed(self._tables(link_nodes[self._object.root], animations), self._buffer.to_bytes())

    def _tables(self, root: int, animations: list[dict[str, Any]]) -> dict[str, Any]:
        data = self._buffer.to_bytes()
        tables: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": f"grafu {__version__}"},
            **dict.fromkeys(("extensionsUsed", "extensionsRequired"), self._extensions()),
            "scene": 0,
            "scenes": [{"name": self._object.name, "nodes": [root]}],
            "nodes": self._nodes,
            "meshes": self._meshes,
            **self._materials.tables,
            "animations": animations,
            "accessors": self._buffer.accessors,
            "bufferViews": self._buffer.views,
            "buffers": [{"byteLength": len(data)}] if data else [],
        }
        return {name: table for name, table in tables.items() if table != []}

    def _extensions(self) -> list[str]:
        primitives = (primitive for mesh in self._meshes for primitive in mesh["primitives"])
        return [EXTENSION] if any("extensions" in primitive for primitive in primitives) else []

    def _add_link(self, link: Link) -> int:
        joint = self._object.joint_of.get(link.id)
        node: dict[str, Any] = {"name": self._names.unique(f"{link.id}_link")}
        extras: dict[str, Any] = {"link": link.id}
        grasps = [g for g in self._object.grasps if g.link == link.id]
        if grasps:
            extras["grasps"] = [_described_grasp(grasp, self._origins[link.id]) for grasp in grasps]
        if joint is not None:
            node["translation"] = self._offset(joint)
            extras["joint"] = _described_joint(joint)
            if self._config.animate and _opens(joint):
                extras["on_click"] = self._on_click(joint)
        node["extras"] = {"grafu": extras}
        self._nodes.append(node)
        index = len(self._nodes) - 1
        visuals = merged_visuals(link) if self._config.merge else link.visuals
        children = [self._add_visual(visual, self._origins[link.id]) for visual in visuals]
        if children:
            node["children"] = children
        return index

    def _offset(self, joint: Joint) -> list[float]:
        offset = self._origins[joint.child] - self._origins[joint.parent]
        return _plain(to_y_up(offset[None])[0])

    def _add_visual(self, visual: Visual, origin: Vec3) -> int:
        """Adds a part of a link whose frame stands at an origin; one that swings has a node on its own pin."""
        stands = origin if visual.swing is None else visual.swing.axis.closest_point(visual.mesh.box.center)
        writer = self._buffer, self._materials
        mesh = mesh_of(visual, stands, writer, self._config.crease_angle, self._config.draco)
        node: dict[str, Any] = {"name": visual.name}
        if visual.swing is not None:
            node["translation"] = _plain(to_y_up((stands - origin)[None])[0])
            self._swings.append((len(self._nodes), visual.swing))
        if mesh["primitives"]:
            node["mesh"] = len(self._meshes)
            self._meshes.append(mesh)
        node["extras"] = {"grafu": {"role": visual.role.value, "label": visual.label.value}}
        self._nodes.append(node)
        return len(self._nodes) - 1

    def _on_click(self, joint: Joint) -> dict[str, Any]:
        """Returns which animation a click on a link plays, and those that must have been played before."""
        leader = self._object.leader_of(joint)
        return {"play": _clip_name(leader.id), "toggle": True, "after": [_clip_name(other) for other in leader.after]}

    def _animations(self, link_nodes: dict[str, int]) -> list[dict[str, Any]]:
        """Returns the animation that opens and closes everything, then one for each joint that moves by itself."""
        times: dict[bytes, int] = {}
        tracks = cycle_tracks(self._object, self._config.stage_seconds, self._config.pause)
        made = [self._animation(ANIMATION_NAME, tracks, link_nodes, times)]
        for joint in self._object.free_joints:
            tracks = opening_tracks(self._object, joint.id, self._config.stage_seconds)
            made.append(self._animation(_clip_name(joint.id), tracks, link_nodes, times))
        return [animation for animation in made if animation is not None]

    def _animation(
        self, name: str, tracks: tuple[JointTrack, ...], link_nodes: dict[str, int], times: dict[bytes, int]
    ) -> dict[str, Any] | None:
        joints = {joint.id: joint for joint in self._object.moving_joints if _opens(joint)}
        moving = [track for track in tracks if track.joint in joints]
        if not moving:
            return None
        samplers: list[dict[str, Any]] = []
        channels: list[dict[str, Any]] = []
        for track in moving:
            joint = joints[track.joint]
            for path, values in self._animated(joint, track.values):
                target = {"node": link_nodes[joint.child], "path": path}
                channels.append({"sampler": len(samplers), "target": target})
                samplers.append(self._sampler(track, values, times))
            for node, swing in self._swings:
                if swing.moving == joint.child:
                    turns = quaternions_about(to_y_up(swing.axis.direction[None])[0], swing.angles_at(track.values))
                    channels.append({"sampler": len(samplers), "target": {"node": node, "path": "rotation"}})
                    samplers.append(self._sampler(track, turns, times))
        return {"name": name, "channels": channels, "samplers": samplers}

    def _animated(self, joint: Joint, values: Scalars) -> Iterator[tuple[str, np.ndarray]]:
        """Yields the properties of a joint's node that follow its values, with what they pass through."""
        axis, kind = to_y_up(joint.axis.direction[None])[0], joint.kind
        if kind.turn:
            # neighbours lie on one side, so that interpolation never flips
            yield "rotation", quaternions_about(axis, kind.turn * values)
        if kind.shift or joint.slip is not None:
            beside = 0.0 if joint.slip is None else to_y_up(joint.slip.shifts_at(values))
            yield "translation", np.array(self._offset(joint)) + np.outer(kind.shift * values, axis) + beside

    def _sampler(self, track: JointTrack, values: np.ndarray, times: dict[bytes, int]) -> dict[str, Any]:
        key = track.times.tobytes()
        if key not in times:  # joints of one stage share their key times
            times[key] = self._buffer.add_array(track.times.astype(np.float32), bounds=True)
        output = self._buffer.add_array(np.ascontiguousarray(values, dtype=np.float32))
        return {"input": times[key], "output": output, "interpolation": "LINEAR"}


def _reserved_names(articulated: ArticulatedObject) -> NameBook:
    names = NameBook()
    for link in articulated.links:
        for visual in link.visuals:
            names.unique(visual.name)
    return names


def _opens(joint: Joint) -> bool:
    return joint.kind.moves and joint.limits.range > 0


def _clip_name(joint_id: str) -> str:
    return f"open_{joint_id}"


def _described_joint(joint: Joint) -> dict[str, Any]:
    return {
        "id": joint.id,
        "type": joint.type.value,
        "axis": _plain(to_y_up(joint.axis.direction[None])[0]),
        "lower": joint.limits.lower,
        "upper": joint.limits.upper,
        "after": list(joint.after),
        **({} if joint.coupling is None else {"coupling": asdict(joint.coupling)}),
        **({} if joint.catch is CatchKind.NONE else {"catch": joint.catch.value}),
    }


def _described_grasp(grasp: GraspFrame, origin: Vec3) -> dict[str, Any]:
    """Returns a grasp in the frame of its link's node."""
    vectors = np.stack([grasp.position - origin, grasp.approach, grasp.closing])
    position, approach, closing = (_plain(vector) for vector in to_y_up(vectors))
    return {
        "name": grasp.name,
        "part": grasp.part,
        "kind": grasp.kind,
        "position": position,
        "approach": approach,
        "closing": closing,
        "width": grasp.width,
        "depth": grasp.depth,
    }


def _plain(vector: Vec3) -> list[float]:
    return [float(v) + 0.0 for v in vector]  # + 0.0 turns -0.0 into 0.0


def _packed(tables: dict[str, Any], binary: bytes) -> bytes:
    text = writable(json.dumps(tables, separators=(",", ":"), ensure_ascii=False, allow_nan=False)).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), _JSON_CHUNK) + text
    if binary:
        chunks += struct.pack("<II", len(binary), _BINARY_CHUNK) + binary
    if 12 + len(chunks) >= 2**32:
        raise ExportError(f"a GLB holds at most 4 GiB: `{len(chunks)}` bytes are needed; choose another format")
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
