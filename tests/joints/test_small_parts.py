"""Knobs, buttons, wheels and casters get joints of their own, and nothing else does."""

from dataclasses import replace
from math import pi

import mujoco
import numpy as np
import pytest
import trimesh
import yourdfpy

from grafu.articulation.sweep import cycle_tracks
from grafu.asset.edit import yawed
from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.part import AnnotatedJoint, PartSource
from grafu.export.files import write_files
from grafu.export.glb import export_glb
from grafu.export.mjcf import export_mjcf
from grafu.export.urdf import export_urdf
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.graph.parse import parse_graph
from grafu.joints.config import RealizationConfig
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.pipeline.settings import Settings
from grafu.pipeline.shown_by_shape import shown_by_shape
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel
from judging import swept_collisions
from small_scenes import DOOR, SIDE, box, cylinder, drawer, hinged, scene

BACK = box("back", (-0.02, 0.38, 0.0), (0.4, 0.4, 0.6))
OTHER_SIDE = box("other_side", (0.4, 0.0, 0.0), (0.42, 0.4, 0.6))
CASE = (SIDE, OTHER_SIDE, BACK)


def made_of(*parts, small=True, source=MotionSource.RULE, **settings):
    asset = parts[0] if len(parts) == 1 else scene(*parts)
    config = PipelineConfig(Settings(small_parts=small, **settings))
    return functionalize(asset, source, builtin_gallery(), config)


def small_joints(made):
    planned = {request.moving for request in made.plan.joints}
    return {joint.child: joint for joint in made.object.joints if joint.child not in planned}


def knob(name="handle", x=0.36, ends=(-0.02, -0.05), radius=0.015):
    return cylinder(name, ((x, ends[0], 0.3), (x, ends[1], 0.3)), radius)


def mark(name="handle_mark", x=0.36, before=-0.05):
    """A line on the front of a knob, which shows how far it is turned."""
    return box(name, (x - 0.002, before - 0.001, 0.3), (x + 0.002, before + 0.001, 0.312))


def ball(name="handle_ball", x=0.36, y=-0.048, radius=0.02):
    mesh = trimesh.creation.uv_sphere(radius, count=(24, 24))
    mesh.apply_translation((x, y, 0.3))
    return replace(
        cylinder(name, ((x, y, 0.3), (x, y - 0.01, 0.3))), surfaces=(Surface(TriangleMesh.from_trimesh(mesh)),)
    )


DIAL = cylinder("dial", ((0.5, 0.0, 0.3), (0.5, -0.02, 0.3)), 0.02)
PANEL = box("panel", (0.42, 0.0, 0.0), (0.58, 0.02, 0.6))


def caster(name, x, y):
    """A wheel of 60 mm on an axle between two cheeks, under a plate at 0.1 m with a stem into the board above."""
    sides = ((x - 0.022, x - 0.02), (x + 0.02, x + 0.022))
    cheeks = [box(f"{name}_cheek_{k}", (a, y - 0.01, 0.03), (b, y + 0.01, 0.08)) for k, (a, b) in enumerate(sides)]
    plate = box(f"{name}_plate", (x - 0.022, y - 0.02, 0.08), (x + 0.022, y + 0.02, 0.09))
    stem = cylinder(f"{name}_stem", ((x, y, 0.09), (x, y, 0.11)), 0.006)
    axle = cylinder(f"{name}_axle", ((x - 0.022, y, 0.03), (x + 0.022, y, 0.03)), 0.003)
    return [*cheeks, plate, stem, axle, cylinder(f"{name}_roll", ((x - 0.015, y, 0.03), (x + 0.015, y, 0.03)), 0.03)]


def trolley(*more):
    boards = [box("floor_board", (-0.3, -0.3, 0.1), (0.3, 0.3, 0.12)), box("wall", (-0.3, 0.28, 0.12), (0.3, 0.3, 0.7))]
    return [*boards, *more]


