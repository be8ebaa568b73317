"""A folder of results in a real Blender: shown as after a run, changed from there, refused in one line."""

import json
import shutil
from pathlib import Path

import pytest
from probe_runs import SAMPLES, facts_in, run_probe

from grafu.cli.main import main
from grafu.pipeline.result_folder import read_result

SAMPLE = SAMPLES / "chest.glb"
BAD = {
    "empty": "no report.json",
    "no glb": "with --formats glb",
    "broken": "is truncated",
    "a file": "is none",
}


def lay_out(folder: Path) -> None:
    """Writes a result and broken ones."""
    arguments = ["--motion", "rule", "--formats", "glb", "--no-page", "--out", str(folder / "out")]
    assert main(["functionalize", str(SAMPLE), *arguments]) == 0
    made = folder / "out" / "chest"
    for name in ("no glb", "broken"):
        shutil.copytree(made, folder / "bad" / name)
    (folder / "bad" / "empty").mkdir()
    (folder / "bad" / "a file").write_text("")
    (folder / "bad" / "no glb" / "model.glb").unlink()
    (folder / "bad" / "broken" / "model.glb").write_bytes(b"glTF")
    shutil.copytree(made, folder / "sourceless")
    report = json.loads((made / "report.json").read_text())
    report["input"]["path"] = "/nowhere/chest.glb"
    (folder / "sourceless" / "report.json").write_text(json.dumps(report))


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("results")
    lay_out(folder)
    run_probe("results", SAMPLE, folder)
    return folder


@pytest.fixture(scope="module")
def facts(run):
    return facts_in(run)


@pytest.mark.parametrize(("name", "words"), BAD.items())
def test_a_bad_folder_is_one_line_and_changes_nothing(facts, name, words):
    fact = facts[f"bad {name}"]
    assert fact["result"] == ["CANCELLED"]
    assert words in fact["status"]
    assert "\n" not in fact["status"]
    assert fact["models"] == 0


def test_a_folder_of_many_says_which_to_choose(facts):
    assert facts["many"]["result"] == ["CANCELLED"]
    assert "choose one of its folders (chest)" in facts["many"]["status"]


def test_the_scene_is_the_object_in_the_folder(facts, run):
    made = read_result(run / "out" / "chest").object
    fact = facts["chest"]
    assert fact["result"] == ["FINISHED"]
    expected = [("link", link.id) for link in made.links] + [("joint", joint.id) for joint in made.joints]
    expected += [(visual.role.value, visual.name) for link in made.links for visual in link.visuals]
    assert sorted((kind, name) for kind, name, *_ in fact["things"]) == sorted(expected)
    assert fact["rows"].keys() == {joint.child for joint in made.moving_joints}
    assert all(level in ("ok", "warning") and mechanism for level, mechanism in fact["rows"].values())
    assert set(fact["frame 50"].values()) == {1.0}
    assert fact["end"] == 100
    assert fact["place"] == [3.0, 1.0, 0.0]


def test_opening_is_taken_back_and_done_again(facts):
    assert facts["undone"]["models"] == 0
    assert facts["redone"]["things"] == facts["chest"]["things"]
    assert set(facts["redone"]["open"].values()) == {1.0}


def test_it_has_no_objects_to_show_instead(facts):
    assert facts["sources"]["result"] == ["CANCELLED"]


def test_a_change_is_built_from_the_input_and_stays_where_it_was_moved(facts):
    fact = facts["changed"]
    assert fact["result"] == ["FINISHED"]
    assert [mechanism.split()[0] for _, mechanism in fact["rows"].values()] == ["2"]
    assert fact["place"][0] == 5.0
    assert facts["again"]["things"] == fact["things"]
    assert facts["goes on"]["result"] == ["FINISHED"]
    kinds = [[thing[:2] for thing in facts[step]["things"]] for step in ("goes on", "chest")]
    assert kinds[0] == kinds[1]


def test_what_is_finalized_is_opened_again(facts, run):
    assert facts["finalized"]["result"] == ["FINISHED"]
    assert (run / "final" / "done" / "source.glb").read_bytes() == SAMPLE.read_bytes()
    assert facts["reopened"]["result"] == ["FINISHED"]
    assert facts["reopened"]["things"] == facts["finalized"]["things"]


def test_compartments_of_an_opened_result_are_found_when_asked_for(facts):
    assert facts["compartments"]["result"] == ["FINISHED"]
    assert facts["compartments"]["boxes"] > 0
    assert facts["compartments"]["things"] == facts["reopened"]["things"]
    assert facts["compartments undone"]["boxes"] == 0


def test_without_its_input_it_is_shown_and_cannot_be_changed(facts):
    assert facts["sourceless"]["result"] == ["FINISHED"]
    assert facts["sourceless"]["models"] == 3
    assert "its input is gone" in facts["sourceless"]["status"]
    assert facts["sourceless changed"]["result"] == ["CANCELLED"]
    assert facts["sourceless changed"]["things"] == facts["sourceless"]["things"]
    assert "its input is gone" in facts["sourceless changed"]["status"]
