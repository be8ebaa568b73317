"""Templates in Blender's asset browser and in the dialogs, and what is dragged in the 3D View becomes a request."""

import pytest
from probe_runs import SAMPLES, assert_refused, assert_taken_back, facts_in, run_probe

from grafu.templates.gallery import builtin_gallery
from grafu.templates.handles import HANDLES

REFUSED = {
    "rail on a door": "door_1",
    "limit again": "",
    "broad face": "front is a broad face",
    "no joint": "",
}


@pytest.fixture(scope="module")
def steps(tmp_path_factory):
    folder = tmp_path_factory.mktemp("assets")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("BLENDER_USER_RESOURCES", str(tmp_path_factory.mktemp("profile")))
        run_probe("assets", SAMPLES / "sideboard.glb", folder)
    found = facts_in(folder)
    return {name: fact for name, fact in found.items() if "result" in fact}, found


@pytest.fixture(scope="module")
def changes(steps):
    return steps[0]


@pytest.fixture(scope="module")
def facts(steps):
    return steps[1]


def test_the_library_is_registered_once_and_removed_with_its_files(facts):
    assert not facts["before"]["can remove"]
    assert facts["before"]["gizmos"]
    assert facts["added"]["new"] == [1, 1]
    assert facts["added"]["files"] == ["blender_assets.cats.txt", "templates.blend"]
    assert facts["added"]["left behind"] == [0, 1, 0]
    assert facts["removed"]["libraries"]
    assert facts["removed"]["files"] == []


def test_every_template_is_an_asset_with_a_picture_in_its_catalog(facts):
    gallery, assets = builtin_gallery(), facts["marked"]["assets"]
    hinges = {f"hinge-{model.id}" for model in (*gallery.hinges, *gallery.concealed)}
    rails = {f"rail-{model.id}" for model in gallery.rails}
    assert assets.keys() == hinges | rails | {f"handle-{handle.id}" for handle in HANDLES}
    lines = facts["added"]["catalogs"].splitlines()
    catalogs = dict(line.split(":")[:2] for line in lines if line.count(":") == 2)
    for key, stated in assets.items():
        kind = key.split("-")[0]
        assert stated["size"] == [256, 256]
        assert stated["shown"]
        assert kind in stated["tags"]
        assert catalogs[stated["catalog"]].lower() == f"grafu/{kind}s"
        assert stated["joints"] == (kind != "handle")


def test_a_handle_stands_on_what_it_is_dropped_on(facts):
    handles = [stated["stands"] for key, stated in facts["marked"]["assets"].items() if key.startswith("handle")]
    assert len(handles) == len(HANDLES)
    for low, high in handles:
        assert low == pytest.approx(0.0, abs=1e-6)
        assert high > 0.01


def test_pictures_for_the_dialogs_stay_when_their_files_are_gone(facts):
    drawn = facts["pictures"]
    assert drawn["before"] == 0
    assert drawn["gone"]
    assert drawn["sizes"] == {key: [256, 256] for key in facts["marked"]["assets"]}


def test_what_is_dropped_is_built_on_the_nearest_part_and_taken_away(changes, facts):
    assert not facts["functionalize"]["can use"]
    assert changes["handle"]["changed"]
    assert "knob-round" in changes["handle"]["added"].values()
    assert changes["hinge"]["joints"]["door_1"][1] == "piano"
    there = {name: changes[name]["dropped is there"] for name in ("handle", "hinge", "rail on a door")}
    assert there == {"handle": False, "hinge": False, "rail on a door": True}


def test_what_is_dragged_is_the_request_that_the_dialogs_make(changes):
    assert changes["limit"]["joints"]["door_1"][3] == pytest.approx(0.7)
    assert changes["limit"]["joints"]["door_1"][1] == "piano", "what was chosen before is lost"
    assert changes["limit of a drawer"]["joints"]["drawer_1"][3] == pytest.approx(0.15)
    assert changes["border"]["motions"]["door_1"] == ["turns", "right", False]
    assert changes["open"]["open"] == pytest.approx(0.5)


def test_the_borders_of_a_door_are_four(changes):
    assert changes["no joint"]["borders"] == ["bottom", "left", "right", "top"]


def test_the_scene_is_always_what_the_library_makes_of_its_settings(changes):
    assert [name for name, fact in changes.items() if not fact["agrees"]] == []


def test_what_does_not_fit_changes_nothing_and_the_rest_is_taken_back(changes):
    assert_refused(changes, REFUSED)
    assert_taken_back(changes, least=7)
