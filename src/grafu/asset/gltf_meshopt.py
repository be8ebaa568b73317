"""Buffer views that are compressed by meshopt (`EXT_meshopt_compression`), unpacked. It opens no file.

The decoder is our own, written from the extension's specification: the library for Python (0.2.30) has to be compiled.
Whoever calls it has held the size of the result against the limits; every byte that is read is checked to be there.
"""

from collections.abc import Callable
from typing import Final

import numpy as np

_GROUP, _BLOCK, _MOST = 16, 8192, 256  # elements of a group; bytes and elements of a block, at most
_TAIL = 32  # bytes at the end: the first element's baseline
_FIFO = 16
_LARGEST_RATIO = 64  # bytes for each byte of a stream: a group of 16 of them has two bits at least
_WORD = 0xFFFFFFFF


class MeshoptError(ValueError):
    """The bytes are no stream of the kind and size that the document declares."""


def unpack(data: bytes, mode: str, count: int, stride: int, kind: str = "NONE") -> bytes:
    """Returns the `count` elements of `stride` bytes that a stream holds.

    Args:
        data: the stream.
        mode: `ATTRIBUTES`, `TRIANGLES` or `INDICES`.
        count: of elements.
        stride: bytes of an element.
        kind: the filter of attributes: `NONE`, `OCTAHEDRAL` or `EXPONENTIAL`.

    Raises:
        MeshoptError: if the stream is damaged, or is of a mode, a filter or a size that there is not.
    """
    try:
        if mode == "ATTRIBUTES" and kind in _FILTERS and stride % 4 == 0 and 0 < stride <= 256:
            return _FILTERS[kind](_attributes(data, count, stride))
        if mode in ("TRIANGLES", "INDICES") and kind == "NONE" and stride in (2, 4):
            found = _triangles(data, count) if mode == "TRIANGLES" else _indices(data, count)
            return np.array(found, np.int64).astype(f"<u{stride}").tobytes()
    except IndexError:
        raise MeshoptError("a compressed stream is cut short") from None
    raise MeshoptError(f"compression {mode[:20]} with filter {kind[:20]} and {stride} bytes an element")


