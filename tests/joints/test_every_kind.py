"""Every kind of synthetic furniture, tidy or not: each door and drawer works, by an independent judge."""

import numpy as np
import pytest

from grafu.articulation.articulated_object import VisualRole
from grafu.asset.edit import as_static_object
from grafu.metrics.collision import CollisionConfig, ConnectivityConfig, collision_shares, largest_gaps
from grafu.synth.samples import KINDS, TIDY
from grafu.vocabulary import JointType
from judging import deepest_cut, hardware, installed, made_kind, realized_kind, swept_collisions, true_joints

CUT = 0.001  # of the object's largest side: what hardware is inset by where there is no room
TOUCH = 0.0008  # of the object's largest side: more is a collision
UNTOUCHED = [kind for kind in TIDY if not kind.startswith("drawers tight")]


@pytest.fixture(scope="module", params=KINDS)
def kind(request):
    """Each kind in turn, for all tests: one process asks all about it, and only this one builds it."""
    return request.param


def test_each_door_and_drawer_gets_a_joint_of_its_type(kind):
    asset, result = made_kind(kind), realized_kind(kind)
    assert result.report.skipped == ()
    assert {j.child: j.type for j in result.object.joints} == {j.part: j.type for j in asset.joints}
    assert set(installed(result)) == set(true_joints(asset))


def test_no_part_is_lost_and_attached_parts_move_along(kind):
    asset, obj = made_kind(kind), realized_kind(kind).object
    link_of = {v.name: link.id for link in obj.links for v in link.visuals if v.role is not VisualRole.HARDWARE}
    moving_bodies = set(true_joints(asset))
    assert link_of == {p.id: p.carried_by or (p.id if p.id in moving_bodies else obj.root) for p in asset.parts}


def test_nothing_collides_with_the_static_body(kind):
    asset, obj = made_kind(kind), realized_kind(kind).object
    for joint in obj.joints:
        hit = swept_collisions(obj, joint, 50)
        assert max(hit.values(), default=0.0) <= TOUCH * asset.extent, (joint.child, hit)


def test_each_joint_opens_most_of_its_true_way(kind):
    for part, joint in true_joints(made_kind(kind)).items():
        outcome = installed(realized_kind(kind))[part]
        assert outcome.opening >= 0.7 * joint.upper
        assert not outcome.restricted
        assert realized_kind(kind).object.joint_of[part].limits.upper == outcome.opening


def test_each_axis_points_the_true_way_along_the_true_border(kind):
    asset, result = made_kind(kind), realized_kind(kind)
    for part, joint in true_joints(asset).items():
        axis, box = result.object.joint_of[part].axis, asset.part(part).box
        assert np.degrees(axis.angle_to(joint.axis)) <= 10.0
        if joint.type is JointType.REVOLUTE:
            assert axis.distance_to(joint.axis.closest_point(box.center)) <= 0.12 * box.size.max()


def test_every_moving_body_stays_connected_through_anchored_hardware(kind):
    obj = realized_kind(kind).object
    gaps = largest_gaps(obj, ConnectivityConfig(poses=4))
    assert max(gaps.values()) <= 0.001 * made_kind(kind).extent


def test_hardware_cuts_into_no_part_of_the_other_side(kind):
    asset, result = made_kind(kind), realized_kind(kind)
    obj = result.object
    for joint in obj.joints:
        moving, still = hardware(result, joint.child)
        assert moving
        assert still
        parts = [v for v in obj.link(joint.child).visuals if v.role is not VisualRole.HARDWARE]
        body = [v for v in obj.link(obj.root).visuals if v.role is not VisualRole.HARDWARE]
        assert deepest_cut(parts, still, joint) <= CUT * asset.extent, joint.child
        assert deepest_cut(moving, body, joint) <= CUT * asset.extent, joint.child


def test_the_report_says_what_the_judge_finds(kind):
    asset, result = made_kind(kind), realized_kind(kind)
    ratios = collision_shares(result.object, CollisionConfig(poses=12, tolerance=TOUCH))
    for outcome in result.report.installed:
        assert outcome.collision_share == ratios[outcome.joint] == 0.0
        assert outcome.largest_gap <= 0.001 * asset.extent
        assert outcome.mount in {p.id for p in asset.parts}
        assert outcome.source == "annotation"


def test_nothing_is_cut_but_what_the_report_names_and_of_tidy_furniture_nothing(kind):
    asset, result = made_kind(kind), realized_kind(kind)
    before = {v.name: v.surfaces for v in as_static_object(asset).links[0].visuals}
    named = {clearance.part for outcome in result.report.installed for clearance in outcome.clearances}
    assert not named or kind not in UNTOUCHED
    for link in result.object.links:
        for visual in link.visuals:
            assert visual.role is VisualRole.HARDWARE or visual.name in named or visual.surfaces == before[visual.name]


def test_the_judge_sees_a_door_that_turns_into_its_case():
    """The judge itself can fail: about an axis in its middle a door cuts deep."""
    result = realized_kind("overlay door, hinged right")
    obj = result.object
    from dataclasses import replace

    joint = obj.joints[0]
    inwards = replace(joint, axis=joint.axis.reversed())
    parts, body = obj.link("door").visuals[:1], [v for v in obj.link(obj.root).visuals if v.name.startswith("side")]
    assert deepest_cut(list(parts), body, inwards) > 0.01
    assert swept_collisions(replace(obj, joints=(inwards,)), inwards, 8)
