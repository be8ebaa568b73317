"""The glTF container: JSON, buffers, accessors, images as bytes. It knows no nodes and no materials.

Every size that the file declares is checked against the bytes that are there before memory is taken for it.
"""

import base64
import binascii
import json
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, final
from urllib.parse import unquote

import numpy as np

from grafu.asset.mesh_files import read_bytes
from grafu.asset.options import Limits
from grafu.errors import AssetTooLarge, UnreadableAsset

_DTYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_REFUSED = {
    "KHR_draco_mesh_compression": "Draco",
    "EXT_meshopt_compression": "meshopt",
    "KHR_meshopt_compression": "meshopt",
}
# An accessor without bytes behind it is all zeros: a few characters of JSON could claim any amount of memory.
_MOST_ZEROS = 10_000_000


@final
@dataclass(frozen=True)
class GltfFile:
    """A parsed glTF document with its buffers' bytes."""

    path: Path
    document: dict[str, Any]
    buffers: tuple[bytes, ...]

    def items(self, key: str) -> list[dict[str, Any]]:
        """Returns a top-level array of the document, empty where it is absent."""
        found = self.document.get(key, [])
        return found if isinstance(found, list) else []

    def item(self, key: str, index: Any) -> dict[str, Any]:
        """Returns one element of a top-level array.

        Raises:
            UnreadableAsset: if there is no such element.
        """
        items = self.items(key)
        if not isinstance(index, int) or not 0 <= index < len(items) or not isinstance(items[index], dict):
            raise self.damaged(f"{key}[{index}] is not there")
        return items[index]

    def damaged(self, why: str) -> UnreadableAsset:
        """Returns the error for a damaged document, to be raised."""
        return UnreadableAsset(f"{self.path} is damaged ({why}): expected a valid glTF 2.0 file; export it again")

    @contextmanager
    def guarded(self) -> Iterator[None]:
        """Turns what a malformed document trips inside the block into one clear error.

        Raises:
            UnreadableAsset: where an entry is missing or of the wrong type.
        """
        try:
            yield
        except (KeyError, TypeError, AttributeError, ValueError, OverflowError) as error:
            raise self.damaged(f"an entry has the wrong type: {str(error).splitlines()[0]}") from None

    def view(self, index: Any) -> tuple[bytes, int]:
        """Returns the bytes of a buffer view and its stride (0: tight)."""
        view = self.item("bufferViews", index)
        buffer = view.get("buffer")
        if not isinstance(buffer, int) or not 0 <= buffer < len(self.buffers):
            raise self.damaged(f"buffer {buffer} is not there")
        start, length = int(view.get("byteOffset", 0)), int(view.get("byteLength", 0))
        if start < 0 or length < 0 or start + length > len(self.buffers[buffer]):
            raise self.damaged(f"bufferViews[{index}] reaches beyond its buffer")
        return self.buffers[buffer][start : start + length], int(view.get("byteStride", 0))

    def accessor(self, index: Any) -> np.ndarray:
        """Returns an accessor as (count, width) of its own number type; normalised integers become floats."""
        accessor = self.item("accessors", index)
        dtype, width = _DTYPES.get(accessor.get("componentType", 0)), _WIDTHS.get(accessor.get("type", ""))
        count = accessor.get("count", 0)
        if dtype is None or width is None or not isinstance(count, int) or count < 0:
            raise self.damaged(f"accessors[{index}] has no valid type or count")
        values = self._dense(accessor, index, np.dtype(dtype), width)
        if "sparse" in accessor:
            values = self._sparse(values, accessor["sparse"])
        if accessor.get("normalized") and values.dtype.kind in "iu":
            values = np.maximum(values / np.iinfo(values.dtype).max, -1.0)
        return values

    def _dense(self, accessor: dict[str, Any], index: Any, dtype: np.dtype[Any], width: int) -> np.ndarray:
        count = accessor["count"]
        if "bufferView" not in accessor:
            if count * width > _MOST_ZEROS:
                raise AssetTooLarge(f"{self.path}: accessors[{index}] declares {count:,} elements without data")
            return np.zeros((count, width), dtype)
        data, stride = self.view(accessor["bufferView"])
        offset, element = int(accessor.get("byteOffset", 0)), dtype.itemsize * width
        stride = stride or element
        if offset < 0 or stride < element or (count and offset + stride * (count - 1) + element > len(data)):
            raise self.damaged(f"accessors[{index}] declares {count:,} elements, more than its buffer holds")
        if not count:
            return np.zeros((0, width), dtype)
        return np.ndarray((count, width), dtype, data, offset, (stride, dtype.itemsize)).copy()

    def _sparse(self, values: np.ndarray, sparse: dict[str, Any]) -> np.ndarray:
        try:
            count, places, news = sparse["count"], sparse["indices"], sparse["values"]
            where = np.frombuffer(self.view(places["bufferView"])[0], _DTYPES[places["componentType"]], count)
            data = self.view(news["bufferView"])[0]
            values[where] = np.frombuffer(data, values.dtype, count * values.shape[1]).reshape(count, -1)
        except (KeyError, ValueError, IndexError, TypeError):
            raise self.damaged("a sparse accessor does not fit") from None
        return values

    def image(self, index: Any) -> tuple[bytes, str] | None:
        """Returns the encoded bytes of an image and its name, or None where its file is missing."""
        image = self.item("images", index)
        if "bufferView" in image:
            return self.view(image["bufferView"])[0], str(image.get("name", f"image_{index}"))
        uri = str(image.get("uri", ""))
        data = _data_uri(uri)
        if data is not None:
            return data, str(image.get("name", f"image_{index}"))
        path = self.path.parent / unquote(uri)
        return (path.read_bytes(), path.name) if uri and path.is_file() else None


