"""A piece without names whose front is below has another direction up than its format states."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from grafu.asset.frame import settle_frame, whole_box
from grafu.asset.options import DIRECTIONS, LoadOptions
from grafu.asset.part import Part
from grafu.asset.reading import Convention, Reading
from grafu.asset.resting import stands_on_another_side
from grafu.asset.seen_side import lies_on_its_front
from grafu.asset.settling import settled
from grafu.asset.standing import vector
from grafu.synth.samples import desk, dresser, kitchen_base
from grafu.vocabulary import PartLabel
from small_scenes import box

GLTF = Convention("glTF", up="+Y", front="+Z")
OBJ = Convention("OBJ", usual_up="+Y")


def in_pose(parts, up, front):
    """Returns nameless parts, in the object frame before, whose up and front are these directions of the input."""
    T = np.eye(4)
    T[:3, :3] = np.column_stack([np.cross(-vector(front), vector(up)), -vector(front), vector(up)])
    return tuple(
        Part(f"Cube.{k}", PartLabel.UNKNOWN, tuple(s.transformed(T) for s in part.surfaces), part.source, "none")
        for k, part in enumerate(parts)
    )


def flat_chest(feet=0.0):
    """Returns a case with a plinth, or with a foot of some height in each corner, and three plain drawers in front."""
    drawers = [box(f"d{z}", (-0.4, -0.32, z), (0.4, -0.3, z + 0.3)) for z in (0.05, 0.36, 0.67)]
    places = [(x, y) for x in (-0.4, 0.35) for y in (-0.3, 0.25)]
    legs = [box(f"f{x}{y}", (x, y, -feet), (x + 0.05, y + 0.05, 0.0)) for x, y in places]
    return (box("case", (-0.4, -0.3, 0.0), (0.4, 0.3, 1.0)), *drawers, *(legs if feet else ()))


@pytest.mark.parametrize("convention", [GLTF, OBJ])
def test_a_chest_does_not_lie_on_its_drawers(convention):
    frame = settle_frame(Reading("glb", in_pose(flat_chest(), "+Z", "-Y"), convention), LoadOptions())
    assert (frame.up, frame.front) == ("+Z", "-Y")
    assert "it would lie on what shows the most parts" in frame.assumed[0]


@pytest.mark.parametrize("sample", [desk, dresser, kitchen_base])
def test_what_stands_does_not_lie_on_its_front(sample):
    parts = in_pose(sample().parts, "+Y", "+Z")
    assert not lies_on_its_front(parts, whole_box(parts), "+Y")
    assert settle_frame(Reading("glb", parts, GLTF), LoadOptions()).up == "+Y"


def test_a_table_with_many_battens_below_its_top_does_not_lie_on_them():
    aprons = [box(f"a{y}", (-0.55, y, 0.6), (0.55, y + 0.02, 0.7)) for y in (-0.4, 0.38)]
    aprons += [box(f"b{x}", (x, -0.4, 0.6), (x + 0.02, 0.4, 0.7)) for x in (-0.6, 0.58)]
    battens = [box(f"c{k}", (-0.58, -0.35 + 0.1 * k, 0.66), (0.58, -0.29 + 0.1 * k, 0.7)) for k in range(7)]
    legs = [box(f"l{x}{y}", (x, y, 0.0), (x + 0.05, y + 0.05, 0.7)) for x in (-0.6, 0.55) for y in (-0.4, 0.35)]
    parts = in_pose((box("top", (-0.6, -0.4, 0.7), (0.6, 0.4, 0.73)), *aprons, *battens, *legs), "+Y", "+Z")
    assert not lies_on_its_front(parts, whole_box(parts), "+Y")


def test_a_chest_that_is_divided_by_its_materials_does_not_lie_on_its_plinth():
    case, *drawers = flat_chest()
    wood = replace(case, surfaces=(*case.surfaces, *(s for drawer in drawers for s in drawer.surfaces)))
    plinth, top = (
        box("dark", (-0.38, -0.2, -0.1), (0.38, 0.28, 0.0)),
        box("stone", (-0.42, -0.45, 1.0), (0.42, 0.42, 1.04)),
    )
    parts = in_pose((wood, plinth, top), "+Y", "+Z")
    assert not lies_on_its_front(parts, whole_box(parts), "+Y")


@pytest.mark.parametrize("up", DIRECTIONS)
def test_a_piece_with_a_foot_in_each_corner_stands_on_these_in_every_pose(up):
    parts = in_pose(flat_chest(feet=0.1), up, next(d for d in DIRECTIONS if d[1] != up[1]))
    assert (stands_on_another_side(parts, "+Y", "+Z") or "+Y") == up


def test_four_knobs_in_the_corners_of_a_front_are_no_feet():
    knobs = [box(f"k{x}{z}", (x, -0.35, z), (x + 0.03, -0.32, z + 0.03)) for x in (-0.36, 0.33) for z in (0.1, 0.85)]
    assert stands_on_another_side(in_pose((*flat_chest(), *knobs), "+Y", "-Z"), "+Y", "+Z") is None


def test_doors_that_lie_by_their_names_let_the_shape_decide_which_way_is_up():
    case, *drawers = in_pose(flat_chest(), "+Z", "-Y")
    named = tuple(replace(d, label=PartLabel.DOOR, labelled_by="name") for d in drawers)
    assert settle_frame(Reading("glb", (case, *named), GLTF), LoadOptions()).up == "+Z"
    case, *drawers = in_pose(flat_chest(), "+Y", "+Z")  # doors that stand are believed
    named = tuple(replace(d, label=PartLabel.DOOR, labelled_by="name") for d in drawers)
    assert settle_frame(Reading("glb", (case, *named), GLTF), LoadOptions()).up == "+Y"


def joined(parts):
    """Returns one part of all surfaces, as where a piece was joined to one mesh."""
    return (replace(parts[0], surfaces=tuple(s for part in parts for s in part.surfaces)),)


@pytest.mark.parametrize(("convention", "up"), [(OBJ, "+Z"), (GLTF, "+Y")])
def test_shells_of_one_mesh_tell_which_way_is_up_where_the_format_does_not(convention, up):
    parts = joined(in_pose(flat_chest(), "+Z", "-Y"))
    assert settle_frame(Reading("mesh file", parts, convention), LoadOptions()).up == up


def test_a_wall_cabinet_that_shows_its_inside_from_below_does_not_lie_on_it():
    boards = [box(f"b{k}", (-0.38, -0.25 + 0.1 * k, 0.02), (0.38, -0.2 + 0.1 * k, 0.1)) for k in range(5)]
    door = box("door", (-0.4, -0.32, 0.0), (0.4, -0.3, 1.0))
    knob = box("knob", (0.3, -0.35, 0.5), (0.33, -0.32, 0.53))
    case = box("case", (-0.4, -0.3, 0.1), (0.4, 0.3, 1.0))
    parts = joined(in_pose((case, *boards, door), "+Y", "+Z"))
    assert settle_frame(Reading("mesh file", parts, OBJ), LoadOptions()).up == "+Z"  # nothing tells of a front
    parts = joined(in_pose((case, *boards, door, knob), "+Y", "+Z"))
    assert settle_frame(Reading("mesh file", parts, OBJ), LoadOptions()).up == "+Y"


def test_a_piece_stands_as_it_stood_when_its_lid_was_found():
    ends = [
        (-0.45, -0.43, -0.22, 0.22),
        (0.43, 0.45, -0.22, 0.22),
        (-0.43, 0.43, -0.22, -0.2),
        (-0.43, 0.43, 0.2, 0.22),
    ]
    walls = [box(f"w{k}", (x0, y0, 0.02), (x1, y1, 0.4)) for k, (x0, x1, y0, y1) in enumerate(ends)]
    body = joined([box("bottom", (-0.45, -0.22, 0.0), (0.45, 0.22, 0.02)), *walls])
    straps = [box(f"s{x}", (x - 0.02, -0.225, 0.0), (x + 0.02, -0.22, 0.4)) for x in (-0.3, 0.3)]
    latch = box("latch", (-0.06, -0.232, 0.35), (0.06, -0.22, 0.398))
    lid = box("lid", (-0.46, -0.23, 0.402), (0.46, 0.22, 0.45))
    parts = in_pose((*body, lid, latch, *straps), "+Z", "-Y")
    chest = settled(Reading("mesh file", parts, OBJ), "chest", Path("chest.obj"))
    (lid,) = (part for part in chest.parts if part.label is PartLabel.DOOR)
    assert (chest.frame.up, chest.frame.front) == ("+Z", "-Y")
    assert lid.box.size[2] == pytest.approx(0.048 * chest.frame.scale)


@pytest.mark.parametrize("is_trunk", [True, False], ids=["on feet", "on its walls"])
def test_the_rim_of_a_lid_that_stands_out_is_no_part_of_the_lower_side(is_trunk):
    """Seen from below, it shows all round beside the walls: a box with a lid does not lie on its front."""
    walls = [box(f"y{y}", (-0.4, y, 0.05), (0.4, y + 0.02, 0.475)) for y in (-0.21, 0.19)]
    walls += [box(f"x{x}", (x, -0.19, 0.05), (x + 0.02, 0.19, 0.475)) for x in (-0.4, 0.38)]
    walls = walls if is_trunk else [box("body", (-0.4, -0.21, 0.0), (0.4, 0.21, 0.475))]
    parts = [*walls, box("lid", (-0.42, -0.23, 0.475), (0.42, 0.22, 0.5))]
    places = [(x, y) for x in (-0.38, 0.34) for y in (-0.19, 0.15)] if is_trunk else []
    parts += [box(f"f{x}{y}", (x, y, 0.0), (x + 0.04, y + 0.04, 0.05)) for x, y in places]
    parts += [box("floor", (-0.38, -0.19, 0.06), (0.38, 0.19, 0.08))] if is_trunk else []
    made = in_pose(tuple(parts), "+Y", "+Z")

    assert not lies_on_its_front(made, whole_box(made), "+Y")


def row_of_units(count=3):
    """Returns two high cases at the ends of a low one, with plain fronts: nothing stands above the low one."""
    places = ((-1.8, -1.2, 2.0), (-1.2, 1.2, 0.6), (1.2, 1.8, 2.0))
    cases = [box(f"case{x}", (x, -0.3, 0.0), (end, 0.3, z)) for x, end, z in places]
    backs = [box(f"back{x}", (x, 0.3, 0.0), (end, 0.305, z)) for x, end, z in places]
    fronts = [
        box(f"front{x}{k}", (x + 0.01, -0.32, z * k / count + 0.005), (end - 0.01, -0.3, z * (k + 1) / count - 0.005))
        for x, end, z in places
        for k in range(count)
    ]
    return (*cases, *backs, *fronts)


@pytest.mark.parametrize("convention", [GLTF, OBJ])
def test_a_row_of_units_of_several_heights_does_not_lie_on_its_fronts(convention):
    """Less than the outline is covered, as nothing stands above the low unit, but all that is seen is in front."""
    frame = settle_frame(Reading("glb", in_pose(row_of_units(), "+Z", "-Y"), convention), LoadOptions())
    assert (frame.up, frame.front) == ("+Z", "-Y")
    standing = in_pose(row_of_units(), "+Y", "+Z")
    assert not lies_on_its_front(standing, whole_box(standing), "+Y", is_stated=convention is GLTF)
