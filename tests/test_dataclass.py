"""A class of `grafu.dataclass` is one of the standard library: each behaviour of the two is compared."""

import copy
import dataclasses
import inspect
import pickle
from collections.abc import Callable
from functools import cached_property
from itertools import product
from typing import Any, ClassVar

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.dataclass import dataclass

Maker = Callable[..., Any]
VALUES = st.integers(-3, 3) | st.text(max_size=2)
SETS = [dict(zip(("slots", "eq", "repr"), chosen, strict=True)) for chosen in product((True, False), repeat=3)]
NAMES = st.sampled_from(["first", "second", "own", "third"])
TWICE_AS_OFTEN_AS_BY_HAND = 128


def made(decorate: Maker, **options: bool) -> type:
    """Returns a class with two fields, a default, and a list of its own, which is not compared."""

    @decorate(frozen=True, **options)
    class Given:
        """Given."""

        first: object
        second: object = 2
        own: list[int] = dataclasses.field(default_factory=list, compare=False)

        def __post_init__(self) -> None:
            self.own.append(1)

    return Given


def made_with_a_sum(decorate: Maker, **options: bool) -> type:
    """Returns a class with a field that is worked out, and one that is given by its name alone."""

    @decorate(frozen=True, **options)
    class Given:
        """Given."""

        first: object
        second: object = 2
        own: list[int] = dataclasses.field(default_factory=list, kw_only=True)
        total: str = dataclasses.field(init=False, repr=False, default="")

        def __post_init__(self) -> None:
            object.__setattr__(self, "total", f"{self.first}{self.second}")

    return Given


def outcome(make: Callable[[], object]) -> object:
    """Returns what is made, or the kind of the error and its words."""
    try:
        return make()
    except (TypeError, AttributeError) as error:
        return type(error), str(error)


@pytest.mark.parametrize("make", [made, made_with_a_sum])
@pytest.mark.parametrize("options", [*SETS, {"kw_only": True}, {"kw_only": True, "slots": True}], ids=str)
@given(args=st.lists(VALUES, max_size=4), kwargs=st.dictionaries(NAMES, VALUES))
def test_it_takes_and_refuses_what_the_standard_library_does(
    make: Maker, options: dict[str, bool], args: list[object], kwargs: dict[str, object]
) -> None:
    classes = make(dataclass, **options), make(dataclasses.dataclass, **options)
    names = [field.name for field in dataclasses.fields(classes[0])]

    def values_of(cls: type) -> list[object]:
        value = cls(*args, **kwargs)
        return [getattr(value, name) for name in names]

    ours, theirs = (outcome(lambda cls=cls: values_of(cls)) for cls in classes)

    assert ours == theirs


@pytest.mark.parametrize("options", SETS, ids=str)
def test_values_stay_the_same_when_their_class_is_compiled(options: dict[str, bool]) -> None:
    ours, theirs = made(dataclass, **options), made(dataclasses.dataclass, **options)
    waiting = ours.__init__

    values = [(ours(n, second=n), theirs(n, second=n)) for n in range(TWICE_AS_OFTEN_AS_BY_HAND)]

    assert ours.__init__ is not waiting
    for mine, other in values:
        assert (mine.first, mine.second, mine.own) == (other.first, other.second, other.own)
        assert not options["repr"] or repr(mine) == repr(other)
        assert (mine == ours(mine.first, mine.second)) is options["eq"]
        assert (hash(mine) == hash(ours(mine.first, mine.second))) is options["eq"]
    assert len({mine for mine, _ in values}) == len(values)
    assert inspect.signature(ours) == inspect.signature(theirs)


