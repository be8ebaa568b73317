"""What was not made: one value, reasons from a fixed list, each with a sentence."""

import pickle
import re

import pytest

from grafu.refusal import Asked, Reason, Refusal


@pytest.mark.parametrize("reason", Reason)
def test_each_reason_is_a_short_word_and_one_plain_sentence(reason):
    assert re.fullmatch(r"[a-z ]{3,20}", reason.value)
    assert re.fullmatch(r"[A-Z][^.]+\.", reason.sentence)
    assert len(reason.sentence) < 90
    assert Reason(str(reason)) is reason
    assert pickle.loads(pickle.dumps(reason)) is reason


def test_no_two_reasons_say_the_same():
    assert len({reason.sentence for reason in Reason}) == len(Reason)


def test_a_refusal_says_what_was_found_else_its_sentence():
    found = Refusal("", Reason.NO_ROOM, "only 3 mm are free")
    assert str(found.of("door", Asked.GRASP)) == "only 3 mm are free"
    assert found.of("door", Asked.GRASP) == Refusal("door", Reason.NO_ROOM, "only 3 mm are free", Asked.GRASP)
    assert str(Refusal("door", Reason.NO_ROOM)) == Reason.NO_ROOM.sentence
