"""Where motions come from: annotations however they are drawn, and completed graphs, end in the same plan."""

from dataclasses import replace
from math import pi, radians

import numpy as np
import pytest

from grafu.articulation.articulated_object import VisualRole
from grafu.asset.part import AnnotatedJoint
from grafu.completion.rule import complete_by_rule
from grafu.geometry.arrays import vec3
from grafu.geometry.transform import from_rotation, rotation_matrix, translation
from grafu.graph.parse import ParsingConfig, parse_graph
from grafu.joints.make_plan import plan_from_annotation, plan_from_completion
from grafu.joints.realize import realize
from grafu.vocabulary import JointType
from judging import GALLERY, installed, made_kind, realized
from small_scenes import DOOR, LEFT_EDGE, SIDE, box, drawer, hinged, scene, sliding

HANDLE = box("handle", (0.35, -0.05, 0.2), (0.37, -0.02, 0.4), carried_by="door")


def request_of(joint: AnnotatedJoint):
    (request,) = plan_from_annotation(scene(DOOR, SIDE, joints=(joint,))).joints
    return request


def opens_outwards(request) -> bool:
    """Whether the door's free edge sets off to the front (-Y)."""
    edge = np.array([0.4, 0.0, 0.3])
    moved_edge = request.axis.rotation(0.1) @ np.append(edge, 1.0)
    return bool(moved_edge[1] < 0)


@pytest.mark.parametrize(
    ("lower", "upper", "outwards", "reference"),
    [
        (0.0, 1.5, True, 1.5),
        (1.5, 0.0, True, 1.5),  # limits the wrong way round
        (-1.5, 0.0, False, 1.5),  # it opens about the axis reversed
        (0.0, -1.5, False, 1.5),
        (-0.1, 1.5, True, 1.5),  # a little play behind the drawn pose
        (0.2, 1.5, True, 1.5),  # a lower limit above 0 stands for no other rest pose
        (-1.5, 0.1, False, 1.5),
    ],
)
def test_a_range_says_which_way_a_door_opens(lower, upper, outwards, reference):
    request = request_of(hinged(lower=lower, upper=upper))
    assert opens_outwards(request) is outwards
    assert request.reference == pytest.approx(reference)
    assert request.drawn_at == 0.0


def test_a_joint_without_limits_opens_by_a_right_angle():
    joint = replace(hinged(), lower=-pi, upper=pi, limited=False)
    assert request_of(joint).reference == pytest.approx(pi / 2)
    assert request_of(joint).drawn_at == 0.0


def test_requests_say_where_they_come_from_and_what_rides():
    (request,) = plan_from_annotation(scene(DOOR, SIDE, HANDLE, joints=(hinged(),))).joints
    assert (request.source, request.attached, request.mounts) == ("annotation", ("handle",), ())


def test_parts_attached_to_attached_parts_move_too():
    knob = box("handle_knob", (0.35, -0.06, 0.3), (0.37, -0.05, 0.32), carried_by="handle")
    (request,) = plan_from_annotation(scene(DOOR, SIDE, HANDLE, knob, joints=(hinged(),))).joints
    assert request.attached == ("handle", "handle_knob")


def test_doors_without_a_joint_are_refused_unless_they_ride():
    glass = box("door_glass", (0.1, -0.015, 0.1), (0.3, -0.005, 0.5), carried_by="door")
    other = box("door_2", (0.4, -0.02, 0.0), (0.8, 0.0, 0.6))
    plan = plan_from_annotation(scene(DOOR, SIDE, glass, other, joints=(hinged(),)))
    assert [(r.part, r.why) for r in plan.refused] == [("door_2", "the input states no joint for it")]


