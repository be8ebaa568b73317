"""Doors hang on the side away from a handle that is clearly off the middle; others stay as they are predicted."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset
from grafu.completion.handle_sides import HandleSideConfig, with_handle_sides
from grafu.graph.completion import BY_RULE, Decision, GraphCompletion
from grafu.graph.edges import Attached, Hinge
from grafu.graph.edit import with_edges
from grafu.graph.motion import border_to_face, face_to_border, opening_face, sign_for_opening
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

LEFT, RIGHT, FRONT, BACK, BOTTOM, TOP = 0, 1, 2, 3, 4, 5  # faces
BODY = replace(box("body", (-0.4, 0.0, 0.0), (0.4, 0.6, 1.0)), label=PartLabel.SIDE_PANEL)
DOOR = box("door", (-0.35, -0.03, 0.1), (0.35, 0.0, 0.7))
LOW_DOOR = box("door", (-0.35, -0.03, 0.1), (0.35, 0.0, 0.4))
LID = box("door", (-0.35, 0.0, 1.0), (0.35, 0.6, 1.03))


def bar(x: float, z=(0.3, 0.5), y=(-0.06, -0.03), name="handle"):
    return replace(box(name, (x - 0.01, y[0], z[0]), (x + 0.01, y[1], z[1])), label=PartLabel.HANDLE)


def level_bar(x: float):
    return replace(box("handle", (x - 0.08, -0.06, 0.6), (x + 0.08, -0.03, 0.62)), label=PartLabel.HANDLE)


def hung(door, handles, face: int, *, thin=1, front=FRONT, given=True, coupling=None):
    """Returns the completion in which a door hangs on a face of its box, before and after."""
    door = replace(door, label=PartLabel.DOOR)
    graph = parse_graph(Asset("made", "", "made", (BODY, door, *handles)))
    border = face_to_border(thin, face)
    sign = sign_for_opening(thin, border, front)
    scores = {
        str(face_to_border(thin, other)): 0.1 for other in range(6) if other not in (2 * thin, 2 * thin + 1, face)
    }
    first, *others = scores.items()
    decisions = (
        Decision("door", "border", str(border), 0.7, *first, others=tuple(others)),
        Decision("door", "sign", str(sign), 0.9, str(1 - sign), 0.1),
    )
    edges = [Hinge("body", "door", border, sign, coupling), *(Attached("door", handle.id) for handle in handles)]
    completion = GraphCompletion(graph, with_edges(graph, edges), "network", decisions=decisions)
    asset = Asset("made", "", "made", (BODY, door, *(handles if given else ())))
    return completion, with_handle_sides(completion, asset)


@pytest.mark.parametrize(
    ("handles", "face", "side"),
    [
        ([bar(-0.3)], LEFT, RIGHT),
        ([bar(0.3)], RIGHT, LEFT),
        ([level_bar(0.25)], RIGHT, LEFT),
        ([bar(0.3)], BOTTOM, LEFT),
        ([bar(-0.3)], TOP, RIGHT),
        ([bar(-0.3), bar(-0.25, name="handle_2")], TOP, RIGHT),
    ],
    ids=["left", "right", "level bar", "drops", "lifts", "two handles"],
)
def test_a_door_hangs_on_the_side_away_from_its_handle_and_opens_to_the_same_face(handles, face, side):
    before, after = hung(DOOR, handles, face)
    (hinge,) = after.completed.hinges
    assert border_to_face(1, hinge.border) == side
    assert opening_face(1, hinge.border, hinge.sign) == FRONT
    told = after.decision("door", "border")
    assert (told.choice, told.score, told.by) == (str(hinge.border), 0.75, BY_RULE)
    assert (told.runner_up, told.runner_up_score) == (str(before.completed.hinges[0].border), 0.25)


@pytest.mark.parametrize(
    ("door", "handles", "face", "how"),
    [
        (DOOR, [bar(-0.3)], RIGHT, {}),
        (DOOR, [level_bar(0.25)], BOTTOM, {}),
        (LOW_DOOR, [bar(0.3, z=(0.2, 0.3))], BOTTOM, {}),
        (DOOR, [bar(0.05)], RIGHT, {}),
        (DOOR, [bar(0.38)], RIGHT, {}),
        (DOOR, [bar(-0.3), bar(0.3, name="handle_2")], TOP, {}),
        (DOOR, [bar(0.3)], RIGHT, {"given": False}),
        (LID, [bar(0.3, z=(1.03, 1.06), y=(0.2, 0.4))], RIGHT, {"thin": 2, "front": TOP}),
    ],
    ids=[
        "away already",
        "a flap with a level bar",
        "a wide flap",
        "a handle in the middle",
        "a handle beside the door",
        "a handle at either side",
        "a handle that was added",
        "a lid",
    ],
)
def test_other_doors_stay_as_they_are_predicted(door, handles, face, how):
    before, after = hung(door, handles, face, **how)
    assert after is before


def lid_handle(x=(-0.1, 0.1), y=(-0.03, 0.0)):
    return replace(box("handle", (x[0], y[0], 1.01), (x[1], y[1], 1.02)), label=PartLabel.HANDLE)


def test_a_lid_hangs_opposite_to_the_border_at_which_its_handle_is():
    _, after = hung(LID, [lid_handle()], FRONT, thin=2, front=TOP)
    (hinge,) = after.completed.hinges
    assert border_to_face(2, hinge.border) == BACK
    assert opening_face(2, hinge.border, hinge.sign) == TOP


@pytest.mark.parametrize(
    ("handles", "face"),
    [([lid_handle()], BACK), ([lid_handle()], LEFT), ([lid_handle(y=(0.2, 0.23))], FRONT), ([], FRONT)],
    ids=["opposite already", "at a side", "in the middle", "no handle"],
)
def test_other_lids_stay_as_they_are_predicted(handles, face):
    before, after = hung(LID, handles, face, thin=2, front=TOP)
    assert after is before


def test_numbers_are_above_nothing():
    with pytest.raises(ValueError, match="off"):
        HandleSideConfig(off=0.0)


def at(z: float, half: float = 0.08, x: float = 0.0):
    return replace(box("handle", (x - half, -0.06, z), (x + half, -0.03, z + 0.02)), label=PartLabel.HANDLE)


@pytest.mark.parametrize(("z", "side"), [(0.37, BOTTOM), (0.11, TOP)])
def test_a_wide_front_with_a_level_bar_at_its_edge_turns_about_the_other_one(z, side):
    _, after = hung(LOW_DOOR, [at(z)], LEFT)
    (hinge,) = after.completed.hinges
    assert border_to_face(1, hinge.border) == side
    assert opening_face(1, hinge.border, hinge.sign) == FRONT


@pytest.mark.parametrize(
    ("door", "handle"),
    [
        (LOW_DOOR, at(0.24)),
        (LOW_DOOR, at(0.37, half=0.015)),
        (LOW_DOOR, at(0.37, x=-0.15)),
        (DOOR, at(0.65)),
    ],
    ids=["at half height", "a knob", "off the middle", "not wide"],
)
def test_other_doors_with_level_bars_hang_as_predicted(door, handle):
    before, after = hung(door, [handle], LEFT)
    assert after is before


def in_one(door, *more):
    return replace(door, surfaces=(*door.surfaces, *(surface for part in more for surface in part.surfaces)))


def test_a_grip_that_is_drawn_in_one_with_its_door_tells_the_side():
    low, high = (-0.34, -0.042, 0.3), (-0.31, -0.03, 0.5)
    _, after = hung(in_one(DOOR, box("grip", low, high)), [], LEFT)
    assert border_to_face(1, after.completed.hinges[0].border) == RIGHT


def test_a_bar_and_its_posts_in_one_with_a_wide_front_are_one_handle():
    wide = box("door", (-0.35, -0.03, 0.1), (0.35, 0.0, 0.5))
    bar_and_posts = [
        box("bar", (-0.1, -0.07, 0.13), (0.1, -0.06, 0.14)),
        *(box(f"post_{x}", (x, -0.062, 0.131), (x + 0.006, -0.03, 0.139)) for x in (-0.08, 0.074)),
    ]
    _, after = hung(in_one(wide, *bar_and_posts), [], LEFT)
    assert border_to_face(1, after.completed.hinges[0].border) == TOP


@pytest.mark.parametrize(
    "more",
    [
        [box("bin", (-0.34, 0.0, 0.3), (-0.24, 0.03, 0.5))],
        [box(f"moulding_{x}", (x, -0.042, 0.12), (x + 0.02, -0.03, 0.68)) for x in (-0.3, 0.28)],
        [box("plate", (-0.34, -0.033, 0.3), (-0.24, -0.03, 0.4))],
    ],
    ids=["behind the leaf", "mouldings at both sides", "a flat plate"],
)
def test_other_shells_of_a_door_tell_no_side(more):
    _, after = hung(in_one(DOOR, *more), [], LEFT)
    assert border_to_face(1, after.completed.hinges[0].border) == LEFT
