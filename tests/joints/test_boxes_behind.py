"""A front drawn apart from the box of its drawer slides out with it, whatever the boards touch; look-alikes do not.

All pieces have no labels, but for what a test calls a door: shape alone tells.
"""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import Asset, Part
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.boxes_behind import with_boxes_behind
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel
from judging import swept_collisions
from small_scenes import box, scene

OUT = vec3(0.0, -1.0, 0.0)


def nameless(name: str, low, high) -> Part:
    return replace(box(name, low, high), label=PartLabel.UNKNOWN, labelled_by="none")


def one_part(name: str, parts: list[Part]) -> Part:
    return replace(parts[0], id=name, surfaces=tuple(surface for part in parts for surface in part.surfaces))


def case(width: float = 0.5, depth: float = 0.57, low: float = 0.0, high: float = 0.3, t: float = 0.03) -> list[Part]:
    """A case of five boards whose front edges lie at y = 0."""
    x = width / 2
    return [
        nameless("above", (-x, 0.0, high - t), (x, depth, high)),
        nameless("below", (-x, 0.0, low), (x, depth, low + t)),
        nameless("rear", (t - x, depth - t, low + t), (x - t, depth, high - t)),
        nameless("west", (-x, 0.0, low + t), (t - x, depth, high - t)),
        nameless("east", (x - t, 0.0, low + t), (x, depth, high - t)),
    ]


def boards(width: float = 0.438, depth: float = 0.54, low: float = 0.031, high: float = 0.239) -> list[Part]:
    """The box of a drawer without a front of its own, 1 mm beside its case; its rear board touches the case."""
    x, t = width / 2, 0.02
    return [
        nameless("floor", (-x, 0.0, low), (x, depth, low + t)),
        nameless("end", (t - x, depth - t, low + t), (x - t, depth, high)),
        nameless("left", (-x, 0.0, low + t), (t - x, depth, high)),
        nameless("right", (x - t, 0.0, low + t), (x, depth, high)),
    ]


FRONT = nameless("front", (-0.249, -0.025, 0.001), (0.249, -0.005, 0.299))
DOOR = replace(FRONT, label=PartLabel.DOOR, labelled_by="name")
ITS_BOX = {"floor", "end", "left", "right"}


def requested(front: Part, *parts: Part, turns: bool = False, others: tuple[JointRequest, ...] = ()):
    """Returns what is built of a front that turns, or slides out, before other parts."""
    axis = Axis(front.box.low, vec3(0.0, 0.0, 1.0)) if turns else Axis(front.box.center, OUT)
    request = JointRequest(front.id, JointType.REVOLUTE if turns else JointType.PRISMATIC, axis, "network")
    return with_boxes_behind(RealizationPlan((request, *others)), scene(front, *parts)).joints


@pytest.mark.parametrize("merged", [False, True], ids=["boards", "one part"])
@pytest.mark.parametrize("front", [FRONT, DOOR], ids=["a drawer", "what is called a door"])
def test_a_box_goes_with_its_front(front, merged):
    apart = [one_part("box", boards())] if merged else boards()
    inside = [one_part("case", case())] if merged else case()
    (request,) = requested(front, *inside, *apart, turns=front is DOOR)
    assert request.type is JointType.PRISMATIC
    assert request.axis.direction == pytest.approx(OUT)
    assert set(request.attached) == ({"box"} if merged else ITS_BOX)


def test_boards_that_were_guessed_to_move_go_with_it_with_what_they_carry():
    floor = next(part for part in boards() if part.id == "floor")
    guess = JointRequest("floor", JointType.PRISMATIC, Axis(floor.box.center, OUT), "network", attached=("knob",))
    knob = nameless("knob", (-0.01, -0.05, 0.14), (0.01, -0.025, 0.16))
    (request,) = requested(FRONT, *case(), *boards(), knob, others=(guess,))
    assert set(request.attached) == {*ITS_BOX, "knob"}


def test_a_board_moves_with_one_part_only():
    other = nameless("other", (-0.249, -0.025, 0.301), (0.249, -0.005, 0.599))
    guess = JointRequest(
        "other", JointType.PRISMATIC, Axis(other.box.center, OUT), "network", attached=("left", "pull")
    )
    pull = nameless("pull", (-0.01, -0.05, 0.44), (0.01, -0.025, 0.46))
    made = requested(FRONT, *case(), *boards(), other, pull, others=(guess,))
    assert {request.moving: set(request.attached) for request in made} == {"front": ITS_BOX, "other": {"pull"}}


