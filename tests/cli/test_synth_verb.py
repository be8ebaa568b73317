"""`synth` through the real command: data sets that go on after an interruption, pictures, statistics, plain errors."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest

from folders import contents
from grafu.cli.main import main
from grafu.data import write
from grafu.data.write import models_written

FEW = ["synth", "--points", "8", "--models-per-shard", "4"]

pytestmark = pytest.mark.usefixtures("remembered")


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The files of a run of 12 models that nothing stopped."""
    folder = tmp_path_factory.mktemp("runs") / "whole"
    assert main([*FEW, "--count", "12", "--jobs", "1", "--out", str(folder)]) == 0
    return contents(folder)


def test_jobs_change_no_byte(whole: dict[str, bytes], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*FEW, "--count", "12", "--jobs", "2", "--out", str(tmp_path)]) == 0
    assert contents(tmp_path) == whole
    said = capsys.readouterr().out
    assert "12 models" in said
    assert "12 made in" in said
    assert f"written to {tmp_path}" in said


def test_an_interrupted_run_says_how_to_go_on(
    whole: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupted(items: Iterable[object], total: int, word: str) -> Iterator[object]:
        for place, item in enumerate(items):
            if place == 7:
                raise KeyboardInterrupt
            yield item

    command = [*FEW, "--count", "12", "--jobs", "1", "--out", str(tmp_path)]
    with monkeypatch.context() as patch:
        patch.setattr("grafu.cli.item_bar.with_progress", interrupted)
        assert main(command) == 130
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "4 models stand in whole files" in said

    assert main(command) == 0
    assert "8 made in" in (again := capsys.readouterr().out)
    assert "4 were there before" in again
    assert contents(tmp_path) == whole
    assert main(command) == 0
    assert "nothing to make: 12 models are there" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("awaited", "sent", "code"),
    [
        ("dataset.json", signal.SIGINT, 130),
        ("shard_000000.npz", signal.SIGINT, 130),
        ("shard_000000.npz", signal.SIGKILL, -9),
    ],
)
def test_a_killed_run_goes_on(
    whole: dict[str, bytes], tmp_path: Path, awaited: str, sent: signal.Signals, code: int
) -> None:
    """As a terminal does it: the signal reaches the workers too (but none can be sent to them when the parent dies)."""
    folder = tmp_path / "data"
    command = [sys.executable, "-m", "grafu.cli.main", *FEW, "--count", "3000", "--jobs", "2", "--out", str(folder)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
    while process.poll() is None and not (folder / awaited).exists():
        time.sleep(0.01)
    time.sleep(0.1)  # of those killed early, the workers are being started
    os.killpg(process.pid, sent) if sent is signal.SIGINT else process.kill()
    _, said = process.communicate(timeout=60)  # the workers hold the pipes: this ends when they do
    assert process.returncode == code
    assert b"Traceback" not in said
    assert sent is signal.SIGKILL or said.count(b"\n") == 1

    kept = models_written(folder)
    assert kept % 4 == 0
    assert kept or awaited == "dataset.json"
    assert main([*FEW, "--count", str(max(kept, 12)), "--jobs", "1", "--out", str(folder)]) == 0
    assert whole.items() <= contents(folder).items()


def test_another_seed_is_refused_in_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    command = [*FEW, "--count", "2", "--jobs", "1", "--out", str(tmp_path)]
    assert main(command) == 0
    assert main([*command, "--seed", "1"]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "was made with 0 as its seed, not 1" in said
    assert main([*command, "--seed", "1", "--overwrite"]) == 0


def test_faults_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    command = [*FEW, "--count", "2", "--jobs", "1", "--out", str(tmp_path)]
    monkeypatch.setattr(write, "faults_said", lambda specimen: ("collision of door, shelf",))
    assert main(command) == 0
    assert "faults beyond" not in capsys.readouterr().out
    assert main([*command, "--check", "--overwrite"]) == 1
    said = capsys.readouterr().out
    assert "faulty: synth_0_0000001: collision of door, shelf" in said
    assert "2 models have faults beyond their defects" in said


def test_furfun_folders_are_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    command = ["synth", "--points", "8", "--count", "3", "--format", "furfun", "--jobs", "1", "--out", str(tmp_path)]
    assert main(command) == 0
    assert {p.name for p in tmp_path.iterdir()} == {
        "dataset.json",
        "graphs_functional",
        "graphs_unfunctional",
        "part_geometries",
        "splits",
    }
    assert main(command) == 0
    assert "nothing to make: 3 models are there" in capsys.readouterr().out


def test_a_gallery_is_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    command = ["synth", "--gallery", "--points", "8", "--count", "2", "--jobs", "1", "--out", str(tmp_path)]
    assert main(command) == 0
    assert {p.name for p in tmp_path.iterdir()} == {".grafu.json", "gallery.html", "gallery.png"}
    assert main(command) == 2
    assert "exists already" in capsys.readouterr().err
    assert main([*command, "--overwrite"]) == 0


def test_statistics_are_printed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    command = ["synth", "--points", "8", "--count", "3", "--jobs", "1", "--stats"]
    assert main(command) == 0
    assert "3 synthetic models" in capsys.readouterr().out
    (tmp_path / "broken.glb").write_bytes(b"no model")
    assert main([*command, str(tmp_path)]) == 0
    assert "not read: broken.glb" in capsys.readouterr().out
    assert main([*command, str(tmp_path / "nowhere")]) == 2


@pytest.mark.parametrize("more", [[], ["--gallery"]])
def test_without_a_folder_it_is_one_line(more: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["synth", "--count", "1", *more]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "give --out DIR" in said
