"""`ablate` through the real command: all experiments, their table, nothing twice, errors in one line."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from grafu.cli import ablate
from grafu.cli.main import main
from grafu.evaluation import weights_on_models
from grafu.training import ablation, ablation_run, workers
from grafu.training.ablation import KINDS

TINY = ["--config", "tiny", "--steps", "2", "--jobs", "1"]

TRIED = (0, 17)  # of the numbers of copies: each is a run, and tests/training asks for all

pytestmark = pytest.mark.usefixtures("remembered")


@pytest.fixture(scope="module", autouse=True)
def _few_folds() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ablation, "FOLDS_TRIED", TRIED)
        yield


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory, remembered: None) -> Path:
    folder = tmp_path_factory.mktemp("ablations") / "folds"
    assert main(["ablate", "folds", *TINY, "--out", str(folder)]) == 0
    return folder


def test_the_kinds_are_those_that_there_are() -> None:
    assert ablate.KINDS == KINDS


def test_every_experiment_has_its_row_and_its_folder(done: Path) -> None:
    names = [*(f"folds_{count}" for count in TRIED), "folds_endless"]
    table = (done / "table.md").read_text()
    assert table.startswith("Ablation of folds: config `tiny`, 2 steps of 4 graphs, seed 1, trained on the first 200 ")
    assert [line.split("`")[1] for line in table.splitlines() if line.startswith("| `")] == names
    assert all((done / name / "seed_1" / "figures.json").is_file() for name in names)
    assert len((done / "table.csv").read_text().splitlines()) == 1 + 4 * len(names)


def test_what_is_finished_is_not_trained_again(
    done: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.delattr(ablation_run, "train")
    assert main(["ablate", "folds", *TINY, "--out", str(done)]) == 0
    said = capsys.readouterr().out
    assert "3 runs, 3 of them finished before" in said
    assert "| `folds_17` |" in said


def test_networks_are_scored_on_annotated_models_once(
    done: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["ablate", "folds", *TINY, "--out", str(done), "--real", "synth:990002:2"]
    assert main(arguments) == 0
    said = capsys.readouterr().out
    assert "| real GT-aligned |" in said
    weights = list(done.glob("*/seed_1/weights.onnx"))
    assert len(weights) == len(TRIED) + 1
    header, first, *_ = (done / "table.csv").read_text().splitlines()
    assert header.endswith(",real/aligned")
    assert first.endswith(",")
    means = [line for line in (done / "table.csv").read_text().splitlines() if ",mean," in line]
    assert all(0.0 <= float(line.rsplit(",", 1)[1]) <= 1.0 for line in means)
    monkeypatch.delattr(weights_on_models, "aligned_ratio")
    assert main(arguments) == 0  # what was scored on the same models is not scored again
    assert capsys.readouterr().out.split("experiment")[1] == said.split("experiment")[1]


def test_a_run_that_fails_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def diverges(*_: object) -> None:
        raise ArithmeticError("no numbers")

    monkeypatch.setattr(ablation_run, "train", diverges)
    assert main(["ablate", "folds", *TINY, "--out", str(tmp_path)]) == 1
    said = capsys.readouterr().err.splitlines()
    assert len(said) == 3
    assert said[0] == "grafu: folds_0, seed 1: no numbers"


def test_a_stop_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(ablation_run, "do_runs", lambda *_: (event for event in ()))
    assert main(["ablate", "losses", *TINY, "--seeds", "1", "2", "--out", str(tmp_path)]) == 130
    assert "stopped with 0 of 34 runs finished; the same command goes on" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["losses"], "another ablation"),
        (["folds", "--steps", "3"], "another ablation"),
        (["folds", "--seeds", "1", "990002"], "judges the weights"),
        (["folds", "--data", "nowhere"], "is no folder"),
    ],
)
def test_errors_of_use_are_one_line(
    done: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], said: str
) -> None:
    assert main(["ablate", arguments[0], *TINY, "--out", str(done), *arguments[1:]]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1


def test_a_device_must_be_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(workers, "has_device", lambda name: name != "cuda")
    assert main(["ablate", "folds", "--out", str(tmp_path), "--device", "cuda"]) == 2
    assert "`--device`" in capsys.readouterr().err
