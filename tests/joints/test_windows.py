"""Leaves of frame and panes in a closed frame move as windows do; pictures, mirrors and cabinets have none."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.edit import mirrored
from grafu.graph.edges import Hinge, Slide
from grafu.joints.motion_choice import FIXED, choice_in_words
from grafu.joints.windows import window, with_window_labels
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.synth.openings.door import DoorSpec, make_building_door
from grafu.synth.openings.window import WindowSpec, make_window
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel
from judging import swept_collisions
from small_scenes import box, scene


def bare(asset):
    """The asset as it is read without joints: nothing is labelled or carried."""
    parts = tuple(replace(p, label=PartLabel.UNKNOWN, labelled_by="none", carried_by=None) for p in asset.parts)
    return replace(asset, parts=parts, joints=(), small_joints=())


def built(asset, source=MotionSource.NETWORK, **settings):
    return functionalize(asset, source, builtin_gallery(), PipelineConfig(Settings(**settings)))


SPECS = (
    WindowSpec(hinge="right"),
    WindowSpec(kind="awning", width=1.0, height=0.6, at_back=True),
    WindowSpec(kind="hopper", width=1.0, height=0.6, sill=0.05),
    WindowSpec(kind="pair", width=1.2, handle=False),
    WindowSpec(kind="sash", height=1.4, depth=0.13),
)


@pytest.mark.parametrize("source", [MotionSource.NETWORK, MotionSource.ANNOTATION])
@pytest.mark.parametrize("spec", SPECS, ids=lambda spec: spec.kind)
def test_a_window_moves_as_its_shape_shows_and_as_is_stated(spec, source):
    asset = make_window(spec)
    made = built(bare(asset) if source is MotionSource.NETWORK else asset, source)
    truth = {joint.part: joint for joint in asset.joints}
    assert {joint.child for joint in made.object.joints} == set(truth)
    for joint in made.object.joints:
        true = truth[joint.child]
        assert joint.type is true.type
        assert float(joint.axis.direction @ true.axis.direction) == pytest.approx(1.0, abs=1e-6)
        if joint.kind.turns:
            assert np.linalg.norm(joint.axis.closest_point(true.axis.point) - true.axis.point) < 0.06
        assert joint.limits.upper >= 0.7 * true.upper
        assert not swept_collisions(made.object, joint, 10)
    if source is MotionSource.NETWORK:
        doors = {part.id for part in made.asset.parts if part.label is PartLabel.DOOR}
        assert doors == set(truth)  # the upper sash stays, and is none
        assert made.report.skipped == made.fittings.refusals == ()  # it has no inside for shelves


NOT_WINDOWS = {
    "a picture": (make_window(WindowSpec()).part("window_frame"), box("canvas", (-0.3, 0.0, 0.05), (0.3, 0.01, 1.05))),
    "an empty frame": (make_window(WindowSpec()).part("window_frame"),),
    "a frame without panes": tuple(p for p in make_window(WindowSpec()).parts if p.id != "pane"),
    "a cabinet": (*make_window(WindowSpec()).parts, box("back", (-0.35, 0.3, 0.0), (0.35, 0.31, 1.1))),
    "a door with a threshold": make_building_door(DoorSpec()).parts,
}


@pytest.mark.parametrize("what", NOT_WINDOWS)
def test_other_pieces_are_no_windows(what):
    assert window(scene(*NOT_WINDOWS[what])) is None


def test_labels_of_the_user_stay_and_a_mirror_image_is_found_alike():
    asset = bare(make_window(WindowSpec()))
    stated = replace(asset.part("leaf"), label=PartLabel.SIDE_PANEL, labelled_by="user")
    corrected = replace(asset, parts=tuple(stated if p.id == "leaf" else p for p in asset.parts))
    assert with_window_labels(corrected).part("leaf").label is PartLabel.SIDE_PANEL
    assert with_window_labels(asset).part("leaf").label is PartLabel.DOOR
    assert window(mirrored(asset)) is not None


def test_the_user_may_fix_a_leaf_or_state_how_it_moves():
    asset = bare(make_window(WindowSpec()))
    assert built(asset, motions={"leaf": FIXED}).object.joints == ()
    made = built(asset, motions={"leaf": choice_in_words("top")})
    (joint,) = made.object.joints
    assert abs(joint.axis.direction[0]) == pytest.approx(1.0)
    assert {v.name for v in made.object.link("leaf").visuals if v.role == "part"} == {"leaf", "pane", "handle"}


def test_the_kinds_of_motion_are_those_of_hinges_and_rails():
    kinds = {joint.type for spec in SPECS for joint in make_window(spec).joints}
    assert kinds == {Hinge.joint_type, Slide.joint_type}


def ring(name, low, high, wide):
    """A frame of four boards as one part, open in its middle."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    ends = [
        ((x0, y0, z0), (x1, y1, z0 + wide)),
        ((x0, y0, z1 - wide), (x1, y1, z1)),
        ((x0, y0, z0), (x0 + wide, y1, z1)),
        ((x1 - wide, y0, z0), (x1, y1, z1)),
    ]
    boards = [box(name, *both) for both in ends]
    return replace(boards[0], surfaces=tuple(surface for board in boards for surface in board.surfaces))


