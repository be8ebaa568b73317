"""What a data set of synthetic models is asked to be, and the manifest that keeps runs of different ones apart.

    DIR/dataset.json   seed, points, models in each shard, format, version, and a digest of the first model

The digest tells another generator, whatever its version states. This module writes the manifest and no model.
"""

import json
from contextlib import suppress
from dataclasses import asdict
from hashlib import blake2b
from pathlib import Path
from typing import Any, Literal, final

import numpy as np

from grafu.asset.json_files import read_own_json
from grafu.data.furfun.layout import FUNCTIONAL, GEOMETRY, SPLITS, UNFUNCTIONAL
from grafu.data.furfun.split import SPLIT_NAMES
from grafu.data.pair import record_of
from grafu.data.shards import MODELS_PER_SHARD
from grafu.data.shards_arrays import ABSENT, ModelArrays, record_to_arrays
from grafu.data.stream import shard_paths
from grafu.dataclass import dataclass
from grafu.errors import AssetError, ExportError, UnreadableAsset
from grafu.export.whole_file import write_whole
from grafu.graph.arrays import LABELS
from grafu.synth.generate import make_specimen
from grafu.synth.specimen import Specimen
from grafu.synth.truth.check import faults_in
from grafu.version import __version__

DatasetFormat = Literal["shards", "furfun"]
SCHEMA = "grafu.dataset/1"
MANIFEST = "dataset.json"

_MOVABLE = [code for code, label in enumerate(LABELS) if label.is_movable]
_SAID = {
    "format": "format",
    "seed": "seed",
    "points": "points for each part",
    "models_per_shard": "models in each shard",
}


