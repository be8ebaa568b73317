"""`--settings FILE` through the real command: it is followed, and options beside it win over it."""

import json
from pathlib import Path

import pytest
from obj_inputs import write_cabinet

from grafu.cli.main import main
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.settings import SCHEMA, settings_from_json


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


def test_options_win_over_the_settings_beside_them(tmp_path: Path) -> None:
    in_file = {
        "schema": SCHEMA,
        "motion": "annotation",
        "reading": {"height": 2.0, "parts": "loose", "limits": {"max_faces": 500_000}},
        "additions": {"drawer_boxes": None, "handles": {"style": "knob-round", "length": 0.1}},
        "joints": {"door": {"count": 3}},
    }
    (tmp_path / "settings.json").write_text(json.dumps(in_file))
    given = ["--motion", "rule", "--scale", "0.5", "--parts", "input", "--limit", "parts=900"]
    given += ["--no-top", "--handle", "bar-round", "--no-trim"]
    model = str(write_cabinet(tmp_path))
    args = ["functionalize", model, "--settings", str(tmp_path / "settings.json"), "--no-page", *given]
    assert main([*args, "--formats", "urdf", "--out", str(tmp_path / "out")]) == 0

    made = settings_from_json(json.loads((tmp_path / "out" / "cabinet" / "settings.json").read_text()))
    reading, additions = made.reading, made.additions
    assert (made.motion, made.trim) == (MotionSource.RULE, False)
    assert (reading.scale, reading.height, reading.parts) == (0.5, None, "input")
    assert (reading.limits.by_name()["faces"], reading.limits.by_name()["parts"]) == (500_000, 900)
    assert additions.top is None
    assert additions.drawer_boxes is None  # no option states otherwise
    assert additions.handles is not None
    assert (additions.handles.style, additions.handles.length) == ("bar-round", 0.1)
    assert made.joints["door"].count == 3


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
