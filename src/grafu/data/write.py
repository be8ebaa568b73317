"""Writes a data set of made models in either format, and goes on where it was stopped. It prints nothing."""

from collections.abc import Iterator
from pathlib import Path

from grafu.data.shards import ShardReader
from grafu.data.stream import shard_paths
from grafu.data.write_furfun import furfun_models, write_furfun_models
from grafu.data.write_plan import DatasetPlan, ModelSummary, begin_dataset
from grafu.data.write_shards import write_shards


def write_dataset(
    plan: DatasetPlan, folder: Path, jobs: int = 1, overwrite: bool = False, check: bool = False
) -> Iterator[ModelSummary]:
    """Makes the models that the folder lacks with `jobs` processes, and yields a summary of each.

    Of shards the models of earlier runs are summed up first; FurFun's files do not say enough for that. Stopping the
    iterator, or the process, loses the shard or the model in work and nothing else. With `overwrite` the models of an
    earlier run are removed first; with `check` each new model is judged, and its summary says what is wrong with it.

    Raises:
        ExportError: if the folder holds another data set or other things, or cannot be written.
        UnreadableAsset: if a shard that is there is damaged.
    """
    begin_dataset(plan, folder, overwrite)
    yield from (write_shards if plan.format == "shards" else write_furfun_models)(plan, folder, jobs, check)


def models_written(folder: Path) -> int:
    """Returns how many whole models a folder holds, in whole files."""
    return sum(len(ShardReader(path, points=False)) for path in shard_paths(folder)) + len(furfun_models(folder))
