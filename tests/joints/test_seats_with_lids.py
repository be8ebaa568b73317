"""A ring and a closed plate of one outline are the seat and the lid of a toilet; a pane in a frame is none."""

from dataclasses import replace

import numpy as np
import pytest
import shapely
import trimesh

from grafu.asset.part import Asset, Part
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import rotation_about
from grafu.joints.plan import RealizationPlan
from grafu.joints.realize import realize
from grafu.joints.ring_seats import seat_pair, with_seat_labels, with_seat_pair
from grafu.vocabulary import PartLabel
from judging import GALLERY, installed
from small_scenes import box

HEIGHT, THICK = 0.4, 0.02
OUTLINE = shapely.affinity.scale(shapely.Point(0.0, 0.0).buffer(1.0), 0.18, 0.22)


def plate(name: str, low: float, hole: float = 0.0, raised: float = 0.0, size: float = 1.0) -> Part:
    """An oval plate of the seat's outline, with a hole (fraction of it), raised by degrees about its rear edge."""
    outline = shapely.affinity.scale(OUTLINE, size, size)
    if hole:
        outline = outline.difference(shapely.affinity.scale(OUTLINE, hole, hole))
    made = trimesh.creation.extrude_polygon(outline, THICK)
    mesh = TriangleMesh(np.asarray(made.vertices, float) + np.array([0.0, 0.0, low]), np.asarray(made.faces, int))
    turn = rotation_about(np.array([0.0, 0.22, HEIGHT]), vec3(-1.0, 0.0, 0.0), np.radians(raised))
    return replace(
        box(name, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)),
        label=PartLabel.UNKNOWN,
        surfaces=(Surface(mesh.transformed(turn)),),
    )


def bowl(depth: float = 0.2) -> Part:
    """What is below the seat: a block with a round bowl in it."""
    rim = trimesh.creation.extrude_polygon(OUTLINE.difference(shapely.affinity.scale(OUTLINE, 0.7, 0.7)), depth)
    base = trimesh.creation.extrude_polygon(OUTLINE, HEIGHT - depth - 0.005)
    rim.apply_translation((0.0, 0.0, HEIGHT - depth - 0.005))
    made = trimesh.util.concatenate([rim, base])
    mesh = TriangleMesh(np.asarray(made.vertices, float), np.asarray(made.faces, int))
    return replace(box("pan", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), label=PartLabel.UNKNOWN, surfaces=(Surface(mesh),))


SEAT = plate("a", HEIGHT, hole=0.65)
LID = plate("b", HEIGHT + THICK + 0.002)
LEGS = tuple(box(f"leg_{x}_{y}", (x, y, 0.0), (x + 0.03, y + 0.03, 0.39)) for x in (-0.1, 0.07) for y in (-0.1, 0.07))


def pair(*parts: Part):
    return seat_pair(Asset("made", "", "made", parts))


@pytest.mark.parametrize("raised", [0.0, 92.0])
def test_a_seat_and_its_lid_are_hinged_at_their_rear(raised):
    lid = plate("b", HEIGHT + THICK + 0.002, raised=raised)
    found = pair(bowl(), SEAT, lid)
    assert found is not None
    assert (found.seat.id, found.lid.id) == ("a", "b")
    assert np.allclose(found.pin.direction, (-1, 0, 0))
    assert np.allclose(found.pin.point[1:], (0.22, found.lid.box.high[2] if not raised else HEIGHT), atol=0.025)


def test_a_sheet_seen_from_its_edge_is_no_lid():
    corners = np.array([[0.0, -0.22, HEIGHT], [0.0, 0.22, HEIGHT], [0.0, 0.22, HEIGHT + 0.05]])
    sheet = replace(LID, id="sheet", surfaces=(Surface(TriangleMesh(corners, np.array([[0, 1, 2]]))),))
    assert pair(bowl(), SEAT, sheet) is None


def test_both_may_be_raised_where_they_are_named():
    doors = [
        replace(plate(n, HEIGHT + z, hole, 90.0), label=PartLabel.DOOR)
        for n, z, hole in (("a", 0.0, 0.65), ("b", 0.022, 0.0))
    ]
    found = pair(bowl(), *doors)
    assert found is not None
    assert np.allclose(found.pin.point[1:], (0.22, HEIGHT), atol=0.03)


@pytest.mark.parametrize(
    "parts",
    [
        (*LEGS, SEAT, LID),
        (bowl(depth=0.02), SEAT, LID),
        (bowl(), SEAT, plate("b", HEIGHT + THICK + 0.002, size=0.7)),
        (bowl(), SEAT, plate("b", HEIGHT + 0.2)),
        (bowl(), plate("a", HEIGHT), LID),
    ],
    ids=["a pane on the frame of a table", "a flat tray", "a smaller plate", "a shelf far above", "two plates"],
)
def test_other_plates_are_no_such_pair(parts):
    assert pair(*parts) is None


def test_both_are_doors_each_with_a_joint_of_its_own():
    asset = with_seat_labels(Asset("made", "", "made", (bowl(), SEAT, LID)))
    assert [part.label for part in asset.parts] == [PartLabel.UNKNOWN, PartLabel.DOOR, PartLabel.DOOR]
    plan = with_seat_pair(RealizationPlan(), asset)
    assert {request.moving: request.attached for request in plan.joints} == {"a": (), "b": ()}
    assert with_seat_pair(RealizationPlan(), asset, settled=("a",)) == RealizationPlan()


def test_both_rise_in_front_of_a_tank_close_behind_them():
    tank = box("tank", (-0.2, 0.235, HEIGHT - 0.02), (0.2, 0.4, HEIGHT + 0.4))
    asset = with_seat_labels(Asset("made", "", "made", (bowl(), SEAT, LID, tank)))
    built = installed(realize(with_seat_pair(RealizationPlan(), asset), asset, GALLERY))

    assert min(built["a"].opening, built["b"].opening) > np.radians(80)
    assert built["a"].after == ("b_joint",)
    assert max(built["a"].largest_gap, built["b"].largest_gap) < 0.05
