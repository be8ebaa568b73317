"""Gate legs and brackets swing out below the raised leaf of a table, and lopers slide out; other bars stay."""

from dataclasses import replace
from math import pi

import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.drop_supports import with_stated_supports, with_supported_leaves
from grafu.joints.motion_choice import MotionChoice, Moves, Side
from grafu.joints.plan import JointRequest, MotionRole, RealizationPlan
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.render.picture import posed_visuals
from grafu.synth.tables.drop_leaf import DropLeafTable, make_drop_leaf_table
from grafu.synth.tables.drop_leaf_supports import LeafSupports
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel
from small_scenes import box, scene

TOP = box("top", (-0.3, -0.4, 0.72), (0.3, 0.4, 0.74))
LEGS = [
    box(f"leg_{k}", (x - 0.03, y - 0.03, 0.0), (x + 0.03, y + 0.03, 0.72))
    for k, (x, y) in enumerate((x, y) for x in (-0.24, 0.24) for y in (-0.34, 0.34))
]
APRON = replace(box("apron", (0.23, -0.31, 0.6), (0.25, 0.31, 0.72)), label=PartLabel.FACE_FRAME)
LEAF = box("leaf", (0.302, -0.4, 0.4), (0.322, 0.4, 0.74))
TABLE = (TOP, *LEGS, APRON, LEAF)
BRACKET = ((0.251, -0.15, 0.64), (0.269, 0.1, 0.719))
LOPER = ((-0.1, -0.02, 0.69), (0.298, 0.02, 0.719))


def table(kind, count=1, *, nameless=False, **sizes):
    spec = DropLeafTable(drop=0.4, overhang=0.035, supports=LeafSupports(kind, count, 0.7, 0.02), **sizes)
    made = make_drop_leaf_table(replace(spec, depth=0.95))
    if not nameless:
        return made
    parts = (
        replace(part, label=PartLabel.UNKNOWN, source=replace(part.source, name=f"object_{k}"))
        for k, part in enumerate(made.parts)
    )
    return replace(made, parts=tuple(parts))


def supports_in(asset):
    plan = with_supported_leaves(RealizationPlan(), asset)
    return {request.moving: request for request in plan.joints if request.role is MotionRole.SUPPORT}


@pytest.mark.parametrize("nameless", [False, True])
@pytest.mark.parametrize(("kind", "count"), [("bracket", 1), ("bracket", 2), ("gate", 1)])
def test_what_lies_folded_behind_a_leaf_swings_out_about_its_true_end(kind, count, nameless):
    asset = table(kind, count, nameless=nameless)
    found = supports_in(asset)
    truth = {joint.part: joint for joint in asset.joints if not joint.part.startswith("leaf")}
    assert set(found) == set(truth)
    for name, joint in truth.items():
        assert found[name].axis.direction @ joint.axis.direction > 0.99
        assert found[name].axis.distance_to(joint.axis.point) < 0.005


@pytest.mark.parametrize("count", [1, 2])
def test_lopers_slide_out_below_their_own_leaf(count):
    asset = table("loper", count)
    found = supports_in(asset)
    truth = {joint.part: joint for joint in asset.joints if joint.type is JointType.PRISMATIC}
    assert set(found) == set(truth)
    assert all(found[name].axis.direction @ joint.axis.direction > 0.99 for name, joint in truth.items())


def test_a_bar_is_a_loper_by_its_name_alone():
    assert set(supports_in(scene(*TABLE, box("loper", *LOPER)))) == {"loper"}
    assert supports_in(scene(*TABLE, box("bar", *LOPER))) == {}  # many rails of frames end behind a leaf


OTHERS = {
    "a moulding along the whole apron": (box("strip", (0.251, -0.31, 0.64), (0.269, 0.31, 0.719)),),
    "a plank well below the top": (box("strip", (0.251, -0.15, 0.5), (0.269, 0.1, 0.6)),),
    "a block": (box("block", (0.251, -0.02, 0.64), (0.269, 0.02, 0.719)),),
    "a plank between two blocks": (
        box("strip", *BRACKET),
        box("block_1", (0.251, -0.17, 0.64), (0.269, -0.152, 0.719)),
        box("block_2", (0.251, 0.102, 0.64), (0.269, 0.12, 0.719)),
    ),
    "a plank with nothing behind it": (box("strip", (0.28, -0.15, 0.64), (0.298, 0.1, 0.719)),),
    "a bracket that something stands before": (
        box("bracket", *BRACKET),
        box("box", (0.28, -0.2, 0.66), (0.299, 0.2, 0.7)),
    ),
    "a high board, as of a door": (box("board", (0.251, -0.15, 0.5), (0.269, 0.1, 0.719)),),
}


