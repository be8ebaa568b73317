"""A table of named arrays as one file that numpy opens too (`.npz`, uncompressed), its largest array left on disk.

The same arrays always give the same bytes. A file appears whole, by one rename. The columns of a shard are checked, for
they may come from any source; nothing is decoded.
"""

import json
import math
import os
import struct
import tokenize
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipFile, ZipInfo

import numpy as np

from grafu.asset.scan_files import array_from
from grafu.data.shards_arrays import ABSENT, DEFECT_KINDS, NO_BODY
from grafu.errors import AssetTooLarge, UnreadableAsset
from grafu.export.whole_file import whole_file
from grafu.graph.arrays import KIND_OF, LABELS
from grafu.graph.piece_facts import PIECES

_WORD: Final = ("<u4", ())
_PLACE: Final = ("<i8", ())
# The type of each column and the shape of a row.
_ROWS: Final[Mapping[str, tuple[str, tuple[int, ...]]]] = {
    **dict.fromkeys(("model_id", "family", "node_id", "source_name", "defect_part"), _WORD),
    **dict.fromkeys(("nodes_from", "edges_from", "given_edges_from", "defects_from"), _PLACE),
    **dict.fromkeys(("defect_parts_from", "points_from"), _PLACE),
    **dict.fromkeys(("label", "given_label", "defect_kind", "ajar", "piece"), ("|u1", ())),
    "body": ("<u2", ()),
    **dict.fromkeys(("edge", "given_edge"), ("<u2", (4,))),
    "removable": ("|b1", ()),
    "box": ("<f8", (2, 3)),
    "transparent": ("<f8", ()),
    "points": ("<u4", ()),
}
_OF_NODES: Final = ("node_id", "source_name", "label", "given_label", "removable", "box", "body", "ajar", "transparent")
# Where the rows of which columns begin, for each row of which column.
_STARTS: Final[Mapping[str, tuple[str, tuple[str, ...]]]] = {
    "nodes_from": ("model_id", _OF_NODES),
    "edges_from": ("model_id", ("edge",)),
    "given_edges_from": ("model_id", ("given_edge",)),
    "defects_from": ("model_id", ("defect_kind",)),
    "defect_parts_from": ("defect_kind", ("defect_part",)),
    "points_from": ("node_id", ("points",)),
}


def require_columns(columns: Mapping[str, np.ndarray], names: Any, path: Path) -> None:
    """Makes sure that the columns of a shard fit together and that its words and codes are known.

    Raises:
        UnreadableAsset: if they do not.
    """
    wrong = _wrong_type(columns) or _wrong_starts(columns) or _wrong_words(columns, names) or _wrong_codes(columns)
    if wrong:
        raise UnreadableAsset(f"`{path}` is damaged ({wrong}): make it again with `grafu synth`")


def _wrong_type(columns: Mapping[str, np.ndarray]) -> str:
    for name, (kind, row) in _ROWS.items():
        found = columns.get(name)
        if found is None:
            return f"it lacks the column `{name}`"
        if found.dtype != np.dtype(kind) or found.ndim != 1 + len(row) or found.shape[1:] != row:
            return f"its column `{name}` holds {found.dtype} {found.shape}"
    return ""


def _wrong_starts(columns: Mapping[str, np.ndarray]) -> str:
    for name, (owner, targets) in _STARTS.items():
        starts = columns[name]
        if len(starts) != len(columns[owner]) + 1 or starts[0] != 0 or (np.diff(starts) < 0).any():
            return f"its column `{name}` is no list of places"
        for target in targets:
            if starts[-1] != len(columns[target]):
                return f"its columns `{name}` and `{target}` do not fit"
    models = len(columns["model_id"])
    wrong = next((name for name in ("family", "piece") if len(columns[name]) != models), "")
    return f"`{wrong}` and `model_id` do not fit" if wrong else ""


