"""Where handles go on fronts: every style and place keeps clear of the border and stands on the leaf."""

from typing import get_args

import numpy as np
import pytest

from grafu.geometry.mesh import merge_meshes
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.handles import handle_pieces, held_side
from grafu.synth.fronts.hold import HandleStyle, Hold, Place
from grafu.synth.fronts.layout import Door, Drawer, LeafStyle, Pair, Rect
from grafu.synth.fronts.leaf_relief import LeafShape
from grafu.synth.fronts.leaves import face_at
from grafu.synth.pieces.finish import STEEL
from grafu.templates.handles import HANDLES
from grafu.vocabulary import PartLabel

STYLES = tuple(style for style in get_args(HandleStyle) if style != "none")
DOOR, FRONT = Rect(0.0, 0.4, 0.0, 0.7), Rect(0.0, 0.8, 0.0, 0.2)
every_style = pytest.mark.parametrize("style", STYLES)
every_place = pytest.mark.parametrize("place", get_args(Place))


def boxes(style="bar-round", hold=None, rect=DOOR, hinge="left", leaf="slab"):
    shape = LeafShape(leaf, rect, 0.0, 0.02, "right")
    pieces = handle_pieces(style, hold or Hold(), shape, hinge, STEEL)
    return [merge_meshes([s.mesh for s in piece.surfaces]).box for piece in pieces]


def test_styles_are_the_templates_and_none():
    assert set(STYLES) == {template.id for template in HANDLES}
    assert boxes("none") == []


@every_style
@every_place
@pytest.mark.parametrize("hinge", ["left", "right", "top", "bottom", None])
@pytest.mark.parametrize("along", [None, 0.0, 1.0])
def test_every_handle_at_every_place_is_clear_of_the_border_and_on_the_leaf(style, place, hinge, along):
    for count in (1, 2):
        found = boxes(style, Hold(place, along, length=0.3, ratio=1.0, count=count), hinge=hinge)
        assert len(found) == count
        for box in found:
            assert np.all(box.low[[0, 2]] >= 0.0019)
            assert np.all(box.high[[0, 2]] <= (0.3981, 0.6981))
            assert box.high[1] == pytest.approx(0.0, abs=1e-9)
            assert box.low[1] > -0.06


@every_style
def test_handles_fit_on_tiny_fronts(style):
    (box,) = boxes(style, rect=Rect(0.0, 0.09, 0.0, 0.07), hinge=None)
    assert np.all(box.low[[0, 2]] > 0)
    assert np.all(box.high[[0, 2]] < (0.09, 0.07))


@pytest.mark.parametrize(
    ("hold", "hinge", "center"),
    [
        (Hold(), "left", (0.355, 0.455)),
        (Hold(), "right", (0.045, 0.455)),
        (Hold(), "top", (0.2, 0.045)),
        (Hold(), None, (0.2, 0.35)),
        (Hold("hinge edge"), "left", (0.045, 0.455)),
        (Hold("middle line", 0.5), "left", (0.2, 0.35)),
        (Hold("top edge"), "left", (0.2, 0.655)),
        (Hold("bottom edge", inset=0.06), "left", (0.2, 0.06)),
        (Hold("free edge", 0.2), "right", (0.045, 0.14)),
        (Hold("free edge", 0.0, orientation="lying"), "left", (0.302, 0.008)),
    ],
)
def test_handles_go_where_the_hold_says(hold, hinge, center):
    (box,) = boxes(hold=hold, hinge=hinge)
    assert box.center[[0, 2]] == pytest.approx(center)


@pytest.mark.parametrize(
    ("style", "hold", "upright"),
    [
        ("bar-round", Hold(), True),
        ("bar-round", Hold("top edge"), False),
        ("bar-round", Hold(orientation="lying"), False),
        ("bar-round", Hold("top edge", orientation="upright"), True),
        ("cup-shell", Hold(), False),
    ],
)
def test_bars_stand_upright_on_doors_and_cups_hang_level(style, hold, upright):
    (box,) = boxes(style, hold)
    assert bool(box.size[2] > box.size[0]) == upright


