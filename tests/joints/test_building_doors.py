"""A leaf in a frame that stands on the floor turns about the edge away from its handle; wardrobes have none."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from building_scenes import frame, knob, leaf
from grafu.asset.edit import mirrored
from grafu.asset.part import Asset
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.building_doors import building_door, with_door_labels
from grafu.joints.motion_choice import FIXED
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.pipeline.settings import Settings
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel
from judging import swept_collisions
from small_scenes import box, scene


def built(*parts):
    return functionalize(scene(*parts), MotionSource.NETWORK, builtin_gallery())


@pytest.mark.parametrize("at", [0.11, 0.79])
@pytest.mark.parametrize(("y", "towards"), [((-0.06, -0.02), -1.0), ((0.02, 0.06), 1.0)])
def test_a_leaf_turns_about_the_edge_away_from_its_handle_to_the_face_that_it_is_nearer_to(at, y, towards):
    made = built(frame(), leaf(y), knob(at, (y[0] - 0.04, y[0])))
    (joint,) = made.object.joints
    assert (joint.child, joint.type) == ("panel", JointType.REVOLUTE)
    assert {v.name for v in made.object.link("panel").visuals if v.role == "part"} == {"panel", "grip"}
    assert bool(joint.axis.point[0] < 0.45) is (at > 0.45)
    opens = joint.axis.direction[2] * (1.0 if at > 0.45 else -1.0)  # of the free edge, along Y
    assert opens == pytest.approx(towards)
    assert not swept_collisions(made.object, joint, 12)
    assert joint.limits.upper > 1.5
    report = report_of(made)
    assert report.verdict.colour != "red"
    assert {part.id: part.category for part in report.parts}["panel"] is PartLabel.DOOR


@pytest.mark.parametrize("reach", [0.0, 1e-7])
@pytest.mark.parametrize("depth", [0.06, 0.14])
def test_a_threshold_that_its_leaf_touches_stays(depth, reach):
    """By rounding the two overlap."""
    strip = replace(box("strip", (0.05, -depth, 0.0), (0.85, depth, 0.005 + reach)), label=PartLabel.BOTTOM_PANEL)
    made = built(frame(), leaf(), knob(), strip)
    assert building_door(made.asset) is not None
    (joint,) = made.object.joints
    assert {v.name for v in made.object.link(joint.child).visuals if v.role == "part"} == {"panel", "grip"}
    assert abs(joint.axis.direction[2]) == pytest.approx(1.0)


def test_what_stands_before_a_leaf_is_no_threshold_and_a_seal_below_it_goes_with_it():
    stand = box("stand", (0.05, -0.3, 0.0), (0.85, -0.1, 0.3))
    assert building_door(scene(frame(), leaf(), knob(), stand)) is None
    seal = box("seal", (0.06, -0.05, 0.0), (0.84, -0.03, 0.005))
    found = building_door(scene(frame(), leaf(), knob(), seal))
    assert {part.id for part in found.on_leaf[0]} == {"grip", "seal"}


def test_in_the_middle_of_its_frame_a_leaf_opens_away_from_the_only_knob():
    for before in (True, False):
        grip = knob(0.79, (-0.06, -0.02) if before else (-0.02, 0.02))
        (joint,) = built(frame(), leaf((-0.02, 0.02)), grip).object.joints
        assert bool(joint.axis.direction[2] > 0) is before


def test_two_leaves_open_in_the_middle():
    made = built(frame(), leaf(x=(0.053, 0.449), name="one"), leaf(x=(0.451, 0.847), name="other"))
    places = {joint.child: joint.axis.point[0] for joint in made.object.joints}
    assert places["one"] < 0.1
    assert places["other"] > 0.8


def half(low: float, high: float, name: str):
    return box(name, (0.053, -0.06, low), (0.847, -0.02, high))


@pytest.mark.parametrize("at", [0.11, 0.79])
def test_the_two_leaves_of_a_divided_door_turn_about_one_edge(at):
    """The knob is on the lower one alone."""
    made = built(frame(), half(0.005, 1.1, "lower"), half(1.106, 2.045, "upper"), knob(at))
    axes = {joint.child: joint.axis for joint in made.object.joints}
    assert set(axes) == {"lower", "upper"}
    assert {bool(axis.point[0] < 0.45) for axis in axes.values()} == {at > 0.45}
    assert all(abs(axis.direction[2]) == pytest.approx(1.0) for axis in axes.values())


@pytest.mark.parametrize(
    "boards",
    [
        (half(0.005, 1.1, "lower"), half(1.3, 2.045, "upper")),
        (half(0.005, 1.1, "lower"), box("upper", (0.3, -0.06, 1.106), (0.847, -0.02, 2.045))),
        (half(0.5, 1.1, "lower"), half(1.106, 2.045, "upper")),
    ],
    ids=["far above", "narrower", "above the floor"],
)
def test_boards_that_are_not_two_halves_of_a_door_are_none(boards):
    assert building_door(scene(frame(), *boards)) is None


def test_a_leaf_that_stands_beside_its_frame_slides_before_it():
    (request,) = built(frame(), leaf((-0.1, -0.062), (-0.4, 0.45))).plan.joints
    assert request.type is JointType.PRISMATIC
    assert request.axis.direction[0] == pytest.approx(-1.0)
    assert request.drawn_at == pytest.approx(0.425)


def jambs(name="inner", sill=0.0):
    """A frame that stands in the outer one, 0.1 narrower, with a rail below where `sill` is the height of one."""
    pieces = [
        box("a", (0.05, -0.05, 0.0), (0.1, 0.05, 2.05)),
        box("b", (0.8, -0.05, 0.0), (0.85, 0.05, 2.05)),
        box("c", (0.1, -0.05, 2.0), (0.8, 0.05, 2.05)),
        *([box("d", (0.1, -0.05, 0.0), (0.8, 0.05, sill))] if sill else []),
    ]
    return replace(box(name, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=tuple(s for p in pieces for s in p.surfaces))


def standing(low, name="panel"):
    return box(name, (0.102, -0.01, low), (0.798, 0.01, 1.998))


def test_in_a_frame_within_a_frame_the_leaf_moves_and_both_frames_stay():
    """Buttons and a sign beside the leaf stay as well."""
    beside = (
        box("buttons", (0.06, -0.06, 1.0), (0.09, -0.05, 1.2)),
        box("sign", (0.4, -0.055, 2.01), (0.5, -0.05, 2.04)),
    )
    found = building_door(scene(frame(), jambs(), standing(0.003), *beside))
    assert found is not None
    assert (found.frame.id, [part.id for part in found.inner_frames]) == ("frame", ["inner"])
    assert [part.id for part in found.leaves] == ["panel"]
    labels = {part.id: part.label for part in with_door_labels(scene(frame(), jambs(), standing(0.003))).parts}
    assert labels["inner"] is PartLabel.FACE_FRAME
    assert [joint.child for joint in built(frame(), jambs(), standing(0.003), *beside).object.joints] == ["panel"]


def test_a_leaf_with_a_rail_below_its_pane_is_no_frame():
    found = building_door(scene(frame(), jambs("panel", sill=0.05), standing(0.045, "pane")))
    assert found is not None
    assert [part.id for part in found.leaves] == ["panel"]
    assert [[part.id for part in parts] for parts in found.on_leaf] == [["pane"]]


NOT_DOORS = {
    "a mirror": (
        replace(frame(), surfaces=(*frame().surfaces, *box("d", (0.05, -0.06, 0.0), (0.85, 0.06, 0.2)).surfaces)),
        box("glass", (0.05, -0.01, 0.2), (0.85, 0.0, 2.05)),
    ),
    "a low one": tuple(
        replace(p, surfaces=box(p.id, tuple(0.5 * p.box.low), tuple(0.5 * p.box.high)).surfaces) for p in (leaf(),)
    ),
    "a wardrobe": (frame(0.5), leaf((-0.27, -0.25)), box("shelf", (0.05, -0.2, 1.0), (0.85, 0.25, 1.02))),
    "a bookcase with a back": (frame(0.25), leaf((0.11, 0.125)), box("shelf", (0.05, -0.12, 1.0), (0.85, 0.11, 1.02))),
    "a cabinet with a drawer": (
        frame(0.3, width=1.5),
        leaf((-0.17, -0.15), (0.053, 0.8)),
        box("board", (0.82, -0.15, 0.0), (1.45, 0.15, 1.4)),
    ),
    "a cabinet with what is called a drawer": (
        frame(0.3, width=1.5),
        leaf((-0.17, -0.15), (0.053, 1.2)),
        box("drawer", (1.22, -0.15, 0.3), (1.45, 0.12, 0.5)),
    ),
    "a panel before a wall": (box("wall", (0.0, 0.0, 0.0), (0.9, 0.1, 2.1)), leaf()),
}


@pytest.mark.parametrize("what", NOT_DOORS)
def test_other_pieces_are_no_doors(what):
    assert building_door(scene(*NOT_DOORS[what])) is None


def test_labels_of_the_user_stay_and_a_mirror_image_is_found_alike():
    asset = scene(frame(), replace(leaf(), label=PartLabel.SIDE_PANEL, labelled_by="user"), knob())
    assert with_door_labels(asset).part("panel").label is PartLabel.SIDE_PANEL
    assert isinstance(mirrored(asset), Asset)
    assert building_door(mirrored(asset)) is not None


def test_the_user_may_fix_a_leaf():
    asset = scene(frame(), leaf(), knob())
    config = PipelineConfig(Settings(motions={"panel": FIXED}))
    assert functionalize(asset, MotionSource.NETWORK, builtin_gallery(), config).object.joints == ()


def standing_open(angle, x):
    """A leaf that is turned out of its frame about a corner, radians, and then moved so far from the left jamb."""
    panel = leaf(y=(-0.02, 0.02), x=(0.0, 0.794), name="door")
    turn = trimesh.transformations.rotation_matrix(-angle, (0, 0, 1), (0.0, -0.02, 0.0))
    mesh = panel.mesh.vertices @ turn[:3, :3].T + turn[:3, 3] + (x, -0.04, 0.0)
    return replace(panel, surfaces=(Surface(TriangleMesh(mesh, panel.mesh.faces)),))


@pytest.mark.parametrize("angle", [0.82, 1.3, 1.55])
def test_a_leaf_that_is_drawn_open_across_its_frame_closes_about_the_edge_about_which_it_fits(angle):
    made = built(frame(), standing_open(angle, 0.053))
    (joint,) = made.object.joints
    closed = next(v for v in made.object.link("door").visuals if v.name == "door").mesh.box
    assert np.allclose(closed.low[:2], (0.053, -0.06), atol=0.004)
    assert np.allclose(closed.high[:2], (0.847, -0.02), atol=0.004)
    assert joint.limits.upper > 1.5
    assert joint.axis.direction[2] < -0.9
    assert joint.axis.point[0] < 0.1
    assert not swept_collisions(made.object, joint, 12)


def test_a_leaf_across_its_frame_that_fits_into_it_about_no_edge_stays_and_the_report_states_why():
    made = built(frame(), standing_open(0.82, 0.3))
    assert made.object.joints == ()
    (line,) = [line for line in report_of(made).verdict.lines if line.part == "door"]
    assert "drawn open" in line.why


@pytest.mark.parametrize(("y", "towards"), [((-0.06, -0.02), -1.0), ((0.02, 0.06), 1.0)])
def test_a_casing_before_the_frame_is_part_of_it(y, towards):
    """The casing is wider and higher than the frame, and flat: a leaf flush with the frame's front is behind it."""
    bars = [
        box("casing", (-0.08, -0.08, 0.0), (0.02, -0.061, 2.12)),
        box("casing", (0.88, -0.08, 0.0), (0.98, -0.061, 2.12)),
        box("casing", (-0.08, -0.08, 2.06), (0.98, -0.061, 2.16)),
    ]
    casing = replace(bars[0], surfaces=tuple(surface for bar in bars for surface in bar.surfaces))
    (joint,) = built(frame(), casing, leaf(y), knob(0.79, (y[0] - 0.04, y[0]))).object.joints
    assert joint.axis.direction[2] == pytest.approx(towards)


@pytest.mark.parametrize(("width", "lifts"), [(2.4, True), (1.3, False)])
@pytest.mark.parametrize("y", [(-0.06, -0.02), (0.02, 0.06)])
def test_a_leaf_that_is_too_wide_for_side_hinges_lifts_as_that_of_a_garage(width, lifts, y):
    made = built(frame(width=width), leaf(y, (0.053, width - 0.053)))
    (joint,) = made.object.joints
    assert bool(abs(joint.axis.direction[0]) > 0.9) is lifts
    assert bool(joint.axis.point[2] > 1.9) is lifts
    assert joint.limits.upper > 1.5
    assert not swept_collisions(made.object, joint, 12)
