"""Panels in rooms that are no boxes fill the room at their level: L-shaped, under a slope, round, five-sided."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest
import shapely
from interior_judge import faults_of_panels

from front_scenes import cabinet, scene_of
from grafu.additions.interior.compartments import find_compartments
from grafu.additions.interior.furnish import Furnished
from grafu.additions.interior.request import PREDICTED, parse_interior
from grafu.additions.interior.turned import furnish_scene
from grafu.additions.step import PanelHint
from grafu.asset.edit import yawed
from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.cabinets.bureau import Bureau, make_bureau
from grafu.synth.cabinets.corner import CornerCabinet, InnerCorner, make_corner_cabinet, make_inner_corner
from grafu.synth.fronts.layout import Door, Pair
from grafu.synth.noise.edits import with_merged, with_sheets
from grafu.vocabulary import PartLabel
from odd_rooms import BOARD, open_corner, round_corner, under_a_slope_to_the_back, under_a_slope_to_the_side

BOARDS = ("side panel", "back panel", "top panel", "bottom panel", "face frame")
MILLIMETRES = 0.003
ONE_DOOR = InnerCorner(shelves=0)
TWO_DOORS = replace(ONE_DOOR, second=Door("left"))


def furnished(asset: Asset, request: str, hints: tuple[PanelHint, ...] = ()) -> Furnished:
    scene = scene_of(asset)
    found = furnish_scene(scene, PREDICTED if hints else parse_interior(request), hints=hints)
    assert faults_of_panels(found.additions, scene) == []
    return found


def plan(mesh: TriangleMesh, axes: tuple[int, int] = (0, 1)) -> shapely.Geometry:
    """The outline of a panel, seen along the third axis."""
    flat = mesh.triangles[:, :, list(axes)]
    return shapely.union_all([shapely.Polygon(t) for t in flat if shapely.Polygon(t).area > 1e-12])


def wings(spec: InnerCorner, front: float) -> float:
    """The area between the backs, the ends and lines so far behind the faces of the case, square metres."""
    t, deep = spec.panel, spec.depth - spec.panel - front
    return (spec.along_x - 2 * t) * deep + (spec.along_y - 2 * t - deep) * deep


L_SHAPED = {
    "one door": make_inner_corner(ONE_DOOR),
    "two doors": make_inner_corner(TWO_DOORS),
    "no top": make_inner_corner(replace(TWO_DOORS, topped=False)),
    "long wing": make_inner_corner(replace(TWO_DOORS, along_x=1.4)),
    "boards in one part": with_merged(make_inner_corner(TWO_DOORS), BOARDS),
    "sheets": with_sheets(make_inner_corner(ONE_DOOR), BOARDS[:-1]),
    "turned": yawed(make_inner_corner(TWO_DOORS), radians(30)),
}


@pytest.mark.parametrize("name", L_SHAPED)
def test_a_corner_cabinet_is_one_compartment_with_l_shaped_shelves(name: str) -> None:
    found = furnished(L_SHAPED[name], "shelves=2")

    assert [a.part.label for a in found.additions] == [PartLabel.SHELF] * 2
    spec = replace(TWO_DOORS, along_x=1.4) if name == "long wing" else TWO_DOORS
    outer = -spec.panel if name == "sheets" else 0.0  # they stand where the outer faces of the boards were
    for addition in found.additions:
        shape = plan(addition.part.mesh)
        assert wings(spec, 0.03) <= shape.area <= wings(spec, -BOARD) - 4 * outer * spec.along_x
        assert shape.area < 0.9 * shape.minimum_rotated_rectangle.area  # an L, no rectangle


def test_a_shelf_that_is_expected_in_a_wing_takes_the_whole_l() -> None:
    asset = make_inner_corner(ONE_DOOR)
    hint = PanelHint("expected", PartLabel.SHELF, Box(vec3(-0.4, -0.4, 0.5), vec3(0.0, -0.2, 0.52)))

    (addition,) = furnished(asset, "", (hint,)).additions

    assert addition.part.box.center[2] == pytest.approx(0.51, abs=0.005)
    assert plan(addition.part.mesh).area >= wings(ONE_DOOR, 0.03)


def test_an_open_corner_bookcase_gets_l_shaped_shelves() -> None:
    for addition in furnished(open_corner(), "shelves=2").additions:
        assert plan(addition.part.mesh).area >= 2 * 0.964 * 0.32 - 0.332**2


@pytest.mark.parametrize("spec", [CornerCabinet(shelves=0), CornerCabinet(shelves=0, along_x=1.043, along_y=0.75)])
@pytest.mark.parametrize("degrees", [0.0, 20.0])
def test_a_diagonal_corner_cabinet_gets_five_sided_shelves(spec: CornerCabinet, degrees: float) -> None:
    found = furnished(yawed(make_corner_cabinet(spec), radians(degrees)), "shelves=2")

    assert len(found.additions) == 2
    inner = (spec.along_x - 2 * BOARD) * (spec.along_y - 2 * BOARD)
    cut = 0.5 * (spec.along_x - spec.depth - BOARD) * (spec.along_y - spec.depth - BOARD)
    for addition in found.additions:
        assert inner - cut - 0.05 * spec.front_width <= plan(addition.part.mesh).area <= inner - cut


def test_shelves_under_a_slope_to_the_side_end_at_it() -> None:
    asset = under_a_slope_to_the_side()
    top = asset.part("top").mesh
    found = furnished(asset, "shelves=3,dividers=0")

    assert len(found.additions) == 3
    slope = float(np.ptp(top.vertices[:, 2]) - BOARD * 1.318) / 1.4
    for addition in found.additions:
        low_end = max(-0.7 + BOARD, -0.7 + (float(addition.part.box.high[2]) - (0.8 - BOARD * 1.318)) / slope)
        assert addition.part.box.low[0] == pytest.approx(low_end, abs=MILLIMETRES)
        assert addition.part.box.high[0] == pytest.approx(0.7 - BOARD, abs=MILLIMETRES)


@pytest.mark.parametrize("door", [True, False])
def test_a_divider_under_a_slope_to_the_back_follows_it(door: bool) -> None:
    asset = under_a_slope_to_the_back(door=door)

    (divider,) = furnished(asset, "dividers=1").additions

    shape = plan(divider.part.mesh, (1, 2))
    room = shapely.Polygon([(-0.45, BOARD), (0.45 - BOARD, BOARD), (0.45 - BOARD, 0.4925), (-0.45, 1.3745)])
    assert room.buffer(1e-3).contains(shape)
    assert shape.area >= room.area - (0.02 + 0.005) * 1.36 - 0.01


def test_shelves_in_a_round_cabinet_follow_its_wall() -> None:
    found = furnished(round_corner(), "shelves=2")

    assert len(found.additions) == 2
    for addition in found.additions:
        assert plan(addition.part.mesh).area >= 0.5 * np.pi * 0.578**2 - 0.025 * 1.164


def test_a_secretaire_has_room_up_to_its_leaning_flap() -> None:
    asset = make_bureau(Bureau(holes=0))

    lower, upper = sorted((a.part for a in furnished(asset, "shelves=2").additions), key=lambda p: p.box.low[2])

    assert upper.box.low[1] - lower.box.low[1] > 0.1  # the flap leans back
    assert lower.box.high[1] == pytest.approx(float(upper.box.high[1]), abs=MILLIMETRES)


def test_a_room_that_is_a_box_gets_plain_panels() -> None:
    found = furnished(cabinet(Pair(), width=0.9), "shelves=2,dividers=1")

    assert {len(a.part.mesh.faces) for a in found.additions} == {12}
    assert all(len(np.unique(a.part.mesh.vertices.round(6), axis=0)) == 8 for a in found.additions)


def test_what_is_open_below_a_slope_is_no_compartment() -> None:
    asset = under_a_slope_to_the_back(door=False)
    rest = tuple(part for part in asset.parts if part.id not in ("bottom", "left"))

    assert find_compartments(scene_of(replace(asset, parts=rest))) == ()