def _attributes(data: bytes, count: int, stride: int) -> np.ndarray:
    """Returns the elements as rows of bytes: differences to the element before, byte for byte."""
    tail = max(stride, _TAIL)
    if len(data) < 1 + tail + count * stride // _LARGEST_RATIO or data[0] != 0xA0:
        raise MeshoptError("a compressed stream is cut short or of another version")
    found = np.empty((count, stride), np.uint8)
    before = np.frombuffer(data[len(data) - stride :], np.uint8)
    per_block = min(_BLOCK // stride & ~(_GROUP - 1), _MOST)
    at, end = 1, len(data) - tail
    for first in range(0, count, per_block):
        size = min(per_block, count - first)
        for byte in range(stride):
            codes, at = _deltas(data, at, end, -(-size // _GROUP))
            code = np.frombuffer(codes, np.uint8)[:size]
            delta = (code >> 1) ^ (0 - (code & 1)).astype(np.uint8)
            found[first : first + size, byte] = np.cumsum(delta, dtype=np.uint8) + before[byte]
        before = found[first + size - 1]
    if at != end:
        raise MeshoptError("a compressed stream is longer than its elements")
    return found


def _spread(bits: int) -> list[bytes]:
    """Returns for each byte the codes of so many bits in it, the highest first."""
    return [bytes(byte >> shift & (1 << bits) - 1 for shift in range(8 - bits, -1, -bits)) for byte in range(256)]


_SPREAD: Final = {1: (2, _spread(2)), 2: (4, _spread(4))}  # by the mode of a group: bits of a code


def _deltas(data: bytes, at: int, end: int, groups: int) -> tuple[bytes, int]:
    """Returns the codes of so many groups of 16 elements, and where the next begin."""
    modes = data[at : at + -(-groups // 4)]
    at += len(modes)
    found = []
    for group in range(groups):
        mode = modes[group // 4] >> 2 * (group % 4) & 3
        if mode == 0:
            found.append(bytes(_GROUP))
            continue
        if mode == 3:
            found.append(data[at : at + _GROUP])
            at += _GROUP
        else:
            bits, spread = _SPREAD[mode]
            codes = b"".join([spread[byte] for byte in data[at : at + 2 * bits]])
            at += 2 * bits
            marker = (1 << bits) - 1
            wide = codes.count(marker)
            if wide:  # the codes that do not fit follow as whole bytes
                places = np.flatnonzero(np.frombuffer(codes, np.uint8) == marker)
                filled, extra = bytearray(codes), data[at : at + wide]
                for place, value in zip(places.tolist(), extra, strict=False):
                    filled[place] = value
                codes, at = bytes(filled), at + wide
            found.append(codes)
        if at > end:
            raise MeshoptError("a compressed stream is cut short")
    return b"".join(found), at


class _Numbers:
    """Whole numbers of seven bits a byte, the lowest first. Not a value: it moves on."""

    def __init__(self, data: bytes, at: int, end: int) -> None:
        self.data, self.at, self.end = data, at, end

    def byte(self) -> int:
        if self.at >= self.end:
            raise MeshoptError("a compressed stream is cut short")
        self.at += 1
        return self.data[self.at - 1]

    def next(self) -> int:
        value = shift = 0
        while True:
            byte = self.byte()
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80 or shift > 28:
                return value & _WORD


def _signed(value: int) -> int:
    return ~(value >> 1) if value & 1 else value >> 1


def _indices(data: bytes, count: int) -> list[int]:
    """Returns indices, each a difference to one of the last two that it follows."""
    if len(data) < 5 + count or data[0] != 0xD1:
        raise MeshoptError("a compressed list of indices is cut short or of another version")
    numbers, last, found = _Numbers(data, 1, len(data) - 4), [0, 0], []
    for _ in range(count):
        value = numbers.next()
        of = value & 1
        last[of] = last[of] + _signed(value >> 1) & _WORD
        found.append(last[of])
    return found


def _triangles(data: bytes, count: int) -> list[int]:
    """Returns the corners of triangles, each in terms of edges and vertices before it."""
    if count % 3 or len(data) < 17 + count // 3 or data[0] != 0xE1:
        raise MeshoptError("a compressed list of triangles is cut short or of another version")
    return _Triangles(data, count // 3).corners


class _Triangles:
    """A list of triangles while it is unpacked. Not a value: edges and vertices that came last are kept."""

    def __init__(self, data: bytes, count: int) -> None:
        self.corners: list[int] = []
        self._numbers = _Numbers(data, 1 + count, len(data) - 16)
        self._pairs = data[-16:]
        self._edges = [(0, 0)] * _FIFO
        self._vertices = [0] * _FIFO
        self._next = self._last = 0
        for code in data[1 : 1 + count]:
            if code < 0xF0:
                self._on_edge(code >> 4, code & 15)
            else:
                self._free(code)

    def _on_edge(self, edge: int, how: int) -> None:
        """Adds a triangle on an edge that came before."""
        a, b = self._edges[-1 - edge]
        if 0 < how < 13:
            c = self._vertices[-1 - how]
        else:
            c = self._step(how)
            self._keep(c)
        self.corners += (a, b, c)
        self._edges = [*self._edges[2:], (c, b), (a, c)]

    def _step(self, how: int) -> int:
        """Returns a new vertex, one beside the last that was stated, or one that is stated."""
        if how == 0:
            return self._new()
        if how == 15:
            return self._stated()
        self._last = (self._last + (1 if how == 14 else -1)) & _WORD
        return self._last

    def _free(self, code: int) -> None:
        """Adds a triangle on no edge; its vertices are new, among those that came before, or stated."""
        is_stated = code >= 0xFE
        pair = self._numbers.byte() if is_stated else self._pairs[code & 15]
        if is_stated and pair == 0:
            self._next = 0
        a = self._stated() if code == 0xFF else self._new()
        first, second = pair >> 4, pair & 15
        before = list(self._vertices)
        b, b_is_kept = self._corner(first, before, is_stated)
        c, c_is_kept = self._corner(second, before, is_stated)
        for vertex, is_kept in ((a, True), (b, b_is_kept), (c, c_is_kept)):
            if is_kept:
                self._keep(vertex)
        self.corners += (a, b, c)
        self._edges = [*self._edges[3:], (b, a), (c, b), (a, c)]

    def _corner(self, how: int, before: list[int], is_stated: bool) -> tuple[int, bool]:
        if how == 0:
            return self._new(), True
        if how == 15:
            if not is_stated:
                raise MeshoptError("a compressed list of triangles is damaged")
            return self._stated(), True
        return before[-how], False

    def _new(self) -> int:
        self._next += 1
        return self._next - 1

    def _stated(self) -> int:
        self._last = (self._last + _signed(self._numbers.next())) & _WORD
        return self._last

    def _keep(self, vertex: int) -> None:
        self._vertices = [*self._vertices[1:], vertex]


def _plain(rows: np.ndarray) -> bytes:
    return rows.tobytes()


def _octahedral(rows: np.ndarray) -> bytes:
    """Returns unit vectors of three whole numbers, from two on an unfolded octahedron; the fourth stays."""
    if rows.shape[1] not in (4, 8):
        raise MeshoptError("vectors of another size than 4 or 8 bytes")
    kind = "<i1" if rows.shape[1] == 4 else "<i2"
    values = rows.view(kind).astype(np.float64)
    one = np.maximum(values[:, 2], 1.0)
    x, y = values[:, 0] / one, values[:, 1] / one
    z = 1.0 - np.abs(x) - np.abs(y)
    fold = np.minimum(z, 0.0)
    vectors = np.column_stack([x - np.copysign(fold, x), y - np.copysign(fold, y), z])
    vectors /= np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-12)
    values[:, :3] = np.round(vectors * np.iinfo(kind).max)
    return values.astype(kind).tobytes()


def _exponential(rows: np.ndarray) -> bytes:
    """Returns floats of a signed exponent of 8 bits and a signed mantissa of 24."""
    words = rows.view("<i4").astype(np.int64)
    exponent = np.clip(words >> 24, -100, 100)
    mantissa = ((words & 0xFFFFFF) ^ 0x800000) - 0x800000
    return np.ldexp(mantissa.astype(np.float64), exponent).astype("<f4").tobytes()


_FILTERS: Final[dict[str, Callable[[np.ndarray], bytes]]] = {
    "NONE": _plain,
    "OCTAHEDRAL": _octahedral,
    "EXPONENTIAL": _exponential,
}
