"""The record of decisions: its last lines state what holds, whatever was undone or cut short in between."""

import json

from hypothesis import given
from hypothesis import strategies as st

from grafu.additions.handle.config import HandleChoice
from grafu.asset.regrouping import Regroup, Regrouping
from grafu.editor.decisions import Prediction, append_lines, decided, decision_lines, word_of
from grafu.joints.motion_choice import MotionChoice, Moves, Side, choice_in_words
from grafu.joints.plan import JointChoice
from grafu.pipeline.decisions import decided_before
from grafu.pipeline.settings import Settings
from grafu.vocabulary import MOTION_WORDS, PartLabel

PARTS = st.sampled_from(["door", "drawer", "odd \u2028 name"])
CHANGES = st.one_of(
    st.tuples(st.just("motion"), PARTS, st.none() | st.sampled_from(MOTION_WORDS)),
    st.tuples(st.just("label"), PARTS, st.sampled_from(list(PartLabel))),
    st.tuples(st.just("joint"), PARTS, st.builds(JointChoice, opening=st.none() | st.just(0.5))),
    st.tuples(st.just("split"), PARTS, st.none()),
    st.tuples(st.just("join"), PARTS, st.just("side")),
    st.tuples(st.just("front"), PARTS, st.none() | st.just(HandleChoice("knob-round", offset=(0.1, 0.0)))),
)


def changed(settings, change):
    kind, part, value = change
    if kind == "motion":
        return settings.with_motion(part, value and choice_in_words(value))
    if kind in ("split", "join"):
        return settings.with_regrouping(Regrouping(Regroup(kind), (part, value) if value else (part,)))
    return {"label": settings.with_label, "joint": settings.with_joint, "front": settings.with_front}[kind](part, value)


@given(st.lists(CHANGES, max_size=8))
def test_the_last_lines_are_what_is_decided(changes):
    from pathlib import Path
    from tempfile import TemporaryDirectory

    with TemporaryDirectory() as folder:
        path, before, settings = Path(folder) / "decisions.jsonl", {}, Settings()
        for change in changes:
            settings = changed(settings, change)
            append_lines(path, decision_lines("cabinet", before, decided(settings), {}))
            before = decided(settings)
        assert decided_before(path, "cabinet") == decided(settings)
        assert decided_before(path, "another") == {}


def test_a_line_holds_what_was_predicted_and_its_score():
    settings = Settings().with_motion("door", choice_in_words("right"))
    predictions = {("door", "motion"): Prediction("left", 0.61)}
    (line,) = decision_lines("cabinet", {}, decided(settings), predictions)
    assert line["predicted"] == {"choice": "left", "score": 0.61}
    assert (line["model"], line["part"], line["question"], line["chosen"]) == ("cabinet", "door", "motion", "right")
    (back,) = decision_lines("cabinet", decided(settings), {}, predictions)
    assert back["chosen"] is None


def test_a_damaged_line_is_passed_over(tmp_path):
    path = tmp_path / "decisions.jsonl"
    whole = {"model": "cabinet", "part": "door", "question": "motion", "chosen": "left"}
    path.write_bytes(b'\xff\n[1]\n{"model": "cabinet", "part": 3}\n' + json.dumps(whole).encode() + b'\n{"model": "cab')
    assert decided_before(path, "cabinet") == {("door", "motion"): "left"}


def test_every_motion_has_a_word():
    for word in MOTION_WORDS:
        assert choice_in_words(word_of(choice_in_words(word))) == choice_in_words(word)
    assert word_of(MotionChoice(Moves.TURNS, Side.LEFT, inwards=True)) == "left"
    assert choice_in_words(word_of(MotionChoice(Moves.SLIDES, Side.FRONT))) == choice_in_words("pull")
