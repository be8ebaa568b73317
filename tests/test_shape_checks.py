"""The checks of shapes that all tests run under refuse what jaxtyping's own decorator refuses, and nothing else."""

import sys
from collections.abc import Callable, Iterator
from functools import partial
from inspect import signature

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from jaxtyping import Float, Int, TypeCheckError

import shape_checks
from grafu.geometry.arrays import Points, Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import transform_points
from shape_checks import EVERY, FIRST, FIRST_MADE, checked, fits, fits_as_usual, typed, usual

Numbers = Float[np.ndarray, " n"]


def fixed(point: Vec3, times: float = 1.0) -> Vec3:
    return point * times


def named(left: Numbers, right: Float[np.ndarray, "n m"]) -> Float[np.ndarray, " m"]:
    return left @ right


def counted(values: Numbers, *more: Points) -> Int[np.ndarray, " n"]:
    return np.arange(2)


def listed(values: list[Numbers], among: "Numbers | None" = None) -> tuple[Numbers, ...]:
    return tuple(values)


def lone(rows: Float[np.ndarray, "n 3"], turned: Float[np.ndarray, "2 m"]) -> Float[np.ndarray, " k"]:
    return rows @ np.ones(3)


def several(*rows: Float[np.ndarray, "n 3"]) -> tuple[Float[np.ndarray, "_ m"], ...]:
    return rows


def symbolic(values: Numbers) -> Float[np.ndarray, " n+1"]:
    return np.zeros(4)


def called(how: Callable[[Numbers], Numbers], values: Float[np.ndarray, "_ 3"]) -> object:
    return how


def running(values: Numbers) -> Iterator[Numbers]:
    yield values[:1]


def early(value: "NotYet") -> "NotYet":  # noqa: F821  # a hint that cannot be resolved passes
    return value


FUNCTIONS = (fixed, named, counted, listed, lone, several, symbolic, called, running, early)
PAIRS = {f: (checked(f, typechecker=typed), usual(f, typechecker=typed)) for f in FUNCTIONS}

lengths = st.integers(0, 4)
values = st.one_of(
    st.builds(np.zeros, lengths),
    st.builds(np.zeros, st.tuples(lengths, lengths)),
    st.builds(lambda n: np.zeros(n, dtype=np.int64), lengths),
    st.lists(st.builds(np.zeros, lengths), max_size=1),
    st.sampled_from([None, 1, 2.0, "three", len]),
)


def refused(function: Callable[..., object], arguments: list[object]) -> bool | type:
    """Whether a check refuses the call; what the function itself raises, by its type."""
    try:
        function(*arguments)
    except TypeCheckError:
        return True
    except Exception as error:
        return type(error)
    return False


@pytest.mark.parametrize("function", FUNCTIONS)
@given(data=st.data())
def test_refused_is_what_jaxtyping_refuses(function: Callable[..., object], data: st.DataObject) -> None:
    ours, theirs = PAIRS[function]
    count = len(signature(function).parameters)
    arguments = data.draw(st.lists(values, min_size=count, max_size=count))
    assert refused(ours, arguments) == refused(theirs, arguments)


def test_one_name_is_one_size_within_a_call_alone() -> None:
    ours, _ = PAIRS[named]

    @partial(checked, typechecker=typed)
    def calls_another(left: Numbers) -> Numbers:
        return ours(np.zeros(5), np.zeros((5, len(left))))

    assert calls_another(np.zeros(3)).shape == (3,)
    with pytest.raises(TypeCheckError):
        ours(np.zeros(5), np.zeros((4, 3)))


HINTS = [kind[np.ndarray, dims] for kind in (Float, Int) for dims in ("3", "_ 3", "", "... 2", "_", "n", "n n", "2 n")]


@pytest.mark.parametrize("hint", HINTS)
@given(values)
def test_an_array_fits_where_it_fits_for_jaxtyping(hint: type, value: object) -> None:
    assert [fits(hint, value) for _ in range(2)] == [fits_as_usual(hint, value)] * 2  # also when it is known


def test_several_arrays_have_one_size_where_one_hint_names_it() -> None:
    ours, theirs = PAIRS[several]
    assert len(ours(np.zeros((2, 3)), np.zeros((2, 3)))) == 2
    for function in (ours, theirs):
        with pytest.raises(TypeCheckError):
            function(np.zeros((2, 3)), np.zeros((4, 3)))


@pytest.mark.parametrize("wrong", [np.zeros(2), np.zeros((3, 1)), np.zeros(3, dtype=np.int64), [0.0, 0.0, 0.0]])
def test_the_package_is_checked(wrong: object, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shape_checks, "FIRST", sys.maxsize)
    right = np.array([0.0, 0.0, 1.0])
    with pytest.raises(TypeCheckError):
        Axis(wrong, right)
    with pytest.raises(TypeCheckError):
        Axis(right, right).closest_point(wrong)
    with pytest.raises(TypeCheckError):
        transform_points(np.eye(4), wrong)


def test_what_is_called_often_is_checked_first_and_then_now_and_then() -> None:
    def whole(value: int) -> int:
        return value

    function = checked(whole, typechecker=typed)
    refusals = [refused(function, [0.5]) for _ in range(FIRST + 3 * EVERY)]
    assert refusals[:FIRST] == [True] * FIRST
    assert refusals[FIRST:].count(True) == 3


def test_what_is_made_often_within_another_is_checked_first_and_then_now_and_then() -> None:
    def made() -> Callable[..., object]:
        def whole(value: int) -> int:
            return value

        return checked(whole, typechecker=typed)

    refusals = [refused(made(), [0.5]) for _ in range(FIRST_MADE + 3 * EVERY)]
    assert refusals[:FIRST_MADE] == [True] * FIRST_MADE
    assert refusals[FIRST_MADE:].count(True) == 3
