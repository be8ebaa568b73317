"""Labels are hidden by number, the same for the same model and seed, and leave no way back."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from measured_cabinets import cabinet

from grafu.evaluation.methods import LEVELS, mask_order, masked
from grafu.vocabulary import PartLabel


def hidden(ratio: float, seed: int, name: str = "cabinet") -> set[str]:
    return {p.id for p in masked(cabinet(name=name), ratio, seed).parts if p.label is PartLabel.UNKNOWN}


@given(st.sampled_from(LEVELS), st.integers(0, 10))
def test_as_many_as_asked_for_are_hidden(ratio: float, seed: int) -> None:
    assert len(hidden(ratio, seed)) == round(ratio * len(cabinet().parts))


def test_the_same_seed_hides_the_same_and_others_differ() -> None:
    assert hidden(0.5, 3) == hidden(0.5, 3)
    assert len({frozenset(hidden(0.5, seed)) for seed in range(5)}) > 1
    assert len({frozenset(hidden(0.5, 0, name)) for name in "abcde"}) > 1


@given(st.integers(0, 20))
def test_what_is_hidden_at_a_lower_fraction_is_hidden_at_every_higher_one(seed: int) -> None:
    assert hidden(0.1, seed) <= hidden(0.3, seed) <= hidden(0.5, seed) <= hidden(1.0, seed)


def test_nothing_says_what_was_hidden() -> None:
    asset = masked(cabinet(), 1.0, 0)
    assert asset.joints == ()
    assert {p.carried_by for p in asset.parts} == {None}
    assert {p.label for p in asset.without_annotation().parts} == {PartLabel.UNKNOWN}


def test_the_order_of_parts_does_not_decide_what_is_hidden() -> None:
    asset = cabinet()
    turned = replace(asset, parts=tuple(reversed(asset.parts)))
    assert mask_order(turned, 1) == mask_order(asset, 1)
    assert sorted(mask_order(asset, 1)) == sorted(p.id for p in asset.parts)


@pytest.mark.parametrize("ratio", [-0.1, 1.1])
def test_a_fraction_is_a_fraction(ratio: float) -> None:
    with pytest.raises(ValueError, match="ratio"):
        masked(cabinet(), ratio, 0)
