"""Reads a .blend in a Blender of its own and writes down what is there: `python blend_probe.py FILE OUT`."""

import os
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np

FRAMES = (0, 12, 25, 37, 50, 75, 100)


def probe(interpreter: str, data: bytes, folder: Path) -> dict:
    """Returns what a fresh Blender finds in a .blend."""
    source, target = folder / "probed.blend", folder / "found.pickle"
    source.write_bytes(data)
    command = [interpreter, str(Path(__file__)), str(source), str(target)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    return pickle.loads(target.read_bytes())


def _read(path: str) -> dict:
    import bpy

    bpy.ops.wm.open_mainfile(filepath=path)
    scene = bpy.context.scene
    return {
        "version": bpy.app.version,
        "scene": (scene.frame_start, scene.frame_end, scene.unit_settings.system, scene.unit_settings.scale_length),
        "collections": {c.name: [child.name for child in c.children] for c in bpy.data.collections},
        "objects": {o.name: _object(o) for o in bpy.data.objects},
        "materials": {m.name: _material(m) for m in bpy.data.materials},
        "images": {i.name: _image(i) for i in bpy.data.images},
        "frames": {frame: _posed_at(bpy, scene, frame) for frame in FRAMES},
        "alone": _each_alone(bpy, scene),
    }


def _object(o) -> dict:
    found = {
        "type": o.type,
        "parent": o.parent.name if o.parent else None,
        "collections": [c.name for c in o.users_collection],
        "properties": {name: o[name] for name in o.keys()},  # noqa: SIM118  # Blender's objects are no mappings
        "rest": np.array(o.matrix_world),
        "overridable": "open" in o and o.is_property_overridable_library('["open"]'),
    }
    if o.type == "MESH":
        mesh = o.data
        corners = _numbers(mesh.loops, "vertex_index", 1, np.int32).ravel()
        found |= {
            "materials": [m.name for m in mesh.materials],
            "look": _numbers(mesh.polygons, "material_index", 1, np.int32).ravel().tolist(),
            "triangles": _numbers(mesh.vertices, "co", 3)[corners].reshape(-1, 3, 3),
            "normals": _numbers(mesh.corner_normals, "vector", 3),
            "uv": {layer.name: _numbers(layer.data, "uv", 2) for layer in mesh.uv_layers},
            "colors": {a.name: (a.domain, _numbers(a.data, "color", 4)) for a in mesh.color_attributes},
            "mended": mesh.copy().validate(),
        }
    return found


def _numbers(collection, name: str, width: int, dtype=np.float32) -> np.ndarray:
    values = np.zeros(len(collection) * width, dtype)
    collection.foreach_get(name, values)
    return values.reshape(-1, width)


def _material(m) -> dict:
    shader = next(n for n in m.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    values = {
        s.name: np.array(s.default_value).tolist() for s in shader.inputs if s.type in ("RGBA", "VALUE", "VECTOR")
    }
    return {
        "values": values,
        "linked": {s.name: s.links[0].from_node.type for s in shader.inputs if s.is_linked},
        "images": sorted(n.image.name for n in m.node_tree.nodes if n.type == "TEX_IMAGE"),
        "groups": {n.node_tree.name: n.inputs[0].is_linked for n in m.node_tree.nodes if n.type == "GROUP"},
        "culled": m.use_backface_culling,
        "method": m.surface_render_method,
    }


def _image(i) -> dict:
    return {"data": bytes(i.packed_file.data), "size": tuple(i.size), "space": i.colorspace_settings.name}


def _posed_at(bpy, scene, frame: int) -> dict:
    scene.frame_set(frame)
    return _poses(bpy)


def _poses(bpy) -> dict:
    graph = bpy.context.evaluated_depsgraph_get()
    return {o.name: np.array(o.evaluated_get(graph).matrix_world) for o in bpy.data.objects}


def _curves(data) -> list:
    if hasattr(data.action, "fcurves"):
        return list(data.action.fcurves)
    strips = [strip for layer in data.action.layers for strip in layer.strips]
    return [curve for strip in strips for curve in strip.channelbag(data.action_slot).fcurves]


def _each_alone(bpy, scene) -> dict:
    """The poses with the animation muted and one joint at 0.4 of its range, at a frame where all would be open."""
    joints = [o for o in bpy.data.objects if o.get("grafu") == "joint" and "open" in o and "leader" not in o]
    for joint in joints:
        for curve in _curves(joint.animation_data):
            curve.mute = True
    found = {}
    for joint in joints:
        for other in joints:
            other["open"] = 0.4 if other is joint else 0.0
            other.update_tag()
        scene.frame_set(50)
        found[joint["id"]] = (joint["open"], _poses(bpy))
    return found


if __name__ == "__main__":
    Path(sys.argv[2]).write_bytes(pickle.dumps(_read(sys.argv[1])))
    os._exit(0)