def test_a_knob_with_a_mark_turns_on_its_door_and_the_door_keeps_its_handle():
    made = made_of(*CASE, DOOR, knob(), mark())
    (joint,) = small_joints(made).values()

    assert (joint.parent, joint.child, joint.type) == ("door", "handle", JointType.CONTINUOUS)
    assert np.allclose(joint.axis.direction, (0, -1, 0))
    assert joint.axis.distance_to(np.array([0.36, 0.0, 0.3])) < 1e-6
    assert joint.limits.upper == pytest.approx(2 * pi)
    records = {record.part: record for record in report_of(made).joints}
    assert (records["handle"].small, records["handle"].grasp, records["handle"].collision_share) == (True, "itself", 0)
    assert (records["door"].small, records["door"].grasp) == (False, "handle")
    assert {visual.name for visual in made.object.link("handle").visuals} == {"handle", "handle_mark"}
    assert not [addition for addition in made.additions if addition.part.label is PartLabel.HANDLE]
    assert "1 door and 1 small part" in report_of(made).verdict.sentence
    assert not swept_collisions(made.object, made.object.joint_of["door"], 20)


@pytest.mark.parametrize("small", [None, False])
def test_without_being_asked_for_nothing_small_moves(small):
    made = made_of(*CASE, DOOR, knob(), mark(), small=small)
    assert [joint.child for joint in made.object.joints] == ["door"]


def in_link(link, *parts):
    return [replace(part, source=PartSource(part.id, link=link)) for part in parts]


@pytest.mark.parametrize(("small", "moving"), [(None, {"handle"}), (False, set()), (True, {"handle", "dial"})])
def test_by_default_what_is_a_link_of_its_own_in_a_robot_description_turns(small, moving):
    body = in_link("body", *CASE, PANEL, DIAL)
    made = made_of(*body, *in_link("door", DOOR), *in_link("knob", knob(), mark()), small=small)
    assert set(small_joints(made)) == moving


def test_by_default_a_knob_in_the_link_of_its_door_stays_a_piece():
    made = made_of(*in_link("body", *CASE), *in_link("door", DOOR, knob(), mark()), small=None)
    assert small_joints(made) == {}


def test_a_knob_with_a_mark_in_one_mesh_turns():
    surfaces = (*knob("handle_stem", ends=(-0.02, -0.03), radius=0.008).surfaces, *ball(y=-0.048).surfaces)
    one = replace(knob(), surfaces=(*surfaces, *mark(before=-0.068).surfaces))
    (joint,) = small_joints(made_of(*CASE, DOOR, one)).values()
    assert np.allclose(joint.axis.direction, (0, -1, 0))


def test_the_pieces_of_one_knob_turn_together():
    stem, head = knob("handle_stem", ends=(-0.02, -0.035), radius=0.008), knob("handle_head", ends=(-0.035, -0.05))
    made = made_of(*CASE, DOOR, stem, head, mark())
    (joint,) = small_joints(made).values()
    pieces = {visual.name for visual in made.object.link(joint.child).visuals}
    assert pieces == {"handle_stem", "handle_head", "handle_mark"}


def test_a_ball_on_a_stem_turns_about_the_stem():
    stem = knob("handle_stem", ends=(-0.02, -0.03), radius=0.008)
    made = made_of(*CASE, DOOR, stem, ball(), mark(before=-0.068))
    (joint,) = small_joints(made).values()
    assert np.allclose(joint.axis.direction, (0, -1, 0))
    assert len(made.object.link(joint.child).visuals) == 3


def test_a_dial_on_the_body_turns_without_a_mark():
    (joint,) = small_joints(made_of(*CASE, DOOR, PANEL, DIAL)).values()
    assert (joint.parent, joint.child) != ("door", "dial")
    assert np.allclose(joint.axis.direction, (0, -1, 0))


def test_a_dial_on_a_plate_with_corners_turns_and_the_plate_stays():
    plate = box("handle_plate", (0.47, -0.004, 0.26), (0.53, 0.0, 0.34))
    knob_on_it = cylinder("handle_dial", ((0.5, -0.004, 0.3), (0.5, -0.024, 0.3)), 0.02)
    cap = cylinder("handle_cap", ((0.5, -0.024, 0.3), (0.5, -0.026, 0.3)), 0.01)
    made = made_of(*CASE, DOOR, PANEL, plate, knob_on_it, cap)
    (joint,) = small_joints(made).values()
    assert joint.child == "handle_dial"
    assert {visual.name for visual in made.object.link(joint.child).visuals} == {"handle_dial", "handle_cap"}
    assert {skip.request for skip in report_of(made).skipped}.isdisjoint({"handle_dial", "handle_cap", "handle_plate"})