def fitted(wall: float) -> list[Part]:
    """What a cabinet-maker draws of one drawer: a board behind its front, a screw through both, and rails at one side.

    The outer profile of the rails lies on the wall of the case where `wall` is 0, else so far from it (metres).
    """
    return [
        nameless("sub_front", (-0.188, -0.005, 0.05), (0.188, 0.007, 0.2)),
        nameless("screw", (0.1, -0.016, 0.1), (0.104, 0.01, 0.104)),
        nameless("outer", (-0.22 + wall, 0.0, 0.06), (-0.216 + wall, 0.5, 0.1)),
        nameless("inner", (-0.212, 0.0, 0.07), (-0.208, 0.5, 0.09)),
    ]


def test_a_board_behind_the_front_and_the_screws_in_it_go_with_the_drawer():
    (request,) = requested(FRONT, *case(), *boards(width=0.416), *fitted(0.0))
    assert set(request.attached) == {*ITS_BOX, "sub_front", "screw", "inner"}


def test_the_profile_of_a_rail_that_lies_on_no_wall_goes_with_the_drawer():
    (request,) = requested(FRONT, *case(), *boards(width=0.416), *fitted(0.0035))
    assert "outer" in request.attached


def test_a_shelf_that_begins_in_the_front_stays():
    shelf = nameless("shelf", (-0.2, -0.01, 0.22), (0.2, 0.56, 0.235))
    long = nameless("long", (0.1, -0.016, 0.1), (0.104, 0.6, 0.104))
    (request,) = requested(FRONT, *case(), *boards(high=0.2), shelf, long)
    assert set(request.attached) == ITS_BOX


LOOK_ALIKES = {
    "the case alone": (FRONT, case(), False),
    "a case that is open above": (FRONT, [part for part in case() if part.id != "above"], False),
    "that case among others": (
        FRONT,
        [
            *(part for part in case() if part.id != "above"),
            nameless("next", (0.25, 0.0, 0.0), (0.28, 0.57, 0.3)),
            nameless("last", (-0.28, 0.0, 0.0), (-0.25, 0.57, 0.3)),
        ],
        False,
    ),
    "a box that is closed above": (
        FRONT,
        [*case(), *boards(), nameless("lid", (-0.219, 0.0, 0.239), (0.219, 0.54, 0.249))],
        False,
    ),
    "a board that begins far behind the front": (
        FRONT,
        [*case(), nameless("floor", (-0.219, 0.1, 0.031), (0.219, 0.54, 0.05)), *boards()[2:]],
        False,
    ),
    "a shelf between two boards that stand free": (FRONT, boards(), False),
    "a tray with a front of its own, behind a door": (
        DOOR,
        [*case(), *boards(), nameless("face", (-0.219, 0.0, 0.031), (0.219, 0.015, 0.239))],
        True,
    ),
    "a low tray behind a tall door": (
        replace(DOOR, surfaces=box("d", (-0.249, -0.025, 0.001), (0.249, -0.005, 0.999)).surfaces),
        [*case(high=1.0), *boards()],
        True,
    ),
}


@pytest.mark.parametrize("what", LOOK_ALIKES)
def test_what_only_looks_like_one_stays(what):
    front, parts, turns = LOOK_ALIKES[what]
    (request,) = requested(front, *parts, turns=turns)
    assert request.attached == ()
    assert request.kind.turns == turns


def test_what_the_user_states_stays():
    request = JointRequest("front", JointType.REVOLUTE, Axis(FRONT.box.low, vec3(0.0, 0.0, 1.0)), "user")
    plan = RealizationPlan((request,))
    assert with_boxes_behind(plan, scene(DOOR, *case(), *boards()), {"front"}).joints == plan.joints


def test_a_chest_of_such_drawers_works():
    parts: list[Part] = []
    for k in range(3):
        up = np.eye(4)
        up[2, 3] = 0.3 * k
        named = (FRONT, *case(), *boards(), nameless("knob", (-0.02, -0.06, 0.14), (0.02, -0.025, 0.16)))
        parts += [
            replace(part, id=f"{part.id}_{k}", surfaces=tuple(s.transformed(up) for s in part.surfaces))
            for part in named
        ]
    made = functionalize(Asset("chest", "", "made", tuple(parts)), MotionSource.NETWORK, builtin_gallery())
    assert {joint.child for joint in made.object.joints} == {f"front_{k}" for k in range(3)}
    for k, joint in enumerate(made.object.joints):
        moving = {visual.name for visual in made.object.link(joint.child).visuals}
        assert {f"{name}_{k}" for name in ITS_BOX} <= moving
        assert not {f"{part.id}_{k}" for part in case()} & moving
        assert joint.limits.upper > 0.3
        assert max(swept_collisions(made.object, joint, 10).values(), default=0.0) < 1e-9  # its rear board touches
    assert not [addition for addition in made.additions if addition.category == "drawer box"]
