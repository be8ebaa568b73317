"""`visible`: nothing that steers a terminal gets through, and what people write stays as it is."""

import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.visible import visible, writable

_BIDIRECTIONAL = {"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"}


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("\x1b[2J\x1b]0;title\x07", r"\x1b[2J\x1b]0;title\x07"),
        ("door\r\n\tleft", r"door\r\n\tleft"),
        ("\x9b31m\x7f", r"\x9b31m\x7f"),
        ("gpj\u202e.exe\u2066\u200f\u061c", r"gpj\u202e.exe\u2066\u200f\u061c"),
        ("a\u2028b\u2029c\x85d", r"a\u2028b\u2029c\x85d"),
        (b"caf\xe9\x9b".decode("utf-8", "surrogateescape"), r"caf\udce9\udc9b"),
    ],
)
def test_what_steers_a_terminal_is_escaped(text: str, shown: str) -> None:
    assert visible(text) == shown


@pytest.mark.parametrize("text", ["", "door_1", r"a\b", "Schränkchen", "扉", "دولاب", "👩‍🔧", "cafe\u0301", "a\u00a0b"])
def test_what_people_write_stays(text: str) -> None:
    assert visible(text) == text


@given(st.text(st.characters(exclude_categories=())))
def test_nothing_hidden_is_left_and_the_rest_is_kept(text: str) -> None:
    shown = visible(text)

    shown.encode("utf-8")
    assert all(unicodedata.category(c) not in ("Cc", "Cs", "Zl", "Zp") for c in shown)
    assert all(unicodedata.bidirectional(c) not in _BIDIRECTIONAL for c in shown)
    assert visible(shown) == shown
    kept = [c for c in text if visible(c) == c]
    rest = iter(shown)
    assert all(c in rest for c in kept)  # in their order


@given(st.text(st.characters(exclude_categories=())))
def test_what_is_written_is_utf_8_and_only_surrogates_change(text: str) -> None:
    shown = writable(text)

    assert shown.encode("utf-8") == text.encode("utf-8", "backslashreplace")
    if text.isascii():
        assert shown == text