@pytest.mark.parametrize(
    ("style", "hold", "length"),
    [
        ("bar-round", Hold(), 0.16),
        ("bar-round", Hold(length=0.4, ratio=0.7), 0.4),
        ("bar-round", Hold(length=2.0, ratio=1.0), 0.796),
        ("bar-round", Hold(length=2.0, ratio=0.8, count=2), 0.32),
        ("knob-round", Hold(length=2.0, ratio=1.0), 0.03),
        ("knob-round", Hold(length=0.015), 0.015),
    ],
)
def test_a_handle_is_as_long_as_said_and_as_fits(style, hold, length):
    assert boxes(style, hold, FRONT, None)[0].size[0] == pytest.approx(length)


@pytest.mark.parametrize(
    ("place", "hinge", "axis", "outwards"),
    [
        ("free edge", "left", 0, 1),
        ("free edge", "right", 0, -1),
        ("top edge", "left", 2, 1),
        ("bottom edge", None, 2, -1),
    ],
)
def test_an_edge_profile_juts_out_at_its_edge(place, hinge, axis, outwards):
    shape = LeafShape("slab", DOOR, 0.0, 0.02, "right")
    (piece,) = handle_pieces("bar-profile", Hold(place), shape, hinge, STEEL)
    vertices = piece.surfaces[0].mesh.vertices
    jutting = vertices[vertices[:, 1] < -0.01]
    middle = (vertices[:, axis].min() + vertices[:, axis].max()) / 2
    assert (jutting[:, axis].mean() - middle) * outwards > 0
    border = (0.4, 0.0, 0.7)[axis] if outwards > 0 else 0.0
    assert abs(vertices[:, axis] - border).min() == pytest.approx(0.002)


def test_two_handles_lie_side_by_side():
    one, other = boxes("knob-flat", Hold(count=2), FRONT, None)
    assert (one.center[0], other.center[0]) == pytest.approx((0.2, 0.6))
    assert one.center[2] == other.center[2]


def test_protrusion_is_as_said_and_in_proportion_on_small_knobs():
    assert boxes("knob-round", Hold(length=0.015))[0].low[1] == pytest.approx(-0.013)
    assert boxes(hold=Hold(protrusion=0.05))[0].low[1] == pytest.approx(-0.05)


@pytest.mark.parametrize("leaf", get_args(LeafStyle))
def test_handles_stand_on_every_leaf(leaf):
    (box,) = boxes("knob-round", Hold(along=0.5), leaf=leaf)
    shape = LeafShape(leaf, DOOR, 0.0, 0.02, "right")
    assert box.high[1] == pytest.approx(face_at(shape, float(box.center[0]), float(box.center[2])))


def test_a_drawer_has_no_free_edge():
    assert held_side(Hold(), None) is None
    with pytest.raises(ValueError, match="no hinge"):
        Drawer(hold=Hold("free edge"))
    with pytest.raises(ValueError, match="no free side"):
        Drawer(leaf="swept")
    with pytest.raises(ValueError, match="upright hinge"):
        Door("top", "swept frame")


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        ({"along": 1.2}, "`along`"),
        ({"ratio": 0.0}, "`ratio`"),
        ({"inset": 0.0}, "`inset`"),
        ({"length": -1.0}, "`length`"),
    ],
)
def test_holds_check_themselves(bad, message):
    with pytest.raises(ValueError, match=message):
        Hold(**bad)


def test_both_doors_of_a_pair_are_held_alike():
    made = make_cabinet(Cabinet(layout=Pair(handle="bar-slim", hold=Hold(along=0.2), leaf="swept")))
    one, other = (part.box for part in made.parts if part.label is PartLabel.HANDLE)
    assert one.center[2] == pytest.approx(other.center[2])
    assert one.center[0] == pytest.approx(-other.center[0])
