"""The add-on in a real Blender window: its panels draw, a run goes on behind them, Escape stops it."""

import json
import re

import pytest
from real_window import ROOT, SIZE, missing, read_screen, run_in_window

SAMPLE = ROOT / "samples" / "sideboard.glb"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    why = missing()
    if why:
        pytest.skip(why)
    made = tmp_path_factory.mktemp("window")
    done = run_in_window(ROOT / "tests/blender_addon/window_probe.py", [str(SAMPLE)], made, 1200.0)
    assert done.returncode == 0, (done.stdout + done.stderr)[-3000:]
    return made


@pytest.fixture(scope="module")
def facts(folder):
    return json.loads((folder / "facts.json").read_text())


def test_every_panel_and_list_is_drawn_and_none_goes_wrong(facts):
    import ast

    assert facts["faults"] == []
    names = set()
    for module in ("panels", "lists"):
        tree = ast.parse((ROOT / "blender_addon" / f"{module}.py").read_text())
        names |= {node.name for node in tree.body if isinstance(node, ast.ClassDef)}
    expected = {name for name in names if name.startswith(("GRAFU_PT_", "GRAFU_UL_"))}
    assert expected - facts["drawn"].keys() <= {"GRAFU_UL_additions"}  # nothing is added to the sample
    assert len(expected) >= 8


def test_escape_stops_a_run_and_nothing_has_changed(facts):
    assert facts["was running"]
    assert facts["stopped"] == [False, "stopped", False]


def test_a_run_goes_on_behind_the_window_to_its_end(facts):
    assert facts["began"] == "RUNNING_MODAL"
    assert not facts["can begin another"]
    assert facts["drawn while it ran"] > 3
    status, joints, sources = facts["ended"]
    assert re.match(r"5 joints, (1 added part|\d+ added parts), \d+ left out$", status)
    assert (joints, sources) == (5, 24)


def test_undo_during_a_run_does_no_harm_and_what_does_not_fit_changes_nothing(facts):
    mechanism, changed, alive = facts["changed"]
    assert mechanism.endswith("piano")
    assert changed
    assert alive
    assert facts["unfit"][0] == mechanism
    assert "class P" in facts["unfit"][1]


def test_every_question_is_closed_by_escape(facts):
    assert facts["asked"] == [False, True]
    names = ("set_joint", "set_handle", "set_top", "furnish", "set_label", "set_motion")
    assert [name for name in names if f"GRAFU_OT_{name}" not in facts["drawn"]] == []


def test_finalize_writes_from_the_window(facts):
    status, names = facts["finalized"]
    assert "5 joints" in status
    assert {"model.glb", "report.json", "settings.json", "source.glb"} <= set(names)


def test_another_file_ends_the_run(facts):
    assert facts["left a run"]
    assert facts["after another file"] == [False, False]


def test_the_screen_is_seen(folder):
    seen = read_screen(folder / "shown.xwd")
    assert seen.shape == (SIZE[1], SIZE[0], 3)
    assert seen.std() > 10.0
