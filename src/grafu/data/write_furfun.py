"""Writes made models laid out as the authors' release, model by model, and goes on where it was stopped.

    DIR/dataset.json                                        what was asked for (`write_plan`)
    DIR/part_geometries/<model>/  graphs_functional/<model>/  graphs_unfunctional/<model>/
    DIR/splits/                                             written last, over all models

A model's folders are moved into place in this order, so a model whose input graph stands is whole.
"""

import shutil
from collections.abc import Iterator, Mapping
from contextlib import closing, suppress
from functools import partial
from pathlib import Path
from uuid import uuid4

from grafu.data.furfun.layout import FUNCTIONAL, GEOMETRY, SPLITS, UNFUNCTIONAL
from grafu.data.furfun.split_files import SPLIT_NAMES
from grafu.data.furfun.write import furfun_files, split_files
from grafu.data.shards_arrays import record_to_arrays
from grafu.data.shards_record import record_of
from grafu.data.stream import ordered_map
from grafu.data.write_plan import DatasetPlan, ModelSummary, faults_said, summary_of
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
            with suppress(OSError):  # somebody put something in
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
