"""The lines of a Wavefront OBJ by kind, found without an object for each: files have millions. It reads no values."""

import re
from typing import Final, final

import numpy as np

from grafu.asset.options import Tally
from grafu.dataclass import dataclass

OTHER, VERTEX, TEXTURE, NORMAL, FACE, STATE = range(6)
_SPACE, _BREAK = 32, 10
# kind, the bytes that the line begins with
_KEYS: Final = ((VERTEX, b"v "), (TEXTURE, b"vt "), (NORMAL, b"vn "), (FACE, b"f "))
_STATES: Final = (b"o ", b"g ", b"us", b"mt")
_INDENTED = re.compile(rb"\n[ \x0b\x0c]+")


@final
@dataclass(frozen=True, eq=False, slots=True)
class ObjLines:
    """An OBJ's bytes, where its lines begin and end, and the kind of each.

    `blank` are the same bytes with the keys of vertices, texture coordinates, normals and faces as spaces.
    """

    data: bytes
    blank: np.ndarray
    begins: np.ndarray
    ends: np.ndarray
    kinds: np.ndarray

    def rows(self, kind: int) -> np.ndarray:
        """Returns the indices of the lines of a kind."""
        return np.flatnonzero(self.kinds == kind)

    def text(self, kind: int) -> bytes:
        """Returns the lines of a kind without their keys, one after another, each with its line break."""
        rows = self.rows(kind)
        if not len(rows):
            return b""
        first = rows[np.concatenate([[True], np.diff(rows) > 1])]
        last = rows[np.concatenate([np.diff(rows) > 1, [True]])]
        return b"".join(self.blank[a:b].tobytes() for a, b in zip(self.begins[first], self.ends[last] + 1, strict=True))

    def line(self, row: int) -> str:
        """Returns a line as text."""
        return self.data[self.begins[row] : self.ends[row]].decode("utf-8", "replace").strip()


def lines_of(data: bytes, where: str, tally: Tally) -> ObjLines:
    """Returns the lines of an OBJ; `where` names the file in errors.

    Raises:
        AssetTooLarge: if it has more lines, vertices, faces or changes of group than the limits allow.
    """
    tally.require(where, lines=data.count(b"\n") + data.count(b"\r") + 1)
    data = _plain(data)
    raw = np.frombuffer(data, np.uint8)
    ends = np.flatnonzero(raw == _BREAK)
    begins = np.concatenate([[0], ends[:-1] + 1]) if len(ends) else ends
    kinds = _kinds(raw, begins)
    count = np.bincount(kinds, minlength=STATE + 1)
    tally.add(where, groups=int(count[STATE]))
    tally.require(where, faces=int(count[FACE]), vertices=int(count[VERTEX]))
    tally.require(where, vertices=int(count[TEXTURE]))
    tally.require(where, vertices=int(count[NORMAL]))
    return ObjLines(data, _blanked(raw, begins, kinds), begins, ends, kinds)


def _plain(data: bytes) -> bytes:
    """Returns the bytes with one kind of line break and space, nothing before a line's key, and broken lines joined."""
    data = data.replace(b"\\\r\n", b" ").replace(b"\\\n", b" ").replace(b"\t", b" ")
    data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    data = data.lstrip(b" \x0b\x0c")
    if b"\n " in data:
        data = _INDENTED.sub(b"\n", data)
    return data if data.endswith(b"\n") or not data else data + b"\n"


def _kinds(raw: np.ndarray, begins: np.ndarray) -> np.ndarray:
    kinds = np.full(len(begins), OTHER, np.uint8)
    for kind, key in _KEYS:
        kinds[_begin_with(raw, begins, key)] = kind
    for key in _STATES:
        kinds[_begin_with(raw, begins, key)] = STATE
    return kinds


def _begin_with(raw: np.ndarray, begins: np.ndarray, key: bytes) -> np.ndarray:
    last = len(raw) - 1
    found = np.ones(len(begins), bool)
    for place, sign in enumerate(key):
        found &= raw[np.minimum(begins + place, last)] == sign
    return found


def _blanked(raw: np.ndarray, begins: np.ndarray, kinds: np.ndarray) -> np.ndarray:
    blank = raw.copy()
    for kind, key in _KEYS:
        at = begins[kinds == kind]
        for place in range(len(key)):
            blank[at + place] = _SPACE
    return blank