@pytest.mark.parametrize(
    ("label", "settled", "is_dropped"),
    [
        (PartLabel.UNKNOWN, (), True),
        (PartLabel.UNKNOWN, ("dial",), False),
        (PartLabel.DRAWER, (), False),
    ],
)
def test_a_nameless_part_of_the_shape_of_a_knob_is_no_drawer_whatever_was_predicted(label, settled, is_dropped):
    dial = replace(knob("dial", radius=0.02), label=label)
    plate = replace(box("plate", (0.1, -0.02, 0.4), (0.2, 0.0, 0.5)), label=PartLabel.UNKNOWN)
    asset = scene(*CASE, dial, plate)
    out = Axis(dial.box.center, vec3(0.0, -1.0, 0.0))
    plan = RealizationPlan(tuple(JointRequest(p.id, JointType.PRISMATIC, out, "network") for p in (dial, plate)), ())
    shown, _ = shown_by_shape(plan, asset, parse_graph(asset), RealizationConfig(), settled)
    assert [r.moving for r in shown.joints] == (["plate"] if is_dropped else ["dial", "plate"])


def test_a_knob_beside_the_door_stays_on_the_body():
    high = replace(box("panel", (0.0, 0.0, 0.6), (0.4, 0.4, 0.7)), label=PartLabel.FACE_FRAME)
    knobs = [cylinder(f"handle_knob_{k}", ((x, 0.0, 0.65), (x, -0.03, 0.65)), 0.02) for k, x in enumerate((0.1, 0.3))]
    for source in (MotionSource.RULE, MotionSource.NETWORK):
        made = made_of(*CASE, DOOR, high, *knobs, source=source)
        assert {joint.parent for joint in small_joints(made).values()} == {made.object.root}
        assert len(small_joints(made)) == 2


def test_a_knob_on_a_turned_piece_turns_about_its_own_axis():
    made = made_of(yawed(scene(*CASE, DOOR, knob(), mark()), 0.5))
    (joint,) = small_joints(made).values()
    assert np.allclose(joint.axis.direction, (np.sin(0.5), -np.cos(0.5), 0), atol=1e-6)


def test_a_shaft_turns_in_the_hole_that_it_passes_through():
    made = made_of(*CASE, DOOR, knob(ends=(-0.005, -0.05)), mark())
    (record,) = [record for record in report_of(made).joints if record.small]
    assert record.collision_share == 0
    assert report_of(made).verdict.colour == "green"


def test_a_knob_that_is_sunk_into_a_panel_ends_on_it_and_looks_the_same():
    dial = cylinder("handle_dial", ((0.5, 0.01, 0.3), (0.5, -0.02, 0.3)), 0.02)
    made = made_of(*CASE, DOOR, PANEL, dial)
    (record,) = [record for record in report_of(made).joints if record.small]
    assert record.collision_share == 0
    assert [(one.kind, round(one.amount, 3)) for one in record.clearances] == [("trimmed", 0.01)]
    box = made.object.link("handle_dial").mesh.box
    assert (box.low[1], box.high[1]) == (pytest.approx(-0.02), pytest.approx(0.0, abs=5e-4))
    assert "handle_dial" not in {skip.request for skip in report_of(made).skipped}


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_stated_knob_that_is_sunk_into_a_panel_ends_on_it_whichever_way_its_axis_points(sense):
    dial = cylinder("dial", ((0.5, 0.01, 0.3), (0.5, -0.02, 0.3)), 0.02)
    axis = Axis(vec3(0.5, 0.0, 0.3), vec3(0.0, sense, 0.0))
    stated = (AnnotatedJoint("dial", JointType.CONTINUOUS, axis, 0.0, 2 * pi),)
    asset = replace(scene(*CASE, DOOR, PANEL, dial, joints=(hinged(),)), small_joints=stated)
    made = made_of(asset, source=MotionSource.ANNOTATION)
    (record,) = [record for record in report_of(made).joints if record.small]
    assert [(one.kind, round(one.amount, 3)) for one in record.clearances] == [("trimmed", 0.01)]
    box = made.object.link("dial").mesh.box
    assert (box.low[1], box.high[1]) == (pytest.approx(-0.02), pytest.approx(0.0, abs=5e-4))


def test_a_knob_that_hangs_in_the_air_stays_a_piece():
    assert small_joints(made_of(*CASE, DOOR, knob(ends=(-0.035, -0.06)), mark(before=-0.06))) == {}


