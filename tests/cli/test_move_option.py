"""`--move PART=HOW` through the real command: a wrong door is set right in one word."""

import json
from pathlib import Path

import pytest
from obj_inputs import write_cabinet

from grafu.cli.main import main


def run(folder: Path, *options: str) -> int:
    model = str(write_cabinet(folder))
    return main(["functionalize", model, "--out", str(folder / "out"), "--formats", "urdf", "--no-page", *options])


def test_parts_move_as_told_and_the_settings_say_so(tmp_path: Path) -> None:
    assert run(tmp_path, "--move", "door=right", "--move", "drawer=fixed") == 0
    result = tmp_path / "out" / "cabinet"
    joints = {joint["part"]: joint for joint in json.loads((result / "report.json").read_text())["joints"]}
    settings = json.loads((result / "settings.json").read_text())

    assert set(joints) == {"door"}
    assert joints["door"]["origin"][0] > 0.2
    assert settings["motions"]["door"]["side"] == "right"
    assert settings["motions"]["drawer"]["moves"] == "fixed"


def test_the_old_word_for_fixed_is_refused_with_the_new_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stopped:
        run(tmp_path, "--move", "drawer=not")

    assert stopped.value.code == 2
    assert "use --move drawer=fixed" in capsys.readouterr().err


def test_it_goes_with_settings(tmp_path: Path) -> None:
    (tmp_path / "settings.json").write_text('{"schema": "grafu.settings/1", "joints": {"door": {"count": 3}}}')
    assert run(tmp_path, "--settings", str(tmp_path / "settings.json"), "--move", "door=left") == 0
    report = json.loads((tmp_path / "out" / "cabinet" / "report.json").read_text())
    door = next(joint for joint in report["joints"] if joint["part"] == "door")

    assert door["count"] == 3
    assert door["origin"][0] < -0.2


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--move", "no_one=left"], "no_one"),
        (["--move", "door=left", "--motion", "urdf:x.urdf"], "exclude each other"),
    ],
)
def test_what_cannot_be_followed_is_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], options: list[str], said: str
) -> None:
    assert run(tmp_path, *options) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1


def test_parts_are_those_of_one_input(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["functionalize", "a.obj", "b.obj", "--out", str(tmp_path), "--move", "door=left"]) == 2
    assert "give one input" in capsys.readouterr().err


@pytest.mark.parametrize("move", ["door", "=left", "door=sideways"])
def test_another_form_is_an_argument_error(tmp_path: Path, capsys: pytest.CaptureFixture[str], move: str) -> None:
    with pytest.raises(SystemExit) as end:
        run(tmp_path, "--move", move)
    assert end.value.code == 2
    assert "PART=HOW" in capsys.readouterr().err


def test_a_misspelled_motion_is_told_with_the_word_that_is_like_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        run(tmp_path, "--move", "door=rigth")
    assert "did you mean `right`?" in capsys.readouterr().err
