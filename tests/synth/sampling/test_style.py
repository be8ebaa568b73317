from collections import Counter

import numpy as np
import pytest

from grafu.synth.sampling.style import LIGHT, LIGHT_FRONT, chunky, draw_style, pushed
from grafu.synth.sampling.traditions import TRADITIONS, mixed


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


@pytest.mark.parametrize(("names", "low", "high"), [(("frameless", "face frame"), 0.2, 0.33), (("office",), 0.1, 0.25)])
def test_bars_that_say_nothing_about_the_hinge_are_commonest_in_kitchens(names, low, high):
    carries = Counter(style.carry for name in names for style in styles(name))
    assert low < carries["top line"] / sum(carries.values()) < high


def test_pieces_without_handles_are_pushed_as_often_as_asked():
    rng = np.random.default_rng(7)
    drawn = [pushed(rng, style, 0.5) for style in styles("shaker", 200) if style.handle != "none"]
    assert 0.35 < np.mean([style.drawer_handle == "none" for style in drawn]) < 0.65


def test_thin_boards_have_thin_fronts_and_chunky_ones_are_thick():
    assert all(style.front <= LIGHT_FRONT for style in styles("face frame") if style.panel < LIGHT)
    rng = np.random.default_rng(8)
    assert all(chunky(rng, style, 1.0).panel >= 0.028 for style in styles("flat-pack", 20))


def test_bare_pieces_have_neither_frames_nor_mouldings():
    bare = [style for name in TRADITIONS for style in styles(name, 100) if style.bare]
    assert len(bare) > 50
    assert not any(style.frame or style.moulding or style.muntin or style.runners for style in bare)


def test_grips_are_cut_into_slabs_alone():
    gripped = [style for name in TRADITIONS for style in styles(name, 100) if style.grip != "none"]
    assert gripped
    assert all(style.leaf == "slab" and style.handle == "none" for style in gripped)


def test_the_same_generator_state_draws_the_same_style():
    assert styles("ornate", 5) == styles("ornate", 5)


def test_mixed_tables_keep_their_fractions():
    table = mixed((0.75, {"bar-round": 3.0, "ring": 1.0}), (0.25, {"ring": 2.0}))
    assert table == pytest.approx({"bar-round": 0.5625, "ring": 0.4375})


def test_edge_bands_are_drawn_on_frameless_overlay_pieces_alone():
    banded = [style for name in TRADITIONS for style in styles(name, 100) if style.banded]
    assert len(banded) > 50
    assert all(style.mount == "overlay" and not style.frame and not style.bare for style in banded)
    assert {style.tradition for style in banded} == {"frameless", "flat-pack", "office", "minimal"}


def test_frameless_fronts_mostly_span_the_whole_width():
    reveals = [style.reveal for style in styles("frameless")]
    assert 0.7 < np.mean([reveal == 0.0 for reveal in reveals]) < 0.9
    assert all(reveal is None or reveal <= 0.0 for reveal in reveals)