POSTS = [knob(f"post_{k}", x, (-0.02, -0.045), 0.006) for k, x in enumerate((0.2, 0.3))]
BAR = cylinder("handle_bar", ((0.15, -0.05, 0.3), (0.35, -0.05, 0.3)), 0.006)
CUP = knob("cup", 0.05, (0.0, 0.012), 0.0175)
STILL = {
    "the plain knob of a door": (knob(),),
    "a ball on a door": (ball(y=-0.038), mark(before=-0.058)),
    "posts of a bar": (*POSTS, BAR),
    "a square knob": (box("handle", (0.34, -0.05, 0.28), (0.38, -0.02, 0.32)),),
    "a flat rosette": (knob("rosette", ends=(-0.02, -0.025), radius=0.02),),
    "a long rod": (knob("rod", ends=(-0.02, -0.1), radius=0.007),),
    "a screw's head": (knob("screw", ends=(-0.02, -0.024), radius=0.003),),
    "a hinge's cup inside": (CUP, box("shelf", (0.0, 0.03, 0.29), (0.4, 0.38, 0.31))),
    "a round foot": (cylinder("foot", ((-0.01, 0.2, -0.05), (-0.01, 0.2, 0.0)), 0.02),),
    "a ball as a foot": (cylinder("foot", ((0.0, 0.2, -0.04), (0.0, 0.2, 0.0)), 0.02),),
}


def test_the_knob_of_a_drawer_is_a_pull():
    asset = drawer()
    front = asset.part("drawer").box
    middle, y = float(front.center[2]), float(front.low[1])
    handle = cylinder("handle", ((0.0, y, middle), (0.0, y - 0.03, middle)), 0.015)
    line = box("handle_mark", (-0.002, y - 0.031, middle), (0.002, y - 0.029, middle + 0.012))
    made = made_of(replace(asset, parts=(*asset.parts, handle, line)))
    assert [joint.child for joint in made.object.joints] == ["drawer"]


@pytest.mark.parametrize("what", STILL)
def test_what_only_looks_like_a_small_part_stands_still(what):
    assert small_joints(made_of(*CASE, DOOR, *STILL[what])) == {}


def test_casters_swivel_and_their_wheels_turn():
    places = [(x, y) for x in (-0.25, 0.25) for y in (-0.25, 0.25)]
    made = made_of(*trolley(*(part for k, place in enumerate(places) for part in caster(f"c{k}", *place))))
    joints = small_joints(made)
    wheels = {name: joint for name, joint in joints.items() if name.endswith("_roll")}
    forks = {name: joint for name, joint in joints.items() if name not in wheels}

    assert (len(wheels), len(forks)) == (4, 4)
    for k, (x, y) in enumerate(places):
        wheel = wheels[f"c{k}_roll"]
        fork = forks[wheel.parent]
        assert fork.parent == made.object.root
        assert np.allclose(fork.axis.direction, (0, 0, 1))
        assert fork.axis.distance_to(np.array([x, y, 0.0])) < 1e-6
        assert abs(wheel.axis.direction[0]) == pytest.approx(1.0)
        assert len(made.object.link(fork.child).visuals) == 5
    grasps = {record.grasp for record in report_of(made).joints if record.small}
    assert grasps == {"driven"}


def test_a_wheel_in_a_leg_turns_and_the_leg_stands():
    leg = box("leg", (-0.25, -0.25, 0.05), (-0.22, -0.22, 0.5))
    roll = cylinder("roll", ((-0.25, -0.235, 0.03), (-0.22, -0.235, 0.03)), 0.03)
    made = made_of(*trolley(leg, roll))
    assert set(small_joints(made)) == {"roll"}


SHELF = box("shelf", (0.0, 0.03, 0.28), (0.4, 0.38, 0.3))
RING = cylinder("ring", ((0.2, 0.2, 0.301), (0.2, 0.2, 0.31)), 0.1)


