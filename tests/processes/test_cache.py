"""Cache values: found for equal content, made for any other, the oldest gone first."""

from dataclasses import dataclass, field, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.plan import AUTOMATIC, JointChoice
from grafu.processes.cache import NO_CACHE, Cache, content_key
from grafu.vocabulary import JointType, PartLabel


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


PLAIN = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats(allow_nan=False)
    | st.text(max_size=5)
    | st.binary(max_size=5),
    lambda inner: st.lists(inner, max_size=3).map(tuple) | st.dictionaries(st.text(max_size=3), inner, max_size=3),
    max_leaves=8,
)


def cube(side=1.0):
    return TriangleMesh.box_mesh(Box(vec3(0.0, 0.0, 0.0), vec3(side, 1.0, 1.0)))


@dataclass(frozen=True)
class WithCache:
    number: int
    _found: dict = field(default_factory=dict)


@given(PLAIN, PLAIN)
def test_keys_are_equal_exactly_where_the_content_is(one, other):
    assert (content_key(one) == content_key(other)) == (repr(one) == repr(other))


def test_values_made_apart_have_one_key():
    assert cube() is not cube()
    assert content_key(cube()) == content_key(cube())
    assert content_key((cube(), JointChoice(count=3))) == content_key((cube(), JointChoice(count=3)))


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (1, 1.0),
        (1, True),
        ("1", 1),
        (b"1", "1"),
        (("ab", "c"), ("a", "bc")),
        (((),), ()),
        ({"a": 1, "b": 2}, {"b": 2, "a": 1}),
        (0.0, -0.0),
        (JointType.REVOLUTE, JointType.PRISMATIC),
        (PartLabel.DOOR, PartLabel.DOOR.value),
        (AUTOMATIC, JointChoice(opening=1.0)),
        (np.zeros(3), np.zeros((3, 1))),
        (np.zeros(2), np.zeros(2, np.float32)),
        (np.zeros(2), np.array([0.0, 1e-300])),
        (cube(), cube(1.0 + 1e-15)),
    ],
)
def test_the_least_difference_shows(one, other):
    assert content_key(one) != content_key(other)


def test_sets_have_no_order_and_what_was_worked_out_is_no_content():
    assert content_key(frozenset("abc")) == content_key(frozenset("cba"))
    assert content_key(WithCache(1, {1: 2})) == content_key(WithCache(1))
    mesh = cube()
    before = content_key(mesh)
    assert mesh.box.size.shape == (3,)
    assert content_key(mesh) == before == content_key(cube())


def test_a_key_does_not_outlive_its_value():
    keys = set()
    for k in range(200):  # ids are given out again
        keys.add(content_key(cube(1.0 + k)))
    assert len(keys) == 200


def test_arrays_seen_from_a_stride_count_by_what_they_hold():
    array = np.arange(12.0).reshape(3, 4)
    assert content_key(array[:, ::2]) == content_key(array[:, ::2].copy())


def test_functions_are_themselves():
    assert content_key(len) == content_key(len)
    assert content_key(len) != content_key(max)
    assert content_key(replace(AUTOMATIC)) == content_key(AUTOMATIC)


def test_slotted_dataclasses_of_a_python_that_leaves_a_foreign_descriptor_in_them_have_keys():
    @dataclass(frozen=True, slots=True)
    class Slotted:  # as Python 3.11.0 to 3.11.2 make it, whose `__weakref__` is of another class
        size: int

    Slotted.__weakref__ = vars(type("Other", (), {}))["__weakref__"]
    with pytest.raises(TypeError):
        hasattr(Slotted(1), "__weakref__")
    assert content_key(Slotted(1)) == content_key(Slotted(1)) != content_key(Slotted(2))
