"""`--settings FILE` through the real command: it is followed, and options that say the same are refused."""

import json
from pathlib import Path

import pytest
from obj_inputs import write_cabinet

from grafu.cli.main import main
from grafu.pipeline.settings import SCHEMA, Settings


def test_settings_are_followed_and_the_same_file_gives_the_same_again(tmp_path: Path) -> None:
    chosen = {"schema": SCHEMA, "joints": {"door": {"count": 3}}, "additions": {"fronts": {"door": {"style": "none"}}}}
    (tmp_path / "settings.json").write_text(json.dumps(chosen))
    model = str(write_cabinet(tmp_path))
    for name in ("a", "b"):
        args = ["functionalize", model, "--settings", str(tmp_path / "settings.json"), "--out", str(tmp_path / name)]
        assert main(args) == 0
    report = json.loads((tmp_path / "a" / "cabinet" / "report.json").read_text())
    assert {joint["part"]: joint["count"] for joint in report["joints"]}["door"] == 3
    made = [(tmp_path / name / "cabinet" / "model.glb").read_bytes() for name in ("a", "b")]
    assert made[0] == made[1]


@pytest.mark.parametrize(
    "option", [["--no-top"], ["--motion", "rule"], ["--height", "1"], ["--no-trim"], ["--parts", "loose"]]
)
def test_options_that_settings_hold_are_refused_beside_them(tmp_path, capsys, option):
    (tmp_path / "settings.json").write_text(json.dumps(Settings().to_json()))
    model = str(write_cabinet(tmp_path))
    args = ["functionalize", model, "--settings", str(tmp_path / "settings.json"), "--out", str(tmp_path), *option]
    assert main(args) == 2
    assert f"`--settings` and `{option[0]}` exclude each other" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{", "is not JSON: expected settings of the form grafu.settings/1"),
        ("[" * 100_000, "JSON nested too deeply"),
        ("[]", "must be a JSON object"),
    ],
    ids=["half", "deep", "a list"],
)
def test_a_wrong_file_is_one_line(tmp_path, capsys, text, words):
    (tmp_path / "settings.json").write_text(text)
    model = str(write_cabinet(tmp_path))
    assert main(["functionalize", model, "--settings", str(tmp_path / "settings.json"), "--out", str(tmp_path)]) == 2
    said = capsys.readouterr().err
    assert words in said
    assert said.count("\n") == 1


def test_what_a_run_writes_gives_the_same_again(tmp_path: Path) -> None:
    model = str(write_cabinet(tmp_path))
    options = ["--motion", "rule", "--height", "1.2", "--no-trim", "--handle", "knob-round", "--interior", "shelves=1"]
    assert main(["functionalize", model, *options, "--formats", "glb", "--no-page", "--out", str(tmp_path / "a")]) == 0
    written = tmp_path / "a" / "cabinet" / "settings.json"
    again = ["--settings", str(written), "--formats", "glb", "--no-page", "--out", str(tmp_path / "b")]
    assert main(["functionalize", model, *again]) == 0

    same = tmp_path / "b" / "cabinet"
    assert json.loads(written.read_text())["reading"]["height"] == 1.2
    assert (same / "settings.json").read_bytes() == written.read_bytes()
    assert (same / "model.glb").read_bytes() == (written.parent / "model.glb").read_bytes()
