"""A run in a process of its own: stages as they begin, all files or one line that states why not."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from grafu.errors import FunctionalizationError
from grafu.export.blend.process import unpacked
from grafu.pipeline import interactive
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import SCHEMA
from spoiled_files import DAMAGED, SPOILS

SAMPLE = Path(__file__).parents[2] / "samples" / "sideboard.glb"


def run(folder: Path, source: Path, settings: dict) -> tuple[int, list[str]]:
    (folder / "settings.json").write_text(json.dumps({"schema": SCHEMA, "motion": "rule", **settings}))
    command = [sys.executable, "-m", "grafu.pipeline.interactive", str(source), str(folder / "settings.json")]
    done = subprocess.run([*command, str(folder)], capture_output=True, text=True, timeout=120, check=False)
    return done.returncode, done.stdout.splitlines()


def test_everything_comes_back(tmp_path):
    code, said = run(tmp_path, SAMPLE, {"joints": {"door_1": {"count": 3}}})
    assert code == 0
    stages = ["load", "parse", "complete", "plan", "close", "body", "realize", "fittings", "write"]
    assert said == [f"stage {name}" for name in stages]
    made = unpacked((tmp_path / "object.packed").read_bytes())
    report = Report.model_validate_json((tmp_path / "report.json").read_text())
    assert {j.child for j in made.moving_joints} == {j.part for j in report.joints}
    assert {j.part: j.count for j in report.joints}["door_1"] == 3
    assert "nodes" in (tmp_path / "graph.json").read_text()
    boxes = json.loads((tmp_path / "interior.json").read_text())["compartments"]
    assert boxes
    assert all(np.shape(box["corners"]) == (8, 3) for box in boxes)


@pytest.mark.parametrize("settings", [{"joints": {"door_1": {"template": "spring"}}}, {"source": "x"}])
def test_what_is_wrong_is_said_in_one_line_and_nothing_is_written(tmp_path, settings):
    code, said = run(tmp_path, SAMPLE, settings)
    assert code == 2
    assert said[-1].startswith("error ")
    assert not (tmp_path / "object.packed").exists()


@pytest.mark.parametrize("what", [*SPOILS, *DAMAGED])
def test_settings_that_cannot_be_read_are_one_line(tmp_path, what):
    path = tmp_path / "settings.json"
    path.write_text("{}")
    SPOILS[what](path) if what in SPOILS else path.write_bytes(DAMAGED[what])
    with pytest.raises(FunctionalizationError, match=what if what in SPOILS else "settings") as error:
        interactive.run(SAMPLE, path, tmp_path)
    assert "\n" not in str(error.value)