@pytest.mark.parametrize("slots", [True, False])
def test_it_is_a_dataclass_to_those_who_ask(slots: bool) -> None:
    ours, theirs = made(dataclass, slots=slots), made(dataclasses.dataclass, slots=slots)

    assert inspect.signature(ours) == inspect.signature(theirs)
    assert dataclasses.is_dataclass(ours)
    assert [f.name for f in dataclasses.fields(ours)] == [f.name for f in dataclasses.fields(theirs)]
    assert repr(ours.__dataclass_params__) == repr(theirs.__dataclass_params__)
    assert ours.__match_args__ == theirs.__match_args__
    assert hasattr(ours, "__slots__") is hasattr(theirs, "__slots__")
    assert dataclasses.replace(ours(1), second=3) == ours(1, 3)
    assert dataclasses.asdict(ours(1)) == dataclasses.asdict(theirs(1))


@pytest.mark.parametrize("slots", [True, False])
def test_a_value_cannot_be_changed(slots: bool) -> None:
    value = made(dataclass, slots=slots)(1)

    for change in (
        lambda: setattr(value, "first", 2),
        lambda: setattr(value, "other", 2),
        lambda: delattr(value, "first"),
    ):
        with pytest.raises(dataclasses.FrozenInstanceError, match=r"cannot (assign to|delete) field"):
            change()
    assert value.first == 1


@dataclass(frozen=True, slots=True)
class Slotted:
    """With slots."""

    first: int
    names: tuple[str, ...] = ()


@dataclass(frozen=True)
class Base:
    """With a dictionary, and something worked out once."""

    first: int

    @cached_property
    def double(self) -> int:
        """Twice the first."""
        return 2 * self.first


@dataclass(frozen=True)
class Derived(Base):
    """With a field more, and its own words."""

    second: int = 0

    def __repr__(self) -> str:
        return "own words"


@dataclass(frozen=True, eq=False)
class Alone:
    """Equal to itself alone."""

    first: int


@dataclass(frozen=True)
class OwnEquality:
    """Equal to all of its kind."""

    first: int

    def __eq__(self, other: object) -> bool:
        return isinstance(other, OwnEquality)


@dataclass(frozen=True)
class OwnHash:
    """With a hash of its own."""

    first: int

    def __hash__(self) -> int:
        return 7


@pytest.mark.parametrize("value", [Slotted(1, ("a",)), Base(1), Derived(1, 2), OwnHash(1)], ids=repr)
def test_a_value_is_pickled_and_copied(value: object) -> None:
    for other in (pickle.loads(pickle.dumps(value)), copy.copy(value), copy.deepcopy(value)):
        assert other == value
        assert hash(other) == hash(value)
        assert type(other) is type(value)


def test_a_derived_class_has_all_fields_and_keeps_what_it_states_itself() -> None:
    value = Derived(1, second=3)

    assert (value.first, value.second, value.double, repr(value)) == (1, 3, 2, "own words")
    assert value != Base(1)
    assert Base(1) != value
    with pytest.raises(dataclasses.FrozenInstanceError):
        value.second = 4  # type: ignore[misc]


def test_equality_and_hash_of_its_own_are_kept() -> None:
    assert OwnEquality(1) == OwnEquality(2)
    assert hash(OwnEquality(1)) == hash((1,))
    assert hash(OwnHash(1)) == 7
    assert Alone(1) != Alone(1)
    assert hash(Alone(1)) != hash(Alone(1)) or Alone(1) is not Alone(1)


def test_the_plain_and_the_ordered_form_are_those_of_the_standard_library() -> None:
    @dataclass
    class Plain:
        first: int = 1

    @dataclass(frozen=True, order=True)
    class Ordered:
        first: int

    plain = Plain()
    plain.first = 2

    assert (plain, Ordered(1) < Ordered(2)) == (Plain(2), True)


def test_nothing_is_compiled_before_it_is_needed() -> None:
    @dataclass(frozen=True)
    class Waiting:
        first: int = 1

    methods = {name: vars(Waiting)[name] for name in ("__init__", "__repr__", "__eq__", "__hash__")}

    def compiled() -> set[str]:
        return {name for name, method in methods.items() if vars(Waiting)[name] is not method}

    first, second = Waiting(), Waiting(2)
    assert compiled() == set()
    assert first != second
    assert compiled() == {"__eq__"}
    assert repr(first) != repr(second)
    assert compiled() == {"__eq__", "__repr__"}
    assert len({first, second}) == 2
    assert compiled() == {"__eq__", "__repr__", "__hash__"}


