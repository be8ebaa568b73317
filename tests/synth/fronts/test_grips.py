"""Grips as geometry of the leaf: closed, cut where they belong, kept inside the leaf."""

import numpy as np
import pytest

from grafu.synth.fronts.handles import gripped_side
from grafu.synth.fronts.hold import Hold
from grafu.synth.fronts.layout import Door, Drawer, Pair, Rect
from grafu.synth.fronts.leaf_relief import LeafShape
from grafu.synth.fronts.leaves import gripped_slab, leaf_surfaces
from grafu.synth.pieces.finish import PLAIN

FRONT = Rect(0.0, 0.5, 0.0, 0.3)
CUT = ("scoop", "slot", "finger hole")
every_cut = pytest.mark.parametrize("grip", CUT)
every_side = pytest.mark.parametrize("side", ["left", "right", "top", "bottom"])


def leaf(grip: str, side: str = "top", along: float = 0.5, rect: Rect = FRONT) -> LeafShape:
    return LeafShape("slab", rect, 0.0, 0.02, "top", grip, side, along)  # type: ignore[arg-type]


def mesh_of(shape: LeafShape):
    return leaf_surfaces(shape, PLAIN)[0].mesh


@pytest.mark.parametrize("grip", [*CUT, "edge channel", "lip"])
@every_side
@pytest.mark.parametrize("along", [0.0, 0.65, 1.0])
@pytest.mark.parametrize("rect", [FRONT, Rect(0.0, 0.1, 0.0, 0.06)], ids=["ordinary", "tiny"])
def test_gripped_leaves_are_closed_solids_in_their_outline(grip, side, along, rect):
    mesh = mesh_of(leaf(grip, side, along, rect))
    assert mesh.is_watertight
    assert 0 < mesh.to_trimesh().volume < 1.3 * rect.width * rect.height * 0.02
    assert np.allclose(mesh.box.low[[0, 2]], (rect.x0, rect.z0))
    assert np.allclose(mesh.box.high, (rect.x1, 0.02, rect.z1))


@every_cut
@every_side
def test_cuts_go_through_near_their_edge(grip, side):
    inner = mesh_of(leaf(grip, side)).vertices
    cut = inner[(np.abs(inner[:, 0] - 0.25) < 0.2499) & (np.abs(inner[:, 2] - 0.15) < 0.1499)]
    axis, edge = {"left": (0, 0.0), "right": (0, 0.5), "bottom": (2, 0.0), "top": (2, 0.3)}[side]
    assert np.abs(cut[:, axis] - edge).max() < 0.06
    assert {0.0, 0.02} == set(np.round(cut[:, 1], 6))


def test_a_lip_stands_before_the_front_and_a_channel_behind_it():
    assert mesh_of(leaf("lip")).box.low[1] == pytest.approx(-0.016)
    channel = mesh_of(leaf("edge channel"))
    assert channel.box.low[1] == pytest.approx(0.0)
    assert channel.to_trimesh().volume < 0.5 * 0.3 * 0.02


def test_cutting_needs_a_cut():
    with pytest.raises(ValueError, match="scoop, slot or finger hole"):
        gripped_slab(leaf("lip"))


@pytest.mark.parametrize("front", [Door, Pair, Drawer])
def test_only_slabs_are_gripped(front):
    assert front(grip="scoop").grip == "scoop"
    with pytest.raises(ValueError, match="cut into a slab"):
        front(leaf="shaker", grip="scoop")


@pytest.mark.parametrize(("free", "hinge_x"), [("right", 0.0), ("left", 0.5)])
def test_a_lip_on_top_of_a_door_ends_before_its_hinge(free, hinge_x):
    shape = LeafShape("slab", FRONT, 0.0, 0.02, free, "lip", "top")
    lip = mesh_of(shape).vertices
    lip = lip[lip[:, 1] < -0.01]
    assert np.abs(lip[:, 0] - hinge_x).min() > 0.029
    assert np.abs(lip[:, 0] - hinge_x).max() == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("place", "hinge", "side"),
    [
        ("usual", "left", "right"),
        ("hinge edge", "left", "right"),
        ("top edge", "left", "top"),
        ("top edge", "top", "bottom"),
        ("usual", None, "top"),
        ("bottom edge", None, "bottom"),
        ("middle line", "right", "left"),
    ],
)
def test_no_grip_is_at_a_hinge(place, hinge, side):
    assert gripped_side(Hold(place), hinge) == side
