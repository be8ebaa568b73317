"""Folds depend on seed, model and number alone; splits on the ids alone."""

from collections import Counter
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.data.corruption.config import PAPER, CorruptionConfig
from grafu.data.corruption.corrupt import FOLDS, fold, folded
from grafu.data.furfun.split import Split, split_models, split_of
from grafu.data.pair import GraphPair, natural_pair
from grafu.graph.edges import ends_of
from grafu.graph.edit import as_contacts, without_contacts
from small_graphs import cabinet

OTHER = replace(cabinet(), model_id="other")


def test_each_model_gives_its_natural_pair_and_seventeen_more():
    pairs = list(folded([cabinet(), natural_pair(OTHER)]))
    assert len(pairs) == 2 * (1 + FOLDS) == 36
    assert [p.strategy for p in pairs].count("natural") == 2
    assert Counter(p.model_id for p in pairs) == {"cabinet": 18, "other": 18}


def test_folds_do_not_depend_on_order_or_on_what_else_is_there():
    a, b = list(folded([cabinet(), OTHER], 5, seed=3)), list(folded([OTHER, cabinet()], 5, seed=3))
    assert a[:6] == b[6:]
    assert a[6:] == b[:6]
    assert list(folded([OTHER], 2, seed=3)) == b[:3]
    assert fold(natural_pair(OTHER), 1, seed=3) == b[2]


def test_folds_differ_by_seed_model_and_number():
    masked = CorruptionConfig(weights=(("mask_materials_keep_edges", 1e9),))  # one strategy, a great many outcomes
    pairs = [natural_pair(replace(cabinet(), model_id=name)) for name in "ab"]
    numbers = [(pair, number, seed) for pair in pairs for number in (0, 1) for seed in (0, 1)]
    inputs = [replace(fold(*which, masked).input, model_id="any") for which in numbers]
    assert all(a != b for k, a in enumerate(inputs) for b in inputs[:k])


def test_parts_that_do_not_touch_touch_in_no_fold():
    apart = frozenset([frozenset(["right", "drawer_2"])])
    target = cabinet()
    natural = GraphPair(without_contacts(as_contacts(target), apart), target, "natural", "cabinet")
    folds = [fold(natural, number) for number in range(60)]
    contacts = [frozenset(ends_of(c)) for pair in folds for c in pair.input.contacts]
    assert natural.apart == apart
    assert frozenset(["left", "drawer_1"]) in contacts
    assert not apart & set(contacts)
    assert any(r.child == "drawer_2" for pair in folds for r in pair.input.rails)  # where kinds are kept, it is a rail


def test_without_folds_the_natural_pair_is_left_and_fewer_are_refused():
    assert list(folded([cabinet()], 0, config=PAPER)) == [natural_pair(cabinet())]
    with pytest.raises(ValueError, match="`folds` must not be negative"):
        next(folded([cabinet()], -1))


def test_a_split_is_80_10_10_by_model_and_does_not_depend_on_order():
    ids = [f"fur_{k:03d}" for k in range(1, 234)]
    split = split_models(ids)
    assert [len(part) for part in (split.train, split.val, split.test)] == [186, 24, 23]
    assert sorted(split.train + split.val + split.test) == ids
    assert split == split_models(reversed(ids))
    assert split != split_models(ids, seed=1)


@given(st.sets(st.text(min_size=1), max_size=30), st.integers(0, 5))
def test_a_split_holds_every_model_once(ids, seed):
    split = split_models(ids, seed)
    assert sorted(split.train + split.val + split.test) == sorted(ids)
    kept = split.only(list(ids)[:3])
    assert len(kept.train + kept.val + kept.test) == min(3, len(ids))


def test_a_stream_is_split_without_knowing_its_end():
    found = Counter(split_of(f"synth_0_{k:07d}") for k in range(5000))
    assert abs(found["train"] - 4000) < 150
    assert abs(found["val"] - 500) < 110
    assert split_of("fur_001") == split_of("fur_001")


def test_a_split_refuses_a_model_twice():
    with pytest.raises(ValueError, match="got `a` twice"):
        Split(("a",), ("b",), ("a",))
