"""The learning rate: up evenly, down along a cosine, zero at the end."""

import pytest

from grafu.training.schedule import rate_at


def test_it_rises_and_falls_to_zero() -> None:
    rates = [rate_at(step, 100, 10) for step in range(101)]
    assert rates[:11] == sorted(rates[:11])
    assert rates[10] == 1.0
    assert rates[10:] == sorted(rates[10:], reverse=True)
    assert rates[100] == pytest.approx(0.0)
    assert rate_at(55, 100, 10) == pytest.approx(0.5)


def test_a_period_beyond_the_end_never_comes_to_zero() -> None:
    assert rate_at(119, 120, 0, 450) == pytest.approx(0.837, abs=0.01)  # the authors stop at 83 % of the peak
