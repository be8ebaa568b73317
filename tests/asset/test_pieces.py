from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import Part, PartSource
from grafu.asset.pieces import with_joined_pieces
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel

WHOLE = Box(np.zeros(3), np.ones(3))


def part(name, low, high, label=PartLabel.DRAWER, carried_by=None):
    mesh = TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))
    return Part(name, label, (Surface(mesh),), PartSource(name), carried_by=carried_by)


def drawer(tag, low, high):
    """A drawer in five pieces that opens to -Y, its front at y = 0."""
    z = (low + high) / 2
    return [
        part(f"drawer_front{tag}", (0, 0, low), (1, 0.02, high)),
        part(f"drawer_side{tag}a", (0.05, 0.02, low + 0.02), (0.06, 0.5, high - 0.02)),
        part(f"drawer_side{tag}b", (0.94, 0.02, low + 0.02), (0.95, 0.5, high - 0.02)),
        part(f"drawer_bottom{tag}", (0.06, 0.02, low + 0.03), (0.94, 0.5, low + 0.04)),
        part(f"drawer_handle{tag}", (0.4, -0.03, z), (0.6, 0, z + 0.01), PartLabel.HANDLE, f"drawer_side{tag}a"),
    ]


def test_pieces_join_the_front_that_covers_them():
    parts, notes = with_joined_pieces((*drawer("A", 0.0, 0.3), *drawer("B", 0.31, 0.6)), WHOLE)
    assert [p.id for p in parts] == ["drawer_frontA", "drawer_handleA", "drawer_frontB", "drawer_handleB"]
    assert [len(p.surfaces) for p in parts] == [4, 1, 4, 1]
    assert parts[1].carried_by == "drawer_frontA"
    assert len(notes) == 2


@pytest.mark.parametrize(("width", "joins"), [(0.003, True), (0.3, False)])
def test_slivers_that_stretch_a_piece_keep_it_from_no_front(width, joins):
    front, *_, bottom, _ = drawer("", 0.6, 0.9)
    stretched = part("stray", (-0.2, 0.3, 0.0), (-0.2 + width, 0.3, 0.6))
    bottom = replace(bottom, surfaces=(*bottom.surfaces, *stretched.surfaces))
    parts, _ = with_joined_pieces((front, bottom), WHOLE)
    assert (len(parts) == 1) is joins


@pytest.mark.parametrize(("width", "joins"), [(0.1, True), (0.3, False)])
def test_the_side_of_a_drawer_joins_its_front_with_pieces_of_the_runner_drawn_in_it(width, joins):
    front, side, *_ = drawer("A", 0.6, 0.9)
    runners = [part("runner", (0.0, y, 0.55), (width, y + 0.02, 0.57)) for y in (0.1, 0.2, 0.3)]
    side = replace(side, surfaces=(*side.surfaces, *(surface for runner in runners for surface in runner.surfaces)))
    parts, _ = with_joined_pieces((front, side), WHOLE)
    assert (len(parts) == 1) is joins


@pytest.mark.parametrize(("left", "joins"), [(0.1, True), (0.7, False)])
def test_what_is_called_a_door_within_another_is_its_pane(left, joins):
    frame = part("Doors.003", (0, 0, 0), (1, 0.03, 1), PartLabel.DOOR)
    pane = part("Doors.002", (left, 0.01, 0.1), (left + 0.8, 0.02, 0.9), PartLabel.DOOR)
    parts, _ = with_joined_pieces((pane, frame), WHOLE)
    assert {p.id: len(p.surfaces) for p in parts} == ({"Doors.003": 2} if joins else {"Doors.002": 1, "Doors.003": 1})


@pytest.mark.parametrize(
    ("name", "joins"), [("lid_1", True), ("lid.001", True), ("lid_band", False), ("door_1", False)]
)
def test_bands_around_a_lid_join_it_where_their_names_are_those_of_one_object(name, joins):
    lid = part("lid", (0, 0, 0.6), (1, 0.5, 0.8), PartLabel.DOOR)
    band = part(name, (0.1, -0.01, 0.6), (0.15, 0.51, 0.81), PartLabel.DOOR)
    parts, _ = with_joined_pieces((lid, band), WHOLE)
    assert (len(parts) == 1) is joins


