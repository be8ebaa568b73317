"""One front drawn as several nameless parts moves as one; what only looks like it stays two."""

from dataclasses import replace

import pytest

from grafu.asset.part import Part
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.edit import relabelled
from grafu.graph.parse import parse_graph
from grafu.joints.config import RealizationConfig
from grafu.joints.layered_fronts import with_layered_fronts
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.pipeline.shown_by_shape import shown_by_shape
from grafu.vocabulary import JointType, PartLabel
from small_scenes import box, scene

OUT = vec3(0.0, -1.0, 0.0)


def board(name: str, low, high, label: PartLabel = PartLabel.UNKNOWN) -> Part:
    return replace(box(name, low, high), label=label)


def turning(part: Part, *attached: str, parent: str = "") -> JointRequest:
    axis = Axis(part.box.low, vec3(0.0, 0.0, 1.0))
    return JointRequest(part.id, JointType.REVOLUTE, axis, "network", attached=attached, parent=parent)


def sliding_out(part: Part, *attached: str) -> JointRequest:
    return JointRequest(part.id, JointType.PRISMATIC, Axis(part.box.center, OUT), "network", attached=attached)


def moved(*requests: JointRequest, parts: list[Part]) -> dict[str, tuple[str, ...]]:
    """Returns what moves by a joint of its own, with what goes along."""
    plan = with_layered_fronts(RealizationPlan(requests), scene(*parts))
    return {request.moving: request.attached for request in plan.joints}


TALL = board("tall", (0.0, -0.02, 0.0), (0.5, 0.0, 1.0))
WIDE = board("wide", (-0.03, -0.02, 0.05), (0.53, 0.0, 0.95))
PANE = board("pane", (0.05, -0.026, 0.1), (0.45, -0.025, 0.9))
SCREEN = board("screen", (0.05, -0.06, 0.1), (0.45, -0.04, 0.9))
NEXT = board("next", (0.5, -0.02, 0.0), (1.0, 0.0, 1.0))
LAPPING = board("lapping", (0.4, -0.04, 0.0), (0.9, -0.02, 1.0))


def test_two_boards_in_one_another_with_a_pane_before_them_are_one_leaf():
    parts = [TALL, WIDE, PANE]
    assert moved(turning(PANE), turning(TALL), turning(WIDE, "knob"), parts=parts) == {"wide": ("knob", "tall", "pane")}


def test_a_pane_that_was_taken_for_a_door_on_its_leaf_goes_with_it():
    made = moved(turning(PANE, parent="tall"), turning(TALL, "pane", "knob"), parts=[TALL, PANE])
    assert made == {"tall": ("pane", "knob")}


def test_boards_in_one_another_are_one_whatever_is_on_each():
    made = moved(turning(TALL, "lock"), turning(WIDE, "knob"), parts=[TALL, WIDE])
    assert made == {"wide": ("knob", "tall", "lock")}


@pytest.mark.parametrize(
    ("first", "second"),
    [
        pytest.param(turning(TALL), turning(SCREEN), id="a screen before a door, with air between them"),
        pytest.param(turning(TALL), turning(NEXT), id="a pair of doors"),
        pytest.param(turning(TALL), turning(LAPPING), id="leaves that lap"),
        pytest.param(turning(TALL, "lock"), turning(PANE, "knob"), id="a flap in a door, with handles of their own"),
        pytest.param(turning(TALL), turning(PANE, "knob", parent="tall"), id="what turns on the other, with a handle"),
        pytest.param(turning(TALL), turning(SCREEN, parent="tall"), id="what turns on the other, with air between"),
        pytest.param(turning(TALL), sliding_out(PANE), id="what moves otherwise"),
    ],
)
def test_two_that_move_each_for_itself_stay_two(first, second):
    assert set(moved(first, second, parts=[TALL, PANE, SCREEN, NEXT, LAPPING])) == {first.moving, second.moving}


def test_what_the_input_calls_a_door_stays_one():
    named = replace(PANE, label=PartLabel.DOOR)
    assert set(moved(turning(TALL), turning(named), parts=[TALL, named])) == {"tall", "pane"}


