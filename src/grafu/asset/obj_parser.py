"""Wavefront OBJ text to arrays, fast: polygons, negative indices, v/vt/vn in every form. It knows no materials."""

import warnings
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from grafu.errors import UnreadableAsset


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


def parse_obj(data: bytes, where: str) -> ObjData:
    """Returns the content of an OBJ file's bytes; `where` names the file in errors.

    Raises:
        UnreadableAsset: if a number is damaged or not finite, or a face names a vertex that is not there.
    """
    lines = _lines(data)
    v_lines = [line[2:] for line in lines if line[:2] == b"v "]
    tables = [_numbers([line[3:] for line in lines if line[:3] == key], where) for key in (b"vt ", b"vn ")]
    vertices, colors = _positions(_numbers(v_lines, where), where)
    face_rows = [i for i, line in enumerate(lines) if line[:2] == b"f "]
    corners, starts = _corners([lines[i][2:] for i in face_rows], where)
    sizes = (len(vertices), len(tables[0]), len(tables[1]))
    if len(corners) and corners.min() < 0:
        corners = _resolve_negative(corners, starts, lines, face_rows)
    corners = corners - 1
    for column, (size, noun) in enumerate(zip(sizes, ("vertex", "texture coordinate", "normal"), strict=True)):
        if len(corners) and (corners[:, column].max() >= size or corners[:, column].min() < (0, -1, -1)[column]):
            raise UnreadableAsset(f"{where}: a face names a {noun} that is not there ({size} are); re-export the OBJ")
    return ObjData(
        vertices, colors, _width(tables[0], 2), _width(tables[1], 3), corners, starts, *_runs(lines, face_rows)
    )


def _lines(data: bytes) -> list[bytes]:
    data = data.replace(b"\\\r\n", b" ").replace(b"\\\n", b" ").replace(b"\t", b" ")
    lines = data.splitlines()
    return [line.strip() for line in lines] if b"\n " in data else lines


def _numbers(rows: list[bytes], where: str) -> np.ndarray:
    """Returns the rows' numbers, (rows, columns); the column count is that of the shortest row."""
    if not rows:
        return np.zeros((0, 0))
    flat = _parse_flat(b" ".join(rows), float, where)
    width = len(rows[0].split())
    if len(flat) != width * len(rows) or len({len(r.split()) for r in rows[:: max(1, len(rows) // 50)]}) > 1:
        split = [r.split() for r in rows]
        width = min(len(s) for s in split)
        if width == 0:
            raise UnreadableAsset(f"{where} is not a readable OBJ: a line without its numbers; re-export the mesh")
        flat = _parse_flat(b" ".join(b" ".join(s[:width]) for s in split), float, where)
    table = flat.reshape(len(rows), width)
    if not np.isfinite(table).all():
        raise UnreadableAsset(f"{where} holds NaN or infinite coordinates: expected finite numbers; re-export the mesh")
    return table


def _parse_flat(text: bytes, dtype: type, where: str) -> np.ndarray:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return np.fromstring(text.decode("ascii", "replace"), dtype=dtype, sep=" ")
        except (ValueError, DeprecationWarning):
            found = "a line that should hold numbers holds something else"
            raise UnreadableAsset(f"{where} is not a readable OBJ: {found}; re-export the mesh") from None


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


def _corners(rows: list[bytes], where: str) -> tuple[np.ndarray, np.ndarray]:
    """Returns all corners (vertex, texture, normal; 0 where absent), and where each polygon starts."""
    if not rows:
        return np.zeros((0, 3), np.int64), np.zeros(1, np.int64)
    text = b"\n".join(rows)
    raw = np.frombuffer(text + b"\n", np.uint8)
    gap = (raw == 32) | (raw == 10)
    begins = np.flatnonzero(~gap & np.concatenate([[True], gap[:-1]]))
    per_corner = np.diff(np.searchsorted(np.flatnonzero(raw == 47), np.append(begins, len(raw))))
    row_ends = np.flatnonzero(raw == 10)
    starts = np.concatenate([[0], np.searchsorted(begins, row_ends)])
    corners = _uniform_corners(text, per_corner, where)
    return (corners if corners is not None else _mixed_corners(text, where)), starts


def _uniform_corners(text: bytes, per_corner: np.ndarray, where: str) -> np.ndarray | None:
    fields = int(per_corner[0]) + 1
    if not (per_corner == fields - 1).all() or fields > 3 or b"/ " in text or b"/\n" in text:
        return None
    middle_missing = b"//" in text
    if middle_missing:
        text = text.replace(b"//", b"/0/")
    flat = _parse_flat(text.replace(b"/", b" "), np.int64, where)
    if len(flat) != fields * len(per_corner):
        return None
    corners = np.zeros((len(per_corner), 3), np.int64)
    corners[:, :fields] = flat.reshape(-1, fields)
    return corners


def _mixed_corners(text: bytes, where: str) -> np.ndarray:
    tokens = [(*token.split(b"/"), b"", b"")[:3] for token in text.split()]
    try:
        return np.array([[int(field or 0) for field in token] for token in tokens], np.int64)
    except ValueError:
        raise UnreadableAsset(f"{where} is not a readable OBJ: a face holds something else than indices") from None


def _resolve_negative(corners: np.ndarray, starts: np.ndarray, lines: list[bytes], face_rows: list[int]) -> np.ndarray:
    """Returns the corners with indices counted from the end turned into ones counted from the start (1-based)."""
    corners = corners.copy()
    polygon = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    rows = np.asarray(face_rows)[polygon]
    for column, key in enumerate((b"v ", b"vt ", b"vn ")):
        defined = np.cumsum([line[: len(key)] == key for line in lines])
        below = corners[:, column] < 0
        corners[below, column] += defined[rows[below]] + 1
    return corners


def _runs(lines: list[bytes], face_rows: list[int]) -> tuple[tuple[ObjRun, ...], tuple[str, ...]]:
    state = {"o": "", "g": "", "usemtl": ""}
    runs: list[ObjRun] = []
    libraries: list[str] = []
    first = 0
    states = [(i, line) for i, line in enumerate(lines) if line[:2] in (b"o ", b"g ", b"us", b"mt")]
    at: Any = np.searchsorted(face_rows, [i for i, _ in states]) if states else []
    for (_, line), face in zip(states, at, strict=True):
        key, _, value = line.decode("utf-8", "replace").partition(" ")
        if key == "mtllib":
            libraries.append(value.strip())
        if key not in state:
            continue
        if face > first:
            runs.append(ObjRun(state["o"], state["g"], state["usemtl"], first, int(face)))
            first = int(face)
        state[key] = value.strip()
    if len(face_rows) > first:
        runs.append(ObjRun(state["o"], state["g"], state["usemtl"], first, len(face_rows)))
    return tuple(runs), tuple(libraries)
