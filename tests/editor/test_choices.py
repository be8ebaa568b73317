"""Each answer is a change of the settings that can be saved, read again and taken back; all else is refused."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.additions.handle.config import HandleChoice
from grafu.editor.choices import Choose, handle_styles, hinge_templates, rail_templates, with_choice
from grafu.editor.known import Known
from grafu.errors import OptionError
from grafu.joints.motion_choice import FIXED, MotionChoice, Moves, Side
from grafu.pipeline.addition_choice import TOP_SHAPES
from grafu.pipeline.settings import Settings, settings_from_json
from grafu.vocabulary import MOTION_WORDS, PartLabel

LEFT = MotionChoice(Moves.TURNS, Side.LEFT)
KNOWN = Known(
    frozenset({"door", "side", "odd"}),
    frozenset({"handle_1"}),
    frozenset({"door", "odd"}),
    {"door": LEFT},
    2,
    {"door": PartLabel.DOOR},
    {"handle_1": "door"},
    {"door": ((-1.0, 1.0), (-1.0, 1.0))},
)
NUMBERS = st.floats(1.0, 300.0)
ANSWERS: dict[Choose, st.SearchStrategy[Any]] = {
    Choose.MOTION: st.sampled_from(MOTION_WORDS),
    Choose.TURN: NUMBERS,
    Choose.SLIDE: NUMBERS,
    Choose.TEMPLATE: st.sampled_from((*hinge_templates(), *rail_templates())),
    Choose.HANDLE: st.sampled_from(handle_styles()),
    Choose.HANDLE_OFFSET: st.lists(st.floats(-1.0, 1.0), min_size=2, max_size=2),
    Choose.LABEL: st.sampled_from([str(label) for label in PartLabel]),
    Choose.SHELVES: st.integers(0, 20),
    Choose.TOP: st.sampled_from((*TOP_SHAPES, "none")),
    Choose.HINGE: st.sampled_from(hinge_templates()),
    Choose.HANDLES: st.sampled_from(handle_styles()),
}
PART = dict.fromkeys(ANSWERS, "door") | {Choose.SHELVES: "1", Choose.TOP: "", Choose.HINGE: "", Choose.HANDLES: ""}
JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=5,
)
answered = st.sampled_from(list(ANSWERS)).flatmap(lambda asked: st.tuples(st.just(asked), ANSWERS[asked]))


@given(answered)
def test_an_answer_is_saved_and_read_again(answer):
    asked, value = answer
    settings = with_choice(Settings(), asked, PART[asked], value, KNOWN)
    assert settings_from_json(settings.to_json()) == settings


@given(answered)
def test_an_answer_that_is_taken_back_leaves_nothing(answer):
    asked, value = answer
    settings = with_choice(Settings(), asked, PART[asked], value, KNOWN)
    assert with_choice(settings, asked, PART[asked], None, KNOWN) == Settings()


@given(st.lists(answered, max_size=6))
def test_answers_about_different_things_do_not_touch_each_other(answers):
    settings = Settings()
    for asked, value in answers:
        settings = with_choice(settings, asked, PART[asked], value, KNOWN)
    for asked, value in dict(answers).items():
        if asked not in (Choose.TURN, Choose.SLIDE):  # these two are one number
            assert with_choice(settings, asked, PART[asked], value, KNOWN) == settings


@given(st.text(max_size=12) | st.sampled_from(list(Choose)), st.text(max_size=12) | st.just("door"), JSON)
def test_whatever_is_sent_is_an_answer_or_one_line(question, part, value):
    refused = ""
    try:
        settings = with_choice(Settings(), question, part, value, KNOWN)
    except OptionError as error:
        settings, refused = Settings(), str(error)
    assert refused.isprintable()
    assert settings_from_json(settings.to_json()) == settings


def test_parts_are_joined_and_split_one_after_the_other():
    made = with_choice(Settings().with_motion("side", FIXED), "join", "door", "side", KNOWN)
    made = with_choice(made, "split", "door", None, KNOWN)
    assert [(str(change.do), *change.parts) for change in made.regrouped] == [
        ("join", "door", "side"),
        ("split", "door"),
    ]
    assert made.motions == {}
    assert settings_from_json(made.to_json()) == made


def test_a_part_is_cut_by_a_loop():
    corners = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.1, 0.0, 0.1]]
    made = with_choice(Settings(), "cut", "door", {"eye": [0, -3, 1], "corners": corners, "through": True}, KNOWN)
    (change,) = made.regrouped
    assert (str(change.do), change.parts, change.lasso.through) == ("cut", ("door",), True)
    assert [list(corner) for corner in change.lasso.corners] == corners
    assert change.category is PartLabel.DOOR  # what is left of it stays one
    assert settings_from_json(made.to_json()) == made


def test_accept_states_what_was_built():
    assert with_choice(Settings(), "accept", "door", None, KNOWN).motions == {"door": LEFT}
    assert with_choice(Settings(), "accept", "side", None, KNOWN).motions == {"side": FIXED}
    with pytest.raises(OptionError, match="has no word"):
        with_choice(Settings(), "accept", "odd", None, KNOWN)


def test_reject_fixes_a_part_and_leaves_an_added_one_out():
    assert with_choice(Settings(), "reject", "door", None, KNOWN).motions == {"door": FIXED}
    without = with_choice(Settings(), "reject", "handle_1", None, KNOWN)
    assert without.additions.rejected == {"handle_1"}
    assert with_choice(without, "restore", "handle_1", None, KNOWN) == Settings()


@pytest.mark.parametrize(
    ("question", "part", "value", "said"),
    [
        ("colour", "door", "red", "a question must be one of"),
        ("motion", "gate", "left", "there is no part 'gate'"),
        ("motion", "handle_1", "left", "there is no part"),
        ("motion", "door", "sideways", "a motion must be one of"),
        ("motion", "door", ["left"], "a motion must be one of"),
        ("turn", "door", True, "from 1 to 360 degrees"),
        ("turn", "door", 0, "from 1 to 360 degrees"),
        ("slide", "door", float("nan"), "centimetres"),
        ("shelves", "2", 1, "a compartment must be a number from 0 to 1"),
        ("shelves", "0", 1.5, "whole numbers"),
        ("top", "door", "rounded", "about the whole piece"),
        ("handle offset", "door", [1], "two numbers"),
        ("restore", "handle_1", True, "was left out"),
        ("join", "door", "door", "another part"),
        ("join", "door", "handle_1", "another part"),
        ("split", "handle_1", None, "there is no part"),
        ("cut", "door", None, "cut by a lasso"),
        ("cut", "door", {"eye": [0, -3, 1], "corners": "all"}, "a list of points"),
        ("cut", "door", {"eye": [0, -3], "corners": []}, "three numbers"),
        ("cut", "door", {"eye": [0, -3, 1], "corners": [[0, 0, 0]]}, "3 to 500 corners"),
        ("cut", "door", {"eye": [0, -3, 1], "corners": [[0, 0, 1e9]] * 3}, "metres"),
        ("cut", "door", {"eye": [0, -3, 1], "corners": [], "deep": 1}, "cut by a lasso"),
    ],
)
def test_what_is_no_answer_is_refused_in_words(question, part, value, said):
    with pytest.raises(OptionError, match=said):
        with_choice(Settings(), question, part, value, KNOWN)


@pytest.mark.parametrize(
    ("part", "value", "why"),
    [
        ("door", [1.2, 0], "from -1.001 to 1.001 metres"),
        ("door", [0, -9], "from -1.001"),
        ("side", [0, 0], "no handle"),
    ],
)
def test_a_handle_is_moved_on_its_front_alone(part, value, why):
    assert with_choice(Settings(), "handle offset", "door", [1.0, -1.0], KNOWN) != Settings()
    with pytest.raises(OptionError, match=why):
        with_choice(Settings(), "handle offset", part, value, KNOWN)


def test_a_handle_that_is_left_out_is_not_chosen_any_more():
    chosen = with_choice(Settings(), "handle", "door", "knob-round", KNOWN)
    without = with_choice(chosen, "reject", "handle_1", None, KNOWN)
    assert without.additions.fronts["door"] == HandleChoice("none", replaces=False)
    assert with_choice(without, "handle", "door", "knob-round", KNOWN) == chosen
    by_itself = with_choice(Settings(), "reject", "handle_1", None, KNOWN)
    assert (by_itself.additions.fronts, by_itself.additions.rejected) == ({}, {"handle_1"})
