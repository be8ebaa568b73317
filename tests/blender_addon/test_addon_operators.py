"""Every operator of the add-on in a real Blender, without a window: done, taken back, done again; the library agrees.

The Blender is that of `grafu.export.blend`: an importable `bpy`, or the Python that GRAFU_BLENDER_PYTHON names.
"""

import json
import subprocess

import numpy as np
import pytest
from probe_runs import SAMPLES, assert_refused, assert_taken_back, facts_in, run_probe

from grafu.export.blend.exporter import find_interpreter
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import settings_from_json

SAMPLE = SAMPLES / "sideboard.glb"
REFUSED = {
    "class P": "class P",
    "furnish": "room for",
    "unfit": "corner-mount",
    "too many": "room for",
    "no such box": "no such compartment",
}


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("addon")
    run_probe("operators", SAMPLE, folder)
    return folder


@pytest.fixture(scope="module")
def facts(run):
    return facts_in(run)


@pytest.fixture(scope="module")
def steps(facts):
    return {name: fact for name, fact in facts.items() if "result" in fact}


def test_registering_takes_no_time_and_no_torch_and_is_taken_back(facts):
    assert facts["register"]["seconds"] < 0.5
    assert not facts["register"]["torch"]
    assert facts["unregister"]["gone"]


def test_after_every_step_the_scene_is_what_the_library_makes_of_its_settings(steps):
    assert [name for name, fact in steps.items() if not fact["agrees"]] == []


def test_every_step_is_taken_back_and_done_again(steps):
    assert_taken_back(steps, least=25)


def test_what_does_not_fit_changes_nothing_and_says_why(steps):
    assert_refused(steps, REFUSED)


def test_the_result_stands_where_its_sources_stood(facts):
    assert facts["functionalize"]["hidden"]
    assert facts["functionalize"]["places"] < 1e-4
    assert set(facts["functionalize"]["rows"]) == set(facts["functionalize"]["joints"])


def test_joints_are_as_chosen(steps):
    def door(name):
        return steps[name]["joints"]["door_1"]

    assert door("class C")[0] == "C"
    assert door("class F")[0] == "F"
    assert door("template")[1] == "piano"
    assert door("count")[2] == 3
    assert door("opening")[3] == pytest.approx(1.0)
    assert door("reset joint") == door("functionalize")
    assert steps["rail"]["joints"]["drawer_1"][0] == "corner-mount"
    assert "door_2" not in steps["label"]["joints"]
    assert "door_2" in steps["label as read"]["joints"]
    assert door("goes on")[2] == 4


def test_questions_about_a_motion_begin_with_how_the_part_moves(steps):
    motions = steps["functionalize"]["motions"]
    assert motions["drawer_1"] == ["slides", "front", False]
    turning = {part: motion for part, motion in motions.items() if part.startswith("door")}
    assert turning == {"door_1": ["turns", "left", False], "door_2": ["turns", "bottom", False]}
    assert steps["label"]["motions"].get("door_2", ["", "", False])[0] == ""  # it has no joint


def test_handles_are_as_chosen(steps):
    assert list(steps["restyle"]["added"].values()) == ["knob-round", "knob-round"]
    assert "door_2" in steps["grip"]["added"]
    assert steps["handle back"]["added"].keys() == {"door_2"}


def test_tops_and_shelves_come_and_go(steps, facts):
    def tops(name):
        return [part for part, style in steps[name]["added"].items() if part.startswith("top")]

    assert tops("topless")
    assert steps["rounded top"]["thick"] == pytest.approx(0.03, abs=1e-4)
    assert not tops("no top")
    assert tops("top again")
    assert not tops("reject top")
    assert tops("accept top")
    assert sum(part.startswith("shelf") for part in steps["selected box"]["added"]) == 2
    assert sum(part.startswith("shelf") for part in steps["own box"]["added"]) == 3


def test_compartments_are_boxes_named_in_their_middles(facts):
    fact = facts["compartments"]
    assert set(fact["boxes"]) == {12}
    names = np.array(fact["named at"])
    boxes = np.array(fact["compartments"])
    assert np.allclose(names, boxes.mean(axis=1), atol=1e-5)
    assert len({tuple(name) for name in names.round(3)}) == len(boxes) > 1
    sizes = np.ptp(np.array(fact["found"]), axis=1)
    assert np.allclose(sorted(map(tuple, np.ptp(boxes, axis=1))), sorted(map(tuple, sizes)), atol=1e-4)


def test_modifiers_of_hidden_sources_still_count(steps):
    assert steps["topless"]["bevelled"] == steps["again"]["bevelled"]
    assert steps["topless"]["sources"] == 20


def test_what_is_seen(facts):
    view = facts["view"]
    assert "GraFu door" in view["coloured"]
    assert view["materials_back"]
    assert set(view["all"].values()) == set(view["frame 50"].values()) == {1.0}
    assert set(view["closed"].values()) == {0.0}
    assert {part: value for part, value in view["solo"].items() if value} == {"door_2": 1.0}
    assert view["moved"] > 0.1
    assert view["picked"] == "door_2"
    assert view["selected"] == [view["first"]]


def test_a_saved_file_goes_on(facts):
    assert facts["opened again"]["same"]
    assert facts["opened again"]["sources"] == 24


def test_what_is_written_is_whole_and_its_settings_read_back(run):
    folder = run / "final"
    Report.read_json((folder / "report.json").read_text())
    settings = settings_from_json(json.loads((folder / "settings.json").read_text()))
    assert settings.additions.compartments
    assert {p.name for p in folder.iterdir()} >= {"model.glb", "model.urdf", "graph.json", "source.glb"}
    assert (folder / "model.blend").stat().st_size > 10_000


def test_source_and_settings_give_the_same_without_blender(run, tmp_path):
    written, source = run / "final", tmp_path / "final.glb"
    source.write_bytes((written / "source.glb").read_bytes())
    given = [str(source), "--settings", str(written / "settings.json"), "--formats", "glb,urdf", "--no-page"]
    command = [find_interpreter(), "-m", "grafu.cli.main", "functionalize", *given, "--out", str(tmp_path / "out")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    again = tmp_path / "out" / "final"
    assert (again / "model.glb").read_bytes() == (written / "model.glb").read_bytes()
    reports = [json.loads((folder / "report.json").read_text()) for folder in (again, written)]
    for report in reports:
        del report["timings"], report["input"]["path"]
    assert reports[0] == reports[1]
