"""Groups of near-duplicates: what pairs within the radius connect, whatever the order; and their splits."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.dataset.config import DescriptorConfig
from grafu.dataset.near_duplicates import group_names, near_duplicates
from grafu.dataset.splits import SPLITS, SplitRatio, splits_of
from grafu.errors import OptionError

CONFIG = DescriptorConfig(radius=1.0, tree_axes=2)


def by_pairs(points: np.ndarray) -> set[frozenset[int]]:
    """Returns the groups, from every pair."""
    groups = [{k} for k in range(len(points))]
    for i in range(len(points)):
        for j in range(i):
            if np.linalg.norm(points[i] - points[j]) <= CONFIG.radius:
                joined = groups[i] | groups[j]
                for k in joined:
                    groups[k] = joined
    return {frozenset(group) for group in groups}


def parted(numbers: np.ndarray) -> set[frozenset[int]]:
    return {frozenset(np.flatnonzero(numbers == number).tolist()) for number in set(numbers.tolist())}


points = st.lists(st.tuples(*[st.integers(-6, 6)] * 4), max_size=30)


@given(points)
def test_groups_are_those_that_all_pairs_give(drawn) -> None:
    rows = np.array(drawn, dtype=np.float32).reshape(-1, 4) * 0.45

    assert parted(near_duplicates(rows, CONFIG)) == by_pairs(rows)


@given(points, st.randoms())
def test_a_group_has_the_same_name_in_any_order(drawn, random) -> None:
    rows = np.array(drawn, dtype=np.float32).reshape(-1, 4)
    order = random.sample(range(len(rows)), len(rows))

    names = group_names(rows, near_duplicates(rows, CONFIG))
    assert group_names(rows[order], near_duplicates(rows[order], CONFIG)) == [names[k] for k in order]


def test_a_chain_of_near_ones_is_one_group_and_many_equal_ones_take_no_time() -> None:
    chain = np.arange(5, dtype=np.float32)[:, None] * np.array([[0.9, 0, 0]], dtype=np.float32)
    equal = np.full((20_000, 3), 50.0, dtype=np.float32)

    found = near_duplicates(np.concatenate([chain, equal]), CONFIG)
    assert len(set(found[:5].tolist())) == 1
    assert len(set(found.tolist())) == 2


def test_splits_follow_the_ratio() -> None:
    drawn = [SplitRatio().split_of(f"{k:x}", 0) for k in range(4000)]

    assert [round(drawn.count(name) / len(drawn), 1) for name in SPLITS] == [0.8, 0.1, 0.1]
    assert {SplitRatio((0.0, 0.0, 100.0)).split_of(f"{k}", 0) for k in range(50)} == {"test"}


def test_a_group_lies_in_one_split_and_another_seed_draws_anew() -> None:
    groups, hashes = ["a", "b", "a", "a"], ["7", "3", "1", "9"]

    for seed in range(20):
        found = splits_of(groups, hashes, SplitRatio((50.0, 25.0, 25.0)), seed)
        assert len({found[k] for k in (0, 2, 3)}) == 1
        assert found[0] == SplitRatio((50.0, 25.0, 25.0)).split_of("1", seed)
    assert len({SplitRatio().split_of("x", seed) for seed in range(50)}) > 1


@given(st.dictionaries(st.text("abc", min_size=1), st.text("0123456789abcdef", min_size=1), min_size=2))
def test_more_groups_move_no_model(hash_of_group) -> None:
    groups, hashes = list(hash_of_group), list(hash_of_group.values())

    alone = splits_of(groups[:1], hashes[:1], SplitRatio(), 3)
    assert splits_of(groups, hashes, SplitRatio(), 3)[:1] == alone


@pytest.mark.parametrize("percents", [(80.0, 10.0), (80.0, 10.0, 20.0), (110.0, -10.0, 0.0), ()])
def test_percentages_that_do_not_add_up_are_refused(percents) -> None:
    with pytest.raises(OptionError, match="add up to 100"):
        SplitRatio(percents)


def test_what_was_in_a_split_before_stays_there_with_its_group() -> None:
    groups, hashes = ["a", "b", "a", "c", "c", "c"], ["7", "3", "1", "9", "8", "7"]
    earlier = ["", "test", "validation", "train", "test", "test"]

    for seed in range(10):
        found = splits_of(groups, hashes, SplitRatio(), seed, earlier)
        assert found == ["validation", "test", "validation", "test", "test", "test"]
