"""The small cabinet as a glTF scene compressed with Draco, encoded by DracoPy."""

from pathlib import Path

import numpy as np

from small_assets import CABINET, Y_UP, glb_bytes, mesh_of


def draco_document(names: list[str], **encoding: bool) -> tuple[dict, bytes]:
    """Returns a document (Y up) with one node and one compressed mesh for each named box, and its binary buffer.

    Each has texture coordinates, normals, and colours as normalised bytes.
    """
    binary, views, accessors, meshes, nodes = b"", [], [], [], []
    for index, name in enumerate(names):
        data, counts = _encoded(name, **encoding)
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        binary += data
        first = len(accessors)
        kinds = (("VEC3", 5126, False), ("VEC2", 5126, False), ("VEC3", 5126, False), ("VEC4", 5121, True))
        for kind, component, normalized in kinds:
            accessors.append({"componentType": component, "count": counts[0], "type": kind, "normalized": normalized})
        accessors.append({"componentType": 5123, "count": counts[1], "type": "SCALAR"})
        keys = ("POSITION", "TEXCOORD_0", "NORMAL", "COLOR_0")
        # DracoPy numbers attributes so: colours, texture coordinates, normals, positions
        packed = {"bufferView": index, "attributes": dict(zip(keys, (3, 1, 2, 0), strict=True))}
        primitive = {
            "attributes": {key: first + place for place, key in enumerate(keys)},
            "indices": first + 4,
            "material": 0,
            "extensions": {"KHR_draco_mesh_compression": packed},
        }
        meshes.append({"primitives": [primitive]})
        nodes.append({"name": name, "mesh": index})
    used = ["KHR_draco_mesh_compression"]
    document = {"asset": {"version": "2.0"}, "extensionsUsed": used, "extensionsRequired": used}
    document |= {"buffers": [{"byteLength": len(binary)}], "bufferViews": views, "accessors": accessors}
    document |= {"materials": [{"name": "oak", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.3, 0.1, 1]}}]}
    scenes = [{"nodes": list(range(len(nodes)))}]
    return document | {"meshes": meshes, "nodes": nodes, "scene": 0, "scenes": scenes}, binary


def _encoded(name: str, **encoding: bool) -> tuple[bytes, tuple[int, int]]:
    """Returns the compressed bytes of a box, and how many points and corners they hold."""
    import DracoPy

    mesh = mesh_of(name)
    points = (mesh.vertices @ Y_UP.T).astype(np.float32)
    count = len(points)
    data = DracoPy.encode(
        points,
        mesh.faces.astype(np.uint32),
        quantization_bits=16,
        tex_coord=np.linspace(0, 1, 2 * count).reshape(count, 2),
        normals=(points / np.linalg.norm(points, axis=1, keepdims=True)).astype(np.float64),
        colors=np.full((count, 4), 255, np.uint8),
        **encoding,
    )
    made = DracoPy.decode(data)
    return data, (len(made.points), 3 * len(made.faces))


def write_draco(folder: Path, **encoding: bool) -> Path:
    """Writes the whole cabinet."""
    path = folder / "cabinet.glb"
    path.write_bytes(glb_bytes(*draco_document(list(CABINET), **encoding)))
    return path