@dataclass(frozen=True, slots=True)
class WithRecords:
    """With records of fields, of which one has a default."""

    first: int
    second: int = dataclasses.field(default=2, repr=False)
    own: list[int] = dataclasses.field(default_factory=list)


def test_records_of_fields_are_made_when_they_are_asked_for() -> None:
    @dataclass(frozen=True)
    class Waiting:
        """Waiting."""

        first: int = 1

    waiting = vars(Waiting)["__dataclass_fields__"]
    assert Waiting().first == 1
    assert vars(Waiting)["__dataclass_fields__"] is waiting

    [field] = dataclasses.fields(Waiting)

    assert (field.name, field.type, field.default) == ("first", int, 1)
    assert vars(Waiting)["__dataclass_fields__"] == {"first": field}


def test_records_are_asked_for_by_a_class_that_is_derived_from_one_that_has_none_yet() -> None:
    @dataclass(frozen=True)
    class First:
        """First."""

        first: int = 1

    class Plain(First):
        """No dataclass."""

    @dataclass(frozen=True)
    class Second(First):
        """Second."""

        second: int = 2

    assert [field.name for field in dataclasses.fields(Plain)] == ["first"]
    assert "__dataclass_fields__" not in vars(Plain)
    assert [field.name for field in dataclasses.fields(Second)] == ["first", "second"]


def test_records_state_defaults_and_each_value_has_a_list_of_its_own() -> None:
    one, other = WithRecords(1), WithRecords(1)

    one.own.append(3)

    assert (one.second, other.own, WithRecords(1, 2, [3]) == one) == (2, [], True)
    assert repr(other) == "WithRecords(first=1, own=[])"


def made_with_a_list(decorate: Maker) -> type:
    """Returns a class whose default would be one list for all values."""

    @decorate(frozen=True)
    class Given:
        """Given."""

        own: list[int] = []  # noqa: RUF012

    return Given


def made_without_a_type(decorate: Maker) -> type:
    """Returns a class with a record that no type belongs to."""

    @decorate(frozen=True)
    class Given:
        """Given."""

        own = dataclasses.field(default=1)

    return Given


def made_with_slots_twice(decorate: Maker) -> type:
    """Returns a class that states its slots itself."""

    @decorate(frozen=True, slots=True)
    class Given:
        """Given."""

        __slots__ = ("first",)
        first: int

    return Given


@pytest.mark.parametrize("make", [made_with_a_list, made_without_a_type, made_with_slots_twice])
def test_what_the_standard_library_refuses_is_refused_with_its_words(make: Maker) -> None:
    said = []
    for decorate in (dataclass, dataclasses.dataclass):
        with pytest.raises((TypeError, ValueError)) as refused:
            make(decorate)
        said.append((type(refused.value), str(refused.value)))

    assert said[0] == said[1]


@pytest.mark.parametrize("slots", [True, False])
def test_what_belongs_to_the_class_is_no_field(slots: bool) -> None:
    @dataclass(frozen=True, slots=slots)
    class Given:
        """Given."""

        first: int
        shared: ClassVar[int] = 3
        other: "ClassVar[int]" = 4

    assert [field.name for field in dataclasses.fields(Given)] == ["first"]
    assert (Given(1).shared, Given.shared, Given(1).other) == (3, 3, 4)


@pytest.mark.parametrize("slots", [True, False])
def test_fields_after_a_mark_are_given_by_name_alone(slots: bool) -> None:
    @dataclass(frozen=True, slots=slots)
    class Given:
        """Given."""

        first: int
        _: dataclasses.KW_ONLY
        second: int = 2

    with pytest.raises(TypeError, match="positional"):
        Given(1, 3)  # type: ignore[misc]
    assert Given(1, second=3).second == 3
    assert Given.__match_args__ == ("first",)
