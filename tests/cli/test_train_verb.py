"""`train` through the real command: a run goes on where it was cut, its weights are exported, errors are one line."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from grafu.cli import train
from grafu.cli.main import main
from grafu.training import workers
from grafu.training.config import CONFIGS

TINY = ["train", "--config", "tiny", "--threads", "1", "--jobs", "1"]

pytestmark = pytest.mark.usefixtures("remembered")


@pytest.fixture(scope="module")
def trained(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("runs") / "tiny"
    assert main([*TINY, "--out", str(folder), "--steps", "2"]) == 0
    return folder


def test_the_names_of_configs_are_those_that_there_are() -> None:
    assert set(train.CONFIGS) == set(CONFIGS)


def test_a_run_says_how_it_goes_and_goes_on(trained: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*TINY, "--out", str(trained), "--steps", "3", "--resume"]) == 0
    begun, judged, done = capsys.readouterr().out.splitlines()
    assert begun.startswith("training `tiny` on furniture made with seed 1: from step 2 on, 3 steps of 4 graphs")
    assert judged.startswith("step 3: score 0.")
    assert done.startswith("3 steps done, best score 0.")


def test_a_run_is_not_begun_twice(trained: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*TINY, "--out", str(trained)]) == 2
    assert "--resume" in capsys.readouterr().err


def test_the_best_weights_become_one_file(
    trained: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(train, "exported", lambda network, features: f"weights of {network.config.hidden}".encode())
    target = tmp_path / "new" / "grafu.onnx"
    assert main(["train", "--out", str(trained), "--export", str(target)]) == 0
    assert target.read_bytes() == b"weights of 32"
    assert [path.name for path in target.parent.iterdir()] == ["grafu.onnx"]
    said = capsys.readouterr().out
    assert f"written to {target}" in said
    assert "temperatures: category " in said


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--export", "x.onnx"], "train first"),
        (["--data", "nowhere"], "is no folder"),
        (["--seed", "990001"], "judges the weights"),
    ],
)
def test_errors_are_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], said: str
) -> None:
    assert main([*TINY, "--out", str(tmp_path / "run"), *arguments]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1


def test_furniture_in_a_folder_that_judges_the_weights_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    data = tmp_path / "data"
    assert main(["synth", "--count", "1", "--seed", "990002", "--points", "4", "--jobs", "1", "--out", str(data)]) == 0
    capsys.readouterr()
    assert main([*TINY, "--out", str(tmp_path / "run"), "--data", str(data)]) == 2
    error = capsys.readouterr().err
    assert "made with seed 990002, it judges the weights" in error
    assert error.count("\n") == 1
    assert not (tmp_path / "run").exists()


def test_a_device_that_is_not_there_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(workers, "has_device", lambda name: name != "cuda")
    assert main([*TINY, "--out", str(tmp_path), "--device", "cuda"]) == 2
    assert "`--device`" in capsys.readouterr().err


def test_a_stopped_run_can_go_on(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "grafu.cli.main", *TINY, "--steps", "100000", "--out", str(tmp_path / "run")]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None
    assert process.stdout.readline().startswith("training")
    os.kill(process.pid, signal.SIGTERM)
    _, error = process.communicate(timeout=240)
    assert process.returncode == 143
    assert "--resume goes on" in error
    assert (tmp_path / "run" / "last.pt").is_file()
