"""Doors that are called an oven or a dishwasher drop; with a handle at a side, tall or of other names they do not."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset, PartSource
from grafu.completion.dropping_doors import with_dropping_doors
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Attached, Hinge
from grafu.graph.edit import with_edges
from grafu.graph.motion import border_to_face, face_to_border, opening_face, sign_for_opening
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

LEFT, RIGHT, FRONT, BOTTOM, TOP = 0, 1, 2, 4, 5  # faces
BODY = replace(box("body", (-0.3, 0.0, 0.0), (0.3, 0.6, 1.85)), label=PartLabel.SIDE_PANEL)
GRIP = box("handle", (0.2, -0.05, 0.3), (0.22, -0.02, 0.5))


def hung(name: str, side: int, *others, height: float = 0.58, by: str = "name", body=BODY):
    """The face on which a door that is called so hangs in the end, where a side was predicted."""
    door = replace(box("door", (-0.29, -0.02, 0.1), (0.29, 0.0, 0.1 + height)), source=PartSource(name), labelled_by=by)
    asset = Asset("made", "", "made", (body, door, *others))
    border = face_to_border(1, side)
    decisions = (Decision("door", "border", str(border), 0.8, str(face_to_border(1, BOTTOM)), 0.15),)
    graph = parse_graph(asset)
    sign = sign_for_opening(1, border, FRONT)
    edges = [Hinge("body", "door", border, sign), *(Attached("door", other.id) for other in others)]
    completion = GraphCompletion(graph, with_edges(graph, edges), "network", decisions=decisions)
    (hinge,) = with_dropping_doors(completion, asset).completed.hinges
    assert opening_face(1, hinge.border, hinge.sign) == FRONT
    return border_to_face(1, hinge.border)


@pytest.mark.parametrize("side", [LEFT, RIGHT])
@pytest.mark.parametrize(
    "name", ["oven", "Dishwasher.001", "ofen", "B2_ovendoor", "oven_door_2", "Dishwasher Door", "dish_washer_door"]
)
def test_the_door_of_an_oven_drops(name, side):
    assert hung(name, side) == BOTTOM


@pytest.mark.parametrize("side", [LEFT, TOP])
@pytest.mark.parametrize(
    "name",
    [
        "microwave",
        "microwave oven",
        "microwave_oven_door",
        "door",
        "oven_knob",
        "oven_drawer_door",
        "cooker_front",
    ],
)
def test_doors_of_other_names_hang_as_predicted(name, side):
    assert hung(name, side) == side


def level_bar(x: float):
    return box("handle", (x - 0.1, -0.05, 0.6), (x + 0.1, -0.02, 0.62))


def test_a_level_bar_in_the_middle_shows_no_side():
    assert hung("oven door", LEFT, level_bar(0.0)) == BOTTOM
    assert hung("oven door", LEFT, level_bar(0.18)) == LEFT
    assert hung("cabinet door", LEFT, level_bar(0.0)) == LEFT
    assert hung("oven", LEFT, level_bar(0.0)) == LEFT, "one of several doors of a range"


def test_a_handle_a_height_or_a_hidden_name_leaves_it_as_predicted():
    assert hung("oven", LEFT, GRIP) == LEFT
    assert hung("oven", LEFT, height=1.2) == LEFT
    assert hung("oven", LEFT, by="hidden") == LEFT
    assert hung("oven", TOP) == TOP


def called(name: str, *, high: float = 0.7, wide: float = 0.6):
    """A body of that name, 0.6 m deep."""
    part = box("body", (-wide / 2, 0.0, 0.0), (wide / 2, 0.6, high))
    return replace(part, source=PartSource(name), label=PartLabel.UNKNOWN, labelled_by="none")


HIGH_BAR = box("handle", (-0.25, -0.05, 0.6), (0.25, -0.02, 0.62))


@pytest.mark.parametrize("name", ["dishwasher_body_3", "oven", "Backofen"])
def test_a_door_before_the_body_of_an_oven_drops_where_a_level_bar_pulls_it_down(name):
    body = called(name)
    knob = box("handle_knob", (-0.02, -0.05, 0.64), (0.02, -0.02, 0.67))
    assert hung("link_1", LEFT, HIGH_BAR, knob, body=body) == BOTTOM
    assert hung("link_1", LEFT, level_bar(0.0), height=1.0, body=body) == LEFT, "the bar is in its lower half"
    assert hung("link_1", LEFT, GRIP, body=body) == LEFT
    assert hung("link_1", LEFT, HIGH_BAR, body=called("microwave oven")) == LEFT
    assert hung("link_1", LEFT, HIGH_BAR, body=called(name, wide=3.0)) == LEFT, "one of several"


@pytest.mark.parametrize("side", [BOTTOM, TOP])
def test_no_door_of_a_refrigerator_drops_or_lifts(side):
    assert hung("fridge", side) in (LEFT, RIGHT)
    assert hung("link_1", side, body=called("refrigerator_body_0")) in (LEFT, RIGHT)
    assert hung("link_1", side, body=called("cabinet_body_0")) == side
    assert hung("fridge_door", side, height=0.3) == side, "the flap of a compartment"
    assert hung("link_1", side, body=called("fridge_shelf")) == side
