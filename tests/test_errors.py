"""Messages stay readable, whatever was given."""

import pickle

from grafu.errors import OptionError


def test_a_message_of_very_many_characters_lacks_its_middle():
    said = str(OptionError("`a` must be a word: got " + "x" * 100_000 + "; say another"))
    assert len(said) < 2100
    assert said.startswith("`a` must be a word: got xxx")
    assert said.endswith("xxx; say another")
    assert str(pickle.loads(pickle.dumps(OptionError("x" * 9000)))) == str(OptionError("x" * 9000))


def test_a_usual_message_is_as_it_was_said():
    assert str(OptionError("x" * 2000)) == "x" * 2000