BEHIND_GLASS = board("frame", (0.02, -0.02, 0.0), (0.48, 0.0, 1.0), PartLabel.DOOR)
PULLS = [
    board(name, (x, -0.06, 0.5), (x + 0.02, -0.03, 0.6), label)
    for name, x, label in (
        ("pull", 0.4, PartLabel.HANDLE),
        ("lever", 0.4, PartLabel.HANDLE),
        ("pane", 0.1, PartLabel.MISC),
    )
]
GLASS = board("glass", (0.0, -0.03, 0.0), (0.5, -0.02, 1.0))


@pytest.mark.parametrize(
    ("frame", "glass", "is_one"),
    [
        (turning(BEHIND_GLASS), turning(GLASS, "pull"), True),
        (turning(BEHIND_GLASS, "pull"), turning(GLASS), True),
        (turning(BEHIND_GLASS, "pane"), turning(GLASS, "pull"), True),
        (turning(BEHIND_GLASS), turning(GLASS), False),
        (turning(BEHIND_GLASS, "lever"), turning(GLASS, "pull"), False),
    ],
    ids=["a pull on the glass", "a pull on the frame", "a pane on the frame", "no pull", "a pull on each"],
)
def test_layers_that_touch_and_have_one_pull_are_one_door_whatever_they_are_called(frame, glass, is_one):
    assert (len(moved(frame, glass, parts=[BEHIND_GLASS, GLASS, *PULLS])) == 1) is is_one


def test_what_the_user_states_to_move_by_itself_is_no_layer():
    plan = RealizationPlan((turning(BEHIND_GLASS), turning(GLASS, "pull")))
    assert len(with_layered_fronts(plan, scene(BEHIND_GLASS, GLASS, *PULLS), settled=("frame",)).joints) == 2


TRAY = board("tray", (0.0, 0.0, 0.0), (0.5, 0.5, 0.15))
PLATE = board("plate", (-0.02, -0.02, 0.01), (0.52, 0.0, 0.16))
BEHIND = board("plate", (-0.02, 0.5, 0.01), (0.52, 0.52, 0.16))
ABOVE = board("plate", (-0.02, -0.02, 0.155), (0.52, 0.0, 0.3))


def test_the_plate_before_a_drawer_goes_with_it():
    assert moved(sliding_out(PLATE, "knob"), sliding_out(TRAY), parts=[TRAY, PLATE]) == {"tray": ("plate", "knob")}


def test_a_nameless_plate_goes_with_what_is_called_a_drawer_behind_it():
    named, pull = replace(TRAY, label=PartLabel.DRAWER), board("pull", (0.2, -0.05, 0.08), (0.3, -0.02, 0.1))
    made = moved(sliding_out(named), sliding_out(PLATE, "pull"), parts=[named, PLATE, pull])
    assert made == {"tray": ("plate", "pull")}
    front = replace(PLATE, label=PartLabel.DRAWER)
    assert set(moved(sliding_out(named), sliding_out(front), parts=[named, front])) == {"tray", "plate"}


@pytest.mark.parametrize("other", [BEHIND, ABOVE], ids=["behind it", "the front of the drawer above"])
def test_another_plate_does_not(other):
    assert set(moved(sliding_out(TRAY), sliding_out(other), parts=[TRAY, other])) == {"tray", "plate"}


def test_a_plan_by_shape_holds_the_drawer_alone():
    case = [board("side", (-0.1, 0.0, 0.0), (-0.05, 0.5, 0.4)), board("other", (0.55, 0.0, 0.0), (0.6, 0.5, 0.4))]
    asset = scene(*case, TRAY, PLATE)
    graph = relabelled(parse_graph(asset), {"tray": PartLabel.DRAWER, "plate": PartLabel.DRAWER})
    plan, _ = shown_by_shape(
        RealizationPlan((sliding_out(PLATE), sliding_out(TRAY))), asset, graph, RealizationConfig()
    )
    assert [(request.moving, request.attached) for request in plan.joints] == [("tray", ("plate",))]
