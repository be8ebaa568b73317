"""Where models come from: the same for the same number, over and over, never what judges them."""

from dataclasses import replace
from pathlib import Path

import pytest

from grafu.data.pair import Record, natural_pair
from grafu.data.shards import write_shard
from grafu.data.write import write_dataset
from grafu.data.write_plan import MANIFEST, DatasetPlan
from grafu.errors import UnreadableAsset
from grafu.training.source import VALIDATION_SEED, FurFunSource, ShardSource, SynthSource, source_in
from grafu.training.validation import validation_source
from small_graphs import cabinet


def record(name: str) -> Record:
    truth = replace(cabinet(), model_id=name)
    return Record(name, "test", natural_pair(truth).input, truth)


def test_made_furniture_is_the_same_for_its_number() -> None:
    one, two = (SynthSource(5, points=8).pair(3) for _ in range(2))
    assert one.model_id == two.model_id
    assert [n.box for n in one.input.nodes] == [n.box for n in two.input.nodes]
    assert SynthSource(5, points=8).pair(4).model_id != one.model_id


def test_shards_are_gone_through_again_and_again_each_time_in_another_order(tmp_path: Path) -> None:
    for shard in range(2):
        write_shard([record(f"m{shard}{k}") for k in range(3 + shard)], tmp_path / f"shard_{shard:06d}.npz")
    models = source_in(tmp_path, 1, 8)
    assert isinstance(models, ShardSource)
    first, second = ([models.pair(e * 7 + k).model_id for k in range(7)] for e in (0, 1))
    assert sorted(first) == sorted(second) == ["m00", "m01", "m02", "m10", "m11", "m12", "m13"]
    assert first != second
    assert "7 models" in models.name


def test_a_release_trains_on_its_training_part_and_is_judged_on_another(tmp_path: Path) -> None:
    assert len(list(write_dataset(DatasetPlan(2, 12, points=4, format="furfun"), tmp_path))) == 12
    models = source_in(tmp_path, 1, 4)
    judge = validation_source(models, 4)
    assert isinstance(models, FurFunSource)
    assert isinstance(judge, FurFunSource)
    assert {models.pair(k).model_id for k in range(len(models.models))} == set(models.models)
    assert not set(models.models) & set(judge.models)
    assert "part `train`" in models.name
    assert models.maker_seed == 2


def test_a_folder_of_another_kind_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UnreadableAsset, match="no FurFun folder"):
        source_in(tmp_path, 1, 8)
    with pytest.raises(UnreadableAsset, match="grafu synth"):
        ShardSource(tmp_path)


def test_the_furniture_that_judges_is_not_trained_on() -> None:
    assert validation_source(SynthSource(1), 8) == SynthSource(VALIDATION_SEED, 8)
    with pytest.raises(ValueError, match="judges the weights"):
        validation_source(SynthSource(VALIDATION_SEED), 8)
    with pytest.raises(ValueError, match="negative"):
        SynthSource(-1)


def test_the_furniture_that_judges_is_known_in_a_folder_too(tmp_path: Path) -> None:
    assert len(list(write_dataset(DatasetPlan(VALIDATION_SEED, 1, points=4), tmp_path))) == 1
    source = source_in(tmp_path, 1, 4)
    assert source.maker_seed == VALIDATION_SEED
    with pytest.raises(ValueError, match="judges the weights"):
        validation_source(source, 4)
    (tmp_path / MANIFEST).unlink()
    assert source.maker_seed is None
