"""What hangs on a door alone goes with it: a liner, its bins, the edges of a hollow leaf, a gasket; else it stays."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import IDENTITY_FRAME, PartSource, Standing
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.hung_parts import with_hung_parts
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.vocabulary import JointType, PartLabel
from small_scenes import box, cylinder, scene

DOOR = replace(box("door_skin", (0.0, -0.045, 0.1), (0.6, -0.04, 1.1)), label=PartLabel.DOOR)
CASE = [
    replace(part, label=label)
    for part, label in (
        (box("left", (0.0, 0.0, 0.1), (0.03, 0.6, 1.1)), PartLabel.SIDE_PANEL),
        (box("right", (0.57, 0.0, 0.1), (0.6, 0.6, 1.1)), PartLabel.SIDE_PANEL),
        (box("floor", (0.03, 0.0, 0.1), (0.57, 0.6, 0.13)), PartLabel.BOTTOM_PANEL),
        (box("top", (0.03, 0.0, 1.07), (0.57, 0.6, 1.1)), PartLabel.TOP_PANEL),
    )
]
LINER = box("liner", (0.02, -0.04, 0.12), (0.58, -0.01, 1.08))
BIN = [
    box("bin_floor", (0.1, -0.01, 0.5), (0.5, 0.1, 0.505)),
    box("bin_lip", (0.1, 0.095, 0.505), (0.5, 0.1, 0.56)),
]
GASKET = box("gasket_left", (0.005, -0.04, 0.12), (0.02, 0.0, 1.08))


def hinge(moving="door_skin", attached=()):
    axis = Axis(vec3(0.0, -0.04, 0.6), vec3(0.0, 0.0, -1.0))
    return JointRequest(moving, JointType.REVOLUTE, axis, "network", attached=attached)


def planned(*parts, more=(), settled=()):
    """What goes with each part that moves, by the id of that."""
    plan = with_hung_parts(RealizationPlan((hinge(), *more), ()), scene(DOOR, *CASE, *parts), settled)
    return {request.moving: set(request.attached) for request in plan.joints}


def test_a_liner_its_bin_and_a_gasket_go_with_their_door():
    assert planned(LINER, *BIN, GASKET) == {"door_skin": {"liner", "bin_floor", "bin_lip", "gasket_left"}}


@pytest.mark.parametrize(
    ("name", "others"),
    [
        ("a strip from the case to the liner", [box("strip", (0.03, -0.01, 0.7), (0.1, 0.1, 0.72))]),
        ("a shelf that touches it", [box("shelf", (0.03, -0.01, 0.7), (0.57, 0.5, 0.72))]),
        ("a deep shelf that hangs on it", [box("board", (0.1, -0.01, 0.7), (0.5, 0.5, 0.72))]),
        ("clear of it", [box("rack", (0.1, 0.0, 0.7), (0.5, 0.1, 0.72))]),
        ("beside it", [box("panel", (0.58, -0.04, 0.12), (0.66, -0.035, 1.08))]),
    ],
)
def test_what_the_case_holds_or_what_does_not_touch_the_door_stays(name, others):
    found = planned(LINER, *others)["door_skin"]

    assert not found & {part.id for part in others}, name


def test_a_gasket_on_the_case_alone_stays():
    on_case = box("gasket_left", (0.0, -0.005, 0.12), (0.02, 0.0, 1.08))

    assert planned(on_case) == {"door_skin": set()}


@pytest.mark.parametrize(
    ("kind", "link", "goes"), [("urdf", "body", False), ("urdf", "leaf", True), ("glb", "body", True)]
)
def test_what_is_on_the_link_of_the_body_of_a_robot_stays(kind, link, goes):
    body = [replace(part, source=PartSource(part.id, link="body")) for part in CASE]
    door = replace(DOOR, source=PartSource(DOOR.id, link="leaf"))
    liner, gasket = (replace(part, source=PartSource(part.id, link=link)) for part in (LINER, GASKET))
    asset = replace(scene(door, *body, liner, gasket), kind=kind)
    (request,) = with_hung_parts(RealizationPlan((hinge(),), ()), asset).joints
    assert set(request.attached) == ({"liner", "gasket_left"} if goes else set())


def test_a_hinge_and_a_handle_hold_nothing():
    knuckle = replace(box("hinge_knuckle", (-0.01, -0.04, 0.2), (0.03, 0.01, 0.3)), source=PartSource("hinge_knuckle"))
    handle = replace(cylinder("handle", ((0.5, -0.09, 0.6), (0.5, -0.02, 0.6))), label=PartLabel.HANDLE)

    assert planned(LINER, knuckle, handle) == {"door_skin": {"liner"}}


@pytest.mark.parametrize(
    ("label", "low", "goes"),
    [
        (PartLabel.UNKNOWN, -0.04, True),
        (PartLabel.DOOR, -0.04, True),
        (PartLabel.DRAWER, -0.04, False),
        (PartLabel.DOOR, -0.05, False),
    ],
)
def test_a_strip_taken_for_a_door_moves_with_the_door_that_hides_it(label, low, goes):
    """Edges of a hollow leaf are called `door_edge_left`; a drawer, and what is seen beside a door, moves itself."""
    edge = replace(box("edge", (0.0, low, 0.12), (0.013, -0.005, 1.08)), label=label)
    trim = box("trim", (0.0, -0.005, 0.3), (0.013, -0.001, 0.4))
    found = planned(edge, trim, more=(hinge("edge", ("trim",)),))

    assert found == ({"door_skin": {"edge", "trim"}} if goes else {"door_skin": set(), "edge": {"trim"}})
    assert set(planned(edge, trim, more=(hinge("edge"),), settled=("edge",))) == {"door_skin", "edge"}


def test_the_case_of_a_cabinet_on_a_wall_does_not_hang_on_its_door():
    """In a room nothing else touches such a case, and it is shallow beside what stands in the room."""
    case = box("case", (0.0, -0.04, 0.1), (0.6, 0.11, 1.1))
    room = scene(DOOR, case, box("sofa", (2.0, 0.0, 0.0), (3.0, 2.0, 0.8)))
    standing = Standing(("door_skin", "case"), np.eye(4), IDENTITY_FRAME)
    for asset, hung in ((room, {"case"}), (replace(room, standings=(standing,)), set())):
        (joint,) = with_hung_parts(RealizationPlan((hinge(),), ()), asset).joints
        assert set(joint.attached) == hung
