"""The records of a binary FBX file: names, values, and arrays that are unpacked when they are asked for.

Every size that the file declares is compared with the bytes that are there, and the length of an array with what its
reader expects, before memory is taken for it. The reader is our own: the binding of ufbx (0.0.5) releases objects
that are still in use, and Assimp opens files by itself.
"""

import struct
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, final

import numpy as np

from grafu.asset.options import Limits
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset

MAGIC = b"Kaydara FBX Binary  \x00"
_FIRST, _WIDE = 7000, 7500  # versions: the oldest that is read; from the second on offsets have eight bytes
_DEEPEST = 64  # records of furniture are nested six deep
_ARRAYS = {b"f": "<f4", b"d": "<f8", b"l": "<i8", b"i": "<i4", b"b": "<u1"}
_NUMBERS = {b"Y": "<h", b"C": "<?", b"I": "<i", b"F": "<f", b"D": "<d", b"L": "<q"}
_READ = ("GlobalSettings", "Objects", "Connections", "Creator")


@final
@dataclass(frozen=True)
class FbxArray:
    """An array as it lies in the file: how many values of which type, and the bytes, packed by zlib or not."""

    path: Path
    dtype: str
    count: int
    is_packed: bool
    data: memoryview

    def values(self) -> np.ndarray:
        """Returns the values; whoever asks has compared `count` with what may be read.

        Raises:
            UnreadableAsset: if there are not as many as declared.
        """
        size = self.count * np.dtype(self.dtype).itemsize
        try:
            data = zlib.decompressobj().decompress(self.data, size + 1) if self.is_packed else bytes(self.data)
        except zlib.error:
            raise damaged(self.path, "an array cannot be unpacked") from None
        if len(data) != size:
            raise damaged(self.path, "an array has another length than it declares")
        return np.frombuffer(data, self.dtype)


@final
@dataclass(frozen=True)
class FbxRecord:
    """A named record: its values (numbers, texts, bytes and arrays) and the records within it."""

    path: Path
    name: str
    values: tuple[Any, ...]
    records: tuple["FbxRecord", ...]

    def all(self, name: str) -> list["FbxRecord"]:
        """Returns the records within it that have a name."""
        return [record for record in self.records if record.name == name]

    def first(self, name: str) -> "FbxRecord":
        """Returns the first record within it that has a name, an empty one where there is none."""
        return next((record for record in self.records if record.name == name), FbxRecord(self.path, name, (), ()))

    def text(self, place: int = 0) -> str:
        """Returns a value that is text, empty where it is none; what follows a name is its class and left out."""
        value = self.values[place] if place < len(self.values) else b""
        return value.partition(b"\0")[0].decode("utf-8", "replace") if isinstance(value, bytes) else ""

    def number(self, place: int = 0) -> int:
        """Returns a value that is a whole number, -1 where it is none."""
        value = self.values[place] if place < len(self.values) else None
        return value if isinstance(value, int) else -1

    def array(self) -> FbxArray:
        """Returns its array, an empty one where it has none."""
        found = self.values[0] if self.values else None
        return found if isinstance(found, FbxArray) else FbxArray(self.path, "<f8", 0, False, memoryview(b""))

    def properties(self) -> dict[str, tuple[float, ...]]:
        """Returns the numbers of its `Properties70` by name."""
        found = {}
        for record in self.first("Properties70").all("P"):
            numbers = [float(v) for v in record.values[4:] if isinstance(v, int | float)]
            if numbers and np.isfinite(numbers).all():
                found[record.text()] = tuple(numbers)
        return found


def damaged(path: Path, why: str) -> UnreadableAsset:
    """Returns the error for a damaged file, to be raised."""
    return UnreadableAsset(f"{path} is damaged ({why}): expected binary FBX; export it again")


def read_records(data: bytes, path: Path, limits: Limits) -> FbxRecord:
    """Returns the records of a file below one without a name: settings, objects, connections and who wrote it.

    Raises:
        UnreadableAsset: if it is text, older than FBX 7.0, cut short or damaged.
        AssetTooLarge: if it has more records or values than the limits allow.
    """
    if not data.startswith(MAGIC):
        raise UnreadableAsset(f"{path} is no binary FBX: expected FBX 7.0 or newer; export it as binary FBX or GLB")
    if len(data) < 27:
        raise damaged(path, "it is cut short")
    (version,) = struct.unpack_from("<I", data, 23)
    if version < _FIRST:
        raise UnreadableAsset(f"{path} is FBX {version / 1000:.1f}: expected 7.0 or newer; export it again")
    file = _File(memoryview(data), path, version, limits)
    try:
        return FbxRecord(path, "", (), tuple(file.records(27, len(data), 1)))
    except (struct.error, IndexError):
        raise damaged(path, "it is cut short") from None


@final
class _File:
    """The bytes while they are read. Not a value: what was found is counted."""

    def __init__(self, data: memoryview, path: Path, version: int, limits: Limits) -> None:
        self.data, self.path, self.limits = data, path, limits
        self._head = struct.Struct("<QQQB" if version >= _WIDE else "<IIIB")
        self._count = 0

    def records(self, at: int, end: int, depth: int) -> Iterator[FbxRecord]:
        """Yields the records in a stretch of bytes; of the outermost only those that are read."""
        if depth > _DEEPEST:
            raise damaged(self.path, f"records are nested more than {_DEEPEST} deep")
        while at + self._head.size <= end:
            stop, count, length, named = self._head.unpack_from(self.data, at)
            if stop == 0:
                return
            start = at + self._head.size
            inside = start + named + length
            if not start <= inside <= stop <= end:
                raise damaged(self.path, "a record reaches beyond the one around it")
            name = bytes(self.data[start : start + named]).decode("utf-8", "replace")
            if depth > 1 or name in _READ:
                values = tuple(self._values(start + named, inside, count))
                yield FbxRecord(self.path, name, values, tuple(self.records(inside, stop, depth + 1)))
            at = stop

    def _values(self, at: int, end: int, count: int) -> Iterator[Any]:
        self._count += 1 + count
        self.limits.require("values", self._count, self.path)
        for _ in range(count):
            kind = bytes(self.data[at : at + 1])
            value, at = self._value(kind, at + 1)
            if at > end:
                raise damaged(self.path, "a value reaches beyond its record")
            yield value

    def _value(self, kind: bytes, at: int) -> tuple[Any, int]:
        if kind in _NUMBERS:
            (value,) = struct.unpack_from(_NUMBERS[kind], self.data, at)
            return value, at + struct.calcsize(_NUMBERS[kind])
        if kind in (b"S", b"R"):
            (length,) = struct.unpack_from("<I", self.data, at)
            return bytes(self.data[at + 4 : at + 4 + length]), at + 4 + length
        if kind in _ARRAYS:
            count, packed, length = struct.unpack_from("<III", self.data, at)
            length = length if packed else count * np.dtype(_ARRAYS[kind]).itemsize
            data = self.data[at + 12 : at + 12 + length]
            return FbxArray(self.path, _ARRAYS[kind], count, bool(packed), data), at + 12 + length
        raise damaged(self.path, "it has a value of an unknown type")
