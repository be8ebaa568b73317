"""Shards: a thousand models in one file, read one by one and in any order (docs/dataset.md states what it holds).

All models' arrays stand one after the other in columns, with the places where each model begins. The graphs of a shard
are a few megabytes and are read when it is opened; the points stay on disk until they are asked for. Everything but the
points comes back exactly; `shards_points` states how near these do.
"""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, final

import numpy as np

from grafu.data.pair import Record
from grafu.data.shards_arrays import DEFECT_KINDS, ModelArrays, arrays_to_record, record_to_arrays
from grafu.data.shards_file import read_array_file, require_columns, write_array_file
from grafu.errors import UnreadableAsset
from grafu.graph.arrays import EDGE_WORDS, LABELS
from grafu.graph.piece_facts import PIECES
from grafu.synth.specimen import Defect
from grafu.version import __version__

SCHEMA = "grafu.shard/2"
MODELS_PER_SHARD = 1000

_WORDS = {
    "labels": list(LABELS),
    "edge_kinds": list(EDGE_WORDS),
    "defect_kinds": list(DEFECT_KINDS),
    "pieces": list(PIECES),
}
_NO_WORDS = np.zeros(0, np.uint32)


def write_shard(records: Iterable[Record], path: Path) -> None:
    """Writes the records as one shard, whole or not at all; a shard of that name is replaced.

    Raises:
        GraphError: if a node's points lie outside its box.
        ExportError: if the file cannot be written.
    """
    write_model_arrays([record_to_arrays(record) for record in records], path)


def write_model_arrays(models: Sequence[ModelArrays], path: Path) -> None:
    """Writes models that are arrays already as one shard, whole or not at all.

    Raises:
        ExportError: if the file cannot be written.
    """
    names = _Names()
    columns = _columns(models, names)
    about = {"schema": SCHEMA, "grafu": __version__, "models": len(models)} | _WORDS
    write_array_file(columns, {"shard": about, "names": names.words}, path)


@final
class ShardReader:
    """The models of one shard, by their place in it; nothing is decoded before it is asked for.

    `points` False leaves the points out of all that is read; `verify` False does not check their bytes on opening.

    Raises:
        UnreadableAsset: if the file is missing, no shard of this form, cut short or changed.
    """

    def __init__(self, path: Path, points: bool = True, verify: bool = True) -> None:
        self.path = path
        self.has_points = points
        columns, texts = read_array_file(path, mapped="points", verify=verify and points)
        stated = texts.get("shard")
        about = stated if isinstance(stated, dict) else {}
        schema = about.get("schema")
        if schema != SCHEMA or any(about.get(key) != words for key, words in _WORDS.items()):
            raise UnreadableAsset(f"`{path}` must be a shard of the form `{SCHEMA}`: got {schema or 'another file'!r}")
        self.about: dict[str, Any] = about
        require_columns(columns, texts.get("names"), path)
        self._names: list[str] = texts["names"]
        self._columns = columns

    def __len__(self) -> int:
        return len(self._columns["model_id"])

    def __iter__(self) -> Iterator[Record]:
        return (self[i] for i in range(len(self)))

    def __getitem__(self, place: int) -> Record:
        """Returns the model at a place.

        Raises:
            IndexError: if there is none.
            GraphError: if the graphs in the file break an invariant.
        """
        return arrays_to_record(self.arrays(place))

    @property
    def model_ids(self) -> tuple[str, ...]:
        """The models' ids, in order."""
        return tuple(self._names[i] for i in self._columns["model_id"].tolist())

    def arrays(self, place: int) -> ModelArrays:
        """Returns the model at a place as arrays that look into the shard's.

        Raises:
            IndexError: if there is none.
        """
        if not 0 <= place < len(self):
            raise IndexError(f"a place in `{self.path.name}` must be 0..{len(self) - 1}: got {place}")
        columns, names = self._columns, self._names
        nodes = self._span("nodes_from", place)
        first, last = columns["points_from"][[nodes.start, nodes.stop]].tolist() if self.has_points else (0, 0)
        counts = np.diff(columns["points_from"][nodes.start : nodes.stop + 1]).astype(np.int32)
        return ModelArrays(
            names[columns["model_id"][place]],
            names[columns["family"][place]],
            [names[i] for i in columns["node_id"][nodes].tolist()],
            [names[i] for i in columns["source_name"][nodes].tolist()],
            columns["label"][nodes],
            columns["given_label"][nodes],
            columns["body"][nodes],
            columns["ajar"][nodes],
            int(columns["piece"][place]),
            columns["removable"][nodes],
            columns["box"][nodes],
            columns["transparent"][nodes],
            columns["edge"][self._span("edges_from", place)],
            columns["given_edge"][self._span("given_edges_from", place)],
            self._defects(place),
            counts if self.has_points else np.zeros_like(counts),
            np.asarray(columns["points"][first:last]),
        )

    def _span(self, column: str, place: int) -> slice:
        start, stop = self._columns[column][place : place + 2].tolist()
        return slice(start, stop)

    def _defects(self, place: int) -> tuple[Defect, ...]:
        span = self._span("defects_from", place)
        kinds = self._columns["defect_kind"][span].tolist()
        parts = (self._span("defect_parts_from", i) for i in range(span.start, span.stop))
        return tuple(
            Defect(DEFECT_KINDS[kind], tuple(self._names[i] for i in self._columns["defect_part"][of].tolist()))
            for kind, of in zip(kinds, parts, strict=True)
        )


