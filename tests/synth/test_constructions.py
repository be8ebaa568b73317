from dataclasses import replace
from math import pi

import numpy as np
import pytest

from constructions import CHESTS, SPECS
from grafu.geometry.touching import touching_pairs
from grafu.synth.cabinets.bureau import Bureau, make_bureau
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.cabinets.chest import make_chest
from grafu.synth.cabinets.corner import InnerCorner, make_inner_corner
from grafu.synth.cabinets.rack import Rack, make_rack
from grafu.synth.case.bases import base_pieces
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Back, Base, Bottom, FaceFrame, Top
from grafu.synth.case.legs import Leg
from grafu.synth.fronts.hold import Inside
from grafu.synth.fronts.layout import Blank, Door, Drawer, OpenCell, Pair, Stack, Tilt
from grafu.synth.pieces.finish import PLAIN
from grafu.synth.tables.desk import Desk
from grafu.synth.tables.table import DrawerTable
from grafu.vocabulary import PartLabel
from strategies import made as made_of_strategies
from sweeping import collisions, joint_motion

MAKERS = {Rack: make_rack, InnerCorner: make_inner_corner, Bureau: make_bureau}
TOUCHING = 0.0035  # metres: fronts keep a gap of 3 mm


def made(spec):
    return MAKERS.get(type(spec), made_of_strategies)(spec)


def is_straight(mesh):
    return len(mesh.faces) == 12 and abs(mesh.to_trimesh().volume - mesh.box.volume) < 1e-9


@pytest.mark.parametrize("name", SPECS)
def test_nothing_collides_in_any_construction(name):
    asset = made(SPECS[name])
    for joint in asset.joints:
        assert collisions(asset, joint.part, [ratio * joint.upper for ratio in (0.03, 0.1, 0.4, 0.7, 1.0)]) == {}


@pytest.mark.parametrize("name", SPECS)
def test_still_boards_meet_and_do_not_overlap(name):
    parts = made(SPECS[name]).parts
    boards = [(p.id, s.mesh.box) for p in parts for s in p.surfaces if is_straight(s.mesh)]
    for k, (one, box) in enumerate(boards):
        for other, its in boards[k + 1 :]:
            assert one == other or box.axis_gaps(its).max() > -1e-6, (one, other)


@pytest.mark.parametrize("name", SPECS)
def test_every_part_is_held_by_the_others(name):
    boxes = {p.id: p.box for p in made(SPECS[name]).parts}
    held, todo = set(), [next(iter(boxes))]
    while todo:
        part = todo.pop()
        held.add(part)
        todo += [i for i in boxes if i not in held and boxes[part].gap(boxes[i]) < TOUCHING]
    assert held == set(boxes)


@pytest.mark.parametrize("name", SPECS)
def test_solids_are_closed_and_sheets_are_flat(name):
    for part in made(SPECS[name]).parts:
        for surface in part.surfaces:
            flat = surface.mesh.box.size.min() < 1e-9
            assert flat or part.label is PartLabel.MISC or surface.mesh.is_watertight, part.id
            assert not surface.mesh.is_watertight or surface.mesh.to_trimesh().volume > 0, part.id


def labels(case):
    asset = make_cabinet(Cabinet(case=case, layout=OpenCell()))
    return {p.id: p.label for p in asset.parts}


def test_a_kitchen_toe_kick_is_labelled_as_side_panels():
    found = labels(Case(base=Base("toe kick", boards=3)))
    assert found["toe_kick"] is PartLabel.SIDE_PANEL
    assert sum(name.startswith("base_side_panel") for name in found) == 2


def test_stretchers_take_the_place_of_a_top():
    found = labels(Case(top=Top("stretchers")))
    assert PartLabel.TOP_PANEL not in found.values()
    assert sum(name.startswith("top_stretcher") for name in found) == 4


def test_a_framed_kitchen_cabinet_has_bars_for_its_frame():
    found = labels(Case(frame=FaceFrame(0.035, "bars")))
    assert {found["stile_1"], found["rail_2"]} == {PartLabel.BAR}
    assert PartLabel.FACE_FRAME not in found.values()


def test_edge_strips_have_no_thickness_and_a_sheet_bottom_neither():
    asset = make_cabinet(Cabinet(case=Case(frame=FaceFrame(kind="strips"), bottom=Bottom("sheet")), layout=OpenCell()))
    assert asset.part("edge_strip_1").box.size.min() == pytest.approx(0.0)
    assert asset.part("bottom_panel").box.size[2] == pytest.approx(0.0)


