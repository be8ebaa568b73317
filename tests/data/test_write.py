"""Synthetic models laid out like the authors' release: it reads back, goes on where it was stopped, and never mixes."""

from itertools import islice
from pathlib import Path

import pytest

from folders import contents
from grafu.data.furfun.folder import FurFunFolder
from grafu.data.furfun.layout import FUNCTIONAL, SPLITS, UNFUNCTIONAL
from grafu.data.stream import stream_synth
from grafu.data.write import models_written, write_dataset
from grafu.data.write_plan import DatasetPlan
from grafu.errors import ExportError

PLAN = DatasetPlan(seed=2, count=12, points=16, format="furfun")

pytestmark = pytest.mark.usefixtures("remembered")


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The files of a run that nothing stopped, by one process."""
    folder = tmp_path_factory.mktemp("whole")
    assert len(list(write_dataset(PLAN, folder))) == 12
    return contents(folder)


def test_what_is_written_reads_back(tmp_path: Path) -> None:
    list(write_dataset(PLAN, tmp_path))
    release = FurFunFolder(tmp_path, points=16, keep_disconnected=True)
    for record in stream_synth(2, points=16, stop=12):
        graph = release.pair(record.model_id).target
        assert [(n.id, n.label) for n in graph.nodes] == [(n.id, n.label) for n in record.truth.nodes]
    split = release.split("full_split")
    assert [len(ids) for ids in (split.train, split.val, split.test)] == [10, 1, 1]


@pytest.mark.parametrize(("stopped", "jobs"), [(0, 1), (5, 1), (9, 2)])
def test_a_stopped_run_goes_on(whole: dict[str, bytes], tmp_path: Path, stopped: int, jobs: int) -> None:
    run = write_dataset(PLAN, tmp_path, jobs)
    list(islice(run, stopped))
    run.close()  # type: ignore[attr-defined]
    assert models_written(tmp_path) == stopped
    assert not (tmp_path / SPLITS).exists()

    assert len(list(write_dataset(PLAN, tmp_path, jobs))) == 12 - stopped
    assert contents(tmp_path) == whole
    assert list(write_dataset(PLAN, tmp_path)) == []


def test_half_a_model_is_written_again(whole: dict[str, bytes], tmp_path: Path) -> None:
    list(write_dataset(DatasetPlan(2, 5, 16, format="furfun"), tmp_path))
    half = tmp_path / FUNCTIONAL / f"{sorted((tmp_path / UNFUNCTIONAL).iterdir())[-1].name[:-1]}5"
    half.mkdir()
    (half / "half.json").write_text("half")
    (tmp_path / ".model.0a1b2c3d.new" / FUNCTIONAL).mkdir(parents=True)
    list(write_dataset(PLAN, tmp_path))
    assert contents(tmp_path) == whole
    assert not list(tmp_path.glob(".model.*"))


def test_formats_do_not_mix(tmp_path: Path) -> None:
    list(write_dataset(DatasetPlan(2, 1, 16), tmp_path))
    with pytest.raises(ExportError, match="was made with shards as its format, not furfun"):
        list(write_dataset(PLAN, tmp_path))


def test_overwrite_starts_again(whole: dict[str, bytes], tmp_path: Path) -> None:
    list(write_dataset(DatasetPlan(9, 14, 16, format="furfun"), tmp_path))
    list(write_dataset(DatasetPlan(9, 4, 16), tmp_path, overwrite=True))
    list(write_dataset(PLAN, tmp_path, overwrite=True))
    assert contents(tmp_path) == whole


def test_what_others_put_into_a_data_set_stays(whole: dict[str, bytes], tmp_path: Path) -> None:
    list(write_dataset(DatasetPlan(9, 2, 16, format="furfun"), tmp_path))
    model = next((tmp_path / UNFUNCTIONAL).iterdir()).name
    mine = {f"{UNFUNCTIONAL}/{model}/notes.txt", f"{FUNCTIONAL}/mine/notes.txt", f"{SPLITS}/mine.json", "notes.txt"}
    for name in mine:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(b"mine")
    (tmp_path / UNFUNCTIONAL / model / "notes.txt").rename(tmp_path / FUNCTIONAL / model / "notes.txt")
    mine = mine - {f"{UNFUNCTIONAL}/{model}/notes.txt"} | {f"{FUNCTIONAL}/{model}/notes.txt"}

    list(write_dataset(PLAN, tmp_path, overwrite=True))
    assert contents(tmp_path) == whole | dict.fromkeys(mine, b"mine")


def test_a_data_set_of_others_is_never_removed(tmp_path: Path) -> None:
    (tmp_path / SPLITS).mkdir()
    (tmp_path / SPLITS / "full_split.json").write_text("mine")
    (tmp_path / "dataset.json").write_text('{"name": "mine"}')
    before = contents(tmp_path)

    with pytest.raises(ExportError, match="choose another --out"):
        list(write_dataset(PLAN, tmp_path, overwrite=True))
    assert contents(tmp_path) == before
