"""What is called by a place alone is what its shape makes it, where places do not tell."""

import numpy as np
import pytest
import trimesh

from grafu.asset.labels import label_of
from grafu.asset.load import load_asset
from grafu.asset.part import Part, PartSource
from grafu.asset.place_names import with_place_names
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel


def part(name, low, high):
    mesh = TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))
    return Part(name, label_of(name), (Surface(mesh),), PartSource(name), "name")


def labels(*parts):
    found, notes = with_place_names(parts)
    assert len(notes) == sum(new.label is not old.label for new, old in zip(found, parts, strict=True))
    return [p.label for p in found]


UPPER, LOWER = ((0, 0, 0.41), (0.6, 0.02, 0.7)), ((0, 0, 0.0), (0.6, 0.02, 0.4))


def test_several_fronts_may_be_doors_and_drawers_one_is_a_board():
    assert labels(part("A1_front1", *UPPER), part("A1_front2", *LOWER)) == [PartLabel.UNKNOWN] * 2
    assert labels(part("front", *UPPER)) == [PartLabel.FACE_FRAME]
    named = part("front panel", *UPPER), part("face frame", *LOWER), part("front", *LOWER)
    assert labels(*named) == [PartLabel.FACE_FRAME] * 3


@pytest.mark.parametrize("name", ["front", "front panel", "front_panel_2", "fascia_0"])
def test_a_single_front_with_a_handle_on_it_alone_is_no_fixed_board(name):
    handle = part("handle", (0.25, -0.03, 0.5), (0.35, 0, 0.52))
    beside = part("side panel", (0.24, 0, 0.2), (0.36, 0.4, 0.6))
    drawer = part("drawer", (0.2, -0.001, 0.45), (0.4, 0.3, 0.55))
    board = part(name, *UPPER)

    assert labels(board, handle) == [PartLabel.UNKNOWN, PartLabel.HANDLE]
    assert labels(board, handle, drawer)[0] is PartLabel.FACE_FRAME
    assert labels(board, handle, beside)[0] is PartLabel.FACE_FRAME
    assert labels(part(f"fixed {name}", *UPPER), handle)[0] is PartLabel.FACE_FRAME
    assert labels(part(name, (0, 0, 0.41), (0.6, 0.2, 0.7)), handle)[0] is PartLabel.FACE_FRAME


@pytest.mark.parametrize("turn", [0, 1])
def test_left_and_right_beside_each_other_are_no_sides_of_a_case(turn):
    def turned(name, low, high):
        return part(name, np.roll(low, turn), np.roll(high, turn))

    leaves = turned("left", (0, 0, 0), (0.4, 0.02, 0.7)), turned("right", (0.41, 0.001, 0), (0.8, 0.021, 0.7))
    knob = turned("left_2", (0.35, -0.03, 0.3), (0.37, 0, 0.32))
    walls = turned("left", (0, 0, 0), (0.02, 0.4, 0.7)), turned("right", (0.8, 0, 0), (0.82, 0.4, 0.7))
    assert labels(*leaves, knob) == [PartLabel.UNKNOWN] * 3
    assert labels(*walls) == [PartLabel.SIDE_PANEL] * 2
    # two halves of one wall, each called by the same word, and a wall that is called more than that
    assert labels(leaves[0], turned("left", (0.41, 0, 0), (0.8, 0.02, 0.7))) == [PartLabel.SIDE_PANEL] * 2
    panels = turned("left panel", (0, 0, 0), (0.4, 0.02, 0.7)), turned("right panel", (0.41, 0, 0), (0.8, 0.02, 0.7))
    assert labels(*panels) == [PartLabel.SIDE_PANEL] * 2


