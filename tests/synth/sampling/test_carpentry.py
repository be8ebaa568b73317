from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from grafu.synth.fronts.layout import Blank, CellRow, Door, Drawer, OpenCell, Pair, Rect, Stack, Tilt
from grafu.synth.sampling.carpentry import FREE, PieceSite, drawer_heights, fitted, needed_gap
from grafu.synth.sampling.style import draw_style

ROOM = Rect(-0.6, 0.6, 0.1, 0.8)
DRAWS = 400


def a_style(seed=0):
    return draw_style(np.random.default_rng(seed), {"frameless": 1.0})


def sides(layout):
    """Yields the hinges of all doors, left to right and bottom to top."""
    if isinstance(layout, Door):
        yield layout.hinge
    elif isinstance(layout, CellRow | Stack):
        for cell in layout.cells:
            yield from sides(cell)


def drawn(layout, site=FREE, draws=DRAWS):
    rng, style = np.random.default_rng(1), a_style()
    return Counter(tuple(sides(fitted(rng, layout, ROOM, style, site))) for _ in range(draws))


def within(hits, total, rate):
    """Whether the count lies within four standard deviations of what the rate promises."""
    return abs(hits - total * rate) < 4 * np.sqrt(total * rate * (1 - rate)) + 1


def test_where_nothing_decides_a_door_hangs_on_either_side():
    assert within(drawn(Door())[("left",)], DRAWS, 0.5)


def test_beside_a_wall_a_door_hangs_there():
    assert within(drawn(Door(), PieceSite("right"))[("right",)], DRAWS, 0.85 + 0.075)


def test_two_doors_in_a_row_hang_at_their_outer_sides():
    assert within(drawn(CellRow((Door(), Door())))[("left", "right")], DRAWS, 0.86)


def test_outer_doors_of_three_hang_outside():
    counts = drawn(CellRow((Door(), Door(), Door())))
    outside = sum(n for (left, _, right), n in counts.items() if (left, right) == ("left", "right"))
    assert within(outside, DRAWS, 0.86)


def test_a_door_hangs_on_the_side_of_the_door_below():
    counts = drawn(Stack((Door(), Door())))
    assert within(counts[("left", "left")] + counts[("right", "right")], DRAWS, 0.975)


def test_a_door_beside_drawers_mostly_hangs_outside():
    assert within(drawn(CellRow((Stack((Drawer(), Drawer())), Door())))[("right",)], DRAWS, 0.7)


def test_flaps_keep_their_level_hinge():
    assert set(drawn(Stack((Door("bottom"), Door("top"))), draws=20)) == {("bottom", "top")}


def test_few_pairs_hang_on_one_side():
    rng, style = np.random.default_rng(2), a_style()
    layouts = [fitted(rng, Pair(), ROOM, style) for _ in range(1000)]
    rows = [layout for layout in layouts if isinstance(layout, CellRow)]
    assert within(len(rows), 1000, 0.015)
    assert all(len(set(sides(row))) == 1 for row in rows)


def test_every_kind_of_front_is_fitted_in_one_style():
    style = replace(a_style(), handle="knob-flat", drawer_handle="bar-tee", leaf="shaker", drawer_leaf="chamfered")
    cells = (Drawer(), Tilt(), Blank(), OpenCell(), Pair(), Door("top"))
    layout = fitted(np.random.default_rng(3), Stack(cells), Rect(0.0, 0.6, 0.0, 2.4), style)
    drawer, tilt, blank, bay, pair, flap = layout.cells
    assert (drawer.handle, pair.handle, flap.handle) == ("bar-tee", "knob-flat", "knob-flat")
    assert (drawer.leaf, pair.leaf, flap.leaf, blank.leaf) == ("chamfered", "shaker", "shaker", "chamfered")
    assert isinstance(tilt, Tilt)
    assert isinstance(bay, OpenCell)


def test_the_needed_gap_grows_with_thickness_and_shrinks_with_width():
    narrow, wide = Rect(0.0, 0.3, 0.0, 0.7), Rect(0.0, 0.6, 0.0, 0.7)
    assert needed_gap(Door(), narrow, 0.02) == pytest.approx(0.02**2 / 0.6 + 0.0001)
    assert needed_gap(Pair(), wide, 0.02) == needed_gap(Door(), narrow, 0.02)
    assert needed_gap(Drawer(), narrow, 0.02) < needed_gap(Door(), wide, 0.02)


def test_stacks_of_drawers_are_alike_or_deeper_below():
    rng = np.random.default_rng(4)
    for _ in range(50):
        ratios = drawer_heights(rng, 4)
        assert ratios == () or (len(ratios) == 4 and ratios[0] >= ratios[-1])
