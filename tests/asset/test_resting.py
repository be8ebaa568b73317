from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.frame import settle_frame, whole_box
from grafu.asset.options import DIRECTIONS, LoadOptions
from grafu.asset.part import Part
from grafu.asset.reading import Convention, Reading
from grafu.asset.resting import stands_on_another_side
from grafu.asset.standing import up_votes, vector
from grafu.vocabulary import PartLabel
from small_scenes import box

GLTF = Convention("glTF", up="+Y", front="+Z")


def table() -> tuple[Part, ...]:
    legs = [box(f"leg_{x}{y}", (x, y, 0.0), (x + 0.05, y + 0.05, 0.7)) for x in (-0.6, 0.55) for y in (-0.4, 0.35)]
    return (box("plate", (-0.65, -0.45, 0.7), (0.65, 0.45, 0.73)), *legs)


def cabinet() -> tuple[Part, ...]:
    """Returns a case on a full base whose doors have a knob each: on its face it rests on two knobs."""
    doors = [box(f"d{x}", (x, -0.32, 0.02), (x + 0.39, -0.3, 0.98)) for x in (-0.4, 0.01)]
    knobs = [box(f"k{x}", (x, -0.35, 0.5), (x + 0.02, -0.32, 0.52)) for x in (-0.05, 0.03)]
    return (box("case", (-0.4, -0.3, 0.0), (0.4, 0.3, 1.0)), *doors, *knobs)


def in_pose(parts: tuple[Part, ...], up: str, front: str) -> tuple[Part, ...]:
    """Returns nameless parts whose up and front are these directions of the input."""
    rotation = np.column_stack([np.cross(-vector(front), vector(up)), -vector(front), vector(up)])
    T = np.eye(4)
    T[:3, :3] = rotation
    return tuple(
        Part(f"Cube.{k}", PartLabel.UNKNOWN, tuple(s.transformed(T) for s in part.surfaces), part.source, "none")
        for k, part in enumerate(parts)
    )


@pytest.mark.parametrize("up", DIRECTIONS)
def test_a_nameless_table_stands_on_its_legs_in_every_pose(up):
    parts = in_pose(table(), up, next(d for d in DIRECTIONS if d[1] != up[1]))
    assert (stands_on_another_side(parts, "+Y", "+Z") or "+Y") == up
    frame = settle_frame(Reading("glb", parts, GLTF), LoadOptions())
    assert frame.up == up
    assert ("what the piece rests on tells" in frame.assumed[0]) == (up != "+Y")


@pytest.mark.parametrize("up", DIRECTIONS)
def test_long_legs_with_a_name_do_not_tell_which_axis_is_up_by_where_they_lie(up):
    shorter = box("leg_1", (0.3, 0.35, 0.0), (0.35, 0.4, 0.7))  # one leg aside: their middle lies off the table's
    parts = in_pose((*table()[:-1], shorter), up, next(d for d in DIRECTIONS if d[1] != up[1]))
    named = tuple(replace(part, label=PartLabel.LEG, labelled_by="name") for part in parts[1:])
    frame = settle_frame(Reading("mesh file", (parts[0], *named), Convention("OBJ", usual_up="+Y")), LoadOptions())
    assert frame.up == up
    votes = up_votes(named, whole_box(parts))
    assert votes.best is None
    assert not votes.tells_sense


def test_short_legs_with_a_name_tell_which_end_is_down():
    parts = in_pose(cabinet(), "+Z", "-Y")
    places = [(x, y) for x in (-0.4, 0.35) for y in (-0.3, 0.25)]
    legs = [box(f"leg_{x}{y}", (x, y, -0.1), (x + 0.05, y + 0.05, 0.0)) for x, y in places]
    named = tuple(replace(leg, label=PartLabel.LEG, labelled_by="name") for leg in legs)
    frame = settle_frame(Reading("mesh file", (*parts, *named), Convention("OBJ", usual_up="+Y")), LoadOptions())
    assert frame.up == "+Z"
    assert "confidence 92 %" in frame.assumed[0]


def test_a_nameless_cabinet_on_its_knobs_has_the_other_usual_direction_up():
    lying = in_pose(cabinet(), "+Z", "-Y")
    assert stands_on_another_side(lying, "+Y", "+Z") == "+Z"
    # on its back or on a side it rests steadily, and the format is believed
    assert stands_on_another_side(lying, "-Y", "+Z") is None
    assert stands_on_another_side(lying, "+X", "+Z") is None
    assert stands_on_another_side(in_pose(cabinet(), "+Y", "+Z"), "+Y", "+Z") is None


