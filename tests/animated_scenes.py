"""The small cabinet as a glTF scene whose door and drawer are animated, written by our own code."""

from math import cos, sin
from pathlib import Path

import numpy as np

from small_assets import CABINET, DOOR, DRAWER, HINGE, Y_UP, glb_bytes, gltf_document

Keys = tuple[list[float], list[tuple[float, ...]]]
HINGE_POINT = (Y_UP @ np.array(HINGE[0])).tolist()
OPEN = 1.5  # radians, as in the URDF of the same cabinet
OUT = 0.3  # metres


def turned(angle: float, axis: tuple[float, float, float] = (0.0, -1.0, 0.0)) -> tuple[float, ...]:
    """A quaternion (x, y, z, w)."""
    return (*(sin(angle / 2) * v for v in axis), cos(angle / 2))


def opening() -> dict[str, dict[str, Keys]]:
    """The keys of nodes by name and path: the door turns, the drawer slides."""
    return {
        "door": {"rotation": ([0.0, 0.5, 1.0], [turned(a) for a in (0.0, OPEN / 2, OPEN)])},
        "drawer": {"translation": ([0.0, 2.0], [(0.0, 0.0, 0.0), (0.0, 0.0, OUT)])},
    }


def animated_document() -> tuple[dict, bytes]:
    """The cabinet with a node `door` at its hinge, a node `drawer` at the origin, and their pieces below them."""
    document, binary = gltf_document(list(CABINET))
    nodes, back = document["nodes"], [-v for v in HINGE_POINT]
    for name, pieces in (("door", DOOR), ("drawer", DRAWER)):
        below = [k for k, node in enumerate(nodes) if node["name"] in pieces]
        node = {"name": name, "children": below}
        if name == "door":
            node["translation"] = HINGE_POINT
            for k in below:
                nodes[k]["translation"] = back
        roots = document["scenes"][0]["nodes"]
        document["scenes"][0]["nodes"] = [k for k in roots if k not in below] + [len(nodes)]
        nodes.append(node)
    return document, binary


def with_animation(
    document: dict, binary: bytes, tracks: dict[str, dict[str, Keys]], interpolation: str = "LINEAR"
) -> tuple[dict, bytes]:
    """The document with one animation more."""
    number = {node["name"]: k for k, node in enumerate(document["nodes"])}
    samplers, channels = [], []
    for name, paths in tracks.items():
        for path, (times, values) in paths.items():
            places = []
            for data in (np.array(times, "<f4")[:, None], np.array(values, "<f4")):
                binary += b"\0" * (-len(binary) % 4)
                view = {"buffer": 0, "byteOffset": len(binary), "byteLength": data.nbytes}
                kind = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}[data.shape[1]]
                document["bufferViews"].append(view)
                document["accessors"].append(
                    {"bufferView": len(document["bufferViews"]) - 1, "componentType": 5126, "count": len(data)}
                    | {"type": kind}
                )
                places.append(len(document["accessors"]) - 1)
                binary += data.tobytes()
            samplers.append({"input": places[0], "output": places[1], "interpolation": interpolation})
            channels.append({"sampler": len(samplers) - 1, "target": {"node": number[name], "path": path}})
    document["buffers"] = [{"byteLength": len(binary)}]
    document.setdefault("animations", []).append({"samplers": samplers, "channels": channels})
    return document, binary


def write_animated(
    folder: Path, tracks: dict[str, dict[str, Keys]] | None = None, interpolation: str = "LINEAR"
) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    document, binary = animated_document()
    return save_glb(folder, *with_animation(document, binary, opening() if tracks is None else tracks, interpolation))


def save_glb(folder: Path, document: dict, binary: bytes) -> Path:
    (folder / "cabinet.glb").write_bytes(glb_bytes(document, binary))
    return folder / "cabinet.glb"