def _wrong_words(columns: Mapping[str, np.ndarray], names: Any) -> str:
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        return "its names are no words"
    used = ("model_id", "family", "node_id", "source_name", "defect_part")
    return next((f"`{key}` names words that are not there" for key in used if _most(columns[key]) >= len(names)), "")


def _wrong_codes(columns: Mapping[str, np.ndarray]) -> str:
    given = columns["given_label"]
    labels = max(_most(columns["label"]), _most(given[given != ABSENT]))
    if labels >= len(LABELS) or _most(columns["defect_kind"]) >= len(DEFECT_KINDS):
        return "it has labels or defects that are not known"
    if not (np.isin(columns["ajar"], (0, 1, ABSENT)).all() and _known(columns["piece"], len(PIECES))):
        return "it has kinds of pieces that are not known"
    counts = np.repeat(np.diff(columns["nodes_from"]), np.diff(columns["nodes_from"]))
    bodies = columns["body"]
    if ((bodies > counts) & (bodies != NO_BODY)).any():
        return "`body` names nodes that are not there"
    box = columns["box"]
    if not np.isfinite(box).all() or (box[:, 1] < box[:, 0]).any():
        return "a box is not finite or upside down"
    if not ((columns["transparent"] >= 0.0) & (columns["transparent"] <= 1.0)).all():
        return "a transparent fraction is not in 0..1"
    nodes = np.diff(columns["nodes_from"])
    for name in ("edge", "given_edge"):
        counts = np.repeat(nodes, np.diff(columns[f"{name}s_from"]))
        known = np.isin(columns[name][:, 2], list(KIND_OF))
        if (columns[name][:, :2] >= counts[:, None]).any() or not known.all():
            return f"`{name}` names nodes or kinds that are not there"
    return ""


def _known(column: np.ndarray, count: int) -> bool:
    return bool(((column < count) | (column == ABSENT)).all())


def _most(column: np.ndarray) -> int:
    return int(column.max(initial=0)) if len(column) else -1


_DATE = (1980, 1, 1, 0, 0, 0)  # the first that a zip file can state: the time of writing must not change the bytes
_LOCAL_HEADER = 30  # bytes of a zip member's header before its name; name and extra length stand at 26 and 28
_CHUNK = 1 << 22
_MOST = 512 * 2**20  # bytes of arrays that are not left on disk: a thousand models take a few megabytes

# RuntimeError is zipfile's word for a member that is encrypted, or packed in a way that it does not know; the last four
# come from headers that are no Python.
_DAMAGED: Final[tuple[type[Exception], ...]] = (
    *(BadZipFile, EOFError, ValueError, struct.error, RuntimeError, zlib.error),
    *(TypeError, KeyError, SyntaxError, tokenize.TokenError),
)


def write_array_file(arrays: Mapping[str, np.ndarray], texts: Mapping[str, Any], path: Path) -> None:
    """Writes the arrays as `<name>.npy` and the texts as `<name>.json` into one file, whole or not at all.

    Raises:
        ExportError: if it cannot be written.
    """
    with whole_file(path) as fresh, fresh.open("wb") as file:
        with ZipFile(file, "w", ZIP_STORED) as archive:
            for name, value in texts.items():
                archive.writestr(_member(f"{name}.json", ZIP_DEFLATED), json.dumps(value, ensure_ascii=False))
            for name, array in arrays.items():
                with archive.open(_member(f"{name}.npy", ZIP_STORED), "w", force_zip64=True) as member:
                    np.lib.format.write_array(member, np.ascontiguousarray(array), allow_pickle=False)
        file.flush()
        os.fsync(file.fileno())