def read_gltf_file(path: Path, limits: Limits) -> GltfFile:
    """Returns the parsed document of a .glb or .gltf file.

    Raises:
        UnreadableAsset: if it is missing, truncated, no glTF 2.0, or compressed in a way that is not read.
    """
    data = read_bytes(path, limits)
    text, binary = _chunks(data, path) if data[:4] == b"glTF" else (data, None)
    try:
        document = json.loads(text)
    except (ValueError, RecursionError):
        raise UnreadableAsset(f"{path} is not glTF: expected JSON or a GLB container; export it again") from None
    if not isinstance(document, dict) or "asset" not in document:
        raise UnreadableAsset(f"{path} is not glTF: expected an `asset` entry; export it again")
    version = document["asset"].get("version") if isinstance(document["asset"], dict) else None
    if not str(version).startswith("2"):
        raise UnreadableAsset(f"{path} is glTF version {version}: expected 2.0; export it again")
    for extension in document.get("extensionsRequired", ()):
        if extension in _REFUSED:
            kind = _REFUSED[extension]
            raise UnreadableAsset(f"{path} is compressed with {kind}, which is not read: export it without compression")
    return GltfFile(path, document, _buffers(path, document, binary, limits))


def _chunks(data: bytes, path: Path) -> tuple[bytes, bytes | None]:
    if len(data) < 20:
        raise UnreadableAsset(f"{path} is truncated ({len(data)} bytes): expected a whole GLB; export it again")
    _, version, total = struct.unpack_from("<4sII", data)
    if version != 2:
        raise UnreadableAsset(f"{path} is GLB version {version}: expected version 2; export it again")
    if total > len(data):
        raise UnreadableAsset(f"{path} is truncated: it has {len(data)} of {total} bytes; fetch or export it again")
    chunks: dict[bytes, bytes] = {}
    at = 12
    while at + 8 <= total:
        length, kind = struct.unpack_from("<I4s", data, at)
        if at + 8 + length > total:
            raise UnreadableAsset(f"{path} is truncated: a chunk reaches beyond the file; fetch or export it again")
        chunks.setdefault(kind, data[at + 8 : at + 8 + length])
        at += 8 + length
    if b"JSON" not in chunks:
        raise UnreadableAsset(f"{path} has no JSON chunk: expected a whole GLB; export it again")
    return chunks[b"JSON"], chunks.get(b"BIN\0")


def _buffers(path: Path, document: dict[str, Any], binary: bytes | None, limits: Limits) -> tuple[bytes, ...]:
    buffers = []
    for index, buffer in enumerate(document.get("buffers", ())):
        uri = buffer.get("uri")
        if uri is None:
            data = binary if index == 0 and binary is not None else b""
        else:
            inline = _data_uri(uri)
            data = read_bytes(path.parent / unquote(uri), limits) if inline is None else inline
        if len(data) < int(buffer.get("byteLength", 0)):
            raise UnreadableAsset(
                f"{path} is truncated: buffer {index} holds {len(data)} of {buffer['byteLength']} bytes"
            )
        buffers.append(data)
    return tuple(buffers)


def _data_uri(uri: str) -> bytes | None:
    if not uri.startswith("data:"):
        return None
    head, _, body = uri.partition(",")
    try:
        return base64.b64decode(body) if head.endswith(";base64") else unquote(body).encode("latin-1")
    except (binascii.Error, ValueError):
        return b""