def test_a_round_tray_turns_with_its_ring_and_does_not_slide():
    tray = cylinder("drawer_tray", ((0.2, 0.2, 0.31), (0.2, 0.2, 0.32)), 0.15)
    made = made_of(*CASE, DOOR, SHELF, RING, tray)
    (joint,) = small_joints(made).values()
    assert (joint.child, joint.type) == ("drawer_tray", JointType.CONTINUOUS)
    assert np.allclose(joint.axis.direction, (0, 0, 1))
    assert joint.axis.distance_to(np.array([0.2, 0.2, 0.0])) < 1e-6
    assert {visual.name for visual in made.object.link("drawer_tray").visuals} == {"drawer_tray", "ring"}
    assert {joint.child for joint in made.object.joints} == {"door", "drawer_tray"}


@pytest.mark.parametrize(("small", "type_"), [(None, JointType.CONTINUOUS), (False, JointType.PRISMATIC)])
def test_by_default_a_round_tray_turns_that_would_slide(small, type_):
    tray = cylinder("drawer_tray", ((0.2, 0.2, 0.31), (0.2, 0.2, 0.32)), 0.15)
    made = made_of(*CASE, DOOR, SHELF, RING, tray, small=small)
    assert [joint.type for joint in made.object.joints if joint.child == "drawer_tray"] == [type_]


def test_a_tray_with_corners_is_no_turntable():
    tray = box("drawer_tray", (0.05, 0.05, 0.31), (0.35, 0.35, 0.32))
    assert small_joints(made_of(*CASE, DOOR, SHELF, RING, tray)) == {}


def test_a_button_is_pressed_and_made_shorter_so_that_it_cuts_into_nothing():
    made = made_of(*CASE, DOOR, box("start_button", (0.405, -0.01, 0.5), (0.415, 0.0, 0.51)))
    (joint,) = small_joints(made).values()
    assert joint.type is JointType.PRISMATIC
    assert np.allclose(joint.axis.direction, (0, 1, 0))
    assert joint.limits.upper == pytest.approx(0.003)
    assert made.object.link("start_button").mesh.box.high[1] == pytest.approx(-0.003)
    record = next(record for record in report_of(made).joints if record.part == "start_button")
    assert [one.kind for one in record.clearances] == ["trimmed"]
    assert record.collision_share == 0


def test_a_stated_button_that_travels_farther_than_half_its_length_travels_half_of_it():
    button = box("start_button", (0.405, -0.01, 0.5), (0.415, 0.0, 0.51))
    axis = Axis(vec3(0.41, 0.0, 0.505), vec3(0.0, 1.0, 0.0))
    stated = (AnnotatedJoint("start_button", JointType.PRISMATIC, axis, 0.0, 0.007),)
    asset = replace(scene(*CASE, DOOR, button, joints=(hinged(),)), small_joints=stated)
    made = made_of(asset, source=MotionSource.ANNOTATION)
    assert small_joints(made)["start_button"].limits.upper == pytest.approx(0.005)
    assert made.object.link("start_button").mesh.box.high[1] == pytest.approx(-0.005)


def test_a_button_that_may_not_be_trimmed_stays_and_the_report_says_so():
    made = made_of(*CASE, DOOR, box("start_button", (0.405, -0.01, 0.5), (0.415, 0.0, 0.51)), trim=False)
    assert small_joints(made) == {}
    report = report_of(made)
    assert [(skip.request, skip.what) for skip in report.skipped][-1] == ("start_button", "small joint")
    assert report.verdict.colour != "red"


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    made = made_of(*CASE, DOOR, knob(), mark()).object
    folder = tmp_path_factory.mktemp("knob")
    for export in (export_urdf, export_mjcf):
        write_files(export(made), folder / export.__name__)
    return made, folder


def test_urdf_and_mjcf_limit_no_joint_that_turns_on(files):
    _, folder = files
    joints = yourdfpy.URDF.load(str(folder / "export_urdf" / "model.urdf")).joint_map
    assert joints["handle_joint"].type == "continuous"
    limit = joints["handle_joint"].limit
    assert (limit.lower, limit.upper) == (0.0, pytest.approx(2 * pi))  # one turn, for readers that ask for limits
    as_urdf = mujoco.MjModel.from_xml_path(str(folder / "export_urdf" / "model.urdf"))
    assert not as_urdf.jnt_limited[as_urdf.joint("handle_joint").id]
    model = mujoco.MjModel.from_xml_path(str(folder / "export_mjcf" / "model.xml"))
    limited = {model.joint(k).name: bool(model.jnt_limited[k]) for k in range(model.njnt)}
    assert (limited["handle_joint"], limited["door_joint"]) == (False, True)


