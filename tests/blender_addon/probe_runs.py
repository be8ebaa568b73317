"""Runs a probe in a Blender without a window, and reads what it noted.

The Blender is that of `grafu.export.blend`: an importable `bpy`, or the Python that GRAFU_BLENDER_PYTHON names.
"""

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

from grafu.errors import ExportError
from grafu.export.blend.exporter import find_interpreter

ROOT = Path(__file__).parents[2]
SAMPLES = ROOT / "samples"


def run_probe(name: str, sample: Path, folder: Path, seconds: float = 600) -> None:
    """Has `name`_probe.py write `facts.json` into a folder; skips the test where there is no Blender."""
    try:
        interpreter = find_interpreter()
    except ExportError as error:
        pytest.skip(str(error))
    probe = Path(__file__).with_name(f"{name}_probe.py")
    command = [interpreter, str(probe), str(ROOT), str(sample), str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=False)
    assert done.returncode == 0, done.stderr[-3000:]


def facts_in(folder: Path) -> dict[str, dict[str, Any]]:
    """Returns what a probe noted, by step; no two steps have one name."""
    found = json.loads((folder / "facts.json").read_text())
    assert len({fact["step"] for fact in found}) == len(found)
    return {fact["step"]: fact for fact in found}


def assert_refused(steps: dict[str, dict[str, Any]], expected: dict[str, str]) -> None:
    """Exactly the expected steps are refused, each in words that say why, and change nothing."""
    refused = {name: fact for name, fact in steps.items() if fact["result"] == "CANCELLED"}
    assert refused.keys() == expected.keys()
    for name, words in expected.items():
        assert words in refused[name]["status"]
        assert not refused[name]["changed"]


def assert_taken_back(steps: dict[str, dict[str, Any]], least: int) -> None:
    """Every step that is not refused, so many at least, is undone and done again."""
    done = {name: fact["wrong"] for name, fact in steps.items() if fact["result"] == "FINISHED"}
    assert len(done) >= least
    assert {name: wrong for name, wrong in done.items() if wrong} == {}
