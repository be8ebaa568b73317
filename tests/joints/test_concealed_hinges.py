"""Doors on cup hinges: where they are chosen or preferred, and the door's true path is free."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.errors import OptionError
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.swept_body import SweptBody
from grafu.joints.joint_choice import with_choices
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import JointChoice
from grafu.joints.realize import Realized, realize
from grafu.joints.report import Installed
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.refusal import Refusal
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import Door, Drawer, Pair
from judging import GALLERY, swept_collisions
from small_scenes import DOOR, SIDE, hinged, scene

KINDS = {
    "overlay pair": Cabinet(layout=Pair()),
    "inset pair": Cabinet(layout=Pair(), mount="inset"),
    "one door": Cabinet(layout=Door()),
    "half overlay": Cabinet(layout=Pair(), lap=0.009),
    "hardly apart": Cabinet(layout=Pair(), gap=0.002),
}


def with_cups(asset: Asset) -> Realized:
    plan = plan_from_annotation(asset)
    doors = [request.moving for request in plan.joints if request.kind.turns]
    plan = with_choices(plan, {door: JointChoice(template="cup") for door in doors}, asset, GALLERY)
    return realize(plan, asset, GALLERY)


@pytest.fixture(scope="module", params=KINDS)
def made(request) -> tuple[Asset, Realized]:
    asset = make_cabinet(KINDS[request.param])
    return asset, with_cups(asset)


def test_every_door_gets_them_and_opens_wide(made):
    _, result = made
    for outcome in result.report.outcomes:
        assert isinstance(outcome, Installed)
        assert (outcome.template, outcome.count, outcome.restricted) == ("cup", 2, False)
        assert outcome.opening > np.radians(95)
        assert (outcome.collision_share, outcome.largest_gap) == (0.0, pytest.approx(0.0, abs=5e-4))


def test_one_revolute_joint_is_free_of_collision(made):
    _, result = made
    for joint in result.object.joints:
        assert max(swept_collisions(result.object, joint).values(), default=0.0) < 1e-3


def test_the_true_path_is_free_and_ends_where_the_links_hold_the_cup(made):
    asset, result = made
    still = [MeshCollider(v.mesh) for v in result.object.link("body").visuals if v.swing is None]
    for joint in result.object.joints:
        assert joint.slip is not None
        assert 0.004 < joint.slip.largest(joint.limits.upper) < 0.02
        link = result.object.link(joint.child)
        body = SweptBody(link.body_mesh, 4e-4 * asset.extent, np.eye(3))
        for value in np.linspace(0.0, joint.limits.upper, 15):
            body.place(joint.shown_motion(float(value)))
            assert not any(body.penetrates(other) for other in still), value
        cups = [MeshCollider(v.mesh) for v in link.visuals if v.name.startswith("hinge_")]
        arms = [v for v in result.object.link("body").visuals if v.swing and v.swing.moving == joint.child]
        assert len(arms) == 3 * len(cups)  # a nose and two links each
        for arm in (v for v in arms if "link" in v.name):
            collider = MeshCollider(arm.mesh)
            for value in (0.0, 0.7, joint.limits.upper):
                collider.place(arm.swing.motion(value))
                for cup in cups:
                    cup.place(joint.shown_motion(value))
                assert min(collider.distance(cup) for cup in cups) < 1e-3  # it ends in the cup


def test_plates_sit_on_the_case(made):
    _, result = made
    for outcome in result.report.outcomes:
        assert "side" in outcome.mount or "partition" in outcome.mount or "panel" in outcome.mount


def test_preferred_they_are_taken_where_there_is_room_and_others_elsewhere():
    asset = make_cabinet(Cabinet(layout=Pair()))
    thin = make_cabinet(Cabinet(layout=Pair(), front=0.01))
    settings = PipelineConfig(Settings(hinge="cup"))

    def templates(one: Asset) -> set[str]:
        done = functionalize(one, MotionSource.ANNOTATION, GALLERY, settings)
        return {outcome.template for outcome in done.report.outcomes}

    assert templates(asset) == {"cup"}
    assert "cup" not in templates(thin)


def test_automatic_doors_get_visible_hinges():
    asset = make_cabinet(Cabinet(layout=Pair()))
    result = realize(plan_from_annotation(asset), asset, GALLERY)

    assert all(outcome.template != "cup" for outcome in result.report.outcomes)


def test_a_door_that_nothing_else_carries_gets_them_without_a_choice():
    asset = make_cabinet(Cabinet(layout=Door(), lap=0.009))
    result = realize(plan_from_annotation(asset), asset, replace(GALLERY, hinges=()))

    assert {outcome.template for outcome in result.report.outcomes} <= {"cup", "pivot"}


def test_a_preferred_hinge_of_a_class_comes_first_in_it():
    asset = make_cabinet(Cabinet(layout=Pair()))
    usual = {o.template: o.mechanism for o in realize(plan_from_annotation(asset), asset, GALLERY).report.outcomes}
    ((_, mechanism),) = usual.items()
    other = GALLERY.hinges_of(mechanism)[1].id
    config = PipelineConfig(Settings(hinge=other))
    done = functionalize(asset, MotionSource.ANNOTATION, GALLERY, config)

    assert {outcome.template for outcome in done.report.outcomes} == {other}


def test_an_unknown_hinge_is_refused_with_those_that_there_are():
    with pytest.raises(OptionError, match=r"must be one of butt, .*cup: got 'spring'"):
        GALLERY.preferring("spring")


def test_a_chosen_cup_hinge_without_a_side_to_stand_on_is_refused():
    asset = scene(DOOR, SIDE, joints=(hinged(),))
    plan = with_choices(plan_from_annotation(asset), {"door": JointChoice(template="cup")}, asset, GALLERY)
    (outcome,) = realize(plan, asset, GALLERY).report.outcomes

    assert isinstance(outcome, Refusal) or outcome.template == "cup"


def test_drawers_cannot_choose_it():
    asset = make_cabinet(Cabinet(layout=Drawer()))
    (request,) = plan_from_annotation(asset).joints
    with pytest.raises(OptionError, match="must be one of centre_mount, corner_mount: got 'cup'"):
        with_choices(plan_from_annotation(asset), {request.moving: JointChoice(template="cup")}, asset, GALLERY)