def test_what_is_called_a_frame_and_held_by_a_handle_is_a_door():
    frame, knob = part("frame_1", (0, 0, 0), (0.4, 0.02, 0.7)), part("knob", (0.36, -0.03, 0.3), (0.38, 0, 0.32))
    beside, drawer = (
        part("knob", (0.36, -0.05, 0.3), (0.38, -0.02, 0.32)),
        part("drawer", (0.3, -0.02, 0), (0.8, 0, 0.7)),
    )
    deep = part("frame", (0, 0, 0), (0.4, 0.4, 0.7))
    assert labels(frame, knob) == [PartLabel.DOOR, PartLabel.HANDLE]
    assert labels(frame) == [PartLabel.FACE_FRAME]
    assert labels(frame, beside) == [PartLabel.FACE_FRAME, PartLabel.HANDLE]  # it sits on something else
    assert labels(frame, beside, drawer)[0] is PartLabel.FACE_FRAME
    assert labels(frame, knob, drawer)[0] is PartLabel.FACE_FRAME
    assert labels(deep, knob)[0] is PartLabel.FACE_FRAME
    assert labels(part("face frame", (0, 0, 0), (0.4, 0.02, 0.7)), knob)[0] is PartLabel.FACE_FRAME


def test_a_frame_around_several_leaves_is_none_of_these():
    frame = part("frame", (0, 0, 0), (1.2, 0.04, 1.0))
    knob = part("knob", (0.55, -0.03, 0.5), (0.57, 0, 0.52))
    leaves = [part(f"sash_{k}", (x, 0, 0.05), (x + 0.545, 0.03, 0.95)) for k, x in enumerate((0.05, 0.605))]
    assert labels(frame, knob, *leaves)[0] is PartLabel.FACE_FRAME
    assert labels(frame, knob, leaves[0])[0] is PartLabel.DOOR  # one panel may be that of the door itself


@pytest.mark.parametrize("name", ["mirror", "leaf_mirror", "glass_2"])
def test_a_mirror_or_pane_is_a_door_where_a_handle_sits_on_it_alone(name):
    pane, knob = part(name, (0, 0, 0), (0.4, 0.01, 0.7)), part("knob", (0.3, -0.03, 0.3), (0.32, 0, 0.32))
    stile = part("stile", (0.31, -0.005, 0), (0.4, 0.015, 0.7))
    assert labels(pane, knob) == [PartLabel.DOOR, PartLabel.HANDLE]
    assert labels(pane) == [PartLabel.MISC]
    assert labels(pane, knob, stile)[0] is PartLabel.MISC  # it sits on the frame of the pane, too


@pytest.mark.parametrize("name", ["cabinet_frame_vertical_bar", "rod_3"])
def test_what_is_called_a_bar_is_a_door_where_it_is_wide_and_a_handle_sits_on_it_alone(name):
    leaf, knob = part(name, (0, 0, 0), (0.6, 0.04, 0.5)), part("knob", (0.3, -0.03, 0.4), (0.32, 0, 0.42))
    slim = part(name, (0, 0, 0.3), (0.6, 0.04, 0.5))
    drawer = part("drawer", (0.31, -0.005, 0.3), (0.7, 0.02, 0.5))
    assert labels(leaf, knob) == [PartLabel.DOOR, PartLabel.HANDLE]
    assert labels(leaf) == [PartLabel.BAR]
    assert labels(slim, knob)[0] is PartLabel.BAR
    assert labels(leaf, knob, drawer)[0] is PartLabel.BAR  # it sits on the drawer, too


def test_fronts_of_a_file_are_read_without_a_label(tmp_path):
    scene = trimesh.Scene()
    boxes = {"U1_carcass": ((0, 0.02, 0), (0.6, 0.5, 0.7)), "A1_front1": UPPER, "A1_front2": LOWER}
    for name, bounds in boxes.items():
        scene.add_geometry(trimesh.creation.box(bounds=bounds), node_name=name, geom_name=name)
    scene.export(tmp_path / "unit.glb")
    asset = load_asset(tmp_path / "unit.glb")
    assert {p.label for p in asset.parts if "front" in p.source.name} == {PartLabel.UNKNOWN}
    assert sum("states a place alone" in note for note in asset.notes) == 2
