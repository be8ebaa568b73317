"""Confidence intervals against what is known of them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.evaluation.bootstrap import difference_of, mean_of, ratio_of


def test_of_many_draws_the_interval_is_that_of_the_normal_law() -> None:
    values = np.random.default_rng(5).normal(0.4, 0.2, 400)
    found = mean_of(values.tolist())
    assert found is not None
    half = 1.96 * float(values.std()) / 20
    assert found.value == pytest.approx(float(values.mean()))
    assert found.low == pytest.approx(found.value - half, abs=0.05 * half * 2)
    assert found.high == pytest.approx(found.value + half, abs=0.05 * half * 2)


def test_two_objects_give_the_known_quarters() -> None:
    found = mean_of([0.0, 1.0])
    assert found is not None
    assert (found.value, found.low, found.high, found.count) == (0.5, 0.0, 1.0, 2)


def test_nothing_gives_no_figure() -> None:
    assert mean_of([]) is None
    assert ratio_of([0.0], [0.0]) is None


def test_a_ratio_weighs_objects_by_their_parts() -> None:
    found = ratio_of([1.0, 8.0], [1.0, 8.0])
    assert found is not None
    assert (found.value, found.low, found.high) == (1.0, 1.0, 1.0)
    mixed = ratio_of([0.0, 8.0], [2.0, 8.0])
    assert mixed is not None
    assert mixed.value == pytest.approx(0.8)


def test_a_difference_is_paired() -> None:
    rng = np.random.default_rng(1)
    earlier = rng.random(50)
    found = difference_of((earlier + 0.01).tolist(), earlier.tolist())
    assert found is not None
    assert found.low == pytest.approx(0.01)
    assert found.high == pytest.approx(0.01)


@given(st.lists(st.floats(0.0, 1.0), min_size=1, max_size=12))
def test_the_same_values_give_the_same_interval_around_the_mean(values: list[float]) -> None:
    found = mean_of(values)
    assert found == mean_of(values)
    assert found is not None
    assert min(values) - 1e-9 <= found.low <= found.value + 1e-9
    assert found.value - 1e-9 <= found.high <= max(values) + 1e-9


def test_columns_of_other_lengths_are_refused() -> None:
    with pytest.raises(ValueError, match="as many"):
        ratio_of([1.0], [1.0, 2.0])
