"""Wavefront OBJ text to arrays, fast: polygons, negative indices, v/vt/vn in every form."""

import warnings
from contextlib import suppress
from typing import final

import numpy as np

from grafu.asset.obj_lines import FACE, NORMAL, STATE, TEXTURE, VERTEX, ObjLines, lines_of
from grafu.asset.options import Limits, Tally
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset

_LARGEST = 1e15  # of a number: squares and products of such stay finite


@final
@dataclass(frozen=True, slots=True)
class ObjRun:
    """Polygons in a row that share object, group and material: `first` to `last` (exclusive)."""

    object: str
    group: str
    material: str
    first: int
    last: int


@final
@dataclass(frozen=True, slots=True)
class ObjData:
    """The content of an OBJ file: tables, corners as indices into them (-1 where absent), and runs of polygons.

    Polygon i has the corners `starts[i]` to `starts[i + 1]`; `corners` columns are vertex, texture, normal.
    """

    vertices: np.ndarray
    colors: np.ndarray | None
    uv: np.ndarray
    normals: np.ndarray
    corners: np.ndarray
    starts: np.ndarray
    runs: tuple[ObjRun, ...]
    libraries: tuple[str, ...]


def parse_obj(data: bytes, where: str, tally: Tally | None = None) -> ObjData:
    """Returns the content of an OBJ file's bytes; `where` names the file in errors, `tally` counts what it holds.

    Raises:
        UnreadableAsset: if a number is damaged or not finite, or a face names a vertex that is not there.
        AssetTooLarge: if the model has more of something than the limits allow.
    """
    tally = Tally(Limits()) if tally is None else tally
    lines = lines_of(data, where, tally)
    vertices, colors = _positions(_numbers(lines.text(VERTEX), where), where)
    uv, normals = (_numbers(lines.text(kind), where) for kind in (TEXTURE, NORMAL))
    corners, starts = _corners(lines.text(FACE), where)
    _count(vertices, starts, where, tally)
    if len(corners) and corners.min() < 0:
        corners = _resolve_negative(corners, starts, lines)
    corners = corners - 1
    sizes = (len(vertices), len(uv), len(normals))
    for column, (size, noun) in enumerate(zip(sizes, ("vertex", "texture coordinate", "normal"), strict=True)):
        if len(corners) and (corners[:, column].max() >= size or corners[:, column].min() < (0, -1, -1)[column]):
            raise UnreadableAsset(f"{where}: a face names a {noun} that is not there ({size} are); re-export the OBJ")
    return ObjData(vertices, colors, _width(uv, 2), _width(normals, 3), corners, starts, *_runs(lines))


def _count(vertices: np.ndarray, starts: np.ndarray, where: str, tally: Tally) -> None:
    """Counts the vertices and the triangles that the polygons will come to."""
    sizes = np.diff(starts)
    tally.require(where, corners=int(sizes.max(initial=0)))
    tally.add(where, vertices=len(vertices), faces=int(np.maximum(sizes - 2, 0).sum()))


def _numbers(text: bytes, where: str) -> np.ndarray:
    """Returns the numbers of lines of text, (rows, columns); the column count is that of the shortest row."""
    if not text:
        return np.zeros((0, 0))
    counts = _token_counts(text)
    width = int(counts.min())
    if width == 0:
        raise UnreadableAsset(f"{where} is not a readable OBJ: a line without its numbers; re-export the mesh")
    flat = _parse_flat(text, np.float64, int(counts.sum()), where)
    if width < counts.max():
        begins = np.cumsum(counts) - counts
        flat = flat[np.arange(len(flat)) - np.repeat(begins, counts) < width]
    table = flat.reshape(len(counts), width)
    if not np.isfinite(table).all():
        raise UnreadableAsset(f"{where} holds NaN or infinite coordinates: expected finite numbers; re-export the mesh")
    if len(table) and not np.abs(table).max() < _LARGEST:
        raise UnreadableAsset(f"{where} holds numbers beyond all furniture: expected coordinates; re-export the mesh")
    return table


def _token_counts(text: bytes) -> np.ndarray:
    """Returns how many words each line has."""
    raw = np.frombuffer(text, np.uint8)
    gap = (raw == 32) | ((raw >= 9) & (raw <= 13))
    begins = ~gap
    begins[1:] &= gap[:-1]
    ends = np.flatnonzero(raw == 10)
    return np.diff(np.searchsorted(np.flatnonzero(begins), ends), prepend=0)


