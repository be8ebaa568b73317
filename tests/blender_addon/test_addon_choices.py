"""What is decided by hand in the extension: how parts move, what carries them, what holds rails, another top."""

import json

import pytest
from probe_runs import SAMPLES, assert_refused, assert_taken_back, facts_in, run_probe

from grafu.joints.motion_choice import choice_in_words
from grafu.joints.plan import Supports
from grafu.pipeline.settings import settings_from_json
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import MOTION_WORDS

REFUSED = {
    "no border": "choose the border",
    "broad face": "front is a broad face",
    "wall slides": "back_panel: ",
    "no_one": "has no no_one",
    "far mount": "on `back_panel`",
    "moving mount": "moves itself",
    "hinge supports": "for rails",
    "supports none": "supports: none",
}


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("choices")
    run_probe("choices", SAMPLES, folder)
    return folder


@pytest.fixture(scope="module")
def steps(run):
    return facts_in(run)


def test_after_every_step_the_scene_is_what_the_library_makes_of_its_settings(steps):
    assert [name for name, fact in steps.items() if not fact["agrees"]] == []


def test_what_does_not_fit_changes_nothing_and_says_why(steps):
    assert_refused(steps, REFUSED)


def test_every_other_step_is_taken_back_and_done_again(steps):
    assert_taken_back(steps, least=5)


def test_a_rejected_door_is_static_and_can_be_hung_anew(steps):
    assert "door_1" not in steps["reject"]["joints"]
    assert steps["reject"]["rows"]["door_1"] == "ok"
    assert steps["reject"]["row"] == "is static"
    assert steps["hang right"]["mounts"]["door_1"] == "divider_1"
    assert steps["flap"]["mounts"]["door_1"] == "bottom_panel"
    assert steps["as found"]["joints"] == steps["as found again"]["joints"] == steps["functionalize"]["joints"]
    assert "door_1" not in steps["active"]["joints"]


def test_the_menus_offer_every_motion_that_the_command_has_a_word_for(steps):
    words = {word: choice_in_words(word) for word in MOTION_WORDS}
    expected = {word: [c.moves.value, c.side.value if c.side else None, c.inwards] for word, c in words.items()}
    assert steps["flap"]["words"] == expected


def test_a_front_tilts_as_chosen_and_a_flap_without_room_for_arms_turns_up(steps):
    assert steps["tilts"]["joints"]["door_1"][3] < steps["flap"]["joints"]["door_1"][3]
    assert steps["tilts"]["mounts"]["door_1"] == "bottom_panel"
    assert steps["rises on arms"]["motions"]["door_1"] == ["turns", "top", False]


def test_a_door_hangs_on_the_part_that_is_chosen(steps):
    assert steps["functionalize"]["mounts"]["door_1"] == "side_panel_left"
    assert steps["mount"]["mounts"]["door_1"] == "divider_1"


def test_a_dialog_offers_what_fits_the_joint_and_its_class(steps):
    fact = steps["drawn"]
    gallery = builtin_gallery()
    classes, templates = fact["offered"]["door_1"]
    assert classes == ["auto", "C", "F", "P"]
    assert templates == ["auto", *(model.id for model in (*gallery.hinges, *gallery.concealed)), "pivot"]
    rails = [["auto", "centre-mount", "corner-mount"], ["auto", *(model.id for model in gallery.rails)]]
    assert fact["offered"]["drawer_1"] == rails
    assert fact["of class P"] == ["auto", *(model.id for model in gallery.hinges if model.mechanism == "P")]


def test_a_number_that_a_dialog_leaves_automatic_counts_for_nothing(steps):
    built, usual = steps["drawn"]["joints"]["door_1"], steps["mount"]["joints"]["door_1"]
    assert built[2] == usual[2] != 4
    assert built[3] == pytest.approx(0.8)


def test_a_top_comes_in_the_place_of_the_old_one_and_goes_again(steps):
    def tops(name):
        return [part for part in steps[name]["added"] if part.startswith("top")]

    assert len(tops("replace top")) == 1
    assert not tops("old top")


def test_a_compartment_is_parted_by_upright_panels(steps):
    assert [part for part in steps["divider"]["added"] if part.startswith("divider")]


def test_rails_are_held_as_chosen(steps, run):
    heights = {name: steps[f"supports {name}"]["tallest"] for name in ("slab", "divider")}
    assert len(steps["dresser"]["supports"]) == len(steps["supports slab"]["supports"]) == 2
    assert heights["divider"] > 1.5 * heights["slab"]
    settings = settings_from_json(json.loads((run / "final" / "settings.json").read_text()))
    assert settings.joints["drawer_1"].supports is Supports.DIVIDER
