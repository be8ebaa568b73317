"""How fronts can be grasped: made ones of which it is known."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from front_scenes import cabinet, scaled, scene_of, with_handles_in_their_fronts, without_handles
from grafu.additions.handle.grasp import find_grasp, find_grasps
from grafu.asset.edit import yawed
from grafu.geometry.arrays import vec3
from grafu.scene.scale import metre_on
from grafu.synth.fronts.layout import Door, Drawer, Pair, Stack
from grafu.synth.samples import KINDS
from grafu.templates.handles import HANDLES
from grafu.vocabulary import PartLabel
from small_scenes import box, scene, sliding

LEAVES = (
    "slab", "chamfered", "rounded", "shaker", "glass", "mirror", "muntins", "louvred", "raised panel", "two panels",
    "planks", "arched rail",
)  # fmt: skip
GRIPS = {"scoop": "recess", "slot": "recess", "finger hole": "recess", "edge channel": "recess", "lip": "edge"}


@pytest.mark.parametrize("leaf", LEAVES)
def test_a_bare_door_of_any_style_cannot_be_grasped(leaf):
    grasp = find_grasp(scene_of(cabinet(Door(handle="none", leaf=leaf))), "door")
    assert (grasp.kind, grasp.center) == ("none", None)


@pytest.mark.parametrize("leaf", [leaf for leaf in LEAVES if leaf != "mirror"])
def test_a_bare_drawer_front_of_any_style_cannot_be_grasped(leaf):
    asset = cabinet(Stack((Drawer(handle="none", leaf=leaf), Drawer(handle="none", leaf=leaf))))
    assert {g.kind for g in find_grasps(scene_of(asset)).values()} == {"none"}


@pytest.mark.parametrize("hinge", ["left", "right", "top", "bottom"])
@pytest.mark.parametrize("grip", GRIPS)
def test_a_grip_cut_into_a_door_is_found_where_it_is(grip, hinge):
    asset = cabinet(Door(hinge, handle="none", grip=grip))
    grasp = find_grasp(scene_of(asset), "door")
    assert grasp.kind == GRIPS[grip], grasp.why
    leaf = asset.part("door").box
    axis, end = {"left": (0, 1), "right": (0, -1), "top": (2, -1), "bottom": (2, 1)}[hinge]
    off_middle = (grasp.center[axis] - leaf.center[axis]) / leaf.half[axis]
    assert off_middle * end > 0.6  # by the free edge


@pytest.mark.parametrize("grip", GRIPS)
def test_a_grip_cut_into_a_drawer_is_found(grip):
    asset = cabinet(Stack((Drawer(handle="none", grip=grip), Drawer(handle="none", grip=grip))))
    assert {g.kind for g in find_grasps(scene_of(asset)).values()} == {GRIPS[grip]}


@pytest.mark.parametrize("template", HANDLES, ids=lambda t: t.id)
@pytest.mark.parametrize("front", [Door, Drawer])
def test_a_handle_is_known_by_its_label_or_by_its_shape(template, front):
    asset = cabinet(front(handle=template.id))
    labelled = next(iter(find_grasps(scene_of(asset)).values()))
    assert (labelled.kind, labelled.confidence) == ("handle", 1.0)
    assert asset.part(labelled.part).label is PartLabel.HANDLE
    merged = next(iter(find_grasps(scene_of(with_handles_in_their_fronts(asset))).values()))
    assert merged.kind in ("edge", "recess"), merged.why
    assert np.linalg.norm(merged.center - labelled.center) < max(0.03, 0.5 * labelled.length)


@pytest.mark.parametrize("label", [PartLabel.MISC, PartLabel.UNKNOWN])
def test_a_small_part_that_sticks_out_is_a_handle_whatever_it_is_called(label):
    asset = cabinet(Door())
    parts = tuple(replace(p, label=label) if p.label is PartLabel.HANDLE else p for p in asset.parts)
    assert find_grasp(scene_of(replace(asset, parts=parts)), "door").kind == "handle"


def test_a_handle_that_nothing_attaches_counts_for_the_front_that_it_sits_on():
    asset = cabinet(Pair())
    loose = tuple(replace(p, carried_by=None) if p.label is PartLabel.HANDLE else p for p in asset.parts)
    grasps = find_grasps(scene_of(replace(asset, parts=loose)))
    assert {g.kind for g in grasps.values()} == {"handle"}
    assert len({g.part for g in grasps.values()}) == 2
    assert all(g.confidence < 1.0 for g in grasps.values())


def test_gaps_that_bowed_and_arched_fronts_leave_are_found():
    for leaf in ("bowed", "arched"):  # behind the bulge, and beside the arch
        grasp = find_grasp(scene_of(cabinet(Door(handle="none", leaf=leaf))), "door")
        assert grasp.kind in ("edge", "recess")
        assert grasp.confidence < 0.9


def walls(half, height):
    """Boards on both sides of an opening, 3 mm from what stands in it."""
    left = box("side_left", (-half - 0.05, 0.0, 0.0), (-half - 0.003, 0.5, height))
    return left, box("side_right", (half + 0.003, 0.0, 0.0), (half + 0.05, 0.5, height))


def drawer_under(gap: float, thickness: float = 0.02):
    """A drawer front of 0.5 x 0.2 m with a box behind it, and a board above it at a gap."""
    front = box("drawer", (-0.25, 0.0, 0.1), (0.25, thickness, 0.3))
    above = box("shelf", (-0.25, 0.0, 0.3 + gap), (0.25, 0.5, 0.32 + gap))
    below = box("bottom", (-0.25, 0.0, 0.0), (0.25, 0.5, 0.097))
    asset = scene(front, above, below, *walls(0.25, 0.4), joints=(sliding("drawer", (0.0, -1.0, 0.0)),))
    return find_grasp(scene_of(asset), "drawer")


@pytest.mark.parametrize(("gap", "kind"), [(0.003, "none"), (0.008, "none"), (0.018, "edge"), (0.04, "edge")])
def test_a_gap_above_a_front_is_a_grip_if_fingers_fit(gap, kind):
    grasp = drawer_under(gap)
    assert grasp.kind == kind
    if kind == "edge":
        assert grasp.center[2] > 0.29
        assert grasp.length > 0.4


def test_an_edge_thicker_than_a_hand_reaches_round_is_none():
    assert drawer_under(0.03, thickness=0.05).kind == "edge"
    assert drawer_under(0.03, thickness=0.15).kind == "none"


def test_a_tray_is_held_by_its_edge_where_it_is_free():
    tray = box("drawer", (-0.3, 0.0, 0.60), (0.3, 0.4, 0.62))
    free = scene(tray, box("top", (-0.5, 0.0, 0.7), (0.5, 0.5, 0.73)), joints=(sliding("drawer", (0.0, -1.0, 0.0)),))
    tight = scene(
        tray,
        box("top", (-0.5, 0.0, 0.622), (0.5, 0.5, 0.7)),
        box("apron", (-0.5, 0.0, 0.5), (0.5, 0.5, 0.598)),
        *walls(0.3, 0.7),
        joints=(sliding("drawer", (0.0, -1.0, 0.0)),),
    )
    assert find_grasp(scene_of(free), "drawer").kind == "edge"
    assert find_grasp(scene_of(tight), "drawer").kind == "none"


def test_what_is_near_the_hinge_opens_no_door():
    knob = box("knob", (0.0, 0.0, 0.0), (0.02, 0.02, 0.02))
    asset = cabinet(Door("left", handle="none"))
    leaf = asset.part("door")
    for ratio, kind in ((0.9, "edge"), (0.1, "none")):
        at = leaf.box.low + vec3(ratio * float(leaf.box.size[0]), -0.02, 0.5 * float(leaf.box.size[2]))
        surfaces = tuple(replace(s, mesh=s.mesh.translated(at)) for s in knob.surfaces)
        parts = tuple(replace(p, surfaces=(*p.surfaces, *surfaces)) if p is leaf else p for p in asset.parts)
        assert find_grasp(scene_of(replace(asset, parts=parts)), "door").kind == kind


def test_a_closed_door_hides_no_handle_of_the_drawers_behind_it():
    asset = with_handles_in_their_fronts(KINDS["drawers behind a pair"]())
    grasps = find_grasps(scene_of(asset))
    assert {g.kind for moving, g in grasps.items() if moving.startswith("drawer")} == {"edge"}


@given(angle=st.floats(-175, 175), grip=st.sampled_from(["finger hole", "lip", "none"]))
@settings(max_examples=12, deadline=None)
def test_the_way_furniture_faces_changes_nothing(angle, grip):
    asset = cabinet(Pair(handle="none", grip=grip))
    as_it_is, turned = (find_grasps(scene_of(a)) for a in (asset, yawed(asset, radians(angle))))
    assert {m: g.kind for m, g in as_it_is.items()} == {m: g.kind for m, g in turned.items()}


@pytest.mark.parametrize("factor", [0.1, 1.0])
@pytest.mark.parametrize(("grip", "kind"), [("finger hole", "recess"), ("none", "none")])
def test_small_models_are_grasped_by_small_hands(factor, grip, kind):
    asset = scaled(cabinet(Pair(handle="none", grip=grip)), factor)
    assert {g.kind for g in find_grasps(scene_of(asset)).values()} == {kind}


@pytest.mark.parametrize(("extent", "factor"), [(0.05, 0.1), (0.5, 1.0), (3.9, 1.0), (8.0, 2.0)])
def test_hands_are_scaled_for_furniture_of_no_common_size(extent, factor):
    assert metre_on(extent) == pytest.approx(factor)


def test_a_front_without_faces_cannot_be_grasped_or_is_refused():
    asset = without_handles(cabinet(Door(handle="none")))
    with pytest.raises(KeyError):
        find_grasp(scene_of(asset), "no such door")