def test_a_box_joins_the_plate_that_is_called_the_drawer():
    front = part("bottom_left_drawer", (0, 0, 0), (1, 0.02, 0.3))
    box = part("drawer_container", (0.05, 0.02, 0.03), (0.95, 0.6, 0.27))
    other = part("drawer_container.001", (0.05, 0.02, 0.53), (0.95, 0.6, 0.77))
    parts, _ = with_joined_pieces((front, box, other), WHOLE)
    assert {p.id: len(p.surfaces) for p in parts} == {"bottom_left_drawer": 2, "drawer_container.001": 1}


def test_a_two_sided_desk_joins_each_piece_to_the_nearer_front():
    near, far = part("drawer_front1", (0, 0, 0), (1, 0.02, 0.3)), part("drawer_front2", (0, 0.98, 0), (1, 1, 0.3))
    side = part("drawer_side", (0.1, 0.6, 0.02), (0.12, 0.98, 0.28))
    parts, _ = with_joined_pieces((near, side, far), WHOLE)
    assert {p.id: len(p.surfaces) for p in parts} == {"drawer_front1": 1, "drawer_front2": 2}


def test_a_bottom_at_the_seam_of_two_fronts_joins_the_one_whose_outline_covers_it():
    fronts = [part("drawer_front1", (0, 0, 0), (1, 0.02, 0.3)), part("drawer_front2", (0, 0, 0.3), (1, 0.02, 0.6))]
    bottom = part("drawer_bottom2", (0.01, 0.02, 0.3), (0.99, 0.5, 0.31))
    for order in ([*fronts, bottom], [bottom, *fronts[::-1]]):
        parts, _ = with_joined_pieces(tuple(order), WHOLE)
        assert {p.id: len(p.surfaces) for p in parts} == {"drawer_front1": 1, "drawer_front2": 2}


def test_a_low_front_holds_a_deep_bottom_also_where_a_knob_makes_its_box_deep():
    knob = TriangleMesh.box_mesh(Box(np.array([0.49, -0.12, 0.04]), np.array([0.51, 0.0, 0.06])))
    front = part("drawer_front1", (0, 0, 0), (1, 0.02, 0.1))
    front = replace(front, surfaces=(*front.surfaces, Surface(knob)))
    bottom = part("drawer_bottom1", (0.01, 0.02, 0.02), (0.99, 0.9, 0.03))
    parts, _ = with_joined_pieces((bottom, front), WHOLE)
    assert {p.id: len(p.surfaces) for p in parts} == {"drawer_front1": 3}


def test_the_front_of_the_box_joins_the_front_before_it_and_brings_its_pieces():
    face, inner = (
        part("drawer_front1", (0, 0, 0), (1, 0.02, 0.3)),
        part("drawer_front2", (0.1, 0.02, 0), (0.9, 0.04, 0.25)),
    )
    side = part("drawer_side1", (0.1, 0.04, 0), (0.12, 0.5, 0.25))
    parts, _ = with_joined_pieces((side, inner, face), WHOLE)
    assert {p.id: len(p.surfaces) for p in parts} == {"drawer_front1": 3}


def test_pieces_without_a_front_stay_apart():
    alone = (part("drawer_side1", (0, 0, 0), (0.02, 0.5, 0.2)), part("drawer_bottom1", (0, 0, 0), (0.5, 0.5, 0.01)))
    parts, notes = with_joined_pieces(alone, WHOLE)
    assert parts == alone
    assert not notes


@pytest.mark.parametrize(("y", "count"), [(0.005, 1), (0.2, 2)])
def test_a_pane_joins_the_door_frame_around_it_only_where_they_touch(y, count):
    frame = part("door_frame1", (0, 0, 0), (0.5, 0.02, 1), PartLabel.DOOR)
    pane = part("door_glass1", (0.05, y, 0.05), (0.45, y + 0.004, 0.95), PartLabel.DOOR)
    parts, _ = with_joined_pieces((pane, frame), WHOLE)
    assert len(parts) == count
    assert "door_frame1" in {p.id for p in parts}


def test_a_side_that_no_front_covers_is_no_drawer_where_fronts_are_named():
    beside = part("drawer_side9", (1.1, 0.0, 0.0), (1.15, 0.5, 0.4))
    parts, notes = with_joined_pieces((*drawer("A", 0.0, 0.3), beside), WHOLE)
    assert {p.id: p.label for p in parts}["drawer_side9"] is PartLabel.MISC
    assert notes[-1].startswith("drawer_side9: taken for no drawer")