def test_posts_run_from_the_floor_to_the_top():
    asset = make_cabinet(Cabinet(case=Case(base=Base("posts", 0.3, Leg("square", 0.04))), layout=OpenCell()))
    assert asset.part("leg_1").box.size[2] == pytest.approx(0.72)
    assert asset.part("side_panel_left").box.low[2] == pytest.approx(0.3)


def test_a_case_without_a_bottom_or_a_back_lacks_them():
    found = labels(Case(bottom=Bottom("none"), back=Back("none", rails=2)))
    assert not {PartLabel.BOTTOM_PANEL, PartLabel.BACK_PANEL} & set(found.values())
    assert found["back_rail_1"] is PartLabel.BAR


def test_a_blank_is_still_and_counts_as_face_frame():
    asset = make_cabinet(Cabinet(layout=Blank()))
    assert asset.part("false_front").label is PartLabel.FACE_FRAME
    assert asset.joints == ()


def test_a_tilting_front_turns_about_its_lower_front_edge_with_its_tray():
    asset = make_cabinet(Cabinet(case=Case(0.8, 0.5, 0.3), layout=Tilt()))
    joint, door = asset.joints[0], asset.part("door")
    assert joint.axis.point[1:] == pytest.approx(door.box.low[1:])
    assert door.box.size[1] > 0.1


def test_a_tray_has_no_front():
    asset = make_cabinet(Cabinet(layout=Drawer("tray")))
    assert asset.part("drawer").box.size[2] < 0.06
    assert all(p.label is not PartLabel.HANDLE for p in asset.parts)


def test_bands_lie_between_shelves_and_fronts():
    case = Case(frame=FaceFrame(0.018, "strips", 0.001))
    asset = make_cabinet(Cabinet(case=case, layout=Pair(shelves=2, inside=Inside(setback=0.0, band=True))))
    shelf = next(p.box for p in asset.parts if p.label is PartLabel.SHELF)
    bands = [p.box for p in asset.parts if p.label is PartLabel.BAR and abs(p.box.center[2] - shelf.center[2]) < 1e-6]
    assert len(bands) == 1
    assert bands[0].high[1] == pytest.approx(shelf.low[1])
    assert bands[0].size == pytest.approx([shelf.size[0], 0.001, shelf.size[2]])


@pytest.mark.parametrize("spec", [Cabinet(mount="inset"), Cabinet()])
def test_bands_are_left_out_behind_inset_fronts_and_on_glass(spec):
    shelf = "full" if spec.mount == "inset" else "glass"
    asset = make_cabinet(replace(spec, layout=Pair(shelves=1, inside=Inside(shelf=shelf, band=True))))
    assert not any(p.label is PartLabel.BAR for p in asset.parts)


def test_baskets_are_misc_of_few_faces():
    for basket in ("wire", "rack"):
        asset = make_cabinet(Cabinet(layout=OpenCell(0, Inside(basket=basket))))
        part = asset.part(f"{basket}_basket")
        assert part.label is PartLabel.MISC
        assert len(part.mesh.faces) <= 300


def test_the_fronts_of_an_island_leave_it_on_both_sides():
    directions = {round(float(j.axis.direction[1])) for j in made(SPECS["island"]).joints if j.part.startswith("dra")}
    rear = [j for j in made(SPECS["island"]).joints if j.axis.point[1] > 0]
    assert directions == {-1}
    assert len(rear) == 1


def test_a_lid_within_the_walls_turns_about_its_upper_back_edge():
    asset = make_chest(CHESTS["lid within"])
    assert asset.joints[0].axis.point[2] == pytest.approx(asset.part("lid").box.high[2])


def test_the_fronts_of_an_inner_corner_meet_in_a_post():
    asset = make_inner_corner(InnerCorner(second=Door()))
    first, second, post = (asset.part(i).box for i in ("door_1", "door_2", "corner_post"))
    assert first.size[0] > first.size[1]
    assert second.size[1] > second.size[0]
    assert first.gap(post) < TOUCHING
    assert second.gap(post) < TOUCHING
    assert [j.axis.direction[2] for j in asset.joints] == [1.0, -1.0]


def test_the_ends_of_an_angled_corner_meet_its_frame():
    asset = made(SPECS["angled corner on a toe kick"])
    frame = asset.part("face_frame").mesh
    pairs = [(asset.part(i).mesh, frame) for i in ("side_panel_left", "side_panel_right", "bottom_panel")]
    assert [touching_pairs(list(pair), [(0, 1)], 0.0005) for pair in pairs] == [[(0, 1)]] * 3