def kitchen_run(handle: float = 0.035) -> tuple[Part, ...]:
    """Returns units in a row that rest on a thin plinth in front alone, a bar on each door, which stands out so far."""
    doors = [(x, x + 0.597) for x in (-0.9, -0.3, 0.3)]
    fronts = [box(f"d{x}", (x, -0.58, 0.1), (end, -0.56, 0.8)) for x, end in doors]
    at = [doors[0][0] + 0.03, doors[1][0] + 0.03, doors[2][1] - 0.05]
    bars = [box(f"h{x}", (x, -0.58 - handle, 0.13), (x + 0.02, -0.58, 0.78)) for x in at]
    top = box("top", (-0.9, -0.58, 0.82), (0.9, 0.0, 0.86))
    case, toe = box("case", (-0.9, -0.55, 0.1), (0.9, 0.0, 0.82)), box("toe", (-0.9, -0.5, 0.0), (0.9, -0.48, 0.1))
    return (case, top, toe, *fronts, *bars)


def test_handles_on_fronts_are_no_legs():
    """The back of a row of units is broad, and its handles lie in a plane before it: it does not lie on them."""
    upright = in_pose(kitchen_run(), "+Y", "+Z")
    assert stands_on_another_side(upright, "+Y", "+Z") is None
    # bars as long as legs, on nothing that is as broad within their length, are what it stands on
    low = [box(f"leg_{x}{y}", (x, y, 0.0), (x + 0.05, y + 0.05, 0.2)) for x in (-0.6, 0.55) for y in (-0.4, 0.35)]
    bench = in_pose((box("plate", (-0.65, -0.45, 0.2), (0.65, 0.45, 0.4)), *low), "+X", "+Z")
    assert stands_on_another_side(bench, "+Y", "+Z") == "+X"


def test_what_the_user_or_a_label_states_overrules_what_it_rests_on():
    parts = in_pose(table(), "+Z", "-Y")
    assert settle_frame(Reading("glb", parts, GLTF), LoadOptions(up="+Y")).up == "+Y"
    side = replace(parts[0], label=PartLabel.SIDE_PANEL, labelled_by="name")
    assert settle_frame(Reading("glb", (side, *parts[1:]), GLTF), LoadOptions()).up == "+Y"


def test_panels_that_would_lie_flat_both_ways_leave_it_as_the_format_states():
    boards = [box("a", (-0.3, -0.01, 0.1), (0.3, 0.01, 0.6)), box("b", (-0.3, 0.05, 0.4), (0.3, 0.35, 0.42))]
    parts = in_pose((*table(), *boards), "+Z", "-Y")
    assert settle_frame(Reading("glb", parts, GLTF), LoadOptions()).up == "+Z"
    sides = tuple(replace(part, label=PartLabel.SIDE_PANEL, labelled_by="name") for part in parts[-2:])
    assert settle_frame(Reading("glb", (*parts[:-2], *sides), GLTF), LoadOptions()).up == "+Y"


def refrigerator(*below: Part) -> tuple[Part, ...]:
    """Returns a case that ends above the floor, with two doors and upright handles before it."""
    doors = [box(f"d{x}", (x, -0.42, 0.06), (x + 0.45, -0.35, 1.79)) for x in (-0.46, 0.01)]
    bars = [box(f"b{x}", (x, -0.46, 0.6), (x + 0.02, -0.42, 1.5)) for x in (-0.06, 0.04)]
    walls = [box(f"w{x}", (x, -0.34, 0.03), (x + 0.05, 0.3, 1.79)) for x in (-0.46, 0.41)]
    boards = [box(f"s{z}", (-0.41, -0.34, z), (0.41, 0.3, z + 0.05)) for z in (0.03, 1.74)]
    return (*walls, *boards, box("back", (-0.41, 0.25, 0.08), (0.41, 0.3, 1.74)), *doors, *bars, *below)


def test_a_piece_whose_grille_alone_reaches_the_floor_stands_on_it():
    grille = box("g", (-0.45, -0.35, 0.0), (0.45, -0.32, 0.03))
    upright = in_pose(refrigerator(grille), "+Z", "-X")
    assert stands_on_another_side(upright, "+Z", "+Y") is None
    # a row of handles along a border is none: between them nothing is
    row = [box(f"h{x}", (x, -0.35, 0.0), (x + 0.12, -0.33, 0.03)) for x in (-0.45, -0.06, 0.33)]
    assert stands_on_another_side(in_pose(refrigerator(*row), "+Z", "-X"), "+Z", "+Y") == "+Y"