def _parse_flat(text: bytes, dtype: type, count: int, where: str) -> np.ndarray:
    found: np.ndarray | None = None
    with warnings.catch_warnings(), suppress(ValueError, DeprecationWarning):
        warnings.simplefilter("error")
        found = np.fromstring(text, dtype=dtype, sep=" ")
    if found is None or len(found) != count:
        what = "a line that should hold numbers holds something else"
        raise UnreadableAsset(f"{where} is not a readable OBJ: {what}; re-export the mesh")
    return found


def _positions(table: np.ndarray, where: str) -> tuple[np.ndarray, np.ndarray | None]:
    if len(table) and table.shape[1] < 3:
        raise UnreadableAsset(f"{where}: a vertex has {table.shape[1]} coordinates, expected 3; re-export the OBJ")
    colors = None
    if table.shape[1] in (6, 7) and len(table):
        rgb = np.clip(np.round(table[:, 3:6] * (255 if table[:, 3:6].max() <= 1 else 1)), 0, 255).astype(np.uint8)
        colors = np.hstack([rgb, np.full((len(rgb), 1), 255, np.uint8)])
    return _width(table, 3), colors


def _width(table: np.ndarray, columns: int) -> np.ndarray:
    if table.shape[1] >= columns:
        return table[:, :columns]
    return np.hstack([table, np.zeros((len(table), columns - table.shape[1]))])


def _corners(text: bytes, where: str) -> tuple[np.ndarray, np.ndarray]:
    """Returns all corners (vertex, texture, normal; 0 where absent), and where each polygon starts."""
    if not text:
        return np.zeros((0, 3), np.int64), np.zeros(1, np.int64)
    text = _with_all_fields(text)
    raw = np.frombuffer(text, np.uint8)
    gap = (raw == 32) | ((raw >= 9) & (raw <= 13))
    begins = np.flatnonzero(~gap & np.concatenate([[True], gap[:-1]]))
    starts = np.concatenate([[0], np.searchsorted(begins, np.flatnonzero(raw == 10))])
    fields = 1 + np.diff(np.searchsorted(np.flatnonzero(raw == 47), np.append(begins, len(raw))))
    corners = np.zeros((len(begins), 3), np.int64)
    if not len(begins):
        return corners, starts
    if fields.max() > 3:
        raise UnreadableAsset(f"{where} is not a readable OBJ: a face holds something else than indices")
    flat = _parse_flat(text.replace(b"/", b" "), np.int64, int(fields.sum()), where)
    if fields.min() == fields.max():
        corners[:, : fields[0]] = flat.reshape(-1, fields[0])
    else:
        own = np.cumsum(fields) - fields
        corners[np.repeat(np.arange(len(begins)), fields), np.arange(len(flat)) - np.repeat(own, fields)] = flat
    return corners, starts


def _with_all_fields(text: bytes) -> bytes:
    """Returns the text with 0 for each index that is left out between or beside slashes (`1//3`, `1/`)."""
    if b"//" in text:
        text = text.replace(b"//", b"/0/")
    if b"/ " in text or b"/\n" in text:
        text = text.replace(b"/ ", b"/0 ").replace(b"/\n", b"/0\n")
    return text


def _resolve_negative(corners: np.ndarray, starts: np.ndarray, lines: ObjLines) -> np.ndarray:
    """Returns the corners with indices counted from the end turned into ones counted from the start (1-based)."""
    corners = corners.copy()
    rows = lines.rows(FACE)[np.repeat(np.arange(len(starts) - 1), np.diff(starts))]
    for column, kind in enumerate((VERTEX, TEXTURE, NORMAL)):
        defined = np.cumsum(lines.kinds == kind)
        below = corners[:, column] < 0
        corners[below, column] += defined[rows[below]] + 1
    return corners


def _runs(lines: ObjLines) -> tuple[tuple[ObjRun, ...], tuple[str, ...]]:
    state = {"o": "", "g": "", "usemtl": ""}
    runs: list[ObjRun] = []
    libraries: list[str] = []
    first = 0
    faces, rows = lines.rows(FACE), lines.rows(STATE)
    for row, face in zip(rows.tolist(), np.searchsorted(faces, rows).tolist(), strict=True):
        key, _, value = lines.line(row).partition(" ")
        if key == "mtllib":
            libraries.append(value.strip())
        if key not in state:
            continue
        if face > first:
            runs.append(ObjRun(state["o"], state["g"], state["usemtl"], first, face))
            first = face
        state[key] = value.strip()
    if len(faces) > first:
        runs.append(ObjRun(state["o"], state["g"], state["usemtl"], first, len(faces)))
    return tuple(runs), tuple(libraries)
