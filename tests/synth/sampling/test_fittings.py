from dataclasses import replace

import numpy as np
import pytest

from grafu.synth.fronts.hold import Inside
from grafu.synth.fronts.layout import Door, Drawer, OpenCell, Pair, Rect
from grafu.synth.sampling.fittings import HINGE_EDGE, fit_bay, fit_door, fit_drawer, fit_pair
from grafu.synth.sampling.style import draw_style

LOW, HIGH = Rect(0.0, 0.5, 0.1, 0.75), Rect(0.0, 0.5, 1.5, 2.2)


def rng():
    return np.random.default_rng(5)


def a_style(**changes):
    base = replace(draw_style(rng(), {"frameless": 1.0}), leaf="slab", grip="none", handle="bar-round", carry="reach")
    return replace(base, **changes)


def hold(room, **changes):
    return fit_door(rng(), Door(), "left", room, a_style(**changes), 1.05).hold


def test_handles_sit_as_near_to_the_hand_as_the_door_allows():
    assert hold(LOW).along > 0.7
    assert hold(HIGH).along < 0.3
    assert hold(Rect(0.0, 0.5, 0.1, 2.1)).along == pytest.approx(0.475)


def test_a_lying_bar_sits_at_the_edge_nearer_to_the_hand():
    assert hold(LOW, carry="top line").place == "top edge"
    assert hold(HIGH, carry="top line").place == "bottom edge"


def test_hardly_any_handle_sits_on_the_hinge_side():
    draw, style = rng(), a_style()
    places = [fit_door(draw, Door(), "left", LOW, style, 1.05).hold.place for _ in range(4000)]
    assert 0 < places.count("hinge edge") < 4000 * HINGE_EDGE + 4 * np.sqrt(4000 * HINGE_EDGE)


def test_a_grip_takes_the_place_of_a_handle():
    door = fit_door(rng(), Door(), "left", LOW, a_style(grip="scoop", handle="none"), 1.05)
    assert (door.grip, door.handle) == ("scoop", "none")


def test_a_family_keeps_its_own_leaf_and_handle():
    drawer = fit_drawer(rng(), Drawer(handle="knob-flat", leaf="shaker"), LOW, a_style(drawer_leaf="chamfered"))
    assert (drawer.handle, drawer.leaf) == ("knob-flat", "shaker")


def test_flaps_take_no_curved_leaf():
    flaps = [fit_door(rng(), Door("top"), "top", LOW, a_style(leaf=leaf), 1.05) for leaf in ("bowed", "half arched")]
    assert {flap.leaf for flap in flaps} <= {"slab", "shaker"}


def test_shelves_follow_the_height():
    draw, style = rng(), a_style()
    low = [fit_pair(draw, Pair(), Rect(0.0, 0.8, 0.0, 0.25), style, 1.0).shelves for _ in range(20)]
    tall = [fit_bay(draw, OpenCell(), Rect(0.0, 0.8, 0.0, 2.0), style).shelves for _ in range(50)]
    assert set(low) == {0}
    assert max(tall) >= 4


def test_what_is_asked_for_inside_stays():
    door = fit_door(rng(), Door(inside=Inside(rod=True), shelves=1), "left", LOW, a_style(), 1.05)
    assert door.inside.rod
    assert door.shelves == 1
