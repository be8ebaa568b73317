"""Annotated furniture written as HSSD models with S2O annotations are: a GLB of few meshes, two JSON files beside it.

The object frame (Z up, front -Y) is laid down Y up, front +Z. Parts are dealt out over the meshes, and in pieces, so
that a part's triangles lie in several runs.
"""

import json
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.graph.parse import ParsingConfig, parse_graph
from grafu.vocabulary import JointType, PartLabel
from small_assets import Y_UP, glb_bytes

WORDS = {PartLabel.DOOR: "door", PartLabel.DRAWER: "drawer", PartLabel.HANDLE: "handle", PartLabel.SHELF: "shelf"}
KINDS = {JointType.REVOLUTE: "rotation", JointType.PRISMATIC: "translation"}


@dataclass
class HssdModel:
    """What is to be written; tests damage it before it is saved. Part k of the asset has the pid k + 1."""

    asset: Asset
    parts: dict = field(default_factory=dict)
    articulations: dict | None = field(default_factory=dict)
    glb: bytes = b""

    def pid(self, part_id: str) -> int:
        return [p.id for p in self.asset.parts].index(part_id) + 1

    def save(self, folder: Path, name: str = "a1b2", prefix: str = "", bom: bool = True) -> Path:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / f"{name}.glb").write_bytes(self.glb)
        (folder / f"{name}.artpre.json").write_text(json.dumps(self.parts))
        if self.articulations is not None:
            text = json.dumps(self.articulations)
            encoding = "utf-8-sig" if bom else "utf-8"
            (folder / f"{prefix}{name}.articulations.json").write_text(text, encoding=encoding)
        return folder / f"{name}.glb"


def hssd_model(asset: Asset, meshes: int = 3, spare: int = 0) -> HssdModel:
    """Returns the files' contents; the last `spare` triangles of each mesh belong to no part."""
    buckets: list[list[np.ndarray]] = [[] for _ in range(meshes)]  # of each mesh: corners (n, 3, 3) of its triangles
    runs: dict[str, list[dict]] = {}
    for k, part in enumerate(asset.parts):
        triangles = part.mesh.vertices[part.mesh.faces] @ Y_UP.T
        for half, piece in enumerate(np.array_split(triangles, 2)):
            mesh = (k + half) % meshes
            first = sum(len(b) for b in buckets[mesh])
            buckets[mesh].append(piece)
            run = {"meshIndex": mesh, "triIndex": [[first, first + len(piece)]], "segIndex": 2 * k + half}
            runs.setdefault(part.id, []).append(run)
    if spare:
        corner = np.array([[[0, 0, 0], [0.01, 0, 0], [0, 0, 0.01]]]) + Y_UP @ asset.box.low
        for bucket in buckets:
            bucket.append(np.tile(corner, (spare, 1, 1)))
    model = HssdModel(asset, glb=_glb([np.concatenate(b) for b in buckets]))
    near = _neighbours(model)
    model.parts = {
        "version": "0.0.2",
        "parts": [None, *(_part(model, part, runs[part.id]) for part in asset.parts)],
        "connectivityGraph": near,
        "upAxis": {"x": 0, "y": 1, "z": 0},
        "frontAxis": {"x": 0, "y": 0, "z": 1},
    }
    motions = [_articulation(model, joint) for joint in asset.joints]
    model.articulations = {"modelId": "fpModel.a1b2", "annotation": {"connectivity": near, "articulations": motions}}
    return model


def _part(model: HssdModel, part: Part, runs: list[dict]) -> dict:
    pid = str(model.pid(part.id))
    corners = part.box.corners() @ Y_UP.T
    low, high = corners.min(axis=0), corners.max(axis=0)
    obb = {"centroid": list((low + high) / 2), "axesLengths": list(high - low), "normalizedAxes": list(np.eye(3).flat)}
    word = WORDS.get(part.label, "base")
    return {"pid": pid, "label": word, "name": word, "partInfo": {"meshTri": runs, "data": None}, "obb": obb}


def _articulation(model: HssdModel, joint) -> dict:
    return {
        "pid": model.pid(joint.part),
        "type": KINDS[joint.type],
        "origin": list(Y_UP @ joint.axis.point),
        "axis": list(Y_UP @ joint.axis.direction),
        "ref": [1, 0, 0],
        "base": [k + 1 for k, part in enumerate(model.asset.parts) if part.label.is_support],
        "rangeMin": joint.lower,
        "rangeMax": joint.upper,
        "motionStates": {"closed": {"percent": 0, "value": joint.lower}},
    }


def _neighbours(model: HssdModel) -> list[list[int]]:
    """Returns who touches whom, by pid, each pair stated once only, as in some of the files."""
    found: list[list[int]] = [[] for _ in range(len(model.asset.parts) + 1)]
    for contact in parse_graph(model.asset, ParsingConfig(points=0)).contacts:
        found[model.pid(contact.a)].append(model.pid(contact.b))
    return found


def _glb(meshes: list[np.ndarray]) -> bytes:
    """Returns a GLB with a node, a mesh and a material of its own for each array of triangles."""
    binary, views, accessors = b"", [], []
    for triangles in meshes:
        points = triangles.reshape(-1, 3).astype("<f4")
        uv = points[:, :2].copy()
        order = np.arange(len(points), dtype="<u4")
        for data, kind, component in ((points, "VEC3", 5126), (uv, "VEC2", 5126), (order, "SCALAR", 5125)):
            views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": data.nbytes})
            row = {"bufferView": len(views) - 1, "componentType": component, "count": len(data), "type": kind}
            accessors.append(row)
            binary += data.tobytes()
    count = len(meshes)
    primitives = [
        {"attributes": {"POSITION": 3 * k, "TEXCOORD_0": 3 * k + 1}, "indices": 3 * k + 2, "material": k}
        for k in range(count)
    ]
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(binary)}],
        "bufferViews": views,
        "accessors": accessors,
        "materials": [{"name": f"colour_{k}"} for k in range(count)],
        "meshes": [{"primitives": [primitive]} for primitive in primitives],
        "nodes": [{"name": f"geometry_{k}", "mesh": k} for k in range(count)],
        "scenes": [{"nodes": list(range(count))}],
        "scene": 0,
    }
    return glb_bytes(document, binary)
