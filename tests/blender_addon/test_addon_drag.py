"""Handles of a joint in a real Blender window: dragged, they open it, and make requests; dialogs have pictures."""

import json

import pytest
from real_window import ROOT, missing, run_in_window

from grafu.templates.handles import HANDLES

SAMPLE = ROOT / "samples" / "sideboard.glb"


@pytest.fixture(scope="module")
def facts(tmp_path_factory):
    why = missing()
    if why:
        pytest.skip(why)
    made = tmp_path_factory.mktemp("drag")
    done = run_in_window(ROOT / "tests/blender_addon/drag_probe.py", [str(SAMPLE)], made, 900.0)
    assert done.returncode == 0, (done.stdout + done.stderr)[-3000:]
    assert "Traceback" not in done.stdout + done.stderr, (done.stdout + done.stderr)[-3000:]
    return json.loads((made / "facts.json").read_text())


def test_the_arrow_opens_a_door_within_its_limits_and_undo_closes_it(facts):
    value, upper = facts["opened"]
    assert value == pytest.approx(0.8, abs=0.15)
    assert value < upper
    assert facts["undone"] == 0.0


def test_the_arrow_of_the_limit_asks_for_another_opening(facts):
    before, after = facts["limits"]
    assert after == pytest.approx(0.9, abs=0.15)
    assert after < before
    assert facts["asked for"] == pytest.approx(after, abs=1e-4)
    assert "joints" in facts["status"]


def test_the_dot_hangs_a_door_on_its_other_border(facts):
    assert sorted(facts["side"]) == ["left", "right"]


def test_dialogs_show_a_picture_of_every_handle(facts):
    items, icons = facts["icons"]
    assert icons == len(HANDLES) < items
    assert facts["faults"] == []
    assert {"GRAFU_OT_set_handle", "GRAFU_OT_set_joint"} <= facts["drawn"].keys()