def side_by_side(shift: float, bar: float = 0.06):
    """Two sashes that stand beside one another in their frame, 10 mm apart, the right one `shift` metres behind."""
    left = (-0.46, -0.03, 0.06), (-0.005, -0.005, 0.94)
    right = (0.005, -0.03 + shift, 0.06), (0.46, -0.005 + shift, 0.94)
    panes = [
        box(f"pane_{k}", (low[0] + 0.03, low[1] + 0.01, 0.09), (high[0] - 0.03, high[1] - 0.01, 0.91))
        for k, (low, high) in enumerate((left, right))
    ]
    pull = box("pull", (-0.05, -0.03 - bar, 0.4), (-0.03, -0.03, 0.6))
    frame = ring("frame", (-0.52, -0.05, 0.0), (0.52, 0.05, 1.0), 0.055)
    return scene(frame, ring("west", *left, 0.04), ring("east", *right, 0.04), *panes, pull)


def test_sashes_side_by_side_in_two_planes_slide_past_one_another():
    made = built(bare(side_by_side(shift=0.035)))
    joints = {joint.child: joint for joint in made.object.joints}
    assert {name: joint.axis.direction[0] for name, joint in joints.items()} == pytest.approx({"west": 1, "east": -1})
    assert all(joint.kind.slides and joint.limits.upper > 0.3 for joint in joints.values())
    assert {visual.name for visual in made.object.link("west").visuals} >= {"west", "pane_0", "pull"}


def test_casements_side_by_side_in_one_plane_turn():
    made = built(bare(side_by_side(shift=0.0)))
    assert {joint.child for joint in made.object.joints if joint.kind.turns} == {"west", "east"}
    assert all(joint.kind.turns for joint in made.object.joints)


def over_one_another(height: float, shift: float = 0.0):
    """A window with a leaf of 0.58 m that is so high, metres, above one of 0.9 m, beside it by a shift."""
    frame = ring("frame", (0.0, 0.0, 0.0), (1.3, 0.07, 1.7), 0.05)
    low, top = (0.06, 0.005, 0.06), 0.98 + height
    leaves = [ring("low", low, (0.64, 0.05, 0.96), 0.05)]
    leaves.append(ring("high", (0.06 + shift, 0.005, 0.98), (0.64 + shift, 0.05, top), 0.05))
    inset = np.array([0.05, 0.02, 0.05])
    panes = [box(f"pane_{k}", one.box.low + inset, one.box.high - inset) for k, one in enumerate(leaves)]
    return built(scene(frame, *leaves, *panes))


@pytest.mark.parametrize(("height", "shift", "hangs"), [(0.35, 0.0, True), (0.62, 0.0, False), (0.35, 0.6, False)])
def test_a_low_leaf_above_a_higher_one_of_its_width_hangs_from_its_upper_edge(height, shift, hangs):
    axes = {joint.child: joint.axis for joint in over_one_another(height, shift).object.joints}
    assert (abs(float(axes["high"].direction[0])) > 0.9) is hangs
    assert abs(float(axes["low"].direction[2])) > 0.9


def three_leaves(called: bool, sill: float):
    """A frame with three glazed leaves; the middle one and its pane are one object, which is a door by its name."""
    low, high = 0.02 + sill, 1.94
    frame = ring("frame", (-0.92, -0.05, 0.0), (0.92, 0.05, 2.0), max(sill, 0.05))
    spans = {"west": (-0.86, -0.31), "middle": (-0.30, 0.30), "east": (0.31, 0.86)}
    rings = {name: ring(name, (x0, -0.03, low), (x1, 0.0, high), 0.05) for name, (x0, x1) in spans.items()}
    panes = {
        n: box(f"pane_{n}", (x0 + 0.04, -0.02, low + 0.04), (x1 - 0.04, -0.01, 1.9)) for n, (x0, x1) in spans.items()
    }
    pull = box("pull", (-0.27, -0.06, 0.9), (-0.25, -0.03, 1.05))
    if called:
        whole = (*rings["middle"].surfaces, *panes.pop("middle").surfaces)
        rings["middle"] = replace(rings["middle"], surfaces=whole, label=PartLabel.DOOR, labelled_by="name")
    return scene(frame, *rings.values(), *panes.values(), pull)


@pytest.mark.parametrize("sill", [0.05, 0.0], ids=["window", "door of a building"])
@pytest.mark.parametrize(("called", "turning"), [(True, {"middle"}), (False, {"west", "middle", "east"})])
def test_where_a_leaf_is_called_a_door_it_turns_and_the_others_stay(sill, called, turning):
    made = built(three_leaves(called, sill))
    assert {joint.child for joint in made.object.joints} == turning
    assert all(joint.kind.turns and joint.limits.upper > 1.0 for joint in made.object.joints)


@pytest.mark.parametrize("sill", [0.05, 0.0], ids=["window", "door of a building"])
@pytest.mark.parametrize(("called", "left"), [(("middle", "east"), True), (("west", "middle"), False)])
def test_a_leaf_without_a_handle_hangs_on_the_leaf_that_stays(sill, called, left):
    """At its other edge stands the leaf that opens before it."""
    asset = three_leaves(False, sill)
    parts = {part.id: part for part in asset.parts if part.id != "pull"}
    for name in called:
        whole = (*parts[name].surfaces, *parts.pop(f"pane_{name}").surfaces)
        parts[name] = replace(parts[name], surfaces=whole, label=PartLabel.DOOR, labelled_by="name")
    x = 0.34 if left else -0.36
    made = built(scene(*parts.values(), box("pull", (x, -0.06, 0.9), (x + 0.02, -0.03, 1.05))))
    hung = {joint.child: joint for joint in made.object.joints}
    assert set(hung) == set(called)
    assert bool(hung["middle"].axis.point[0] < 0) is left
    outer = next(name for name in called if name != "middle")
    assert abs(float(hung[outer].axis.point[0])) > 0.8