@pytest.mark.parametrize("ajar", [0.9])
def test_a_door_drawn_ajar_is_closed_before_anything_is_built(ajar):
    """The same cabinet, its door drawn at `ajar` of the way, its limits stated from there."""
    asset = made_kind("overlay door, hinged right")
    (joint,) = asset.joints
    T = joint.axis.rotation(ajar)
    parts = tuple(
        replace(p, surfaces=tuple(s.transformed(T) for s in p.surfaces)) if p.id in ("door", "handle") else p
        for p in asset.parts
    )
    drawn = replace(asset, parts=parts, joints=(replace(joint, lower=-ajar, upper=joint.upper - ajar),))
    result = realized(drawn)
    door = installed(result)["door"]
    assert [(c.kind, c.amount) for c in door.clearances] == [("closed", pytest.approx(ajar))]
    assert door.opening >= joint.upper - 1e-6
    closed = {v.name: v for v in result.object.link("door").visuals if v.role is not VisualRole.HARDWARE}
    np.testing.assert_allclose(closed["door"].mesh.box.low, asset.part("door").box.low, atol=1e-9)
    np.testing.assert_allclose(closed["handle"].mesh.box.high, asset.part("handle").box.high, atol=1e-9)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_drawer_drawn_half_open_is_pushed_in(sign):
    """Whichever way the annotated axis points: in is where the cabinet is."""
    whole = drawer()
    closed = whole.part("drawer")
    half = replace(closed, surfaces=tuple(s.transformed(translation(vec3(0.0, -0.15, 0.0))) for s in closed.surfaces))
    joint = sliding("drawer", (0.0, -sign, 0.0), 0.15, -0.15)
    asset = replace(whole, parts=tuple(half if p.id == "drawer" else p for p in whole.parts), joints=(joint,))
    (request,) = plan_from_annotation(asset).joints
    assert request.drawn_at == pytest.approx(0.15)
    assert request.axis.direction[1] == pytest.approx(-1.0)
    result = realized(asset)
    body = next(v for v in result.object.link("drawer").visuals if v.name == "drawer")
    np.testing.assert_allclose(body.mesh.box.low, closed.box.low, atol=1e-9)
    assert installed(result)["drawer"].opening == pytest.approx(0.3, abs=0.02)


@pytest.mark.parametrize("kind", ["overlay pair", "chest with a lid", "whole drawer boxes"])
def test_a_completed_graph_and_the_annotation_build_the_same(kind):
    asset = made_kind(kind)
    bare = asset.without_annotation()
    completion = complete_by_rule(parse_graph(bare, ParsingConfig()))
    plan = plan_from_completion(completion, bare)
    assert {r.moving: r.type for r in plan.joints} == {j.part: j.type for j in asset.joints}
    assert {r.source for r in plan.joints} == {completion.source}
    annotated, usual = plan_from_annotation(asset), {r.moving: r.reference for r in plan.joints}
    as_far = replace(annotated, joints=tuple(replace(r, reference=usual[r.moving]) for r in annotated.joints))
    from_graph, stated = (installed(realize(built, bare, GALLERY)) for built in (plan, as_far))
    for part, outcome in from_graph.items():
        assert (outcome.mechanism, outcome.template) == (stated[part].mechanism, stated[part].template)
        assert outcome.opening == pytest.approx(stated[part].opening, abs=1e-3)
        assert outcome.axis.angle_to(stated[part].axis) < 1e-3


def test_a_completed_graph_states_mounts_and_attached_parts():
    bare = made_kind("overlay pair").without_annotation()
    plan = plan_from_completion(complete_by_rule(parse_graph(bare, ParsingConfig())), bare)
    by_part = {r.moving: r for r in plan.joints}
    assert by_part["door_1"].mounts == ("side_panel_left",)
    assert len(by_part["door_1"].attached) == 1
    assert by_part["door_1"].reference is None


def test_a_slanted_axis_is_kept_and_a_crooked_one_is_straightened():
    """An axis a few degrees off a side of the door is meant to follow it."""
    asset = scene(DOOR, SIDE, joints=(hinged(),))
    R = rotation_matrix(np.array([0.0, 1.0, 0.0]), radians(4))
    crooked = LEFT_EDGE.transformed(from_rotation(R), rotational=True)
    result = installed(realized(replace(asset, joints=(hinged(axis=crooked),))))
    np.testing.assert_allclose(result["door"].axis.direction, [0.0, 0.0, -1.0], atol=1e-9)
    assert result["door"].initial_axis.angle_to(result["door"].axis) == pytest.approx(radians(4))


def test_a_drawers_crooked_slide_is_straightened():
    asset = drawer()
    slanted = replace(asset, joints=(sliding("drawer", (0.08, -1.0, 0.0)),))
    outcome = installed(realized(slanted))["drawer"]
    assert outcome.type is JointType.PRISMATIC
    np.testing.assert_allclose(outcome.axis.direction, [0.0, -1.0, 0.0], atol=1e-9)
