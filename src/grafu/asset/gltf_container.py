"""The chunks of a GLB file. It reads no JSON."""

import struct
from pathlib import Path

from grafu.errors import UnreadableAsset


def chunks_of(data: bytes, path: Path) -> tuple[memoryview, memoryview | None]:
    """Returns the JSON text of a GLB and its binary chunk, where it has one; `path` is for messages.

    Raises:
        UnreadableAsset: if it is truncated, of another version, or has no JSON.
    """
    if len(data) < 20:
        raise UnreadableAsset(f"{path} is truncated ({len(data)} bytes): expected a whole GLB; export it again")
    _, version, total = struct.unpack_from("<4sII", data)
    if version != 2:
        raise UnreadableAsset(f"{path} is GLB version {version}: expected version 2; export it again")
    if total > len(data):
        raise UnreadableAsset(f"{path} is truncated: it has {len(data)} of {total} bytes; fetch or export it again")
    chunks: dict[bytes, memoryview] = {}
    at = 12
    while at + 8 <= total:
        length, kind = struct.unpack_from("<I4s", data, at)
        if at + 8 + length > total:
            raise UnreadableAsset(f"{path} is truncated: a chunk reaches beyond the file; fetch or export it again")
        chunks.setdefault(kind, memoryview(data)[at + 8 : at + 8 + length])
        at += 8 + length
    if b"JSON" not in chunks:
        raise UnreadableAsset(f"{path} has no JSON chunk: expected a whole GLB; export it again")
    return chunks[b"JSON"], chunks.get(b"BIN\0")
