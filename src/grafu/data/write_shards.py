"""Writes made models as a folder of shards, and goes on where it was stopped. It prints nothing.

    DIR/dataset.json       what was asked for (`write_plan`)
    DIR/shard_000000.npz   models 0..999, and so on; each appears whole, by one rename

The bytes depend on the seed and the points alone: not on the number of processes, nor on how often it was stopped.
"""

from collections.abc import Iterator
from contextlib import closing
from functools import partial
from itertools import islice
from pathlib import Path

from grafu.data.shards import ShardReader, write_model_arrays
from grafu.data.shards_arrays import ModelArrays, record_to_arrays
from grafu.data.shards_record import record_of
from grafu.data.stream import ordered_map
from grafu.data.write_plan import DatasetPlan, ModelSummary, faults_said, summary_of
from grafu.synth.generate import make_specimen


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
