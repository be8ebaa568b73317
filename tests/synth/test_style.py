from collections import Counter

import numpy as np
import pytest

from grafu.synth.style import draw_style
from grafu.synth.traditions import TRADITIONS, mixed


def styles(name, draws=300):
    rng = np.random.default_rng(6)
    return [draw_style(rng, {name: 1.0}) for _ in range(draws)]


@pytest.mark.parametrize("name", sorted(TRADITIONS))
def test_a_style_takes_its_choices_from_its_tradition(name):
    rules = TRADITIONS[name]
    for style in styles(name, 40):
        assert style.tradition == name
        assert style.panel in rules.panel
        assert rules.leaf[style.leaf] > 0
        assert rules.gap[0] <= style.gap <= rules.gap[1]


def test_the_face_frame_is_what_american_kitchens_have():
    assert all(style.frame > 0 for style in styles("face frame"))
    assert not any(style.frame for style in styles("frameless"))


def test_about_one_barred_piece_in_six_carries_handles_that_say_nothing_about_the_hinge():
    carries = Counter(style.carry for name in ("frameless", "face frame", "office") for style in styles(name))
    share = carries["top line"] / sum(carries.values())
    assert 0.1 < share < 0.24


def test_grips_are_cut_into_slabs_alone():
    gripped = [style for name in TRADITIONS for style in styles(name, 100) if style.grip != "none"]
    assert gripped
    assert all(style.leaf == "slab" and style.handle == "none" for style in gripped)


def test_the_same_generator_state_draws_the_same_style():
    assert styles("ornate", 5) == styles("ornate", 5)


def test_mixed_tables_keep_their_shares():
    table = mixed((0.75, {"bar-round": 3.0, "ring": 1.0}), (0.25, {"ring": 2.0}))
    assert table == pytest.approx({"bar-round": 0.5625, "ring": 0.4375})