def test_it_turns_on_and_on_in_a_simulation(files):
    _, folder = files
    model = mujoco.MjModel.from_xml_path(str(folder / "export_mjcf" / "model.xml"))
    data = mujoco.MjData(model)
    k = model.joint("handle_joint").qposadr[0]
    data.qpos[k] = 20.0
    mujoco.mj_step(model, data)
    assert data.qpos[k] == pytest.approx(20.0, abs=0.5)


def test_the_animation_goes_all_the_way_round(files):
    made, _ = files
    track = next(track for track in cycle_tracks(made) if track.joint == "handle_joint")
    assert track.values.max() == pytest.approx(2 * pi)
    assert np.abs(np.diff(track.values)).max() < pi  # a step of half a turn would be shown the other way round
    assert export_glb(made).contents["model.glb"]


def test_a_urdf_with_small_joints_gives_them_again(files):
    _, folder = files
    path = folder / "export_urdf" / "model.urdf"
    asset = load_asset(path, LoadOptions())
    stated = asset.as_annotated()
    assert [joint.part for joint in stated.joints] != []
    assert [(joint.type, joint.limited) for joint in stated.small_joints] == [(JointType.REVOLUTE, False)]

    again = made_of(asset, source=MotionSource.ANNOTATION, small=None)
    (joint,) = small_joints(again).values()
    assert joint.type is JointType.CONTINUOUS
    assert np.allclose(joint.axis.direction, (0, -1, 0), atol=1e-6)
    assert set(small_joints(made_of(asset, source=MotionSource.RULE, small=None))) == {joint.child}
    assert small_joints(made_of(asset, source=MotionSource.ANNOTATION, small=False)) == {}


def test_a_stated_button_is_pressed_as_far_as_its_range_spans():
    button = box("door_button", (0.48, -0.016, 0.28), (0.52, 0.0, 0.32))
    pressed = AnnotatedJoint(
        "door_button", JointType.PRISMATIC, Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0)), -0.009, -0.004
    )
    asset = replace(scene(*CASE, DOOR, PANEL, button, joints=(hinged(),)), small_joints=(pressed,))
    made = made_of(asset, source=MotionSource.ANNOTATION, small=None)
    (joint,) = small_joints(made).values()
    assert joint.limits.upper == pytest.approx(0.005)
    assert joint.axis.direction[1] == pytest.approx(1.0)


def test_a_stated_knob_that_is_drawn_off_its_panel_turns_and_the_report_states_how_far_off():
    dial = cylinder("dial", ((0.5, -0.02, 0.3), (0.5, -0.05, 0.3)), 0.02)
    stated = (
        AnnotatedJoint("dial", JointType.CONTINUOUS, Axis(vec3(0.5, 0.0, 0.3), vec3(0.0, -1.0, 0.0)), 0.0, 2 * pi),
    )
    asset = replace(scene(*CASE, DOOR, PANEL, dial, joints=(hinged(),)), small_joints=stated)
    report = report_of(made_of(asset, source=MotionSource.ANNOTATION))
    (record,) = [record for record in report.joints if record.small]
    assert record.largest_gap == pytest.approx(0.0, abs=1e-5)
    assert record.notes == ("it is drawn 0.020 m off what carries it",)
    assert [line.part for line in report.verdict.lines if line.why in record.notes] == ["dial"]


def test_trays_and_pole_of_a_carousel_turn_as_one():
    trays = [
        cylinder(f"lazy_susan_tray_{k}", ((0.2, 0.2, z), (0.2, 0.2, z + 0.02)), 0.15) for k, z in enumerate((0.1, 0.3))
    ]
    pole = cylinder("lazy_susan_pole", ((0.2, 0.2, 0.05), (0.2, 0.2, 0.5)), 0.01)
    apart = cylinder("lazy_susan_other", ((0.2, 0.55, 0.05), (0.2, 0.55, 0.07)), 0.1)
    floor = box("floor", (-0.02, 0.0, 0.0), (0.42, 0.7, 0.05))
    made = made_of(*CASE, floor, *trays, pole, apart)
    assert set(small_joints(made)) == {"lazy_susan_tray_0", "lazy_susan_other"}
    assert {v.name for v in made.object.link("lazy_susan_tray_0").visuals} == {
        *(t.id for t in trays),
        "lazy_susan_pole",
    }
