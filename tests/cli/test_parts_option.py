"""`--parts loose` through the real command: a welded model works, and its settings give the same again."""

import json
from pathlib import Path

import pytest
from obj_inputs import write_cabinet

from grafu.cli.main import main


def test_a_welded_model_is_taken_apart_and_the_settings_say_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = write_cabinet(tmp_path).read_text().splitlines()
    (tmp_path / "welded.obj").write_text("\n".join(line for line in text if not line.startswith("o ")))
    command = ["functionalize", str(tmp_path / "welded.obj"), "--formats", "urdf", "--no-page", "--out"]
    assert main([*command, str(tmp_path / "out"), "--parts", "input"]) == 2
    assert main([*command, str(tmp_path / "cut")]) == 0
    assert "was cut into" in capsys.readouterr().out
    assert main([*command, str(tmp_path / "out"), "--parts", "loose"]) == 0
    settings = tmp_path / "out" / "welded" / "settings.json"
    assert main([*command, str(tmp_path / "again"), "--settings", str(settings)]) == 0
    reports = [json.loads((tmp_path / out / "welded" / "report.json").read_text()) for out in ("out", "again")]

    assert json.loads(settings.read_text())["reading"]["parts"] == "loose"
    assert [report["input"]["parts"] for report in reports] == [9, 9]
