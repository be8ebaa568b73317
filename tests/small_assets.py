"""A small cabinet written by code in every format that is read: 0.8 wide, 0.4 deep, 1.0 high, one door, one drawer.

Boxes are in metres, Z up, front -Y, standing at z = 0, centred: exactly the object frame.
"""

import io
import json
import math
import struct
from pathlib import Path

import numpy as np
from PIL import Image

from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.part import Asset
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh

# name, low, high
CABINET = {
    "vertical_side_panel-1": ((-0.40, -0.18, 0.0), (-0.38, 0.20, 0.98)),
    "vertical_side_panel-2": ((0.38, -0.18, 0.0), (0.40, 0.20, 0.98)),
    "top_panel-3": ((-0.40, -0.20, 0.98), (0.40, 0.20, 1.00)),
    "bottom_panel-4": ((-0.38, -0.18, 0.0), (0.38, 0.20, 0.02)),
    "back_panel-5": ((-0.38, 0.18, 0.02), (0.38, 0.20, 0.98)),
    "shelf-6": ((-0.38, -0.17, 0.60), (0.38, 0.18, 0.62)),
    "cabinet_door_surface-7": ((-0.40, -0.20, 0.0), (0.40, -0.18, 0.60)),
    "handle-8": ((0.34, -0.23, 0.25), (0.36, -0.20, 0.40)),
    "drawer_front-9": ((-0.39, -0.20, 0.63), (0.39, -0.18, 0.97)),
    "drawer_bottom-10": ((-0.37, -0.18, 0.64), (0.37, 0.15, 0.65)),
    "handle-11": ((-0.08, -0.23, 0.79), (0.08, -0.20, 0.81)),
}
DOOR, DRAWER = ("cabinet_door_surface-7", "handle-8"), ("drawer_front-9", "drawer_bottom-10", "handle-11")
HINGE = ((-0.40, -0.20, 0.0), (0.0, 0.0, -1.0))  # a point of the door's axis and its sense: positive opens
AS_IT_IS = np.eye(3)
Y_UP = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])  # object frame to Y up, front +Z


def load_annotated(path: Path, options: LoadOptions = LoadOptions()) -> Asset:
    """What is at the path as its annotation sees it, with its joints."""
    return load_asset(path, options).as_annotated()


def mesh_of(name: str) -> TriangleMesh:
    low, high = CABINET[name]
    return TriangleMesh.box_mesh(Box(np.array(low), np.array(high)))


def obj_text(mesh: TriangleMesh, matrix: np.ndarray, start: int = 0) -> str:
    rows = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in mesh.vertices @ matrix.T]
    faces = mesh.faces[:, ::-1] if np.linalg.det(matrix) < 0 else mesh.faces
    return "\n".join(rows + [f"f {a} {b} {c}" for a, b, c in faces + 1 + start]) + "\n"


def write_grouped_obj(path: Path, matrix: np.ndarray = AS_IT_IS, names: dict[str, str] | None = None) -> Path:
    text, start = "", 0
    for name in CABINET:
        text += f"g {(names or {}).get(name, name)}\n" + obj_text(mesh_of(name), matrix, start)
        start += 8
    path.write_text(text)
    return path


def write_obj_folder(folder: Path, matrix: np.ndarray = AS_IT_IS) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    for name in CABINET:
        (folder / f"{name}.obj").write_text(obj_text(mesh_of(name), matrix))
    return folder


def write_pnm(folder: Path, matrix: np.ndarray = AS_IT_IS) -> Path:
    """Writes a PartNet-Mobility folder; `matrix` maps the object frame before it is laid down Y up."""
    M, sense = Y_UP @ matrix, np.sign(np.linalg.det(matrix))
    write_obj_folder(folder / "textured_objs", M)
    leaves = [{"id": int(n.split("-")[1]), "name": n.split("-")[0], "objs": [n]} for n in CABINET]
    (folder / "result.json").write_text(json.dumps([{"id": 100, "name": "cabinet", "children": leaves}]))
    scale = float(np.cbrt(abs(np.linalg.det(matrix))))
    links = [
        _link(0, "hinge", "cabinet_door", DOOR, M @ HINGE[0], sense * (M @ HINGE[1]) / scale, (0, 90)),
        _link(1, "slider", "drawer", DRAWER, [0, 0, 0], M @ (0, -1, 0) / scale, (0, 0.3 * scale)),
        _link(2, "heavy", "shelf", [n for n in CABINET if n not in DOOR + DRAWER]),
    ]
    (folder / "mobility_v2.json").write_text(json.dumps(links))
    return folder


