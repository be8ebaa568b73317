"""Names as numbers: what counts of a name, what does not, and that nothing is read beyond its room."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.completion.name_codes import NAME_BUCKETS, NAME_CODES, name_codes


def pieces(name: str) -> set[int]:
    return set(name_codes([name])[0].tolist()) - {0}


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("Drawer.001", "drawer_12"),
        ("DrawerBox", "drawer box"),
        ("Tür", "Tur"),
        ("CABINET-DOOR", "cabinet door 7"),
        ("tiroir", "Tiroir#3"),
    ],
)
def test_case_numbers_signs_and_accents_do_not_count(one: str, other: str) -> None:
    assert pieces(one) == pieces(other) != set()


def test_alike_words_share_pieces_and_others_do_not() -> None:
    assert len(pieces("drawer") & pieces("drawers")) >= 4
    assert pieces("drwr") & pieces("drwrs")
    assert pieces("引き出し") & pieces("引き出し取っ手")
    assert not pieces("drawer") & pieces("hinge")
    assert not pieces("123") | pieces("") | pieces("__#--")


@given(st.lists(st.text(max_size=200), max_size=5))
def test_any_names_have_codes_in_range_words_first(names: list[str]) -> None:
    codes = name_codes(names)
    assert codes.shape == (len(names), NAME_CODES)
    assert codes.dtype == np.int64
    assert ((codes >= 0) & (codes <= NAME_BUCKETS)).all()
    assert (codes == name_codes(names)).all()
    for row in codes:
        said = int((row > 0).sum())
        assert (row[:said] > 0).all()


def test_the_words_of_a_long_name_come_before_its_trigrams() -> None:
    assert pieces("shelf") & set(name_codes(["shelf " + "q" * 300])[0][:2].tolist())
