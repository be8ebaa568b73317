"""Cache values: found for equal content, made for any other, the oldest gone first."""

import pytest

from grafu.realization.cache import NO_CACHE, Cache
from grafu.realization.plan import JointChoice


def test_a_value_is_made_once_for_one_content():
    cache = Cache(4)
    first = cache.value("list", list, (1, 2))
    assert cache.value("list", list, (1, 2)) is first
    assert cache.value("list", list, (1, 3)) == [1, 3]
    assert cache.value("set", set, (1, 2)) == {1, 2}
    assert cache.made == {"list": 2, "set": 1}


def test_the_name_stands_for_the_function():
    cache = Cache(4)
    assert cache.value("least", min, (3, 4)) == 3
    assert cache.value("most", max, (3, 4)) == 4


def test_what_was_not_asked_for_longest_goes_first():
    cache = Cache(2)
    for number in (1, 2, 1, 3):
        cache.value("str", str, number)
    cache.value("str", str, 1)
    assert cache.made == {"str": 3}
    cache.value("str", str, 2)
    assert cache.made == {"str": 4}


def test_what_fails_is_not_kept():
    cache = Cache(2)
    for _ in range(2):
        with pytest.raises(ValueError, match="scale"):
            cache.value("choice", lambda scale: JointChoice(scale=scale), 99.0)
    assert cache.value("choice", lambda scale: JointChoice(scale=scale), 2.0).scale == 2.0


def test_what_keeps_nothing_makes_everything():
    first = NO_CACHE.value("list", list, (1, 2))
    assert NO_CACHE.value("list", list, (1, 2)) is not first
    assert NO_CACHE.made == {}
