"""glTF primitives that are compressed with Draco (KHR_draco_mesh_compression), decoded by DracoPy.

What the compressed bytes declare is compared with what the document declares, and was counted, before they are decoded.
The library is an extra (`grafu[formats]`).
"""

from typing import Any, final

import numpy as np

from grafu.asset.gltf_buffers import GltfFile
from grafu.asset.json_files import JsonObject
from grafu.asset.scan_files import library_call
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset

EXTENSION = "KHR_draco_mesh_compression"
_EXPECTED = "valid Draco meshes; export it again"
_MESH, _EDGEBREAKER, _HAS_METADATA = 1, 1, 0x8000
_MOST_NESTED = 16  # groups of metadata one below the other


@final
@dataclass(frozen=True)
class DracoArrays:
    """The decoded arrays of one primitive: corners of triangles, and attributes by glTF's names (`POSITION`)."""

    indices: np.ndarray
    attributes: dict[str, np.ndarray]


def is_compressed_alone(file: GltfFile, primitive: JsonObject) -> bool:
    """Whether the positions of a primitive are compressed with Draco and there are no plain ones besides."""
    attributes = primitive.member("attributes")
    if EXTENSION not in primitive.member("extensions") or "POSITION" not in attributes:
        return False
    return "bufferView" not in file.item("accessors", attributes.get("POSITION"))


def decoded(file: GltfFile, primitive: JsonObject) -> DracoArrays:
    """Returns the decoded arrays of a compressed primitive; normalised integers become floats.

    Raises:
        UnreadableAsset: if they are damaged or hold more than the document declares, or DracoPy is not installed.
    """
    stated, attributes = primitive.member("extensions").member(EXTENSION), primitive.member("attributes")
    data = bytes(file.view(stated.get("bufferView"))[0])
    points = file.count(attributes.get("POSITION"))
    corners = file.count(primitive.get("indices")) if "indices" in primitive else points
    _check_header(file, data, points, corners // 3)
    mesh = _decoded(file, data)
    with library_call(file.path, _EXPECTED):
        faces, found = np.asarray(mesh.faces), {a["unique_id"]: np.asarray(a["data"]) for a in mesh.attributes}
    ids = {name: stated.member("attributes").whole(name) for name in attributes.data}
    arrays = {name: found[key] for name, key in ids.items() if key in found}
    if any(len(values) > points for values in arrays.values()) or 3 * len(faces) > corners:
        raise file.damaged("a Draco mesh holds more than its accessors declare")
    by_name = {n: file.normalised(attributes.get(n), v.reshape(len(v), -1)) for n, v in arrays.items()}
    if "POSITION" not in by_name:
        raise file.damaged("a Draco mesh has no positions")
    return DracoArrays(faces.ravel(), by_name)


def _decoded(file: GltfFile, data: bytes) -> Any:
    try:
        import DracoPy
    except ImportError:
        raise UnreadableAsset(
            f"{file.path} is compressed with Draco, which is read by DracoPy: install it with "
            "`pip install 'grafu[formats]'`, or export it without compression"
        ) from None
    with library_call(file.path, _EXPECTED):
        return DracoPy.decode(data)


def _check_header(file: GltfFile, data: bytes, points: int, faces: int) -> None:
    """Refuses a mesh that declares more points or faces than were counted, before anything is decoded."""
    if data[:5] != b"DRACO" or data[5:8] != bytes((2, 2, _MESH)):
        raise file.damaged("a compressed mesh is not Draco 2.2")
    try:
        at = 11
        if int.from_bytes(data[9:11], "little") & _HAS_METADATA:
            at = _after_metadata(data, at)
        edgebreaker = data[8] == _EDGEBREAKER
        first, at = _varint(data, at + 1 if edgebreaker else at)
        second, _ = _varint(data, at)
    except IndexError:
        raise file.damaged("a Draco mesh is cut short") from None
    declared_points, declared_faces = (first, second) if edgebreaker else (second, first)
    if declared_points > points or declared_faces > faces:
        raise file.damaged("a Draco mesh declares more than its accessors")


def _varint(data: bytes, at: int) -> tuple[int, int]:
    """Returns a whole number of seven bits a byte, the lowest first, and where the next begins."""
    value = shift = 0
    while data[at] & 0x80 and shift < 63:
        value |= (data[at] & 0x7F) << shift
        at, shift = at + 1, shift + 7
    return value | data[at] << shift, at + 1


def _after_metadata(data: bytes, at: int) -> int:
    """Returns where the metadata of a mesh ends: groups for attributes, each behind its id, and one for the mesh."""
    count, at = _varint(data, at)
    for _ in range(min(count, len(data))):
        at = _after_group(data, _varint(data, at)[1], 0)
    return _after_group(data, at, 0)


def _after_group(data: bytes, at: int, nested: int) -> int:
    """Returns where one group of metadata ends: entries with a name and bytes, then named groups within it."""
    if nested > _MOST_NESTED:
        raise IndexError
    count, at = _varint(data, at)
    for _ in range(min(count, len(data))):
        size, at = _varint(data, at + 1 + data[at])
        at += size
    count, at = _varint(data, at)
    for _ in range(min(count, len(data))):
        at = _after_group(data, at + 1 + data[at], nested + 1)
    return at
