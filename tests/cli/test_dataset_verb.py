"""`grafu dataset`: what it prints and returns; what is in a set is tested in tests/dataset."""

import json
import shutil
from collections.abc import Iterator
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

import pytest

from grafu.cli.dataset import byte_count
from grafu.cli.main import main
from grafu.dataset import load_dataset


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    from small_assets import write_glb

    folder = tmp_path_factory.mktemp("run")
    source = write_glb(folder / "cabinet.glb")
    arguments = ["--motion", "rule", "--formats", "glb", "--no-page", "--quiet", "--out", str(folder / "out")]
    assert main(["functionalize", str(source), *arguments]) == 0
    shutil.copytree(folder / "out" / "cabinet", folder / "out" / "copy")
    return folder / "out"


def test_a_set_is_written_and_summed_up(results: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["dataset", str(results), "--out", str(tmp_path / "set")]) == 0

    said = capsys.readouterr()
    assert "split" in said.out
    assert f"written to {tmp_path / 'set'}" in said.out
    assert said.err == ""
    assert [sample.name for sample in load_dataset(tmp_path / "set")] != []


def test_each_model_is_a_line_of_json(results: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "broken").mkdir()
    (tmp_path / "broken" / "report.json").write_text("{}")
    given = [str(results), str(tmp_path / "broken")]
    assert main(["dataset", *given, "--json", "--out", str(tmp_path / "set")]) == 1

    said = capsys.readouterr()
    lines = {line["name"]: line for line in map(json.loads, said.out.splitlines())}
    assert lines.keys() == {"broken", "cabinet", "copy"}
    assert lines["broken"]["error"] in said.err
    assert said.err.count("\n") == 1
    assert lines["broken"]["split"] is None
    assert lines["cabinet"]["group"] == lines["copy"]["group"]
    assert lines["copy"]["shard"].endswith("-000000.tar")
    assert (lines["copy"]["verdict"], lines["copy"]["group_size"]) in {("green", 2), ("yellow", 2)}


def test_what_cannot_be_read_is_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["dataset", str(tmp_path / "gone"), "--out", str(tmp_path / "set")]) == 2
    said = capsys.readouterr().err

    assert said.startswith(f"grafu: {tmp_path / 'gone'}: a result is a folder")
    assert said.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_of_several_that_cannot_be_read_each_has_a_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    given = [str(tmp_path / name) for name in ("gone", "lost")]
    assert main(["dataset", *given, "--out", str(tmp_path / "set"), "--quiet"]) == 2

    lines = capsys.readouterr().err.splitlines()
    assert [("gone" in line, "lost" in line) for line in lines] == [(True, False), (False, True), (False, False)]
    assert "no result of 2" in lines[2]


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_any_number_of_processes_writes_the_same(jobs: str, results: Path, tmp_path: Path) -> None:
    assert main(["dataset", str(results), "--jobs", jobs, "--quiet", "--out", str(tmp_path / "set")]) == 0
    assert main(["dataset", str(results), "--quiet", "--out", str(tmp_path / "again" / "set")]) == 0

    assert (tmp_path / "set" / "index.jsonl").read_bytes() == (tmp_path / "again" / "set" / "index.jsonl").read_bytes()


def test_without_pyarrow_a_line_states_how_to_get_it(
    results: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)

    assert main(["dataset", str(results / "cabinet"), "--out", str(tmp_path / "set")]) == 0
    assert "pip install 'grafu[dataset]'" in capsys.readouterr().out


@pytest.mark.parametrize(
    "wrong",
    [
        ["--split", "80/20"],
        ["--split", "80/10/20"],
        ["--split", "most/some/few"],
        ["--shard-size", "0"],
        ["--shard-size", "large"],
        ["--shard-size", "500 MBit"],
        ["--seed", "-1"],
        ["--only", "red"],
        ["--format", "zip"],
        ["--jobs", "0"],
    ],
)
def test_wrong_options_are_one_line(wrong: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["dataset", str(tmp_path), "--out", str(tmp_path / "set"), *wrong])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert wrong[0] in said


def test_a_license_that_would_break_the_card_is_refused(
    results: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["dataset", str(results), "--out", str(tmp_path / "set"), "--license", "my own"]) == 2
    assert "cc-by-4.0" in capsys.readouterr().err
    assert not (tmp_path / "set").exists()


def test_sizes_take_units() -> None:
    assert [byte_count(text) for text in ("1000", "500MB", "2 GiB", "1.5kb")] == [1000, 500_000_000, 2**31, 1500]


def test_a_process_that_dies_is_one_line(
    results: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("grafu.dataset.write.ordered_map", died)

    assert main(["dataset", str(results), "--out", str(tmp_path / "set"), "--jobs", "2"]) == 1
    assert "try fewer --jobs" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def died(*_: object) -> Iterator[None]:
    yield from ()
    raise BrokenProcessPool