def read_array_file(path: Path, mapped: str, verify: bool = True) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Returns arrays and texts by name; the array `mapped` stays on disk and is read where it is looked at.

    With `verify` its bytes are checked too (those of the rest always are).

    Raises:
        UnreadableAsset: if the file is missing, no such file, cut short or changed, or a link that leads out of its
            folder.
        AssetTooLarge: if it unpacks to more than a file of arrays ever holds.
    """
    _require_own(path)
    try:
        with ZipFile(path) as archive:
            _require_small(archive, mapped, path)
            arrays: dict[str, np.ndarray] = {}
            texts: dict[str, Any] = {}
            for info in archive.infolist():
                stem, _, kind = info.filename.rpartition(".")
                if kind == "json":
                    texts[stem] = json.loads(archive.read(info))
                elif kind == "npy" and stem == mapped:
                    arrays[stem] = _map_member(path, info, verify)
                elif kind == "npy":
                    arrays[stem] = _read_member(archive, info)
            return arrays, texts
    except _DAMAGED as error:
        said = (str(error) or type(error).__name__).splitlines()[0][:200]
        raise UnreadableAsset(f"`{path}` is no whole file of arrays, or was changed: {said}") from error
    except OSError as error:
        raise UnreadableAsset(f"cannot read `{path}`: {error.strerror or error}") from error


def _member(name: str, compression: int) -> ZipInfo:
    info = ZipInfo(name, _DATE)
    info.compress_type = compression
    info.create_system = 3  # the same on every system
    info.external_attr = 0o644 << 16
    return info


def _require_own(path: Path) -> None:
    """Refuses what is no regular file, and a link that leads out of the folder: a data set may come from any source."""
    if os.path.lexists(path) and not path.is_file():
        raise UnreadableAsset(f"cannot read `{path}`: it is no regular file")
    if os.path.dirname(os.path.realpath(path)) != os.path.realpath(path.parent):
        raise UnreadableAsset(f"`{path}` leads out of its folder: copy the file there")


def _require_small(archive: ZipFile, mapped: str, path: Path) -> None:
    """Refuses what would fill the memory; the array that stays on disk does not count."""
    size = sum(info.file_size for info in archive.infolist() if info.filename != f"{mapped}.npy")
    if size > _MOST:
        raise AssetTooLarge(f"`{path}` unpacks to {size / 2**20:,.0f} MiB: at most {_MOST >> 20} are read")


def _read_member(archive: ZipFile, info: ZipInfo) -> np.ndarray:
    try:
        return array_from(archive.read(info))
    except ValueError as error:
        raise ValueError(f"`{info.filename}`: {error}") from None


def _header(file: Any, info: ZipInfo) -> tuple[tuple[int, ...], bool, np.dtype[Any]]:
    """Returns the shape, order and type that the header of an array file states, and leaves the file after it."""
    version = np.lib.format.read_magic(file)
    if version != (1, 0):
        raise ValueError(f"`{info.filename}` is of another kind of array file: {version}")
    shape, fortran, dtype = np.lib.format.read_array_header_1_0(file)
    return shape, fortran, dtype


def _map_member(path: Path, info: ZipInfo, verify: bool) -> np.ndarray:
    if info.compress_type != ZIP_STORED:
        raise ValueError(f"`{info.filename}` must not be compressed")
    with path.open("rb") as file:
        file.seek(info.header_offset)
        header = file.read(_LOCAL_HEADER)
        name_length, extra_length = struct.unpack("<HH", header[26:30])
        start = info.header_offset + _LOCAL_HEADER + name_length + extra_length
        if verify:
            file.seek(start)
            _require_sum(file, info)
        file.seek(start)
        shape, fortran, dtype = _header(file, info)
        if fortran or dtype.hasobject or file.tell() - start + math.prod(shape) * dtype.itemsize != info.file_size:
            raise ValueError(f"`{info.filename}` holds another array than it states")
        if not math.prod(shape):
            return np.zeros(shape, dtype)
        return np.memmap(path, dtype, "r", file.tell(), shape)


def _require_sum(file: Any, info: ZipInfo) -> None:
    total, left = 0, info.file_size
    while left:
        data = file.read(min(left, _CHUNK))
        if not data:
            raise EOFError("cut short")
        total, left = zlib.crc32(data, total), left - len(data)
    if total != info.CRC:
        raise ValueError(f"bad CRC-32 for `{info.filename}`")