@final
class _Names:
    """Every word of a shard once, and its number."""

    def __init__(self) -> None:
        self._places: dict[str, int] = {}

    @property
    def words(self) -> list[str]:
        return list(self._places)

    def numbers(self, words: Iterable[str]) -> np.ndarray:
        places = self._places
        return np.array([places.setdefault(word, len(places)) for word in words], dtype=np.uint32)


def _columns(models: Sequence[ModelArrays], names: _Names) -> dict[str, np.ndarray]:
    defects = [defect for model in models for defect in model.defects]
    return {
        "model_id": names.numbers(m.model_id for m in models),
        "family": names.numbers(m.family for m in models),
        "nodes_from": _starts([len(m.node_ids) for m in models]),
        "edges_from": _starts([len(m.edges) for m in models]),
        "given_edges_from": _starts([len(m.given_edges) for m in models]),
        "defects_from": _starts([len(m.defects) for m in models]),
        "node_id": names.numbers(word for m in models for word in m.node_ids),
        "source_name": names.numbers(word for m in models for word in m.source_names),
        "label": _joined([m.labels for m in models], np.zeros(0, np.uint8)),
        "given_label": _joined([m.given_labels for m in models], np.zeros(0, np.uint8)),
        "body": _joined([m.bodies for m in models], np.zeros(0, np.uint16)),
        "ajar": _joined([m.ajar for m in models], np.zeros(0, np.uint8)),
        "piece": np.array([m.piece for m in models], dtype=np.uint8),
        "removable": _joined([m.removable for m in models], np.zeros(0, np.bool_)),
        "box": _joined([m.boxes for m in models], np.zeros((0, 2, 3))),
        "transparent": _joined([m.transparent for m in models], np.zeros(0)),
        "edge": _joined([m.edges for m in models], np.zeros((0, 4), np.uint16)),
        "given_edge": _joined([m.given_edges for m in models], np.zeros((0, 4), np.uint16)),
        "defect_kind": np.array([DEFECT_KINDS.index(d.kind) for d in defects], dtype=np.uint8),
        "defect_parts_from": _starts([len(d.parts) for d in defects]),
        "defect_part": names.numbers(part for d in defects for part in d.parts),
        "points_from": _starts([count for m in models for count in m.counts.tolist()]),
        "points": _joined([m.points for m in models], _NO_WORDS),
    }


def _starts(lengths: Sequence[int]) -> np.ndarray:
    """Returns where each begins, and where the last ends."""
    return np.concatenate([[0], np.cumsum(lengths)]).astype(np.int64)


def _joined(arrays: Sequence[np.ndarray], none: np.ndarray) -> np.ndarray:
    return np.concatenate(arrays) if arrays else none
