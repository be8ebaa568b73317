"""Kept values: found for equal content, made for any other, the oldest gone first."""

import pytest

from grafu.realization.kept import NOTHING_KEPT, Kept
from grafu.realization.plan import JointChoice


def test_a_value_is_made_once_for_one_content():
    kept = Kept(4)
    first = kept.value("list", list, (1, 2))
    assert kept.value("list", list, (1, 2)) is first
    assert kept.value("list", list, (1, 3)) == [1, 3]
    assert kept.value("set", set, (1, 2)) == {1, 2}
    assert kept.made == {"list": 2, "set": 1}


def test_the_name_stands_for_the_function():
    kept = Kept(4)
    assert kept.value("least", min, (3, 4)) == 3
    assert kept.value("most", max, (3, 4)) == 4


def test_what_was_not_asked_for_longest_goes_first():
    kept = Kept(2)
    for number in (1, 2, 1, 3):
        kept.value("str", str, number)
    kept.value("str", str, 1)
    assert kept.made == {"str": 3}
    kept.value("str", str, 2)
    assert kept.made == {"str": 4}


def test_what_fails_is_not_kept():
    kept = Kept(2)
    for _ in range(2):
        with pytest.raises(ValueError, match="scale"):
            kept.value("choice", lambda scale: JointChoice(scale=scale), 99.0)
    assert kept.value("choice", lambda scale: JointChoice(scale=scale), 2.0).scale == 2.0


def test_what_keeps_nothing_makes_everything():
    first = NOTHING_KEPT.value("list", list, (1, 2))
    assert NOTHING_KEPT.value("list", list, (1, 2)) is not first
    assert NOTHING_KEPT.made == {}
