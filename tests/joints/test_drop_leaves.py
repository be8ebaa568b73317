"""Boards that hang from a table's top swing up level with it; aprons, sides and panels stay."""

from dataclasses import replace

import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.drop_leaves import SOURCE, with_drop_leaves
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.render.picture import posed_visuals
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel
from small_scenes import box, scene

TOP = box("top", (-0.3, -0.4, 0.72), (0.3, 0.4, 0.74))
LEGS = [
    box(f"leg_{k}", (x - 0.03, y - 0.03, 0.0), (x + 0.03, y + 0.03, 0.72))
    for k, (x, y) in enumerate((x, y) for x in (-0.24, 0.24) for y in (-0.34, 0.34))
]
APRONS = [
    box("apron_0", (-0.21, -0.35, 0.6), (0.21, -0.33, 0.72)),
    box("apron_1", (-0.21, 0.33, 0.6), (0.21, 0.35, 0.72)),
    box("apron_2", (-0.25, -0.31, 0.6), (-0.23, 0.31, 0.72)),
    box("apron_3", (0.23, -0.31, 0.6), (0.25, 0.31, 0.72)),
]
TABLE = (TOP, *LEGS, *(replace(apron, label=PartLabel.FACE_FRAME) for apron in APRONS))


def leaf(sign, name="leaf", low=0.45):
    inner, outer = sorted((sign * 0.302, sign * 0.322))
    return box(name, (inner, -0.4, low), (outer, 0.4, 0.735))


def found(*parts):
    plan = with_drop_leaves(RealizationPlan((), ()), scene(*parts))
    assert {request.source for request in plan.joints} <= {SOURCE}
    return {request.moving for request in plan.joints}


def test_leaves_on_both_sides_swing_up_level_with_the_top():
    leaves = [leaf(-1.0, "left_board"), leaf(1.0, "right_board")]
    made = functionalize(scene(*TABLE, *leaves), MotionSource.RULE, builtin_gallery()).object
    joints = made.joint_of
    assert set(joints) == {"left_board", "right_board"}
    for name, sign in (("left_board", -1.0), ("right_board", 1.0)):
        assert abs(float(joints[name].axis.direction[1])) == pytest.approx(1.0)
        raised = posed_visuals(made, {joints[name].id: joints[name].limits.upper})
        part = next(visual for visual in raised if visual.name == name).mesh.box
        assert part.size[2] == pytest.approx(0.02, abs=2e-3)
        assert part.high[2] == pytest.approx(TOP.box.high[2], abs=0.03)
        assert sign * part.center[0] > 0.4


OTHERS = {
    "aprons under the top": (),
    "a side that reaches the floor": (leaf(1.0, low=0.0),),
    "a low frame around the top": (leaf(1.0, low=0.68),),
    "an apron between legs outside of the top": (
        leaf(1.0),
        box("leg_a", (0.29, -0.46, 0.0), (0.35, -0.4, 0.735)),
        box("leg_b", (0.29, 0.4, 0.0), (0.35, 0.46, 0.735)),
    ),
    "the side of a case on legs": (leaf(1.0), box("bottom", (-0.3, -0.4, 0.45), (0.302, 0.4, 0.47))),
    "a board on a foot": (leaf(1.0), box("foot", (0.3, -0.05, 0.0), (0.33, 0.05, 0.45))),
    "a board away from the top": (box("board", (0.35, -0.4, 0.45), (0.37, 0.4, 0.735)),),
    "a short board": (box("board", (0.302, -0.2, 0.45), (0.322, 0.2, 0.735)),),
}


@pytest.mark.parametrize("what", OTHERS)
def test_what_only_looks_like_a_leaf_stays(what):
    assert found(*TABLE, *OTHERS[what]) == set()


@pytest.mark.parametrize("scale", [0.01, 1.0, 39.37])
def test_a_leaf_is_found_at_any_scale(scale):
    parts = [box(part.id, tuple(scale * part.box.low), tuple(scale * part.box.high)) for part in (*TABLE, leaf(1.0))]
    assert found(*parts) == {"leaf"}


@pytest.mark.parametrize(("by", "hangs"), [("name", False), ("prediction", True)])
def test_what_the_input_calls_a_side_panel_is_no_leaf_and_what_was_only_guessed_to_be_one_may_be(by, hangs):
    side = replace(leaf(1.0), label=PartLabel.SIDE_PANEL, labelled_by=by)
    assert found(*TABLE, side) == ({"leaf"} if hangs else set())


def test_one_leaf_alone_is_enough_and_a_drawer_is_none():
    assert found(*TABLE, leaf(-1.0)) == {"leaf"}
    assert found(*TABLE, leaf(-1.0, "drawer")) == set()


def test_a_leaf_that_is_called_a_door_and_was_predicted_to_turn_about_its_side_swings_up():
    door = replace(leaf(1.0, "door_leaf"), label=PartLabel.DOOR)
    upright = Axis(vec3(0.322, 0.4, 0.6), vec3(0.0, 0.0, 1.0))
    request = JointRequest("door_leaf", JointType.REVOLUTE, upright, "network", attached=("handle",))
    plan = with_drop_leaves(RealizationPlan((request,), ()), scene(*TABLE, door))
    (made,) = plan.joints
    assert (made.moving, made.source, made.attached) == ("door_leaf", SOURCE, ("handle",))
    assert abs(float(made.axis.direction[1])) == pytest.approx(1.0)
