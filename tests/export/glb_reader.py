"""Reads a GLB of ours back, for tests: written against the glTF specification, not against the writer."""

import json
import struct
from dataclasses import dataclass

import numpy as np

_DTYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


@dataclass
class Glb:
    tables: dict
    binary: bytes

    @classmethod
    def parse(cls, data: bytes) -> "Glb":
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data))
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON"
        tables = json.loads(data[20 : 20 + size])
        return cls(tables, data[20 + size + 8 :])

    def view(self, index: int) -> bytes:
        view = self.tables["bufferViews"][index]
        return self.binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]

    def array(self, index: int) -> np.ndarray:
        accessor = self.tables["accessors"][index]
        values = np.frombuffer(self.view(accessor["bufferView"]), _DTYPES[accessor["componentType"]])
        return values.reshape(accessor["count"], _WIDTHS[accessor["type"]])

    def node(self, name: str) -> dict:
        (found,) = [n for n in self.tables["nodes"] if n["name"] == name]
        return found

    def world_offsets(self) -> dict[int, np.ndarray]:
        """The rest translation of every node, glTF frame."""
        offsets, queue = {}, [(n, np.zeros(3)) for n in self.tables["scenes"][0]["nodes"]]
        while queue:
            index, base = queue.pop()
            node = self.tables["nodes"][index]
            offsets[index] = base + node.get("translation", [0.0, 0.0, 0.0])
            queue += [(child, offsets[index]) for child in node.get("children", [])]
        return offsets

    def primitives(self, name: str) -> list[dict]:
        return self.tables["meshes"][self.node(name)["mesh"]]["primitives"]

    def triangles(self, name: str) -> np.ndarray:
        """The corners of every face of a node, (faces, 3, 3), back in the object frame (Z up, front -Y)."""
        offset = self.world_offsets()[self.tables["nodes"].index(self.node(name))]
        parts = []
        for primitive in self.primitives(name):
            points = self.array(primitive["attributes"]["POSITION"]).astype(float) + offset
            parts.append(points[self.array(primitive["indices"]).reshape(-1, 3)])
        corners = np.concatenate(parts)
        return np.stack([corners[..., 0], -corners[..., 2], corners[..., 1]], axis=-1)

    def material(self, name: str, primitive: int = 0) -> dict:
        return self.tables["materials"][self.primitives(name)[primitive]["material"]]