@final
@dataclass(frozen=True)
class DatasetPlan:
    """What to make: `count` models of `seed`, with `points` surface points on each part.

    Raises:
        ExportError: if a number is out of range.
    """

    seed: int
    count: int
    points: int = 512  # the network's (paper, supplement)
    models_per_shard: int = MODELS_PER_SHARD  # of the format `shards`
    format: DatasetFormat = "shards"

    def __post_init__(self) -> None:
        if min(self.seed, self.count - 1, self.points, self.models_per_shard - 1) < 0:
            raise ExportError(f"a data set must have a seed and points of at least 0, and a model: got {self}")

    @property
    def shards(self) -> int:
        """How many files it takes."""
        return -(-self.count // self.models_per_shard)

    def indices(self, shard: int) -> range:
        """The indices of a shard's models."""
        first = shard * self.models_per_shard
        return range(first, min(first + self.models_per_shard, self.count))


@final
@dataclass(frozen=True)
class ModelSummary:
    """One model in numbers: parts as given and of the repaired version, doors and drawers among these, defects.

    Two models with one `shape` are doubles. `fresh`: it was made now, and not in an earlier run. `faults`: what
    is wrong beyond the declared defects, in words, where that was asked for.
    """

    model_id: str
    family: str
    given: int
    parts: int
    movable: int
    defects: tuple[str, ...]
    shape: bytes
    fresh: bool
    faults: tuple[str, ...] = ()


def begin_dataset(plan: DatasetPlan, folder: Path, overwrite: bool = False) -> None:
    """Makes the folder and its manifest, or makes sure that the data set that is there can be gone on with.

    With `overwrite` the models of an earlier run are removed, and nothing that others put among them.

    Raises:
        ExportError: if the folder holds another data set or other things, or cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        held = sorted(path.name for path in folder.iterdir() if not (path.name[0] == "." and path.suffix == ".new"))
    except OSError as error:
        raise ExportError(f"cannot write the output `{folder}`: {error.strerror}; nothing was written") from error
    if held and MANIFEST not in held:
        raise ExportError(f"`{folder}` holds `{held[0]}` and no data set, so it is kept: choose another --out")
    stated = _stated(folder) if held else {}
    manifest = _manifest(plan)
    if held and not overwrite:
        _require_same(manifest, stated, folder)
    else:
        _write_manifest(folder, manifest)


def made_with(folder: Path) -> int | None:
    """Returns the seed that a folder of synthetic models states, None where it states none.

    Raises:
        UnreadableAsset: if its manifest is damaged, or of another form.
    """
    return _read_manifest(folder).get("seed") if (folder / MANIFEST).is_file() else None


def summary_of(arrays: ModelArrays, fresh: bool, faults: tuple[str, ...] = ()) -> ModelSummary:
    """Returns a model in numbers."""
    return ModelSummary(
        arrays.model_id,
        arrays.family,
        int(np.count_nonzero(arrays.given_labels != ABSENT)),
        len(arrays.labels),
        int(np.isin(arrays.labels, _MOVABLE).sum()),
        tuple(defect.kind for defect in arrays.defects),
        _shape(arrays),
        fresh,
        faults,
    )


def _shape(arrays: ModelArrays) -> bytes:
    """Returns the same for two models of the same parts in the same places, to a tenth of a millimetre."""
    places = np.rint(arrays.boxes * 1e4).astype(np.int64)
    return blake2b(places.tobytes() + arrays.labels.tobytes() + arrays.given_labels.tobytes(), digest_size=12).digest()


def faults_said(specimen: Specimen) -> tuple[str, ...]:
    """Returns in words what is wrong with a specimen beyond the defects that it declares."""
    return tuple(f"{fault.kind} of {', '.join(fault.parts)}" for fault in faults_in(specimen))


def _manifest(plan: DatasetPlan) -> dict[str, Any]:
    asked = asdict(plan)
    del asked["count"]  # a data set may grow
    first = record_to_arrays(record_of(make_specimen(plan.seed, 0, plan.points)))
    return {"schema": SCHEMA, "grafu": __version__} | asked | {"first_model": _digest(first)}


def _digest(arrays: ModelArrays) -> str:
    """Returns a digest of a model: another generator makes another, whatever its version states."""
    words = [arrays.model_id, arrays.family, *arrays.node_ids, *map(str, arrays.defects)]
    columns = (arrays.labels, arrays.given_labels, arrays.boxes, arrays.edges, arrays.given_edges, arrays.points)
    return blake2b("\n".join(words).encode() + b"".join(c.tobytes() for c in columns), digest_size=16).hexdigest()


def _write_manifest(folder: Path, manifest: dict[str, Any]) -> None:
    """Removes the models of an earlier run, and states what comes now."""
    try:
        for path in _written(folder):
            path.unlink()
        for name in (UNFUNCTIONAL, FUNCTIONAL, GEOMETRY, SPLITS):
            for empty in (*(folder / name).glob("*/"), folder / name):
                with suppress(OSError):  # it is not empty, or not there
                    empty.rmdir()
    except OSError as error:
        raise ExportError(f"cannot write the output `{folder}`: {error.strerror}") from error
    write_whole(json.dumps(manifest, indent=1) + "\n", folder / MANIFEST)


def _written(folder: Path) -> list[Path]:
    """Returns the files of a data set of ours, by the names that they are given."""
    graphs = [path for kind in (FUNCTIONAL, UNFUNCTIONAL) for path in (folder / kind).glob("*/*.json")]
    parts = [path for ending in ("npy", "ply") for path in (folder / GEOMETRY).glob(f"*/*.{ending}")]
    splits = [path for name in SPLIT_NAMES if (path := folder / SPLITS / f"{name}.json").is_file()]
    shards = [path for path in shard_paths(folder) if path.stem.removeprefix("shard_").isdigit()]
    return [*shards, *(path for path in graphs if path.stem == path.parent.name), *parts, *splits]


def _read_manifest(folder: Path) -> dict[str, Any]:
    stated = read_own_json(folder / MANIFEST, f"a data set of grafu, of the form `{SCHEMA}`")
    if not isinstance(stated, dict) or stated.get("schema") != SCHEMA or not isinstance(stated.get("seed"), int):
        raise UnreadableAsset(f"`{folder / MANIFEST}` must be of the form `{SCHEMA}`")
    return stated


def _stated(folder: Path) -> dict[str, Any]:
    """Returns the manifest of the data set that is there; what has none of ours is none of ours, and is kept."""
    try:
        return _read_manifest(folder)
    except AssetError as error:
        raise ExportError(f"{error}: choose another --out") from error


def _require_same(asked: dict[str, Any], stated: dict[str, Any], folder: Path) -> None:
    """Refuses to resume what was made with other options."""
    advice = "choose another --out, or give --overwrite to start again"
    for key, word in _SAID.items():
        if stated.get(key) != asked[key]:
            raise ExportError(f"`{folder}` was made with {stated.get(key)} as its {word}, not {asked[key]}: {advice}")
    if stated != asked:
        made, now = stated.get("grafu"), asked["grafu"]
        which = f"grafu {made}, and this is {now}" if made != now else "a generator that makes other models"
        raise ExportError(f"`{folder}` was made with {which}: {advice}")
