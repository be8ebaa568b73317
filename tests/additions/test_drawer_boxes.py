"""Drawers without a box get one that fits the opening and runs on rails; whole ones, trays and blocks get nothing."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from grafu.additions.drawer_box.complete import complete_drawers
from grafu.additions.drawer_box.config import DrawerBoxConfig
from grafu.asset.edit import yawed
from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.transform import translation
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.realize import realize
from grafu.pipeline.additions import planned_scene
from grafu.scene.scale import metre_on
from grafu.scene.scene import Scene
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Drawer, DrawerBox, Stack
from grafu.synth.noise.segmentation import with_box_apart
from grafu.synth.tables.table import DrawerTable, make_table
from grafu.vocabulary import PartLabel
from judging import GALLERY, swept_collisions
from small_scenes import box, scene, sliding

CASE = Case(width=0.45)
BOARDS = {"side_left", "side_right", "back", "bottom"}


def stack(kind: DrawerBox, **sizes) -> Asset:
    layout = Stack((Drawer(kind, handle="none"), Drawer(kind)), between="nothing")
    return make_cabinet(Cabinet("chest", CASE, layout, **sizes))


def drawn(asset: Asset) -> Scene:
    return planned_scene(asset, plan_from_annotation(asset))


def found(asset: Asset):
    return complete_drawers(drawn(asset), plan_from_annotation(asset))


def completed(asset: Asset):
    """The asset realized with the boards that its drawers lacked."""
    plan, made = plan_from_annotation(asset), found(asset)
    whole = replace(asset, parts=(*asset.parts, *(a.part for a in made.additions)))
    riding = [(a.part.carried_by, a.part.id) for a in made.additions]
    return realize(plan.with_attached([*made.loose, *riding]), whole, GALLERY)


def boards_of(made, drawer: str) -> dict[str, object]:
    return {a.part.id.removeprefix(f"{drawer}_"): a.part for a in made.additions if a.part.carried_by == drawer}


@pytest.mark.parametrize("kind", ["whole", "shell", "floating", "four walls"])
def test_what_has_a_box_lacks_nothing(kind):
    made = found(stack(kind))
    assert [v.kind for v in made.verdicts] == ["whole", "whole"]
    assert made.additions == ()


@pytest.mark.parametrize("factor", [1.0, 10.0, 30.0])
def test_walls_are_as_thick_as_the_scale_of_the_model_says(factor):
    asset = stack("front only")
    T = np.diag([factor, factor, factor, 1.0])
    parts = tuple(replace(p, surfaces=tuple(s.transformed(T) for s in p.surfaces)) for p in asset.parts)
    joints = tuple(replace(j, axis=replace(j.axis, point=factor * j.axis.point)) for j in asset.joints)
    extent = float(Box.enclosing(p.box for p in parts).size.max())

    boards = found(replace(asset, parts=parts, joints=joints)).additions

    sides = [a.part.box.size[0] for a in boards if "side" in a.part.id]
    assert sides == pytest.approx([DrawerBoxConfig().wall * metre_on(extent)] * 4)


@pytest.mark.parametrize("depth", [0.41, 0.56, 0.73, 0.95])
@pytest.mark.parametrize("mount", ["overlay", "inset"])
def test_a_drawer_opens_as_far_with_its_box_as_its_bare_front_did(depth, mount):
    """However deep the case is; and its rails are as long as the box, whichever rows of rays it lies between."""
    layout = Stack((Drawer("front only"), Drawer("front only")), between="nothing")
    asset = make_cabinet(Cabinet("chest", Case(width=0.45, depth=depth), layout, mount))
    bare = realize(plan_from_annotation(asset), asset, GALLERY).object
    whole = completed(asset).object
    assert found(asset).refused == ()
    for before, after in zip(bare.joints, whole.joints, strict=True):
        assert before.child == after.child
        assert after.limits.upper >= 0.999 * before.limits.upper


def test_trays_and_solid_blocks_lack_nothing():
    walls = [
        box("side_left", (-0.3, -0.2, 0.0), (-0.28, 0.25, 0.3)),
        box("side_r", (0.28, -0.2, 0.0), (0.3, 0.25, 0.3)),
    ]
    block = box("drawer_block", (-0.26, -0.2, 0.02), (0.26, 0.2, 0.12))
    tray = box("drawer_tray", (-0.26, -0.2, 0.2), (0.26, 0.2, 0.216))
    asset = scene(*walls, block, tray, joints=tuple(sliding(p.id, (0.0, -1.0, 0.0)) for p in (block, tray)))
    assert [v.missing for v in found(asset).verdicts] == [(), ()]


@pytest.mark.parametrize("mount", ["overlay", "inset"])
def test_a_front_alone_gets_four_boards_that_ride_on_it(mount):
    asset = stack("front only", mount=mount)
    made = found(asset)
    assert [v.kind for v in made.verdicts] == ["front only", "front only"]
    for drawer in ("drawer_1", "drawer_2"):
        boards = boards_of(made, drawer)
        assert set(boards) == BOARDS
        assert {p.label for p in boards.values()} == {PartLabel.MISC}
        front = asset.part(drawer).box
        for part in boards.values():
            assert MeshCollider(part.mesh).distance(MeshCollider(boards["bottom"].mesh)) < 1e-6
            assert part.box.low[2] > front.low[2]
            assert part.box.high[2] < front.high[2]
        for name in ("side_left", "side_right", "bottom"):
            assert MeshCollider(boards[name].mesh).distance(MeshCollider(asset.part(drawer).mesh)) < 1e-6
        assert boards["side_left"].box.center[0] < boards["side_right"].box.center[0]


def test_the_box_leaves_room_for_rails_and_ends_before_the_back():
    asset = stack("front only")
    boards = boards_of(found(asset), "drawer_1")
    inside = 0.45 / 2 - CASE.panel
    assert boards["side_left"].box.low[0] == pytest.approx(-inside + 0.0125, abs=1e-3)
    assert boards["side_right"].box.high[0] == pytest.approx(inside - 0.0125, abs=1e-3)
    assert boards["back"].box.high[1] == pytest.approx(asset.part("back_panel").box.low[1] - 0.01, abs=1e-3)


@pytest.mark.parametrize("kind", ["front only", "no bottom"])
def test_completed_drawers_run_on_rails_and_hit_nothing(kind):
    asset = stack(kind)
    before = realize(plan_from_annotation(asset), asset, GALLERY)
    after = completed(asset)
    opening = {o.moving: o.opening for o in before.report.installed}
    assert {o.moving for o in after.report.installed} == {"drawer_1", "drawer_2"}
    for outcome in after.report.installed:
        assert outcome.opening >= 0.95 * opening.get(outcome.moving, 0.0)
        assert outcome.collision_share == 0.0
        assert outcome.largest_gap <= 0.005
        assert outcome.clearances == ()
    for joint in after.object.joints:
        assert swept_collisions(after.object, joint, 12) == {}
        assert {v.name for v in after.object.link(joint.child).visuals} >= {f"{joint.child}_bottom"}


def test_a_missing_bottom_lies_between_the_walls_that_are_there():
    made = found(stack("no bottom"))
    assert {v.missing for v in made.verdicts} == {("bottom",)}
    assert {a.part.id for a in made.additions} == {"drawer_1_bottom", "drawer_2_bottom"}


@pytest.mark.parametrize("gone", ["left", "right", "back", "bottom"])
def test_one_missing_board_is_replaced_where_it_was(gone):
    boards = {
        "left": ((-0.2, -0.18, 0.02), (-0.188, 0.2, 0.14)),
        "right": ((0.188, -0.18, 0.02), (0.2, 0.2, 0.14)),
        "back": ((-0.188, 0.188, 0.02), (0.188, 0.2, 0.14)),
        "bottom": ((-0.188, -0.18, 0.02), (0.188, 0.188, 0.026)),
    }
    walls = [
        box("side", (-0.235, -0.18, 0.0), (-0.2125, 0.25, 0.2)),
        box("end", (0.2125, -0.18, 0.0), (0.235, 0.25, 0.2)),
    ]
    attached = [box(f"board_{k}", *span, carried_by="drawer") for k, span in boards.items() if k != gone]
    front = box("drawer", (-0.23, -0.2, 0.0), (0.23, -0.18, 0.2))
    asset = scene(*walls, front, *attached, joints=(sliding("drawer", (0.0, -1.0, 0.0)),))
    (new,) = found(asset).additions
    low, high = boards[gone]
    np.testing.assert_allclose(new.part.box.low, low, atol=2e-3)
    np.testing.assert_allclose(new.part.box.high, high, atol=2e-3)
    assert new.part.carried_by == "drawer"


def test_walls_are_set_on_a_mere_bottom():
    walls = [box("side", (-0.25, -0.18, 0.0), (-0.23, 0.25, 0.2)), box("end", (0.23, -0.18, 0.0), (0.25, 0.25, 0.2))]
    front = box("drawer", (-0.23, -0.2, 0.0), (0.23, -0.18, 0.2))
    bottom = box("board", (-0.21, -0.18, 0.03), (0.21, 0.2, 0.036), carried_by="drawer")
    asset = scene(*walls, front, bottom, joints=(sliding("drawer", (0.0, -1.0, 0.0)),))
    made = found(asset)
    assert made.verdicts[0].missing == ("side_left", "side_right", "back")
    for addition in made.additions:
        assert addition.part.box.low[2] == pytest.approx(0.036, abs=1e-3)
        assert -0.2101 <= addition.part.box.low[0] <= addition.part.box.high[0] <= 0.2101


@pytest.mark.parametrize("label", [PartLabel.MISC, PartLabel.UNKNOWN])
def test_loose_boards_behind_a_front_are_its_box(label):
    asset = stack("whole")
    for drawer in ("drawer_1", "drawer_2"):
        asset = with_box_apart(asset, drawer)
    boards = [p.id for p in asset.parts if p.carried_by and p.label is PartLabel.MISC]
    asset = replace(asset, parts=tuple(replace(p, carried_by=None) if p.id in boards else p for p in asset.parts))
    asset = asset.with_labels(dict.fromkeys(boards, label))
    made = found(asset)
    assert sorted(part_id for _, part_id in made.loose) == sorted(boards)
    assert {v.kind for v in made.verdicts} == {"whole"}
    assert made.additions == ()
    plan = plan_from_annotation(asset).with_attached(made.loose)
    assert {r for request in plan.joints for r in request.attached} >= set(boards)


def test_the_case_is_no_loose_board():
    for mount in ("overlay", "inset"):
        for layout in (Drawer("front only"), Stack((Drawer("front only"),) * 3)):
            asset = make_cabinet(Cabinet("chest", CASE, layout, mount))
            nameless = asset.with_labels({p.id: PartLabel.UNKNOWN for p in asset.parts})
            assert found(nameless).loose == ()


def test_a_front_on_a_solid_block_is_refused_with_the_reason():
    block = box("body", (-0.3, -0.18, 0.0), (0.3, 0.3, 0.5))
    front = box("drawer", (-0.28, -0.2, 0.1), (0.28, -0.18, 0.3))
    made = found(scene(block, front, joints=(sliding("drawer", (0.0, -1.0, 0.0)),)))
    assert made.additions == ()
    assert "space behind the front is only" in made.refused[0].why


def with_walls_in_the_case(back: bool) -> Asset:
    """A front on a bottom; the walls of its box were drawn with the case, as one part."""
    case = [box("side", (-0.25, -0.18, 0.0), (-0.23, 0.25, 0.2)), box("end", (0.23, -0.18, 0.0), (0.25, 0.25, 0.2))]
    walls = [
        box("left", (-0.21, -0.18, 0.03), (-0.2, 0.2, 0.15)),
        box("right", (0.2, -0.18, 0.03), (0.21, 0.2, 0.15)),
        box("inner", (-0.2, -0.18, 0.03), (0.2, -0.17, 0.19)),
        box("back", (-0.2, 0.19, 0.03), (0.2, 0.2, 0.15)),
    ]
    merged = replace(case[0], surfaces=tuple(s for p in (*case, *walls[: 3 + back]) for s in p.surfaces))
    front = box("drawer", (-0.23, -0.2, 0.0), (0.23, -0.18, 0.2))
    bottom = box("board", (-0.21, -0.18, 0.024), (0.21, 0.2, 0.03), carried_by="drawer")
    return scene(merged, front, bottom, joints=(sliding("drawer", (0.0, -1.0, 0.0)),))


def test_walls_that_were_drawn_with_the_case_are_not_missing():
    made = found(with_walls_in_the_case(back=True))
    assert (made.verdicts[0].kind, made.verdicts[0].missing) == ("whole", ())
    assert "part of what is static" in made.verdicts[0].why
    assert made.additions == made.refused == ()


def test_half_a_box_that_was_drawn_with_the_case_is_missing():
    made = found(with_walls_in_the_case(back=False))
    assert made.verdicts[0].kind == "incomplete"
    assert [r.part for r in made.refused] == ["drawer"]


def test_fronts_back_to_back_share_the_depth():
    sides = [box("side", (-0.3, -0.38, 0.0), (-0.28, 0.38, 0.3)), box("end", (0.28, -0.38, 0.0), (0.3, 0.38, 0.3))]
    near = box("drawer_near", (-0.29, -0.4, 0.0), (0.29, -0.38, 0.3))
    far = box("drawer_far", (-0.29, 0.38, 0.0), (0.29, 0.4, 0.3))
    joints = (sliding("drawer_near", (0.0, -1.0, 0.0)), sliding("drawer_far", (0.0, 1.0, 0.0)))
    made = found(scene(*sides, box("top", (-0.3, -0.4, 0.3), (0.3, 0.4, 0.32)), near, far, joints=joints))
    ends = {a.part.id: a.part.box for a in made.additions}
    assert ends["drawer_near_back"].high[1] < 0.0 < ends["drawer_far_back"].low[1]
    assert ends["drawer_near_back"].high[1] == pytest.approx(-ends["drawer_far_back"].low[1], abs=1e-3)


def test_a_runner_in_the_way_narrows_the_box():
    asset = stack("front only")
    bar = box("runner", (-0.207, -0.2, 0.15), (-0.18, 0.2, 0.18))
    made = found(replace(asset, parts=(*asset.parts, bar)))
    for part in boards_of(made, "drawer_1").values():
        assert part.box.axis_gaps(bar.box).max() > 0.0


@pytest.mark.parametrize("turn", [0.0, 30.0, 90.0, 180.0])
def test_boards_turn_with_the_furniture(turn):
    asset = yawed(stack("front only"), radians(turn))
    straight = found(stack("front only"))
    made = found(asset)
    assert len(made.additions) == 8
    volumes = [sum(a.part.mesh.area for a in some.additions) for some in (straight, made)]
    assert volumes[1] == pytest.approx(volumes[0], rel=0.02)


@pytest.mark.parametrize("factor", [0.1, 10.0])
def test_any_scale_gets_a_box_in_proportion(factor):
    T = np.diag([factor, factor, factor, 1.0])
    asset = stack("front only")
    parts = tuple(replace(p, surfaces=tuple(s.transformed(T) for s in p.surfaces)) for p in asset.parts)
    made = complete_drawers(drawn(replace(asset, parts=parts)), plan_from_annotation(asset))
    assert len(made.additions) == 8
    widths = {a.part.id: a.part.box.size / factor for a in made.additions}
    assert 0.3 < widths["drawer_1_bottom"][0] < 0.42
    assert 0.2 < widths["drawer_1_bottom"][1] < 0.56
    assert 1e-4 < widths["drawer_1_side_left"][0] < 0.02


def test_a_front_drawn_ajar_keeps_its_boards_with_it():
    asset = stack("front only")
    closed = found(asset)
    plan = plan_from_annotation(asset)
    requests = tuple(replace(r, drawn_at=0.1) for r in plan.joints)
    T = translation(vec3(0.0, -0.1, 0.0))
    moving = {r.moving for r in requests} | {p.id for p in asset.parts if p.carried_by}
    parts = tuple(
        replace(p, surfaces=tuple(s.transformed(T) for s in p.surfaces)) if p.id in moving else p for p in asset.parts
    )
    ajar = complete_drawers(drawn(replace(asset, parts=parts)), replace(plan, joints=requests))
    for one, other in zip(closed.additions, ajar.additions, strict=True):
        np.testing.assert_allclose(other.part.box.low, one.part.box.low + vec3(0.0, -0.1, 0.0), atol=1e-6)


def test_the_input_is_only_looked_at_where_nothing_is_to_be_built():
    asset = stack("front only")
    made = complete_drawers(drawn(asset), plan_from_annotation(asset), build=False)
    assert [v.missing for v in made.verdicts] == [("side_left", "side_right", "back", "bottom")] * 2
    assert made.additions == ()


def test_drawers_of_tables_are_whole():
    made = found(make_table(DrawerTable()))
    assert {v.kind for v in made.verdicts} == {"whole"}


def test_a_model_without_drawers_lacks_none():
    body = scene(box("body", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)))
    assert complete_drawers(drawn(body), plan_from_annotation(body)).verdicts == ()
