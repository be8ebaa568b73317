from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.cabinets.chest import Chest, make_chest
from grafu.synth.cabinets.corner import CornerCabinet, make_corner_cabinet
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Base, FaceFrame
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Pair, Stack
from grafu.synth.tables.desk import Desk, make_desk
from grafu.synth.tables.table import DrawerTable, make_table
from grafu.vocabulary import JointType, PartLabel
from strategies import furniture_specs, made
from sweeping import collisions

quick = settings(max_examples=25)


def movable(asset):
    return [p.id for p in asset.parts if p.label.is_movable]


def steps(joint, count=5):
    return np.linspace(0.05, 1.0, count) * joint.upper


@quick
@given(furniture_specs)
def test_every_movable_part_has_one_joint_and_every_handle_rides(spec):
    asset = made(spec)
    assert sorted(j.part for j in asset.joints) == sorted(movable(asset))
    assert all((p.carried_by is not None) == (p.label is PartLabel.HANDLE) for p in asset.parts)


@quick
@given(furniture_specs)
def test_furniture_stands_centred_on_the_floor(spec):
    asset = made(spec)
    assert asset.box.low[2] == pytest.approx(0.0, abs=1e-9)
    assert asset.box.center[:2] == pytest.approx([0.0, 0.0], abs=1e-9)


@quick
@given(furniture_specs)
def test_solids_are_closed_and_look_outwards(spec):
    asset = made(spec)
    for part in asset.parts:
        for surface in part.surfaces:
            mesh = surface.mesh.to_trimesh()
            mesh.merge_vertices()
            assert not mesh.is_watertight or mesh.volume > 0
            assert mesh.is_watertight or part.label is PartLabel.DRAWER  # only a drawer's bare shell is a sheet


@quick
@given(furniture_specs)
def test_nothing_collides_about_the_true_axis(spec):
    asset = made(spec)
    for joint in asset.joints:
        assert collisions(asset, joint.part, steps(joint)) == {}, joint.part


@quick
@given(furniture_specs)
def test_positive_opens_to_the_outside(spec):
    asset = made(spec)
    for joint in asset.joints:
        part = asset.part(joint.part)
        motion = joint.axis.rotation(0.2) if joint.type is JointType.REVOLUTE else joint.axis.shift(0.05)
        shift = part.mesh.box.center @ motion[:3, :3].T + motion[:3, 3] - part.mesh.box.center
        outwards = part.box.center - asset.box.center
        side = int(np.argmax(np.abs(shift)))
        assert shift[side] * outwards[side] > 0 or abs(outwards[side]) < 0.1 * asset.extent


@pytest.mark.parametrize("mount", ["overlay", "inset"])
@pytest.mark.parametrize("hinge", ["left", "right", "top", "bottom"])
def test_a_door_turns_about_the_front_edge_of_its_hinge_side(mount, hinge):
    asset = make_cabinet(Cabinet(layout=Door(hinge), mount=mount))
    axis, box = asset.joints[0].axis, asset.part("door").box
    edge = {"left": box.low[0], "right": box.high[0], "top": box.high[2], "bottom": box.low[2]}[hinge]
    across = 0 if hinge in ("left", "right") else 2
    assert axis.point[[across, 1]] == pytest.approx([edge, box.low[1]])


def test_overlay_fronts_cover_the_case_and_inset_fronts_lie_in_it():
    overlay = make_cabinet(Cabinet(layout=Door(), gap=0.002)).part("door").box
    inset = make_cabinet(Cabinet(layout=Door(), mount="inset", gap=0.002)).part("door").box
    assert overlay.size[[0, 2]] == pytest.approx([0.8 - 0.004, 0.72 - 0.004])
    assert inset.size[[0, 2]] == pytest.approx([0.8 - 0.036 - 0.004, 0.72 - 0.036 - 0.004])


def test_half_overlay_doors_share_their_divider():
    asset = make_cabinet(Cabinet(layout=CellRow((Door("right"), Door("left"))), gap=0.002))
    divider, left, right = (asset.part(i).box for i in ("divider", "door_1", "door_2"))
    assert right.low[0] - left.high[0] == pytest.approx(0.002)
    assert divider.low[0] < left.high[0] < right.low[0] < divider.high[0]


def test_an_inset_pair_without_gap_really_binds():
    asset = make_cabinet(Cabinet(layout=Pair(), mount="inset", gap=0.0))
    assert collisions(asset, "door_1") != {}  # so the sweeps above can fail


