"""The columns of a shard as they must be: anybody may have written one. It decodes nothing."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np

from grafu.data.shards_arrays import ABSENT, DEFECT_KINDS
from grafu.errors import UnreadableAsset
from grafu.graph.arrays import KINDS, LABELS

_WORD: Final = ("<u4", ())
_PLACE: Final = ("<i8", ())
# The type of each column and the shape of a row.
_ROWS: Final[Mapping[str, tuple[str, tuple[int, ...]]]] = {
    **dict.fromkeys(("model_id", "family", "node_id", "source_name", "defect_part"), _WORD),
    **dict.fromkeys(("nodes_from", "edges_from", "given_edges_from", "defects_from"), _PLACE),
    **dict.fromkeys(("defect_parts_from", "points_from"), _PLACE),
    **dict.fromkeys(("label", "given_label", "defect_kind"), ("|u1", ())),
    **dict.fromkeys(("edge", "given_edge"), ("<u2", (4,))),
    "removable": ("|b1", ()),
    "box": ("<f8", (2, 3)),
    "points": ("<u4", ()),
}
# Where the rows of which columns begin, for each row of which column.
_STARTS: Final[Mapping[str, tuple[str, tuple[str, ...]]]] = {
    "nodes_from": ("model_id", ("node_id", "source_name", "label", "given_label", "removable", "box")),
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
    return "" if len(columns["family"]) == len(columns["model_id"]) else "`family` and `model_id` do not fit"


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
    box = columns["box"]
    if not np.isfinite(box).all() or (box[:, 1] < box[:, 0]).any():
        return "a box is not finite or upside down"
    nodes = np.diff(columns["nodes_from"])
    for name in ("edge", "given_edge"):
        counts = np.repeat(nodes, np.diff(columns[f"{name}s_from"]))
        if (columns[name][:, :2] >= counts[:, None]).any() or _most(columns[name][:, 2]) >= len(KINDS):
            return f"`{name}` names nodes or kinds that are not there"
    return ""


def _most(column: np.ndarray) -> int:
    return int(column.max(initial=0)) if len(column) else -1
