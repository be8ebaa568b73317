"""Several models in one scene, each with a session of its own; a scene that was saved with one goes on."""

import pytest
from probe_runs import SAMPLES, facts_in, run_probe

LEFT, RIGHT = "left_chest", "right_chest"


@pytest.fixture(scope="module")
def facts(tmp_path_factory):
    folder = tmp_path_factory.mktemp("models")
    run_probe("models", SAMPLES / "chest.glb", folder)
    return facts_in(folder)


def model(facts, step, slot):
    return facts[step]["models"][slot]


def test_other_objects_are_another_model_beside_the_first(facts):
    assert [len(facts[name]["models"]) for name in ("left", "right")] == [1, 2]
    first, second = facts["right"]["models"]
    assert first == model(facts, "left", 0)
    assert first["title"].startswith(LEFT)
    assert second["title"].startswith(RIGHT)
    assert not set(first["objects"]) & set(second["objects"])
    assert not set(first["sources"]) & set(second["sources"])


def test_the_sidebar_shows_the_model_of_the_active_object_else_the_last_one(facts):
    shown = {key: title.startswith(LEFT) for key, title in facts["shown"]["shown"].items()}
    assert shown == {"source": True, "lamp after it": True, "other": False, "nothing": False, "joint": True}
    assert facts["chosen"]["shown"].startswith(RIGHT)


def test_a_change_is_of_one_model_and_is_taken_back_and_done_again(facts):
    before, after = facts["shown"]["models"], facts["change left"]["models"]
    assert facts["change left"]["result"] == ["FINISHED"]
    assert before[1] == after[1]
    assert before[0]["settings"] != after[0]["settings"]
    assert facts["undone"]["models"] == before
    assert facts["redone"]["models"] == after
    assert facts["redone"]["shown"].startswith(LEFT)


def test_what_was_active_is_active_in_the_new_result(facts):
    assert facts["redone"]["active"] in model(facts, "redone", 0)["counts"]


def test_compartments_are_one_models(facts):
    assert [m["boxes"] > 0 for m in facts["boxes"]["models"]] == [True, False]


def test_objects_of_two_models_are_refused(facts):
    assert facts["both"]["result"] == ["CANCELLED"]
    assert "select those of one" in facts["both"]["status"]
    assert facts["both"]["models"] == facts["boxes"]["models"]


def test_a_saved_scene_holds_them_all(facts):
    assert facts["opened again"]["models"] == facts["both"]["models"]


def test_one_is_removed_and_its_sources_are_seen_again(facts):
    assert facts["removed"]["result"] == ["FINISHED"]
    assert not model(facts, "removed", 0)["objects"]
    assert model(facts, "removed", 1) == model(facts, "chosen", 1)
    assert facts["removed"]["hidden"]
    assert not any(facts["removed"]["hidden"])
    assert facts["removal undone"]["models"] == facts["chosen"]["models"]


def test_the_free_place_is_taken_again(facts):
    assert facts["right alone"]["result"] == facts["left anew"]["result"] == ["FINISHED"]
    assert len(facts["left anew"]["models"]) == 2
    assert model(facts, "left anew", 0)["counts"] == model(facts, "left", 0)["counts"]
    assert model(facts, "left anew", 1) == model(facts, "right alone", 1)


def test_a_file_of_the_time_of_one_model_goes_on(facts):
    assert model(facts, "old file", 0)["objects"]
    assert facts["old file goes on"]["result"] == ["FINISHED"]
    before, after = model(facts, "old file", 0), model(facts, "old file goes on", 0)
    for name in ("title", "counts", "sources", "settings"):
        assert after[name] == before[name]
    assert len(after["objects"]) == len(before["objects"])