def test_a_bureau_s_flap_falls_level():
    asset = make_bureau(Bureau(flap=Door("bottom", handle="none")))
    joint, flap = asset.joints[0] if asset.joints[0].part == "door" else asset.joints[-1], asset.part("door")
    opened = joint_motion(joint, joint.upper)
    points = flap.mesh.vertices @ opened[:3, :3].T + opened[:3, 3]
    assert np.ptp(points[:, 2]) == pytest.approx(0.018)
    assert np.ptp(flap.mesh.vertices[:, 2]) > 0.2


@pytest.mark.parametrize("leaf", ["bowed", "swept"])
def test_a_curved_door_stops_before_it_strikes_what_stands_before_its_pin(leaf):
    asset = make_cabinet(Cabinet(case=Case(pilaster=0.05, frame=FaceFrame()), layout=Pair(leaf)))
    for joint in asset.joints:
        assert joint.upper < pi / 2
        assert collisions(asset, joint.part) == {}


def test_a_rack_s_shelves_lie_between_its_uprights():
    asset = make_rack(Rack(shelves=3))
    shelf, upright = asset.part("shelf_3").box, asset.part("upright_1").box
    assert shelf.low[0] == pytest.approx(upright.high[0])
    assert shelf.high[2] <= upright.high[2]


def test_shelves_without_a_setback_touch_the_doors():
    asset = made(SPECS["shelves against doors"])
    assert all(asset.part(f"shelf_{k}").box.gap(asset.part("door_1").box) < 0.0015 for k in (1, 2, 3))


def test_cleats_touch_shelf_and_wall_and_lips_stand_before_shelves():
    asset = made(SPECS["lips, cleats and blocks"])
    shelf, lip, cleat = (asset.part(f"{name}_1").box for name in ("shelf", "shelf_lip", "cleat"))
    assert lip.high[1] == pytest.approx(shelf.low[1])
    assert cleat.high[2] == pytest.approx(shelf.low[2])
    assert cleat.gap(asset.part("side_panel_left").box) < 1e-6


@pytest.mark.parametrize(("reveal", "wider"), [(0.0, 0.0), (-0.02, 0.04)])
def test_fronts_may_cover_the_case_wholly_and_more(reveal, wider):
    asset = make_cabinet(Cabinet(case=Case(0.8), layout=Door(), reveal=reveal))
    assert asset.part("door").box.size[0] == pytest.approx(0.8 + wider)
    assert asset.part("door").box.size[2] == pytest.approx(0.72)


def test_a_flap_above_a_drawer_hangs_on_a_bar_at_its_pin():
    asset = made(SPECS["oven"])
    flap = next(j for j in asset.joints if j.part.startswith("door"))
    bar = asset.part("hinge_rail").box
    assert abs(bar.high[2] - flap.axis.point[2]) < TOUCHING
    assert bar.gap(asset.part(flap.part).box) < TOUCHING


def test_an_open_frame_between_drawers_has_four_bars():
    asset = make_cabinet(Cabinet(layout=Stack((Drawer(), Drawer()), between="frame")))
    assert sum(p.id.startswith(("rail_bar", "drawer_rail")) for p in asset.parts) == 4


def test_no_base_has_no_pieces():
    assert list(base_pieces(Case(), PLAIN)) == []


@pytest.mark.parametrize(
    "spec",
    [
        lambda: Base(height=-0.1),
        lambda: Base(height=0.1, apron=0.2),
        lambda: Back(thickness=-0.001),
        lambda: FaceFrame(0.0),
        lambda: Leg(thick=0.0),
        lambda: Inside(dividers=-1),
        lambda: Inside(setback=-0.01),
        lambda: Cabinet(ratio=0.9),
        lambda: DrawerTable(leg=0.4),
        lambda: Desk(left=Drawer(), wing=0.8),
        lambda: Desk(width=0.7, left=Drawer()),
        lambda: Rack(height=0.7),
        lambda: Bureau(shelf=0.6),
        lambda: Bureau(flap=Door()),
        lambda: DrawerTable(rails=0.05),
        lambda: InnerCorner(along_x=0.6),
    ],
)
def test_a_construction_that_cannot_be_is_refused(spec):
    with pytest.raises(ValueError, match=r"must|needs"):
        spec()
