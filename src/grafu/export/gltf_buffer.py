"""The binary half of a glTF file: arrays and images over one aligned buffer, and the accessors that describe them."""

from typing import Any, final

import numpy as np

from grafu.geometry.arrays import extremes

_COMPONENT = {"uint8": 5121, "uint16": 5123, "uint32": 5125, "float32": 5126}
_TYPE = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}

VERTEX_DATA = 34962
INDEX_DATA = 34963


@final
class GltfBuffer:
    """Collects arrays and encoded images; every one starts at a multiple of four bytes."""

    def __init__(self) -> None:
        self.accessors: list[dict[str, Any]] = []
        self.views: list[dict[str, Any]] = []
        self._chunks: list[bytes] = []
        self._length = 0

    def add_bytes(self, data: bytes, target: int | None = None) -> int:
        """Appends raw bytes as a new buffer view and returns its index."""
        view = {"buffer": 0, "byteOffset": self._length, "byteLength": len(data)}
        self.views.append(view if target is None else {**view, "target": target})
        padded = data + b"\0" * (-len(data) % 4)
        self._chunks.append(padded)
        self._length += len(padded)
        return len(self.views) - 1

    def add_array(self, array: np.ndarray, target: int | None = None, bounds: bool = False) -> int:
        """Appends an array of scalars or rows of up to 4 and returns the index of its accessor.

        `bounds` adds the least and largest value of each column, which positions and key times must have. Bytes are
        colours, read as 0..1.
        """
        view = {"bufferView": self.add_bytes(np.ascontiguousarray(array).tobytes(), target)}
        return self._add_accessor(view | _described(array, bounds))

    def add_compressed(self, array: np.ndarray, bounds: bool = False) -> int:
        """Returns the index of a new accessor for an array whose values are held in a compressed form elsewhere."""
        return self._add_accessor(_described(array, bounds))

    def _add_accessor(self, accessor: dict[str, Any]) -> int:
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def add_indices(self, indices: np.ndarray) -> int:
        """Appends vertex indices as 16-bit numbers where these suffice, else 32-bit ones."""
        return self.add_array(narrowed(indices), INDEX_DATA)

    def to_bytes(self) -> bytes:
        """Returns the whole buffer."""
        return b"".join(self._chunks)


def narrowed(indices: np.ndarray) -> np.ndarray:
    """Returns vertex indices as 16-bit numbers where these suffice (65535 is reserved), else as 32-bit ones."""
    narrow = not len(indices) or int(indices.max()) < 65535
    return indices.astype(np.uint16 if narrow else np.uint32)


def _described(array: np.ndarray, bounds: bool) -> dict[str, Any]:
    """Returns the accessor of an array, without where its bytes are."""
    rows = array.reshape(len(array), -1)
    accessor: dict[str, Any] = {
        "componentType": _COMPONENT[str(array.dtype)],
        "count": len(array),
        "type": _TYPE[rows.shape[1]],
    }
    if array.dtype == np.uint8:
        accessor["normalized"] = True
    if bounds:
        low, high = extremes(rows)
        accessor |= {"min": low.tolist(), "max": high.tolist()}
    return accessor
