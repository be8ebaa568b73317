"""Backs and bottoms that storage furniture lacks are found, and closed on request; tables and racks lack nothing."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from grafu.additions.carcass.complete import complete_carcass
from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.carcass.missing_panels import missing_panels
from grafu.asset.edit import yawed
from grafu.asset.part import Asset
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.swept_body import SweptBody
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.realize import realize
from grafu.pipeline.additions import planned_scene
from grafu.scene.scale import metre_on
from grafu.scene.scene import Scene
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Base
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Layout, Pair, Stack
from grafu.synth.fronts.setting import Mount
from grafu.synth.tables.table import DrawerTable, make_table
from grafu.vocabulary import PartLabel
from judging import GALLERY, made_kind
from small_scenes import box, hinged, scene, sliding

LAYOUTS: dict[str, Layout] = {
    "pair": Pair(shelves=1),
    "doors on a divider": CellRow((Door("right"), Door("left"))),
    "drawers": Stack((Drawer(),) * 3, between="nothing"),
    "pair over a drawer": Stack((Pair(), Drawer()), (3.0, 1.0)),
}


def cabinet(layout: str, mount: Mount = "overlay", base: str = "plinth") -> Asset:
    gap = 0.003 if mount == "overlay" else 0.002
    return make_cabinet(Cabinet("cabinet", Case(base=Base(base)), LAYOUTS[layout], mount, gap=gap))


def without(asset: Asset, label: PartLabel) -> Asset:
    return replace(asset, parts=tuple(p for p in asset.parts if p.label is not label))


def drawn(asset: Asset) -> Scene:
    return planned_scene(asset, plan_from_annotation(asset))


def missing(asset: Asset) -> list[PartLabel]:
    return [panel.what for panel in missing_panels(drawn(asset), plan_from_annotation(asset))]


def closed(asset: Asset):
    return complete_carcass(drawn(asset), plan_from_annotation(asset))


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("mount", ["overlay", "inset"])
def test_a_whole_cabinet_lacks_nothing(layout, mount):
    assert missing(cabinet(layout, mount)) == []


@pytest.mark.parametrize("label", [PartLabel.BACK_PANEL, PartLabel.BOTTOM_PANEL])
@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("mount", ["overlay", "inset"])
def test_what_is_taken_away_is_missed_and_closed_again(label, layout, mount):
    asset = without(cabinet(layout, mount), label)
    made = closed(asset)
    assert {panel.what for panel in made.missing} == {label}
    assert {a.part.label for a in made.additions} == {label}
    assert made.refused == ()
    for addition in made.additions:
        board = addition.part.mesh
        assert addition.part.carried_by is None
        body = SweptBody(board, 5e-4)
        assert [p.id for p in asset.parts if body.penetrates(MeshCollider(p.mesh))] == []
        still = [p for p in asset.parts if not p.label.is_movable and p.carried_by is None]
        assert min(MeshCollider(board).distance(MeshCollider(p.mesh)) for p in still) < 1e-3
    whole = replace(asset, parts=(*asset.parts, *(a.part for a in made.additions)))
    assert missing(whole) == []


@pytest.mark.parametrize("label", [PartLabel.BACK_PANEL, PartLabel.BOTTOM_PANEL])
@pytest.mark.parametrize("layout", ["pair", "drawers"])
def test_a_closed_carcass_opens_as_far_as_before(label, layout):
    asset = without(cabinet(layout), label)
    made = closed(asset)
    whole = replace(asset, parts=(*asset.parts, *(a.part for a in made.additions)))
    before, after = (realize(plan_from_annotation(a), a, GALLERY).report for a in (asset, whole))
    openings = {o.moving: o.opening for o in before.installed}
    assert {o.moving for o in after.installed} >= set(openings)
    for outcome in after.installed:
        assert outcome.collision_share == 0.0
        assert outcome.opening >= 0.97 * openings[outcome.moving]


def test_one_back_closes_adjoining_bays():
    made = closed(without(cabinet("doors on a divider"), PartLabel.BACK_PANEL))
    assert len(made.missing) == 2
    assert len(made.additions) == 1
    assert made.additions[0].part.box.size[0] > 0.7


def test_labels_are_not_needed():
    asset = without(cabinet("pair"), PartLabel.BACK_PANEL)
    nameless = asset.with_labels({p.id: PartLabel.UNKNOWN for p in asset.parts})
    assert missing(nameless) == [PartLabel.BACK_PANEL]


@pytest.mark.parametrize("turn", [30.0, 90.0, 180.0])
def test_turned_cabinets_are_judged_alike(turn):
    whole = yawed(cabinet("pair"), radians(turn))
    assert missing(whole) == []
    made = closed(without(whole, PartLabel.BACK_PANEL))
    assert [a.part.label for a in made.additions] == [PartLabel.BACK_PANEL]


def in_scale(asset: Asset, factor: float) -> Asset:
    T = np.diag([factor, factor, factor, 1.0])
    parts = tuple(replace(p, surfaces=tuple(s.transformed(T) for s in p.surfaces)) for p in asset.parts)
    joints = tuple(replace(j, axis=replace(j.axis, point=factor * j.axis.point)) for j in asset.joints)
    return replace(asset, parts=parts, joints=joints)


@pytest.mark.parametrize("factor", [0.1, 10.0])
def test_any_scale_is_judged_alike(factor):
    made = closed(in_scale(without(cabinet("pair"), PartLabel.BOTTOM_PANEL), factor))
    assert [a.part.label for a in made.additions] == [PartLabel.BOTTOM_PANEL]
    assert 1e-4 * factor < made.additions[0].part.box.size[2] < 0.03 * factor


@pytest.mark.parametrize("factor", [1.0, 10.0, 30.0])
def test_a_bottom_is_as_thick_as_the_scale_of_the_model_says(factor):
    asset = in_scale(without(cabinet("pair"), PartLabel.BOTTOM_PANEL), factor)
    extent = float(Box.enclosing(p.box for p in asset.parts).size.max())

    bottom = closed(asset).additions[0].part.box

    assert bottom.size[2] == pytest.approx(CarcassConfig().bottom * metre_on(extent))


@pytest.mark.parametrize("options", [{}, {"has_aprons": False}, {"two_sided": True}])
def test_tables_have_no_carcass(options):
    assert missing(make_table(DrawerTable(**options))) == []


def test_open_shelves_and_racks_have_no_carcass():
    boards = [box("left", (-0.4, -0.15, 0.0), (-0.38, 0.15, 1.2)), box("right", (0.38, -0.15, 0.0), (0.4, 0.15, 1.2))]
    boards += [box(f"board_{k}", (-0.38, -0.15, 0.4 * k), (0.38, 0.15, 0.4 * k + 0.02)) for k in range(3)]
    assert missing(scene(*boards)) == []


def test_a_door_on_a_frame_without_depth_has_no_carcass():
    post = box("post", (-0.06, -0.02, 0.0), (0.0, 0.02, 0.6))
    other = box("other", (0.4, -0.02, 0.0), (0.46, 0.02, 0.6))
    door = box("door", (0.0, -0.02, 0.0), (0.4, 0.0, 0.6))
    assert missing(scene(post, other, door, joints=(hinged(),))) == []


def test_a_back_door_closes_the_back():
    walls = [box("left", (-0.4, -0.2, 0.0), (-0.38, 0.2, 0.6)), box("right", (0.38, -0.2, 0.0), (0.4, 0.2, 0.6))]
    walls += [box("bottom", (-0.38, -0.2, 0.0), (0.38, 0.2, 0.02)), box("top", (-0.38, -0.2, 0.58), (0.38, 0.2, 0.6))]
    front = box("drawer_front", (-0.4, -0.22, 0.0), (0.4, -0.2, 0.6))
    rear = box("drawer_rear", (-0.4, 0.2, 0.0), (0.4, 0.22, 0.6))
    joints = (sliding("drawer_front", (0.0, -1.0, 0.0)), sliding("drawer_rear", (0.0, 1.0, 0.0)))
    assert missing(scene(*walls, front, rear, joints=joints)) == []
    assert missing(scene(*walls, front, joints=joints[:1])) == [PartLabel.BACK_PANEL]


def test_low_drawers_leave_no_room_for_a_bottom():
    walls = [box("left", (-0.4, -0.2, 0.0), (-0.38, 0.2, 0.4)), box("right", (0.38, -0.2, 0.0), (0.4, 0.2, 0.4))]
    walls.append(box("back", (-0.38, 0.18, 0.0), (0.38, 0.2, 0.4)))
    drawer = box("drawer", (-0.37, -0.2, 0.0), (0.37, 0.17, 0.38))
    made = closed(scene(*walls, drawer, joints=(sliding("drawer", (0.0, -1.0, 0.0)),)))
    assert [panel.what for panel in made.missing] == [PartLabel.BOTTOM_PANEL]
    assert made.additions == ()
    assert made.refused[0].why.startswith("no bottom panel: no board fits")


@pytest.mark.parametrize("kind", ["no top", "chest with a lid", "corner door at 45 degrees", "desk with a pedestal"])
def test_other_furniture_that_is_whole_lacks_nothing(kind):
    assert missing(made_kind(kind)) == []


def test_a_model_without_fronts_lacks_nothing():
    assert missing(scene(box("body", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)))) == []
