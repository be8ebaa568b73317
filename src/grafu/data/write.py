"""Writes a data set of synthetic models in either format, and goes on where it was stopped. It prints nothing.

As shards; the bytes depend on the seed and the points alone, not on the number of processes or of stops:

    DIR/dataset.json       what was asked for (`write_plan`)
    DIR/shard_000000.npz   models 0..999, and so on; each appears whole, by one rename

Or laid out as the authors' release:

    DIR/dataset.json                                        what was asked for (`write_plan`)
    DIR/part_geometries/<model>/  graphs_functional/<model>/  graphs_unfunctional/<model>/
    DIR/splits/                                             written last, over all models

A model's folders are moved into place in this order, so a model whose input graph stands is whole.
"""

import shutil
from collections.abc import Iterator, Mapping
from contextlib import closing, suppress
from functools import partial
from itertools import islice
from pathlib import Path
from uuid import uuid4

from grafu.data.furfun.layout import FUNCTIONAL, GEOMETRY, SPLITS, UNFUNCTIONAL
from grafu.data.furfun.split import SPLIT_NAMES
from grafu.data.furfun.write import furfun_files, split_files
from grafu.data.pair import record_of
from grafu.data.shards import ShardReader, write_model_arrays
from grafu.data.shards_arrays import ModelArrays, record_to_arrays
from grafu.data.stream import ordered_map, shard_paths
from grafu.data.write_plan import DatasetPlan, ModelSummary, begin_dataset, faults_said, summary_of
from grafu.errors import ExportError
from grafu.export.whole_file import write_whole
from grafu.synth.generate import make_specimen

_STAGING = ".model.{mark}.new"


def write_furfun_models(plan: DatasetPlan, folder: Path, jobs: int = 1, check: bool = False) -> Iterator[ModelSummary]:
    """Makes the models that a begun folder lacks, and yields a summary of each of these.

    With `check` the summaries say what is wrong with them.

    Raises:
        ExportError: if a file cannot be written.
    """
    for left in folder.glob(_STAGING.format(mark="*")):  # of a run that was killed while it wrote
        shutil.rmtree(left, ignore_errors=True)
    start = len(furfun_models(folder))  # models are written in order
    made = partial(_make_files, plan.seed, plan.points, check)
    try:
        if start < plan.count:
            for name in SPLIT_NAMES:
                (folder / SPLITS / f"{name}.json").unlink(missing_ok=True)
            with suppress(OSError):  # it is not empty
                (folder / SPLITS).rmdir()
        with closing(ordered_map(made, start, plan.count, jobs)) as models:
            for summary, files in models:
                _put_model(files, folder, summary.model_id)
                yield summary
        if not all((folder / SPLITS / f"{name}.json").exists() for name in SPLIT_NAMES):
            for name, data in split_files(furfun_models(folder)).contents.items():
                write_whole(data.decode(), folder / name)
    except OSError as error:
        raise ExportError(f"cannot write into `{folder}`: {error.strerror}; whole models are kept") from error


def furfun_models(folder: Path) -> tuple[str, ...]:
    """Returns the ids of the whole models in a folder, sorted."""
    return tuple(sorted(path.name for path in (folder / UNFUNCTIONAL).glob("*")))


def _make_files(seed: int, points: int, check: bool, index: int) -> tuple[ModelSummary, dict[str, bytes]]:
    specimen = make_specimen(seed, index, points)
    faults = faults_said(specimen) if check else ()
    summary = summary_of(record_to_arrays(record_of(specimen)), True, faults)
    return summary, dict(furfun_files(specimen).contents)


def _put_model(files: Mapping[str, bytes], folder: Path, name: str) -> None:
    _put(files, folder, [f"{kind}/{name}" for kind in (GEOMETRY, FUNCTIONAL, UNFUNCTIONAL)])


def _put(files: Mapping[str, bytes], folder: Path, places: list[str]) -> None:
    """Writes the files aside and then moves the folders `places`, which hold them all, in this order."""
    staging = folder / _STAGING.format(mark=uuid4().hex[:8])
    try:
        for name, data in files.items():
            path = staging / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        for place in places:
            (folder / place).parent.mkdir(parents=True, exist_ok=True)
            shutil.rmtree(folder / place, ignore_errors=True)  # of a model that was half moved
            (staging / place).rename(folder / place)
    finally:
        shutil.rmtree(staging, ignore_errors=True)


def write_shards(plan: DatasetPlan, folder: Path, jobs: int = 1, check: bool = False) -> Iterator[ModelSummary]:
    """Makes the models that a begun folder lacks, and yields a summary of each model, those of earlier runs first.

    With `check` the summaries of new models say what is wrong with them.

    Raises:
        ExportError: if a shard cannot be written.
        UnreadableAsset: if a shard that is there is damaged.
    """
    for left in folder.glob(".shard_*.new"):  # of a run that was killed while it wrote
        left.unlink(missing_ok=True)
    done: list[ModelArrays] = []
    shard = 0
    for shard in range(plan.shards):
        done = _made_before(shard_path(folder, shard), len(plan.indices(shard)))
        yield from (summary_of(arrays, False) for arrays in done)
        if len(done) < len(plan.indices(shard)):
            break
    else:
        return
    start = plan.indices(shard).start + len(done)
    with closing(ordered_map(partial(_make, plan.seed, plan.points, check), start, plan.count, jobs)) as models:
        for number in range(shard, plan.shards):
            held = done if number == shard else []
            for arrays, faults in islice(models, len(plan.indices(number)) - len(held)):
                held.append(arrays)
                yield summary_of(arrays, True, faults)
            write_model_arrays(held, shard_path(folder, number))


def shard_path(folder: Path, number: int) -> Path:
    """Returns where a shard of a data set stands."""
    return folder / f"shard_{number:06d}.npz"


def _make(seed: int, points: int, check: bool, index: int) -> tuple[ModelArrays, tuple[str, ...]]:
    specimen = make_specimen(seed, index, points)
    return record_to_arrays(record_of(specimen)), faults_said(specimen) if check else ()


def _made_before(path: Path, wanted: int) -> list[ModelArrays]:
    """Returns the models of a shard, with their points only where the shard will be written again."""
    if not path.exists():
        return []
    reader = ShardReader(path, points=False)
    if len(reader) < wanted:
        reader = ShardReader(path)
    return [reader.arrays(place) for place in range(len(reader))]


def write_dataset(
    plan: DatasetPlan, folder: Path, jobs: int = 1, overwrite: bool = False, check: bool = False
) -> Iterator[ModelSummary]:
    """Makes the models that the folder lacks with `jobs` processes, and yields a summary of each.

    Of shards the models of earlier runs are summed up first; FurFun's files do not say enough for that. Stopping the
    iterator, or the process, loses the shard or the model in work and nothing else. With `overwrite` the models of an
    earlier run are removed first; with `check` each new model is judged, and its summary states what is wrong with it.

    Raises:
        ExportError: if the folder holds another data set or other things, or cannot be written.
        UnreadableAsset: if a shard that is there is damaged.
    """
    begin_dataset(plan, folder, overwrite)
    yield from (write_shards if plan.format == "shards" else write_furfun_models)(plan, folder, jobs, check)


def models_written(folder: Path) -> int:
    """Returns how many whole models a folder holds, in whole files."""
    return sum(len(ShardReader(path, points=False)) for path in shard_paths(folder)) + len(furfun_models(folder))