@pytest.mark.parametrize("mount", ["overlay", "inset"])
def test_drawers_behind_doors_move_once_the_doors_are_open(mount):
    inner = Stack((Drawer(handle="knob-round"), Drawer(handle="knob-round")), between="nothing")
    asset = make_cabinet(Cabinet(layout=Pair(behind=inner), mount=mount))
    fronts = frozenset(p.id for p in asset.parts if "door" in (p.label, str(p.carried_by)[:4]))
    assert set(collisions(asset, "drawer_1")) <= fronts
    assert collisions(asset, "drawer_1") != {}
    for joint in asset.joints:
        ignored = fronts if joint.part.startswith("drawer") else frozenset()
        assert collisions(asset, joint.part, ignored=ignored) == {}


@pytest.mark.parametrize("box", ["whole", "no bottom", "shell", "front only"])
def test_drawer_boxes_have_the_boards_that_they_promise(box):
    drawer = make_cabinet(Cabinet(layout=Drawer(box))).part("drawer")
    count = {"whole": 5, "no bottom": 4, "shell": 2, "front only": 1}[box]
    assert len(drawer.surfaces) == count
    assert (drawer.box.size[1] > 0.4) == (box != "front only")


def test_a_face_frame_narrows_the_opening_and_carries_a_bar_before_each_partition():
    layout = CellRow((Door(), Drawer()))
    asset = make_cabinet(Cabinet(case=Case(frame=FaceFrame(0.04)), layout=layout, mount="inset"))
    assert asset.part("face_frame").label is PartLabel.FACE_FRAME
    assert asset.part("face_frame_bar").box.size[0] == pytest.approx(0.04)
    assert asset.part("divider").box.size[0] == pytest.approx(0.018)
    assert asset.part("divider").box.low[2] == pytest.approx(asset.part("bottom_panel").box.high[2])


def test_a_muntin_is_static_between_a_pair():
    asset = make_cabinet(Cabinet(layout=Pair(muntin=0.03)))
    muntin = asset.part("muntin")
    assert asset.part("door_1").box.high[0] < muntin.box.low[0]
    assert muntin.box.high[1] == pytest.approx(asset.part("side_panel_left").box.low[1])


def test_a_moulding_juts_out_before_the_doors_and_limits_a_flap():
    case = Case(moulding=0.05)
    asset = make_cabinet(Cabinet(case=case, layout=Door("top", opening=2.0)))
    assert asset.part("moulding").box.low[1] < asset.part("door").box.low[1]
    assert asset.joints[0].upper == pytest.approx(np.pi / 2)


def test_a_two_sided_table_has_drawers_that_leave_it_on_both_sides():
    table = make_table(DrawerTable(two_sided=True))
    directions = sorted(round(float(j.axis.direction[1])) for j in table.joints)
    assert directions == [-1, -1, 1, 1]


def test_a_desk_may_have_a_pedestal_on_either_side():
    assert len(make_desk(Desk(left=Door())).joints) == 4
    assert "side_panel" in {p.id for p in make_desk(Desk()).parts}


def test_a_chest_opens_upwards_about_its_back_edge():
    joint = make_chest(Chest()).joints[0]
    assert joint.axis.direction == pytest.approx([-1.0, 0.0, 0.0])


def test_a_corner_door_is_turned_by_the_front_s_yaw():
    spec = CornerCabinet(along_x=0.35 + 0.6 * np.cos(np.pi / 6), along_y=0.35 + 0.6 * np.sin(np.pi / 6))
    assert spec.yaw == pytest.approx(np.pi / 6)
    vertices = make_corner_cabinet(spec).part("door").mesh.vertices
    normal = np.array([np.sin(spec.yaw), -np.cos(spec.yaw), 0.0])
    assert np.ptp(vertices @ normal) == pytest.approx(0.018)


def test_the_same_spec_gives_the_same_asset():
    assert make_cabinet(Cabinet()).parts == make_cabinet(Cabinet()).parts


@pytest.mark.parametrize(
    "spec",
    [
        lambda: Case(width=0.03),
        lambda: Case(height=0.1, base=Base("plinth")),
        lambda: CellRow(()),
        lambda: Stack((Door(), Door()), (1.0,)),
        lambda: Stack((Door(), Door()), (1.0, -1.0)),
        lambda: CornerCabinet(along_x=0.3),
        lambda: make_cabinet(Cabinet(layout=CellRow((Door(),) * 60))),
    ],
)
def test_a_spec_without_room_is_refused(spec):
    with pytest.raises(ValueError, match=r"needs|room"):
        spec()


def test_specs_are_values():
    assert replace(Cabinet(), gap=0.003) == Cabinet()
    assert hash(Cabinet()) == hash(Cabinet())
