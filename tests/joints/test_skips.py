"""What cannot be built: each with a reason from the fixed list, and never at the cost of its neighbours."""

from dataclasses import replace

import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.joints.realize import realize
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import JointType
from judging import GALLERY, installed, made_kind, realized
from small_scenes import DOOR, LEFT_EDGE, SIDE, box, hinged, scene, sliding

RIGHT_EDGE = Axis(vec3(0.8, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
SECOND = box("door_2", (0.42, -0.02, 0.0), (0.8, 0.0, 0.6))
FAR = box("cube", (3.0, 3.0, 0.0), (3.2, 3.2, 0.2))
CAGE = (
    box("left", (-0.05, -0.4, 0.0), (0.01, 0.4, 0.6)),
    box("right", (0.39, -0.4, 0.0), (0.45, 0.4, 0.6)),
    box("before", (-0.05, -0.12, 0.0), (0.45, -0.03, 0.6)),
    box("behind", (-0.05, 0.01, 0.0), (0.45, 0.12, 0.6)),
)
NOWHERE = {Reason.NO_FACING_SURFACES, Reason.NO_ROOM}


def skipped(asset) -> dict[str, Reason]:
    result = realized(asset)
    root = result.object.link(result.object.root)
    reasons = {s.part: s.reason for s in result.report.skipped}
    assert reasons.keys() <= {v.name for v in root.visuals}  # it stands with the static body
    assert all(s.why and "\n" not in s.why for s in result.report.skipped)
    return reasons


def test_a_door_next_to_a_side_is_no_skip():
    assert skipped(scene(DOOR, SIDE, joints=(hinged(),))) == {}


@pytest.mark.parametrize("others", [(), (FAR,)], ids=["only part", "nothing near"])
def test_a_door_alone_in_the_air_finds_no_hold(others):
    assert skipped(scene(DOOR, *others, joints=(hinged(),)))["door"] in NOWHERE


def test_moving_bodies_cannot_carry_one_another():
    found = skipped(scene(DOOR, SECOND, joints=(hinged(), hinged("door_2", RIGHT_EDGE))))
    assert found.keys() == {"door", "door_2"}
    assert set(found.values()) <= NOWHERE


def test_a_door_walled_in_on_all_sides_is_blocked():
    assert skipped(scene(DOOR, *CAGE, joints=(hinged(),))) == {"door": Reason.BLOCKED}


@pytest.mark.parametrize("direction", [(0.0, 0.6, 0.8), (0.6, 0.0, -0.8)])
def test_parts_that_slide_askew_are_unsupported(direction):
    asset = scene(DOOR, SIDE, joints=(sliding("door", direction),))
    assert skipped(asset) == {"door": Reason.UNSUPPORTED}


@pytest.mark.parametrize("direction", [(1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)])
def test_a_sliding_door_with_nothing_beside_its_way_has_no_room(direction):
    asset = scene(DOOR, SIDE, joints=(sliding("door", direction),))
    assert skipped(asset) == {"door": Reason.NO_ROOM}


def test_a_part_without_a_motion_says_so():
    result = realized(scene(DOOR, SIDE))
    assert [(s.part, s.reason) for s in result.report.skipped] == [("door", Reason.NO_MOTION)]
    assert result.report.skipped[0].why == "the input states no joint for it"


def test_one_blocked_door_does_not_cost_the_others():
    asset = made_kind("overlay pair")
    front = float(asset.part("door_1").box.low[1])
    plate = box("plate", (-0.4, front - 0.14, 0.0), (-0.001, front - 0.1, 0.72))
    result = realized(replace(asset, parts=(*asset.parts, plate)))
    assert not installed(result)["door_2"].restricted
    assert "door_1" not in installed(result) or installed(result)["door_1"].restricted


def test_a_plan_of_nothing_leaves_everything_as_it_was():
    asset = scene(DOOR, SIDE)
    result = realize(RealizationPlan(), asset, GALLERY)
    assert result.report.outcomes == ()
    assert [link.id for link in result.object.links] == ["body"]
    assert [v.surfaces for v in result.object.links[0].visuals] == [p.surfaces for p in asset.parts]


def test_refusals_are_reported_in_their_own_words():
    plan = RealizationPlan(refused=(Refusal("door", Reason.NO_MOTION, "no one knows"),))
    (outcome,) = realize(plan, scene(DOOR, SIDE), GALLERY).report.skipped
    assert (outcome.part, outcome.reason, outcome.why) == ("door", Reason.NO_MOTION, "no one knows")


def test_the_first_of_two_requests_for_a_part_counts():
    first = JointRequest("door", JointType.REVOLUTE, LEFT_EDGE, "first")
    plan = RealizationPlan((first, replace(first, source="second")))
    assert [o.source for o in realize(plan, scene(DOOR, SIDE), GALLERY).report.outcomes] == ["first"]


def test_what_rides_on_a_door_gets_no_joint_of_its_own():
    handle = box("handle", (0.35, -0.05, 0.2), (0.37, -0.02, 0.4))
    door = JointRequest("door", JointType.REVOLUTE, LEFT_EDGE, "test", attached=("handle",))
    alone = JointRequest("handle", JointType.REVOLUTE, LEFT_EDGE, "test")
    result = realize(RealizationPlan((alone, door)), scene(DOOR, SIDE, handle), GALLERY)
    assert [j.child for j in result.object.joints] == ["door"]
    assert {v.name for v in result.object.link("door").visuals} >= {"door", "handle"}


def test_a_request_must_move():
    with pytest.raises(ValueError, match="must be one that moves"):
        JointRequest("door", JointType.FIXED, LEFT_EDGE, "test")


def test_a_root_called_body_gives_way_to_a_part_of_that_name():
    body = replace(SIDE, id="body")
    result = realized(scene(DOOR, body, joints=(hinged(),)))
    assert result.object.root == "body_"
    assert installed(result)["door"].mount == "body"
