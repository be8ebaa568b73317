"""A data set on disk: it goes on where it was stopped, to the same bytes, and never mixes with another."""

import json
from itertools import islice
from pathlib import Path

import pytest

from folders import contents
from grafu.data import write_plan
from grafu.data.stream import stream_shards
from grafu.data.write import models_written, write_dataset
from grafu.data.write_plan import MANIFEST, DatasetPlan
from grafu.errors import ExportError, UnreadableAsset
from spoiled_files import DAMAGED, SPOILS

PLAN = DatasetPlan(seed=2, count=14, points=16, models_per_shard=4)

pytestmark = pytest.mark.usefixtures("remembered")


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The files of a run that nothing stopped."""
    folder = tmp_path_factory.mktemp("whole")
    assert len(list(write_dataset(PLAN, folder))) == 14
    return contents(folder)


def test_files_hold_so_many_models_each(whole: dict[str, bytes]) -> None:
    assert list(whole) == [MANIFEST, *(f"shard_{k:06d}.npz" for k in range(4))]


def test_two_processes_write_the_same_bytes(whole: dict[str, bytes], tmp_path: Path) -> None:
    summaries = list(write_dataset(PLAN, tmp_path, jobs=2))
    assert contents(tmp_path) == whole
    assert [s.model_id for s in summaries] == [r.model_id for r in stream_shards(tmp_path)]


@pytest.mark.parametrize(("stopped", "jobs"), [(0, 1), (3, 1), (4, 1), (9, 1), (9, 2)])
def test_a_stopped_run_goes_on(whole: dict[str, bytes], tmp_path: Path, stopped: int, jobs: int) -> None:
    run = write_dataset(PLAN, tmp_path, jobs)
    list(islice(run, stopped))
    run.close()  # type: ignore[attr-defined]
    kept = models_written(tmp_path)
    assert set(contents(tmp_path).items()) <= set(whole.items())

    summaries = list(write_dataset(PLAN, tmp_path, jobs))

    assert [s.fresh for s in summaries] == [False] * kept + [True] * (14 - kept)
    assert contents(tmp_path) == whole


def test_a_data_set_can_grow(whole: dict[str, bytes], tmp_path: Path) -> None:
    for count in (3, 4, 9, 14):
        list(write_dataset(DatasetPlan(2, count, 16, 4), tmp_path))
    assert contents(tmp_path) == whole
    assert not any(s.fresh for s in write_dataset(DatasetPlan(2, 5, 16, 4), tmp_path))


def test_what_a_killed_run_left_is_cleared(whole: dict[str, bytes], tmp_path: Path) -> None:
    list(write_dataset(PLAN, tmp_path))
    (tmp_path / ".shard_000001.npz.0a1b2c3d.new").write_bytes(b"half")
    list(write_dataset(PLAN, tmp_path))
    assert contents(tmp_path) == whole


@pytest.mark.parametrize(
    ("plan", "said"),
    [
        (DatasetPlan(3, 14, 16, 4), "was made with 2 as its seed, not 3"),
        (DatasetPlan(2, 14, 17, 4), "was made with 16 as its points for each part, not 17"),
        (DatasetPlan(2, 14, 16, 9), "was made with 4 as its models in each shard, not 9"),
    ],
)
def test_another_data_set_is_refused(tmp_path: Path, plan: DatasetPlan, said: str) -> None:
    list(write_dataset(DatasetPlan(2, 1, 16, 4), tmp_path))
    before = contents(tmp_path)
    with pytest.raises(ExportError, match=f"{said}: choose another --out, or give --overwrite"):
        list(write_dataset(plan, tmp_path))
    assert contents(tmp_path) == before


def test_another_generator_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    list(write_dataset(DatasetPlan(2, 1, 16, 4), tmp_path))
    manifest = json.loads((tmp_path / MANIFEST).read_text())
    (tmp_path / MANIFEST).write_text(json.dumps(manifest | {"first_model": "another"}))
    with pytest.raises(ExportError, match="a generator that makes other models"):
        list(write_dataset(PLAN, tmp_path))
    monkeypatch.setattr(write_plan, "__version__", "99")
    with pytest.raises(ExportError, match=r"made with grafu .*, and this is 99"):
        list(write_dataset(PLAN, tmp_path))


@pytest.mark.parametrize("what", [*SPOILS, *DAMAGED])
def test_a_manifest_that_cannot_be_read_is_refused_in_one_line(tmp_path: Path, what: str) -> None:
    list(write_dataset(DatasetPlan(2, 1, 16, 4), tmp_path / "set"))
    path = tmp_path / "set" / MANIFEST
    SPOILS[what](path) if what in SPOILS else path.write_bytes(DAMAGED[what])
    with pytest.raises(ExportError, match=r"choose another --out|holds") as error:
        list(write_dataset(PLAN, tmp_path / "set"))
    assert "\n" not in str(error.value)


def test_overwrite_starts_again(whole: dict[str, bytes], tmp_path: Path) -> None:
    list(write_dataset(DatasetPlan(9, 17, 16, 4), tmp_path))
    assert all(s.fresh for s in write_dataset(PLAN, tmp_path, overwrite=True))
    assert contents(tmp_path) == whole


def test_a_folder_with_other_things_is_kept(tmp_path: Path) -> None:
    (tmp_path / "diary.txt").write_text("mine")
    with pytest.raises(ExportError, match=r"holds `diary\.txt` and no data set"):
        list(write_dataset(PLAN, tmp_path, overwrite=True))
    assert contents(tmp_path) == {"diary.txt": b"mine"}


def test_a_damaged_data_set_is_refused(tmp_path: Path) -> None:
    list(write_dataset(PLAN, tmp_path))
    shard = tmp_path / "shard_000001.npz"
    shard.write_bytes(shard.read_bytes()[:500])
    with pytest.raises(UnreadableAsset, match=r"shard_000001\.npz` is no whole file"):
        list(write_dataset(PLAN, tmp_path))
    for text, said in (("{}", "must be of the form"), ("no json", "is not JSON")):
        (tmp_path / MANIFEST).write_text(text)
        with pytest.raises(ExportError, match=said):
            list(write_dataset(PLAN, tmp_path))


def test_a_file_in_the_way_is_one_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine")
    for path in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(ExportError, match="cannot write the output"):
            list(write_dataset(PLAN, path))


def test_impossible_plans_are_refused() -> None:
    with pytest.raises(ExportError, match="at least 0"):
        DatasetPlan(seed=-1, count=1)
    with pytest.raises(ExportError, match="a model"):
        DatasetPlan(seed=0, count=0)
