"""The maker of doors and windows of buildings: what it draws fits, opens freely, and states its truth."""

import numpy as np
import pytest

from grafu.graph.edges import Hinge
from grafu.joints.building_doors import building_door
from grafu.joints.door_levers import SOURCE
from grafu.joints.windows import window
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.synth.openings.door import DoorSpec, drawn_door, make_building_door
from grafu.synth.openings.window import KINDS, WindowSpec, drawn_window, make_window
from grafu.templates.gallery import builtin_gallery
from judging import swept_collisions

DRAWS = range(3)


@pytest.mark.parametrize("draw", DRAWS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_drawn_window_is_one_and_has_a_joint_for_each_leaf_that_moves(kind, draw):
    asset = make_window(drawn_window(np.random.default_rng([7, draw]), "window", kind))
    found = window(asset)
    assert found is not None
    assert len(found.leaves) == (1 if kind in ("casement", "awning", "hopper") else 2)
    assert len(asset.joints) == (2 if kind == "pair" else 1)
    assert asset.box.low[2] == pytest.approx(0.0)


@pytest.mark.parametrize("draw", range(6))
def test_a_drawn_door_works_about_its_true_edge(draw):
    asset = make_building_door(drawn_door(np.random.default_rng([7, draw]), "door"))
    assert building_door(asset) is not None
    made = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery())
    truth = {joint.part: joint for joint in (*asset.joints, *asset.small_joints)}
    joints = {joint.child: joint for joint in made.object.joints}
    assert set(joints) == set(truth)
    for joint in asset.joints:
        got = joints[joint.part]
        assert float(got.axis.direction @ joint.axis.direction) == pytest.approx(1.0, abs=1e-6)
        assert got.limits.upper >= 0.9 * joint.upper
        assert not swept_collisions(made.object, got, 8)


def test_two_leaves_that_are_drawn_into_their_frame_at_one_side_are_cut_to_it():
    asset = make_building_door(DoorSpec(width=1.6, leaves=2, lap=0.012))
    made = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery())
    assert {outcome.collision_share for outcome in made.report.installed} == {0.0}
    assert all(joint.limits.upper > 0.7 for joint in made.object.joints)


@pytest.mark.parametrize("grip", ["lever", "none"])
def test_without_joints_a_door_is_found_and_its_lever_turns(grip):
    asset = make_building_door(DoorSpec(grip=grip, bolt=grip == "lever"))
    made = functionalize(asset, MotionSource.NETWORK, builtin_gallery())
    small = {joint.child: joint for joint in made.object.joints if joint.child != "leaf"}
    assert set(small) == ({"lever", "latch_bolt"} if grip == "lever" else set())
    if small:
        (stated,) = (joint for joint in asset.small_joints if joint.type is Hinge.joint_type)
        assert float(small["lever"].axis.direction @ stated.axis.direction) == pytest.approx(1.0)
        assert {o.source for o in made.report.installed if o.moving in small} == {SOURCE}


@pytest.mark.parametrize("change", [{"leaves": 3}, {"set_back": 0.2}])
def test_impossible_doors_are_refused(change):
    with pytest.raises(ValueError, match="must"):
        DoorSpec(**change)


def test_an_impossible_window_is_refused():
    with pytest.raises(ValueError, match="must"):
        WindowSpec(width=0.2)
