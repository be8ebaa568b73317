"""The glTF document: chunks of a GLB file, JSON, buffers, accessors, images as bytes.

Every size that the file declares is checked against the bytes that are there before memory is taken for it. The reader
is our own: trimesh's decodes images and drops the wrap modes of textures, and a result must hold both unchanged;
pygltflib parses the JSON, but leaves accessors and their bounds to its caller.
"""

import base64
import binascii
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import field
from pathlib import Path
from typing import Any, final
from urllib.parse import unquote_to_bytes

import numpy as np

from grafu.asset.gltf_meshopt import MeshoptError, unpack
from grafu.asset.json_files import JsonObject, object_of, parse_json
from grafu.asset.resources import ModelFiles
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Texture


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


_DTYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_MESHOPT = "EXT_meshopt_compression"
_REFUSED = {"KHR_meshopt_compression": "meshopt in the form of KHR_meshopt_compression"}


@final
@dataclass(frozen=True)
class GltfFile:
    """A parsed glTF document with its buffers' bytes."""

    path: Path
    document: JsonObject
    buffers: tuple[memoryview, ...]
    files: ModelFiles
    _unpacked: dict[int, bytes] = field(default_factory=dict, compare=False, repr=False)  # compressed views, once each

    def item(self, key: str, index: Any) -> JsonObject:
        """Returns one element of a top-level array.

        Raises:
            UnreadableAsset: if there is no such element.
        """
        items = self.document.array(key)
        if isinstance(index, bool) or not isinstance(index, int) or not 0 <= index < len(items):
            raise self.damaged(f"{key}[{index}] is not there")
        return object_of(items[index], f"{key}[{index}]", self.damaged)

    def damaged(self, why: str) -> UnreadableAsset:
        """Returns the error for a damaged document, to be raised."""
        return _damaged(self.path, why)

    @contextmanager
    def guarded(self) -> Iterator[None]:
        """Turns what a document trips that should be of our own making into one clear error.

        Raises:
            UnreadableAsset: where an entry is missing or of the wrong type.
        """
        try:
            yield
        except (KeyError, TypeError, AttributeError, ValueError, OverflowError) as error:
            raise self.damaged(f"an entry has the wrong type: {str(error).splitlines()[0]}") from None

    def view(self, index: Any) -> tuple[memoryview, int]:
        """Returns the bytes of a buffer view and its stride (0: tight)."""
        view = self.item("bufferViews", index)
        packed = view.member("extensions")
        if _MESHOPT in packed:
            if index not in self._unpacked:
                self._unpacked[index] = self._unpack(index, view.whole("byteLength", 0), packed.member(_MESHOPT))
            return memoryview(self._unpacked[index]), view.whole("byteStride", 0)
        return self._bytes(index, view), view.whole("byteStride", 0)

    def _bytes(self, index: Any, view: JsonObject) -> memoryview:
        """Returns the bytes of a buffer that a view, or what compresses it, names."""
        buffer = view.whole("buffer")
        if buffer is None or buffer >= len(self.buffers):
            raise self.damaged(f"buffer {buffer} is not there")
        start, length = view.whole("byteOffset", 0), view.whole("byteLength", 0)
        if start + length > len(self.buffers[buffer]):
            raise self.damaged(f"bufferViews[{index}] reaches beyond its buffer")
        return self.buffers[buffer][start : start + length]

    def _unpack(self, index: Any, length: int, packed: JsonObject) -> bytes:
        """Returns the bytes of a view that is compressed by meshopt; they count among those that are read."""
        count, stride = packed.whole("count", 0), packed.whole("byteStride", 0)
        if count * stride != length:
            raise self.damaged(f"bufferViews[{index}] has {length} bytes for {count} elements of {stride}")
        mode = packed.text("mode")
        self.files.tally.add(self.path, bytes=length)
        self.files.limits.require(*(("vertices", count) if mode == "ATTRIBUTES" else ("faces", count // 3)), self.path)
        try:
            data = bytes(self._bytes(index, packed))
            return unpack(data, mode, count, stride, packed.text("filter") or "NONE")
        except MeshoptError as error:
            raise self.damaged(f"bufferViews[{index}]: {error}") from None

    def count(self, index: Any) -> int:
        """Returns how many elements an accessor declares."""
        return self.item("accessors", index).whole("count", 0)

    def accessor(self, index: Any) -> np.ndarray:
        """Returns an accessor as (count, width) of its own number type; normalised integers become floats.

        Without bytes behind it it is all zeros: whoever asks for it has held its count against the limits.
        """
        accessor = self.item("accessors", index)
        dtype, width = _DTYPES.get(accessor.whole("componentType", 0)), _WIDTHS.get(accessor.text("type"))
        if dtype is None or width is None:
            raise self.damaged(f"accessors[{index}] has no valid type or count")
        values = self._dense(accessor, index, np.dtype(dtype), width)
        if "sparse" in accessor:
            self._set_sparse(values, accessor.member("sparse"))
        return self.normalised(index, values)

    def normalised(self, index: Any, values: np.ndarray) -> np.ndarray:
        """Returns values of an accessor, integers as floats within -1..1 where it states that they are normalised."""
        if self.item("accessors", index).get("normalized") and values.dtype.kind in "iu":
            return np.maximum(values / np.iinfo(values.dtype).max, -1.0)
        return values

    def _dense(self, accessor: JsonObject, index: Any, dtype: np.dtype[Any], width: int) -> np.ndarray:
        count = accessor.whole("count", 0)
        if "bufferView" not in accessor:
            return np.zeros((count, width), dtype)
        data, stride = self.view(accessor.get("bufferView"))
        offset, element = accessor.whole("byteOffset", 0), dtype.itemsize * width
        stride = stride or element
        if stride < element or (count and offset + stride * (count - 1) + element > len(data)):
            raise self.damaged(f"accessors[{index}] declares {count:,} elements, more than its buffer holds")
        if not count:
            return np.zeros((0, width), dtype)
        return np.ndarray((count, width), dtype, data, offset, (stride, dtype.itemsize)).copy()

    def _set_sparse(self, values: np.ndarray, sparse: JsonObject) -> None:
        """Puts the elements that a sparse accessor lists in their places."""
        count, places, news = sparse.whole("count", 0), sparse.member("indices"), sparse.member("values")
        kind = _DTYPES.get(places.whole("componentType", 0), "")
        if kind not in ("<u1", "<u2", "<u4") or count > len(values):
            raise self.damaged("a sparse accessor does not fit")
        where = self._elements(places, np.dtype(kind), count, 1)[:, 0]
        if len(where) and where.max() >= len(values):
            raise self.damaged("a sparse accessor does not fit")
        values[where] = self._elements(news, values.dtype, count, values.shape[1])

    def _elements(self, part: JsonObject, dtype: np.dtype[Any], count: int, width: int) -> np.ndarray:
        data = self.view(part.get("bufferView"))[0][part.whole("byteOffset", 0) :]
        if count * width * dtype.itemsize > len(data):
            raise self.damaged("a sparse accessor does not fit")
        return np.frombuffer(data, dtype, count * width).reshape(count, width)

    def image(self, index: Any) -> Texture | str:
        """Returns an image, checked, or in words why it cannot be had."""
        image = self.item("images", index)
        name = image.text("name") or f"image_{index}"
        if "bufferView" in image:
            return self.files.image(self.view(image.get("bufferView"))[0], name)
        uri = image.text("uri")
        data = _data_uri(uri)
        if data is not None:
            return self.files.image(data, name)
        sought = self.files.seek(unquoted(uri), self.path.parent)
        return sought.why if sought.path is None else self.files.texture(sought.path)


def read_gltf_file(path: Path, files: ModelFiles) -> GltfFile:
    """Returns the parsed document of a .glb or .gltf file.

    Raises:
        UnreadableAsset: if it is missing, truncated, no glTF 2.0, or compressed in a way that is not read.
        AssetTooLarge: if it has more bytes than the limit.
    """
    data = files.read(path)
    text, binary = chunks_of(data, path) if data[:4] == b"glTF" else (data, None)
    values = parse_json(bytes(text), path, "glTF, JSON or a GLB container; export it again", files.limits)
    document = object_of(values, "", lambda why: _damaged(path, why))
    if "asset" not in document:
        raise UnreadableAsset(f"{path} is not glTF: expected an `asset` entry; export it again")
    version = document.member("asset").get("version")
    if not str(version).startswith("2"):
        raise UnreadableAsset(f"{path} is glTF version {str(version)[:20]}: expected 2.0; export it again")
    for extension in document.array("extensionsRequired"):
        if isinstance(extension, str) and extension in _REFUSED:
            kind = _REFUSED[extension]
            raise UnreadableAsset(f"{path} is compressed with {kind}, which is not read: export it without compression")
    return GltfFile(path, document, _buffers(path, document, binary, files), files)


def _damaged(path: Path, why: str) -> UnreadableAsset:
    return UnreadableAsset(f"{path} is damaged ({why}): expected a valid glTF 2.0 file; export it again")


def _buffers(path: Path, document: JsonObject, binary: memoryview | None, files: ModelFiles) -> tuple[memoryview, ...]:
    buffers = []
    is_compressed = _MESHOPT in document.array("extensionsUsed")
    for index, buffer in enumerate(document.objects("buffers")):
        data = _buffer(path, index, buffer.text("uri"), binary, files)
        length = buffer.whole("byteLength", 0)
        if data is None:  # it stands for what compressed views hold, and has no bytes of its own
            data, length = memoryview(b""), 0 if is_compressed else length
        if len(data) < length:
            raise UnreadableAsset(f"{path} is truncated: buffer {index} holds {len(data)} of {length} bytes")
        buffers.append(data)
    return tuple(buffers)


def _buffer(path: Path, index: int, uri: str, binary: memoryview | None, files: ModelFiles) -> memoryview | None:
    if not uri:
        return binary if index == 0 and binary is not None else None
    inline = _data_uri(uri)
    if inline is not None:
        return memoryview(inline)
    sought = files.seek(unquoted(uri), path.parent)
    if sought.path is None:
        raise UnreadableAsset(f"{path}: buffer {index}, {uri[:200]}, {sought.why}: expected a file of the model")
    return memoryview(files.read(sought.path))


def unquoted(uri: str) -> str:
    """Returns the file name that a URI means; what is no text becomes a name that no file has."""
    try:
        return unquote_to_bytes(uri).decode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        return "\0"


def _data_uri(uri: str) -> bytes | None:
    if not uri.startswith("data:"):
        return None
    head, _, body = uri.partition(",")
    try:
        return base64.b64decode(body) if head.endswith(";base64") else unquote_to_bytes(body)
    except (binascii.Error, ValueError):
        return b""