@pytest.mark.parametrize("what", OTHERS)
def test_what_carries_no_leaf_stays(what):
    assert supports_in(scene(*TABLE, *OTHERS[what])) == {}


def test_what_was_predicted_to_carry_or_move_a_support_no_longer_does():
    side = Axis(vec3(0.25, 0.0, 0.6), vec3(0.0, 1.0, 0.0))
    requests = (
        JointRequest("apron", JointType.REVOLUTE, side, "network", attached=("bracket", "knob")),
        JointRequest("bracket", JointType.PRISMATIC, side, "network"),
    )
    asset = scene(*TABLE, box("bracket", *BRACKET))
    plan = with_supported_leaves(RealizationPlan(requests), asset)
    assert {r.moving: r.attached for r in plan.joints} == {"apron": ("knob",), "leaf": (), "bracket": ()}
    assert {r.moving: r.type for r in plan.joints}["bracket"] is JointType.REVOLUTE


def test_without_a_leaf_nothing_is_a_support():
    assert supports_in(scene(TOP, *LEGS, APRON, box("bracket", *BRACKET))) == {}


@pytest.mark.parametrize("scale", [0.01, 1.0, 39.37])
def test_a_bracket_is_found_at_any_scale(scale):
    parts = [*TABLE, box("part", *BRACKET)]
    scaled = [box(part.id, tuple(scale * part.box.low), tuple(scale * part.box.high)) for part in parts]
    assert set(supports_in(scene(*scaled))) == {"part"}


@pytest.mark.parametrize("source", [MotionSource.RULE, MotionSource.ANNOTATION])
@pytest.mark.parametrize("kind", ["bracket", "gate", "loper"])
def test_a_support_waits_for_its_leaf_and_collides_with_nothing(kind, source):
    asset = table(kind, leaves=1)
    result = functionalize(asset, source, builtin_gallery())
    (support,) = (joint for joint in asset.joints if joint.part != "leaf")
    joints, outcomes = result.object.joint_of, {one.moving: one for one in result.report.installed}
    assert set(joints) == {"leaf", support.part}
    assert joints[support.part].after == (joints["leaf"].id,)
    assert joints[support.part].limits.upper >= 0.95 * support.upper
    assert outcomes[support.part].template == "drawn"
    assert all(one.collision_share == 0.0 and not one.restricted for one in outcomes.values())
    assert result.fittings.grasps[support.part].kind == "edge"
    assert not result.fittings.additions
    assert not result.body.additions


def test_a_leaf_that_is_set_into_the_edge_comes_to_lie_on_its_support():
    leaf = box("leaf", (0.302, -0.4, 0.4), (0.322, 0.4, 0.73))
    asset = scene(TOP, *LEGS, APRON, leaf, box("bracket", (0.251, -0.15, 0.66), (0.269, 0.1, 0.719)))
    made = functionalize(asset, MotionSource.RULE, builtin_gallery()).object
    joint = made.joint_of["leaf"]
    raised = next(v for v in posed_visuals(made, {joint.id: joint.limits.upper}) if v.name == "leaf").mesh.box
    assert raised.low[2] >= 0.718
    assert made.joint_of["bracket"].limits.upper == pytest.approx(pi / 2, abs=0.02)


def test_what_the_user_states_behind_a_leaf_is_its_support():
    asset = scene(*TABLE, box("part_1", (0.251, -0.15, 0.64), (0.269, 0.1, 0.719)))
    motions = {"part_1": MotionChoice(Moves.TURNS, Side.FRONT)}
    config = PipelineConfig(settings=Settings(motions=motions))
    made = functionalize(asset, MotionSource.RULE, builtin_gallery(), config)
    (support,) = (request for request in made.plan.joints if request.moving == "part_1")
    assert (support.role, support.source) == (MotionRole.SUPPORT, "user")
    assert made.object.joint_of["part_1"].limits.upper == pytest.approx(pi / 2, abs=0.02)


def test_a_stated_door_behind_a_leaf_keeps_its_hinges():
    door = replace(box("door", (0.251, -0.15, 0.3), (0.269, 0.1, 0.719)), label=PartLabel.DOOR)
    up, swing = Axis(vec3(0.302, 0.0, 0.74), vec3(0.0, -1.0, 0.0)), Axis(vec3(0.251, -0.15, 0.5), vec3(0.0, 0.0, -1.0))
    requests = (
        JointRequest("leaf", JointType.REVOLUTE, up, "annotation"),
        JointRequest("door", JointType.REVOLUTE, swing, "annotation"),
    )
    plan = RealizationPlan(requests)
    assert with_stated_supports(plan, scene(*TABLE, door)) == plan
