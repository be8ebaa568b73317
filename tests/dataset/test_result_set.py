"""A set from results: what is in it, that it is whole or not there, and that its splits hold when it grows."""

import json
import os
import shutil
import tarfile
from itertools import pairwise
from pathlib import Path

import pytest

from folders import contents
from grafu.dataset import load_dataset
from grafu.dataset.figures import COLUMNS
from grafu.dataset.splits import SplitRatio
from grafu.dataset.write import ResultSetPlan, write_result_set
from grafu.errors import ExportError, OptionError, UnreadableAsset

PLAN = ResultSetPlan()
TRAIN = SplitRatio((100.0, 0.0, 0.0))


def written(given: list[Path], out: Path, plan: ResultSetPlan = PLAN, overwrite: bool = False) -> dict[str, dict]:
    """Writes a set and returns the rows of its index by name, which are those that were yielded."""
    outcomes = list(write_result_set(given, out, plan, overwrite))
    rows = [json.loads(line) for line in (out / "index.jsonl").read_text().splitlines()]
    assert [outcome.row for outcome in outcomes if outcome.row] == rows
    return {row["name"]: row for row in rows}


@pytest.fixture(scope="session")
def shards(results: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("sets") / "shards"
    written([results], out)
    return out


@pytest.fixture
def copied(results: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(results, tmp_path / "results"))


def test_a_row_states_what_the_report_does(results: Path, shards: Path) -> None:
    rows = [json.loads(line) for line in (shards / "index.jsonl").read_text().splitlines()]
    row = next(row for row in rows if row["name"] == "cabinet")
    report = json.loads((results / "cabinet" / "report.json").read_text())

    assert list(row) == [column.name for column in COLUMNS]
    assert row["verdict"] == report["verdict"]["colour"]
    assert (row["parts"], row["joints"]) == (len(report["parts"]), len(report["joints"]))
    assert (row["revolute"], row["prismatic"], row["continuous"]) == (1, 1, 0)
    stated = {j["id"]: (j["part"], j["type"], j["lower"], j["upper"]) for j in report["joints"]}
    assert {m["joint"]: (m["part"], m["type"], m["lower"], m["upper"]) for m in row["motions"]} == stated
    assert row["size"] == report["size"]
    assert row["mass"] == report["base"]["stability"]["mass"]
    assert row["formats"] == ["glb", "urdf"]
    assert row["bytes"] == sum((results / "cabinet" / name).stat().st_size for name in row["files"])


def test_copies_are_one_group_and_another_piece_is_not(shards: Path) -> None:
    rows = {row["name"]: row for row in map(json.loads, (shards / "index.jsonl").read_text().splitlines())}

    assert len({rows[name]["group"] for name in ("cabinet", "mirrored", "larger")}) == 1
    assert rows["cabinet"]["group_size"] == 3
    assert rows["chest"]["group"] != rows["cabinet"]["group"]
    assert len({rows[name]["split"] for name in ("cabinet", "mirrored", "larger")}) == 1


def test_the_files_of_a_sample_stand_together_under_its_key(shards: Path) -> None:
    held = {}
    for path in shards.glob("*.tar"):
        with tarfile.open(path) as shard:
            names = shard.getnames()
            held |= {name.partition(".")[0]: name for name in names}
            assert all(member.mtime == 0 and member.uid == 0 for member in shard)
        keys = [name.partition(".")[0] for name in names]
        assert len(set(keys)) == 1 + sum(a != b for a, b in pairwise(keys))
    assert set(held) == {"cabinet", "mirrored", "larger", "chest"}


def test_the_same_results_give_the_same_bytes(results: Path, shards: Path, tmp_path: Path) -> None:
    given = [results / name for name in ("chest", "larger", "cabinet", "mirrored")]
    again = tmp_path / shards.name
    written(given, again)

    same = {name: data for name, data in contents(again).items() if name != "index.parquet"}
    assert same == {name: data for name, data in contents(shards).items() if name != "index.parquet"}


def test_folders_hold_results_as_they_were(results: Path, tmp_path: Path) -> None:
    rows = written([results], tmp_path / "set", ResultSetPlan(format="folder"))

    for name, row in rows.items():
        assert contents(tmp_path / "set" / row["shard"]) == contents(results / name)
    again = written([tmp_path / "set" / split for split in {row["split"] for row in rows.values()}], tmp_path / "again")
    assert {name: row["group"] for name, row in again.items()} == {name: row["group"] for name, row in rows.items()}


def test_more_results_move_no_model(results: Path, tmp_path: Path) -> None:
    ratio = SplitRatio((34.0, 33.0, 33.0))
    for seed in range(4):
        few = written([results / "chest"], tmp_path / f"few_{seed}", ResultSetPlan(seed=seed, ratio=ratio))
        all_rows = written([results], tmp_path / f"all_{seed}", ResultSetPlan(seed=seed, ratio=ratio))
        assert all_rows["chest"]["split"] == few["chest"]["split"]


def test_an_earlier_set_states_the_splits(results: Path, tmp_path: Path) -> None:
    every = ResultSetPlan(ratio=SplitRatio((0.0, 0.0, 100.0)))
    written([results / "cabinet"], tmp_path / "set", every)
    rows = written([results], tmp_path / "set", ResultSetPlan(like=tmp_path / "set", ratio=TRAIN), overwrite=True)

    assert {name: row["split"] for name, row in rows.items()} == {
        **dict.fromkeys(("cabinet", "mirrored", "larger"), "test"),
        "chest": "train",
    }


@pytest.mark.parametrize("data", [None, b"{", b"[]", b'{"name": "a", "split": "all"}', b'{"split": "test"}'])
def test_what_is_no_earlier_set_is_refused(data: bytes | None, results: Path, tmp_path: Path) -> None:
    (tmp_path / "earlier").mkdir()
    if data is not None:
        (tmp_path / "earlier" / "index.jsonl").write_bytes(data)

    with pytest.raises(UnreadableAsset, match="the index of a set"):
        list(write_result_set([results], tmp_path / "set", ResultSetPlan(like=tmp_path / "earlier")))
    assert not (tmp_path / "set").exists()


def test_shards_stay_below_their_size_unless_one_model_is_larger(results: Path, tmp_path: Path) -> None:
    rows = written([results], tmp_path / "small", ResultSetPlan(ratio=TRAIN, shard_bytes=1))
    assert sorted(row["shard"] for row in rows.values()) == [f"train-{k:06d}.tar" for k in range(4)]

    most = sum(row["bytes"] for row in rows.values()) // 2 + 200_000
    rows = written([results], tmp_path / "two", ResultSetPlan(ratio=TRAIN, shard_bytes=most))
    assert 1 < len({row["shard"] for row in rows.values()}) < 4
    assert all(path.stat().st_size <= most for path in (tmp_path / "two").glob("*.tar"))


def test_the_table_is_the_index(shards: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")

    rows = parquet.read_table(shards / "index.parquet").to_pylist()
    assert rows == [json.loads(line) for line in (shards / "index.jsonl").read_text().splitlines()]


def test_without_pyarrow_the_rows_are_there_all_the_same(
    results: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)

    assert written([results / "chest"], tmp_path / "set").keys() == {"chest"}
    assert not (tmp_path / "set" / "index.parquet").exists()


def test_the_card_names_the_files_of_each_split_and_the_licence(results: Path, tmp_path: Path) -> None:
    rows = written([results], tmp_path / "set", ResultSetPlan(license="cc-by-4.0"))
    text = (tmp_path / "set" / "README.md").read_text()
    header, body = text.removeprefix("---\n").split("\n---\n")

    assert header.startswith("license: cc-by-4.0\n")
    assert "- n<1K" in header
    for split in {row["split"] for row in rows.values()}:
        assert f"  - split: {split}\n    path: {split}-*.tar" in header
        count = sum(row["split"] == split for row in rows.values())
        assert f"| {split} | {count} |" in body
    assert all(f"- name: {column.name}\n" in header for column in COLUMNS)
    assert "cc-by-4.0" in body


def test_the_header_of_a_card_is_yaml(shards: Path) -> None:
    yaml = pytest.importorskip("yaml")

    header = yaml.safe_load((shards / "README.md").read_text().split("---\n")[1])
    assert header["configs"][0]["config_name"] == "default"
    features = {feature["name"]: feature for feature in header["dataset_info"]["features"]}
    assert features["model.glb"] == {"name": "model.glb", "dtype": "binary"}
    assert [figure["name"] for figure in features["json"]["struct"]] == [column.name for column in COLUMNS]


DAMAGES = {
    "model.glb` is missing|`model.glb`": lambda folder: (folder / "model.glb").unlink(),
    "is no report of grafu": lambda folder: (folder / "report.json").write_text("{}"),
    "`report.json`": lambda folder: (folder / "report.json").unlink(),
    "different runs": lambda folder: shutil.copyfile(folder.parent / "chest" / "model.glb", folder / "model.glb"),
    "is damaged": lambda folder: (folder / ".grafu.json").write_text("[]"),
    "by which grafu knows": lambda folder: (folder / ".grafu.json").unlink(),
    "GLB": lambda folder: (folder / "model.glb").write_bytes(b"glTF"),
}


@pytest.mark.parametrize("why", DAMAGES)
def test_a_damaged_result_is_left_out_with_a_line(why: str, copied: Path, tmp_path: Path) -> None:
    DAMAGES[why](copied / "larger")
    outcomes = list(write_result_set([copied], tmp_path / "set", PLAN))

    (wrong,) = [outcome for outcome in outcomes if outcome.error]
    assert str(copied / "larger") in wrong.error
    assert any(words in wrong.error for words in why.split("|"))
    assert "\n" not in wrong.error
    assert sorted(sample.name for sample in load_dataset(tmp_path / "set")) == ["cabinet", "chest", "mirrored"]


def test_a_marker_that_leads_elsewhere_is_refused(copied: Path, tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("secret")
    marker = json.loads((copied / "larger" / ".grafu.json").read_text())
    marker["files"].append("../../secret")
    (copied / "larger" / ".grafu.json").write_text(json.dumps(marker))
    outcomes = list(write_result_set([copied], tmp_path / "set", PLAN))

    assert ["plain relative path" in outcome.error for outcome in outcomes if outcome.error] == [True]


def test_two_of_one_name_are_told_apart_or_refused(copied: Path, results: Path, tmp_path: Path) -> None:
    outcomes = list(write_result_set([results / "chest", copied / "chest"], tmp_path / "set", PLAN))
    assert [("same name" in outcome.error) for outcome in outcomes if outcome.error] == [True]

    shutil.move(copied / "chest", copied / "old.v1 chest")
    rows = written([results / "chest", copied / "old.v1 chest"], tmp_path / "again")
    assert rows.keys() == {"chest", "old.v1 chest"}
    assert "." not in rows["old.v1 chest"]["key"]
    assert {sample.name for sample in load_dataset(tmp_path / "again")} == rows.keys()


def test_a_name_that_is_no_unicode_is_written_as_an_escape(results: Path, tmp_path: Path) -> None:
    folder = tmp_path / os.fsdecode(b"caf\xe9")
    try:
        shutil.copytree(results / "chest", folder)
    except OSError:
        pytest.skip("the disk takes no such name")

    rows = written([folder], tmp_path / "set")
    assert rows.keys() == {"caf\\udce9"}
    assert [sample.name for sample in load_dataset(tmp_path / "set")] == ["caf\\udce9"]


def test_verdicts_that_are_not_wanted_are_left_out(copied: Path, tmp_path: Path) -> None:
    report = json.loads((copied / "chest" / "report.json").read_text())
    report["joints"][0]["collision_share"] = 0.9
    (copied / "chest" / "report.json").write_text(json.dumps(report))
    colour = {o.folder.name: o.verdict for o in write_result_set([copied], tmp_path / "all", PLAN)}

    assert colour["chest"] == "red"
    outcomes = list(write_result_set([copied], tmp_path / "set", ResultSetPlan(only="yellow")))
    assert [(o.folder.name, o.verdict) for o in outcomes if o.row is None] == [("chest", "red")]
    assert "chest" not in {sample.name for sample in load_dataset(tmp_path / "set")}


def test_nothing_that_can_be_used_is_an_error_and_writes_nothing(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()

    with pytest.raises(UnreadableAsset, match="no result of 2"):
        list(write_result_set([tmp_path / "empty", tmp_path / "gone"], tmp_path / "set", PLAN))
    assert [path.name for path in tmp_path.iterdir()] == ["empty"]


def test_results_that_vanish_while_a_set_is_written_leave_no_set(copied: Path, tmp_path: Path) -> None:
    def watch(items, total, word):
        if word == "stored":
            shutil.rmtree(copied)
        return items

    outcomes = write_result_set([copied / "chest"], tmp_path / "set", PLAN, watch=watch)
    assert "by which grafu knows" in next(outcomes).error
    with pytest.raises(UnreadableAsset, match="while the set was written"):
        next(outcomes)
    assert list(tmp_path.iterdir()) == []


def test_an_iterator_that_is_stopped_leaves_nothing(results: Path, tmp_path: Path) -> None:
    outcomes = write_result_set([results], tmp_path / "set", PLAN)
    next(outcomes)
    outcomes.close()

    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("form", ["tar", "folder"])
def test_only_an_earlier_set_is_replaced_and_notes_in_it_stay(form, copied: Path, tmp_path: Path) -> None:
    out, plan = tmp_path / "set", ResultSetPlan(format=form)
    rows = written([copied], out, plan)
    note = (out / rows["cabinet"]["shard"] if form == "folder" else out) / "notes.txt"
    note.write_text("mine")

    with pytest.raises(ExportError, match="--overwrite"):
        written([copied], out, plan)
    assert written([copied / "chest"], out, plan, overwrite=True).keys() == {"chest"}
    assert note.read_text() == "mine"
    assert [sample.name for sample in load_dataset(out)] == ["chest"]
    assert len(list(out.rglob("model.glb"))) == (form == "folder")


def test_results_and_other_outputs_are_never_replaced(copied: Path, tmp_path: Path) -> None:
    before = contents(copied)
    for out in (copied / "chest", copied):
        with pytest.raises(ExportError):
            list(write_result_set([copied], out, PLAN, overwrite=True))
    with pytest.raises(ExportError, match="another output"):
        list(write_result_set([copied / "cabinet"], copied / "chest", PLAN, overwrite=True))

    assert contents(copied) == before


def test_a_license_is_spelled_as_there() -> None:
    with pytest.raises(OptionError, match=r"cc-by-4\.0"):
        ResultSetPlan(license="CC BY 4.0\nevil: yes")
