"""Values that hold arrays: no one writes to them, and they compare by what they hold."""

import pickle
from dataclasses import dataclass
from typing import final

import numpy as np
import pytest

from grafu.geometry.arrays import (
    ArrayValue,
    cross,
    distinct,
    extremes,
    first_of_each,
    freeze_arrays,
    median,
    renumbered,
    row_medians,
    without,
)

RNG = np.random.default_rng(3)


@final
@dataclass(frozen=True, eq=False, slots=True)
class Sample(ArrayValue):
    name: str
    numbers: np.ndarray
    codes: np.ndarray

    def __post_init__(self) -> None:
        freeze_arrays(self, "codes", dtype=np.uint8)
        freeze_arrays(self)


def sample() -> Sample:
    return Sample("one", np.arange(3, dtype=np.float32), np.arange(3))


def test_a_value_keeps_copies_of_its_arrays() -> None:
    given = np.arange(3.0)
    kept = Sample("one", given, given)
    given[0] = 7.0
    assert kept.numbers[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        kept.numbers[0] = 7.0


def test_named_arrays_take_a_type_and_others_keep_theirs() -> None:
    assert (sample().numbers.dtype, sample().codes.dtype) == (np.float32, np.uint8)
    assert sample().name == "one"


def test_what_is_frozen_already_is_not_copied_again() -> None:
    assert Sample("two", sample().numbers, (codes := sample().codes)).codes is codes


def test_values_compare_by_content_and_travel() -> None:
    assert pickle.loads(pickle.dumps(sample())) == sample()
    assert len({sample(), sample()}) == 1
    assert sample() != Sample("two", sample().numbers, sample().codes)


@pytest.mark.parametrize("order", ["C", "F"])
def test_extremes_are_those_of_each_column(order: str) -> None:
    rows = np.asarray(np.random.default_rng(0).normal(size=(50, 3)), order=order)
    low, high = extremes(rows)
    np.testing.assert_array_equal(low, rows.min(axis=0))
    np.testing.assert_array_equal(high, rows.max(axis=0))
    with pytest.raises(ValueError, match="zero-size"):
        extremes(rows[:0])


@pytest.mark.parametrize("values", [[3.0], [1, 2], [0.1, 0.2, 0.4], [5.0, 1.0, 4.0, 2.0], [np.inf, 1.0], [True, False]])
def test_the_median_is_that_of_numpy(values: list[float]) -> None:
    assert median(values) == np.median(values)
    assert median(np.asarray(values)) == np.median(values)


def test_the_median_of_many_is_that_of_numpy_to_the_last_digit() -> None:
    rng = np.random.default_rng(1)
    for count in range(1, 60):
        values = rng.normal(size=count)
        assert median(values) == np.median(values)
    assert np.isnan(median([1.0, np.nan]))


def test_cross_products_are_those_of_numpy_to_the_last_digit() -> None:
    first, second = np.random.default_rng(2).normal(size=(2, 40, 3))
    np.testing.assert_array_equal(cross(first, second), np.cross(first, second))
    np.testing.assert_array_equal(cross(first, second[0]), np.cross(first, second[0]))
    assert cross(first[:0], second[:0]).shape == (0, 3)


@pytest.mark.parametrize(("faces", "count"), [(0, 5), (1, 1), (40, 30), (40, 2000), (3000, 900)])
def test_rows_that_are_named_are_numbered_as_numpy_does_by_sorting(faces: int, count: int) -> None:
    named = np.random.default_rng(faces).integers(0, count, (faces, 3))
    rows, number = renumbered(named, count)
    expected, inverse = np.unique(named, return_inverse=True)
    np.testing.assert_array_equal(rows, expected)
    np.testing.assert_array_equal(number, inverse.reshape(faces, 3))


@pytest.mark.parametrize("dtype", [np.int64, np.uint64])
@pytest.mark.parametrize("count", [0, 1, 7, 5000])
def test_the_first_of_each_key_is_that_of_numpy(count: int, dtype: type) -> None:
    keys = np.random.default_rng(count).integers(0, 2**62, 50)[np.random.default_rng(1).integers(0, 50, count)]
    _, first, number = np.unique(keys.astype(dtype), return_index=True, return_inverse=True)
    found = first_of_each(keys.astype(dtype))
    np.testing.assert_array_equal(found[0], first)
    np.testing.assert_array_equal(found[1], number)


@pytest.mark.parametrize("shape", [(3, 4), (40, 301), (5, 700), (50, 1), (0, 5), (4, 0)])
@pytest.mark.parametrize("missing", [0.0, 0.3, 0.9])
def test_medians_of_rows_are_those_of_numpy_to_the_last_digit(shape: tuple[int, int], missing: float) -> None:
    rows = RNG.normal(size=shape)
    rows[RNG.random(shape) < missing] = np.nan
    given_ = rows[~np.isnan(rows).all(axis=1)]

    assert np.array_equal(row_medians(rows), np.nanmedian(given_, axis=1) if given_.size else np.zeros(0))


@pytest.mark.parametrize("count", [0, 1, 2, 100])
@pytest.mark.parametrize("dtype", [np.int64, np.int32, np.bool_, np.float64])
def test_what_is_distinct_is_what_numpy_says(count: int, dtype: type) -> None:
    numbers = RNG.integers(0, 20, (count, 3)).astype(dtype)

    assert np.array_equal(distinct(numbers), np.unique(numbers))
    assert distinct(numbers).dtype == dtype


def test_numbers_without_others_are_those_of_numpy() -> None:
    numbers = np.arange(30)

    for others in (np.array([3, 40, 3]), [], [0, 29]):
        assert np.array_equal(without(numbers, others), np.setdiff1d(numbers, others))
