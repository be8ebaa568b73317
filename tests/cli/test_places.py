"""Attacks on what lies where results go: inputs, notes and other people's folders stay, whatever is asked."""

import os
import shutil
from pathlib import Path

import pytest
from obj_inputs import CABINET, obj_text, write_cabinet

from folders import contents
from grafu.asset.load import load_asset
from grafu.cli.main import main


@pytest.fixture
def models(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder `models` with a model in a folder of its own, and notes in it; it is the working folder."""
    folder = tmp_path / "models"
    write_cabinet(folder / "cab", "cab")
    (folder / "cab" / "notes.txt").write_text("mine")
    monkeypatch.chdir(folder)
    return folder


@pytest.mark.parametrize(
    "arguments",
    [
        ["cab", "--out", "."],
        ["cab", "--out", "../models"],
        ["cab/cab.obj", "--out", "."],
        ["cab", "cab/cab.obj", "--out", "."],
        ["../models/cab/", "--out", "../link"],
        ["../link/cab/cab.obj", "--out", "."],
    ],
)
@pytest.mark.parametrize("again", ["--overwrite", "--resume", "--no-page"])
def test_an_input_is_never_replaced(
    models: Path, arguments: list[str], again: str, capsys: pytest.CaptureFixture[str]
) -> None:
    os.symlink(models, models.parent / "link")
    before = contents(models)

    assert main(["functionalize", *arguments, again]) != 0
    said = capsys.readouterr().err
    assert "choose another --out" in said or "different names" in said
    assert contents(models) == before


def test_an_input_that_would_be_replaced_is_not_read(models: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (models / "cab" / "cab.obj").write_text("damaged")

    assert main(["functionalize", "cab", "--out", ".", "--overwrite"]) == 2
    assert "so replace the input" in capsys.readouterr().err


def test_a_marker_in_an_input_changes_nothing(models: Path) -> None:
    (models / "cab" / ".grafu.json").write_text('{"schema": "grafu.output/1", "files": ["cab.obj"], "formats": {}}')
    before = contents(models)

    assert main(["functionalize", "cab", "--out", ".", "--overwrite"]) == 2
    assert contents(models) == before


@pytest.mark.parametrize("name", ["...glb", "..glb", "con.obj", "a .obj", "b?.obj"])
def test_a_name_that_leads_elsewhere_writes_nothing(
    models: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copy("cab/cab.obj", name)
    before = contents(models.parent)

    assert main(["functionalize", name, "--out", "../out/deep", "--overwrite"]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert contents(models.parent) == before
    assert not Path("../out").exists()


def test_a_bad_name_or_place_does_not_stop_the_others(models: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copy("cab/cab.obj", "nul.obj")
    shutil.copy("cab/cab.obj", "good.obj")

    assert main(["functionalize", "nul.obj", "cab", "good.obj", "--out", ".", "--formats", "urdf", "--no-page"]) == 1
    said = capsys.readouterr().err
    assert "nul.obj" in said
    assert "replace the input" in said
    assert Path("good/model.urdf").is_file()


def test_notes_outlive_a_second_run_and_results_are_no_inputs(models: Path) -> None:
    arguments = ["functionalize", "cab", "--out", "cab", "--formats", "glb,urdf", "--no-page"]
    first = load_asset(Path("cab"))
    assert main(arguments) == 0
    Path("cab/cab/mine.txt").write_text("mine")
    assert main([*arguments, "--overwrite"]) == 0

    assert Path("cab/cab/mine.txt").read_text() == "mine"
    again = load_asset(Path("cab"))
    assert (again.kind, [part.id for part in again.parts]) == (first.kind, [part.id for part in first.parts])


def test_a_folder_of_meshes_is_read_beside_its_results(models: Path) -> None:
    boards = models / "boards"
    boards.mkdir()
    for name, box in CABINET.items():
        (boards / f"{name}.obj").write_text(obj_text([(name, box)]))
    arguments = ["functionalize", "boards", "--out", "boards", "--formats", "urdf", "--no-page"]

    assert main(arguments) == 0
    assert load_asset(boards).kind == "mesh folder"
    assert main([*arguments, "--overwrite"]) == 0
