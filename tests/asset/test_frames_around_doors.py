"""What is called a door but stands around doors is their frame; a leaf's own frame stays a door with its pane."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.door_frames import with_door_frames
from grafu.asset.load import load_asset
from grafu.asset.part import Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.vocabulary import PartLabel


def board(low, high):
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def part(name, *boards):
    return Part(name, PartLabel.DOOR, (Surface(merge_meshes([board(*ends) for ends in boards])),), PartSource(name))


def ring(name="frame_door", sill=False, depth=0.1):
    """Two posts and a lintel, 1.8 wide and 2.1 high, and a bar below where there is a sill."""
    posts = [((x, -depth / 2, 0), (x + 0.06, depth / 2, 2.1)) for x in (0.0, 1.74)]
    bars = [((0.06, -depth / 2, z), (1.74, depth / 2, z + 0.06)) for z in ((0.0, 2.04) if sill else (2.04,))]
    return part(name, *posts, *bars)


def leaf(name, low, high, floor=0.0):
    return part(name, ((low, -0.02, floor), (high, 0.02, 2.04)))


def nameless(number, *boards):
    return replace(part(f"Object_{number}", *boards), label=PartLabel.UNKNOWN)


PAIR = ((0.06, 0.899), (0.901, 1.74))


def frames(*parts):
    found, notes = with_door_frames(parts)
    taken = [p.id for p in found if p.label is PartLabel.FACE_FRAME]
    assert len(notes) == len(taken)
    return taken


@pytest.mark.parametrize("sill", [False, True])
def test_a_ring_around_two_doors_is_their_frame(sill):
    floor = 0.06 if sill else 0.0
    pair = [leaf(f"door_{k}", *ends, floor=floor) for k, ends in enumerate(PAIR)]
    assert frames(ring(sill=sill), *pair) == ["frame_door"]


def test_around_one_door_the_frame_is_open_at_the_floor():
    """Below its pane a leaf has a rail."""
    assert frames(ring(), leaf("door", 0.06, 1.74)) == ["frame_door"]
    assert frames(ring(sill=True), leaf("door", 0.06, 1.74, floor=0.06)) == []


def test_panes_side_by_side_stay_in_the_frame_of_their_leaf():
    panes = [leaf(f"door_glass_{k}", *ends, floor=0.06) for k, ends in enumerate(PAIR)]
    assert frames(ring(sill=True), *panes) == []


def test_doors_that_fill_little_of_a_ring_and_a_plate_behind_doors_make_no_frame():
    """A leaf may have two small hatches in it; and a panel is closed behind the doors that lie on it."""
    hatches = [leaf(f"door_{k}", x, x + 0.2, floor=1.7) for k, x in enumerate((0.3, 1.2))]
    assert frames(ring(sill=True), *hatches) == []
    panel = part("doors", ((0, 0.02, 0), (1.8, 0.04, 2.1)))
    assert frames(panel, *(leaf(f"door_{k}", *ends) for k, ends in enumerate(PAIR))) == []


@pytest.mark.parametrize("name", ["door_frame", "Türrahmen"])
def test_what_is_called_a_doors_frame_holds_leaves_without_a_name(name):
    """The two leaves of a stable door stand one above the other; below the pane of one leaf runs a rail."""
    heights = ((0, 1), (1.01, 2.04))
    lower, upper = (nameless(k, ((0.06, -0.02, low), (1.74, 0.02, high))) for k, (low, high) in enumerate(heights))
    assert frames(ring(name), lower, upper) == [name]
    assert frames(ring("door"), lower, upper) == []
    assert frames(ring(name), lower) == []
    pane = nameless(3, ((0.06, -0.02, 0.06), (1.74, 0.02, 2.04)))
    assert frames(ring(name, sill=True), pane) == []


@pytest.mark.parametrize("name", ["door_frame_0", "Türrahmen"])
def test_what_is_called_a_doors_frame_may_have_a_threshold(name):
    """A "frame door" is a door that has a frame: what stands in it is its panel, whatever that is called."""
    door = leaf("door_1", 0.06, 1.74, floor=0.06)
    assert frames(ring(name, sill=True), door) == [name]
    assert frames(ring("frame_door", sill=True), door) == []
    assert frames(ring(name, sill=True), leaf("door_panel", 0.06, 1.74, floor=0.06)) == []
    assert frames(ring(name, sill=True), leaf("door_1", 0.5, 1.2, floor=0.06)) == []


def test_what_the_input_states_to_open_is_the_leaf_and_what_stands_around_it_is_not():
    opening = "sweethome3d_opening_on_hinge_1_door"
    stated = leaf(opening, 0.06, 1.74, floor=0.06)
    assert frames(ring(sill=True), stated) == ["frame_door"]
    assert frames(ring("sweethome3d_opening_on_hinge_2_door", sill=True), stated) == []


def write_obj(path, parts):
    """Groups of boards in centimetres, Y up."""
    lines, count = [], 0
    for one in parts:
        mesh = one.mesh
        lines += [f"o {one.id}"]
        lines += [f"v {100 * x:.4f} {100 * z:.4f} {-100 * y:.4f}" for x, y, z in mesh.vertices]
        lines += ["f " + " ".join(str(k + 1 + count) for k in face) for face in mesh.faces]
        count += len(mesh.vertices)
    path.write_text("\n".join(lines))
    return path


def test_two_stated_leaves_in_a_frame_that_is_called_a_door_stay_two_doors(tmp_path):
    names = [f"sweethome3d_opening_on_hinge_{k}_door" for k in (1, 2)]
    pair = [leaf(name, *ends) for name, ends in zip(names, PAIR, strict=True)]
    asset = load_asset(write_obj(tmp_path / "double.obj", [ring("frame_door_Cube"), *pair]))
    labels = {p.id: p.label for p in asset.parts}
    assert labels == {"frame_door_Cube": PartLabel.FACE_FRAME, **dict.fromkeys(names, PartLabel.DOOR)}