def _link(index, joint, name, visuals, origin=None, direction=None, limit=(0, 0)):
    data = {}
    if origin is not None:
        axis = {"origin": [float(v) for v in origin], "direction": [float(v) for v in direction]}
        data = {"axis": axis, "limit": {"a": limit[0], "b": limit[1], "noLimit": False}}
    parts = [{"id": int(v.split("-")[1]), "name": v.split("-")[0], "children": []} for v in visuals]
    parent = -1 if origin is None else 2
    return {"id": index, "parent": parent, "joint": joint, "name": name, "parts": parts, "jointData": data}


def urdf_text(extra: str = "", door_type: str = "revolute") -> str:
    """Returns a URDF of the cabinet whose mesh files lie in `meshes/`, door axis about -Z."""

    def visuals(names, offset=(0, 0, 0)):
        x, y, z = (-v for v in offset)
        return "".join(
            f'<visual name="{n}"><origin xyz="{x} {y} {z}"/><geometry><mesh filename="meshes/{n}.obj"/></geometry>'
            "</visual>"
            for n in names
        )

    static = [n for n in CABINET if n not in DOOR + DRAWER]
    (x, y, z), _ = HINGE
    return f"""<?xml version="1.0"?><robot name="cabinet">
    <link name="carcass">{visuals(static)}
      <collision><geometry><mesh filename="absent.obj"/></geometry></collision></link>
    <link name="door_link">{visuals(DOOR, HINGE[0])}</link>
    <link name="drawer_link">{visuals(DRAWER)}</link>
    <joint name="door_joint" type="{door_type}"><parent link="carcass"/><child link="door_link"/>
      <origin xyz="{x} {y} {z}"/><axis xyz="0 0 -1"/><limit lower="0" upper="1.5"/></joint>
    <joint name="drawer_joint" type="prismatic"><parent link="carcass"/><child link="drawer_link"/>
      <axis xyz="0 -1 0"/><limit lower="0" upper="0.3"/></joint>{extra}</robot>"""


def write_urdf(folder: Path, text: str | None = None) -> Path:
    write_obj_folder(folder / "meshes")
    (folder / "cabinet.urdf").write_text(text if text is not None else urdf_text())
    return folder / "cabinet.urdf"


def png_bytes(width: int, height: int, color: tuple[int, int, int] = (200, 120, 40)) -> bytes:
    stream = io.BytesIO()
    Image.new("RGB", (width, height), color).save(stream, "PNG")
    return stream.getvalue()


def glb_bytes(document: dict, binary: bytes = b"") -> bytes:
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def gltf_document(names: list[str], matrix: np.ndarray = AS_IT_IS) -> tuple[dict, bytes]:
    """Returns a glTF document (Y up) with one node and one mesh per named box, and its binary buffer."""
    binary, views, accessors, meshes, nodes = b"", [], [], [], []
    for index, name in enumerate(names):
        mesh = mesh_of(name)
        points = (mesh.vertices @ (Y_UP @ matrix).T).astype("<f4")
        for data, kind, component in ((points, "VEC3", 5126), (mesh.faces.astype("<u2"), "SCALAR", 5123)):
            views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": data.nbytes})
            count = len(data) if kind == "VEC3" else data.size
            accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": count, "type": kind})
            binary += data.tobytes()
        meshes.append({"primitives": [{"attributes": {"POSITION": 2 * index}, "indices": 2 * index + 1}]})
        nodes.append({"name": name, "mesh": index})
    document = {"asset": {"version": "2.0"}, "buffers": [{"byteLength": len(binary)}], "bufferViews": views}
    document |= {"accessors": accessors, "meshes": meshes, "nodes": nodes, "scene": 0}
    return document | {"scenes": [{"nodes": list(range(len(nodes)))}]}, binary


def write_glb(path: Path, matrix: np.ndarray = AS_IT_IS) -> Path:
    path.write_bytes(glb_bytes(*gltf_document(list(CABINET), matrix)))
    return path


def yaw(quarter_turns: int) -> np.ndarray:
    angle = quarter_turns * math.pi / 2
    return np.round([[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1]])
