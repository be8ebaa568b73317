"""glTF scenes of the small cabinet with compressed buffer views, and a plain encoder of our own for the streams."""

from pathlib import Path

import numpy as np

from small_assets import CABINET, glb_bytes, gltf_document

EXTENSION = "EXT_meshopt_compression"


def packed_attributes(rows: np.ndarray) -> bytes:
    """Returns the stream of rows of bytes; each group of 16 is stored as whole bytes, or not at all where it is 0."""
    count, stride = rows.shape
    per_block = min(8192 // stride & ~15, 256)
    stream, before = bytearray(b"\xa0"), rows[0]
    for first in range(0, count, per_block):
        block = rows[first : first + per_block]
        delta = np.diff(np.vstack([before, block]).astype(np.int16), axis=0).astype(np.int8)
        codes = ((delta.astype(np.int16) << 1) ^ (delta.astype(np.int16) >> 7)).astype(np.uint8)
        codes = np.vstack([codes, np.zeros((-len(codes) % 16, stride), np.uint8)])
        for byte in codes.T:
            groups = byte.reshape(-1, 16)
            modes = [3 if group.any() else 0 for group in groups]
            modes += [0] * (-len(modes) % 4)
            stream += bytes(
                sum(mode << 2 * k for k, mode in enumerate(modes[i : i + 4])) for i in range(0, len(modes), 4)
            )
            stream += b"".join(group.tobytes() for group in groups if group.any())
        before = block[-1]
    return bytes(stream) + bytes(max(32 - stride, 0)) + rows[0].tobytes()


def _number(value: int) -> bytes:
    found = bytearray()
    while value >= 0x80:
        found.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes([*found, value])


def _zigzag(delta: int) -> int:
    return delta << 1 if delta >= 0 else (-delta << 1) - 1


def packed_triangles(corners: np.ndarray) -> bytes:
    """Returns the stream of triangles, each with three corners that are stated."""
    last, data = 0, b""
    for start in range(0, len(corners), 3):
        data += b"\xff"
        for corner in corners[start : start + 3].tolist():
            data += _number(_zigzag(corner - last))
            last = corner
    return b"\xe1" + b"\xff" * (len(corners) // 3) + data + bytes(16)


def packed_indices(corners: np.ndarray) -> bytes:
    """Returns the stream of indices, each a difference to the one before."""
    deltas = np.diff(corners.astype(np.int64), prepend=0).tolist()
    return b"\xd1" + b"".join(_number(_zigzag(delta) << 1) for delta in deltas) + bytes(4)


def meshopt_document(mode: str = "TRIANGLES") -> tuple[dict, bytes]:
    """Returns the cabinet's document and its buffer, every view compressed; buffer 1 only stands for the result."""
    document, binary = gltf_document(list(CABINET))
    stored, at = b"", 0
    for index, view in enumerate(document["bufferViews"]):
        data = binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
        if index % 2 == 0:
            stride, kind = 12, "ATTRIBUTES"
            stream = packed_attributes(np.frombuffer(data, np.uint8).reshape(-1, 12))
        else:
            stride, kind, corners = 2, mode, np.frombuffer(data, "<u2")
            stream = packed_triangles(corners) if mode == "TRIANGLES" else packed_indices(corners)
        how = {"buffer": 0, "byteOffset": len(stored), "byteLength": len(stream), "byteStride": stride, "mode": kind}
        how["count"] = len(data) // stride
        document["bufferViews"][index] = {"buffer": 1, "byteOffset": at, "byteLength": len(data)}
        document["bufferViews"][index]["extensions"] = {EXTENSION: how}
        stored, at = stored + stream, at + len(data)
    document["buffers"] = [
        {"byteLength": len(stored)},
        {"byteLength": at, "extensions": {EXTENSION: {"fallback": True}}},
    ]
    document["extensionsUsed"] = document["extensionsRequired"] = [EXTENSION]
    return document, stored


def write_meshopt(folder: Path, document: dict | None = None, binary: bytes = b"") -> Path:
    made = meshopt_document() if document is None else (document, binary)
    (folder / "cabinet.glb").write_bytes(glb_bytes(*made))
    return folder / "cabinet.glb"
