"""Scenes of several pieces of furniture, as boxes by name: a row, a table, a room. Metres, Z up, front -Y."""

import json
from pathlib import Path

import numpy as np

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from small_assets import CABINET, Y_UP, glb_bytes

Boxes = dict[str, tuple[tuple[float, float, float], tuple[float, float, float]]]
DOORS = [name for name in CABINET if "door" in name or "drawer" in name or "handle" in name]


def cabinet(name: str, at: tuple[float, float, float] = (0.0, 0.0, 0.0), turned: bool = False) -> Boxes:
    """The cabinet of `small_assets`, 0.8 wide: its front middle moved; `turned` looks to +Y."""

    def placed(point):
        x, y, z = (-point[0], -point[1], point[2]) if turned else point
        return (x + at[0], y + at[1], z + at[2])

    found: Boxes = {}
    for part, (low, high) in CABINET.items():
        a, b = placed(low), placed(high)
        found[f"{name} {part}" if name else part] = (tuple(map(min, a, b)), tuple(map(max, a, b)))
    return found


def numbered(boxes: Boxes, start: int = 1) -> Boxes:
    """The same boxes under names without a meaning."""
    return {f"Cube.{k:03d}": box for k, box in enumerate(boxes.values(), start)}


def table(name: str = "table", x: float = 0.0, y: float = 0.0) -> Boxes:
    legs = {
        f"{name} leg {k}": ((x + a, y + b, 0.0), (x + a + 0.05, y + b + 0.05, 0.72))
        for k, (a, b) in enumerate(((-0.6, -0.4), (0.55, -0.4), (-0.6, 0.35), (0.55, 0.35)))
    }
    return {f"{name} top": ((x - 0.7, y - 0.5, 0.72), (x + 0.7, y + 0.5, 0.75)), **legs}


def hutch_on_sideboard() -> Boxes:
    hutch = {
        "hutch side left": ((-0.38, -0.05, 1.0), (-0.36, 0.2, 1.8)),
        "hutch side right": ((0.36, -0.05, 1.0), (0.38, 0.2, 1.8)),
        "hutch top": ((-0.38, -0.05, 1.8), (0.38, 0.2, 1.82)),
        "hutch back": ((-0.36, 0.19, 1.0), (0.36, 0.2, 1.8)),
    }
    return {**cabinet(""), **hutch}


def room(pieces: Boxes) -> Boxes:
    """A floor and two walls, 4 x 3 x 2.5 m; pieces at y = 1.28 touch the wall behind."""
    return {
        "floor": ((-2.0, -1.5, -0.1), (2.0, 1.6, 0.0)),
        "wall behind": ((-2.0, 1.48, 0.0), (2.0, 1.6, 2.5)),
        "wall left": ((-2.1, -1.5, -0.1), (-2.0, 1.6, 2.5)),
        **pieces,
    }


def furnished_room() -> Boxes:
    return room({**cabinet("wardrobe", (-1.2, 1.28, 0.0)), **cabinet("", (0.5, 1.28, 0.0)), **table("desk", 0.3, -0.6)})


def meshes_of(boxes: Boxes) -> list[TriangleMesh]:
    return [TriangleMesh.box_mesh(Box(np.array(low), np.array(high))) for low, high in boxes.values()]


def write_scene(path: Path, boxes: Boxes) -> Path:
    """Writes a GLB (Y up) with a node for each box."""
    binary, views, accessors, meshes, nodes = b"", [], [], [], []
    for index, (name, mesh) in enumerate(zip(boxes, meshes_of(boxes), strict=True)):
        points = (mesh.vertices @ Y_UP.T).astype("<f4")
        for data, kind, component in ((points, "VEC3", 5126), (mesh.faces.astype("<u2"), "SCALAR", 5123)):
            views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": data.nbytes})
            count = len(data) if kind == "VEC3" else data.size
            accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": count, "type": kind})
            binary += data.tobytes() + b"\0" * (-data.nbytes % 4)
        meshes.append({"primitives": [{"attributes": {"POSITION": 2 * index}, "indices": 2 * index + 1}]})
        nodes.append({"name": name, "mesh": index})
    document = {"asset": {"version": "2.0"}, "buffers": [{"byteLength": len(binary)}], "bufferViews": views}
    document |= {"accessors": accessors, "meshes": meshes, "nodes": nodes, "scene": 0}
    document |= {"scenes": [{"nodes": list(range(len(nodes)))}]}
    path.write_bytes(glb_bytes(json.loads(json.dumps(document)), binary))
    return path


def quarter(boxes: Boxes, x: float, y: float) -> Boxes:
    """The same boxes turned by 90 degrees about the vertical, so that they look to +X, and moved."""
    return {n: ((x - b[1], y + a[0], a[2]), (x - a[1], y + b[0], b[2])) for n, (a, b) in boxes.items()}


def island() -> Boxes:
    """Two cabinets back to back below one worktop."""
    backs = {**cabinet("near"), **cabinet("far", (0.0, 0.4, 0.0), turned=True)}
    return {**backs, "worktop": ((-0.42, -0.22, 1.0), (0.42, 0.62, 1.03))}


def corner() -> Boxes:
    """A cabinet that looks to -Y, and in the corner to its left one that looks to +X, below one worktop."""
    wings = {**cabinet("back"), **quarter(cabinet("left"), -0.62, -0.62)}
    return {**wings, "worktop": ((-0.82, -0.22, 1.0), (0.4, 0.2, 1.03))}
