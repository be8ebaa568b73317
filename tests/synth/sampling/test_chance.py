import numpy as np
import pytest

from grafu.synth.sampling.chance import between, chance, count, only, pick, weights


def rng():
    return np.random.default_rng(0)


def test_words_come_by_their_weight():
    draw = rng()
    drawn = [pick(draw, {"a": 3.0, "b": 1.0, "c": 0.0}) for _ in range(2000)]
    assert drawn.count("c") == 0
    assert 0.71 < drawn.count("a") / 2000 < 0.79


def test_an_empty_table_is_refused():
    with pytest.raises(ValueError, match="must hold a weight above 0"):
        pick(rng(), {"a": 0.0})


def test_numbers_keep_to_their_bounds():
    draw = rng()
    assert all(0.2 <= between(draw, (0.2, 0.3)) <= 0.3 for _ in range(50))
    assert {count(draw, 1, 3) for _ in range(50)} == {1, 2, 3}
    assert not chance(draw, 0.0)


def test_what_is_allowed_keeps_its_weight_or_shares_alike():
    table = {"a": 3.0, "b": 1.0}
    assert only(table, ("a", "c")) == {"a": 3.0}
    assert only(table, ("c", "d")) == {"c": 1.0, "d": 1.0}


def test_weights_spread_about_one():
    assert weights(rng(), 3) == ()
    assert all(0.7 <= w <= 1.3 for w in weights(rng(), 50, 0.3))