def test_a_drawer_at_the_bottom_is_a_drawer():
    upper, lower = part("drawer1_top", (0, 0, 0.5), (1, 1, 0.9)), part("drawer1_bottom", (0, 0, 0), (1, 1, 0.4))
    parts, _ = with_joined_pieces((upper, lower), WHOLE)
    assert {p.label for p in parts} == {PartLabel.DRAWER}


def test_neighbouring_doors_and_whole_drawers_are_left_alone():
    doors = tuple(part(f"door_panel{i}", (i * 0.5, 0, 0), (i * 0.5 + 0.5, 0.02, 1), PartLabel.DOOR) for i in range(2))
    wholes = (part("drawer_1", (0, 0, 0), (1, 0.5, 0.3)), part("drawer_2", (0, 0, 0.01), (1, 0.5, 0.29)))
    assert with_joined_pieces(doors + wholes, WHOLE)[0] == doors + wholes


def test_bar_and_posts_that_are_called_a_door_are_its_handle():
    leaf = part("leftdoor", (0, 0, 0), (0.4, 0.02, 0.6), PartLabel.DOOR)
    posts = [
        part(f"leftdoor.00{k}", (0.3, -0.05, z), (0.31, 0, z + 0.01), PartLabel.DOOR) for k, z in ((2, 0.2), (3, 0.4))
    ]
    bar = part("leftdoor.004", (0.3, -0.06, 0.15), (0.31, -0.05, 0.45), PartLabel.DOOR)
    small = part("flap", (0.42, 0, 0), (0.6, 0.02, 0.1), PartLabel.DOOR)
    parts, _ = with_joined_pieces((bar, *posts, leaf, small), WHOLE)
    assert {p.id: p.carried_by for p in parts if p.label is PartLabel.HANDLE} == dict.fromkeys(
        ("leftdoor.004", "leftdoor.002", "leftdoor.003"), "leftdoor"
    )


BOARDS = (
    ((0.05, 0.02, 0.02), (0.06, 0.5, 0.28)),
    ((0.94, 0.02, 0.02), (0.95, 0.5, 0.28)),
    ((0.06, 0.02, 0.03), (0.94, 0.5, 0.04)),
    ((0.06, 0.49, 0.04), (0.94, 0.5, 0.28)),
)


def test_boards_that_are_called_drawers_by_number_join_the_named_front_on_which_they_hang():
    front = part("drawer_front_2", (0, 0, 0), (1, 0.02, 0.3))
    boards = [part(f"drawer_{k}", *bounds) for k, bounds in enumerate(BOARDS)]
    for order in ((front, *boards), (*boards[::-1], front)):
        parts, _ = with_joined_pieces(order, WHOLE)
        assert {p.id: len(p.surfaces) for p in parts} == {"drawer_front_2": 5}


def test_a_whole_drawer_joins_no_named_front_that_it_does_not_hang_on():
    front = part("drawer_front_2", (0, 0, 0), (1, 0.02, 0.3))
    below, within = part("drawer_1", (0, 0, 0.301), (1, 0.4, 0.6)), part("drawer_3", (0.1, 0.1, 0.05), (0.9, 0.5, 0.25))
    wide = part("drawer_4", (-0.2, 0.02, 0.05), (0.9, 0.5, 0.25))
    parts, _ = with_joined_pieces((front, below, within, wide), WHOLE)
    assert {p.id: len(p.surfaces) for p in parts} == dict.fromkeys(
        ("drawer_front_2", "drawer_1", "drawer_3", "drawer_4"), 1
    )


@pytest.mark.parametrize(("low", "joins"), [((0.01, 0.01, 0.1), False), ((0.0, 0.0, 0.9), True)])
def test_a_door_below_a_lid_is_no_piece_of_it_and_a_strip_along_its_edge_is(low, joins):
    lid = part("cabinet_door_surface", (0, 0, 0.92), (0.6, 0.5, 0.94), PartLabel.DOOR)
    upright = part("door_surface", low, (0.59, 0.02, 0.918), PartLabel.DOOR)
    parts, _ = with_joined_pieces((lid, upright), WHOLE)
    assert [p.id for p in parts] == ["cabinet_door_surface", *([] if joins else ["door_surface"])]
