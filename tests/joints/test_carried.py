"""What nothing but a door or drawer holds moves with it."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.geometry.box import Box
from grafu.graph.edges import Contact, Hinge, Rail
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import face_to_border, sign_for_opening
from grafu.joints.make_plan import carried_parts
from grafu.vocabulary import PartLabel


def node(name, low, high, label=PartLabel.MISC):
    return PartNode(name, label, Box(np.array(low, float), np.array(high, float)))


CASE = node("case", (0, 0, 0), (1, 0.5, 1), PartLabel.SIDE_PANEL)
DOOR = node("door", (0, -0.02, 0), (0.5, 0, 1), PartLabel.DOOR)
POSTS = [node("post_a", (0.4, -0.05, 0.4), (0.41, -0.02, 0.41)), node("post_b", (0.4, -0.05, 0.6), (0.41, -0.02, 0.61))]
BAR = node("bar", (0.4, -0.06, 0.35), (0.41, -0.05, 0.65), PartLabel.BAR)
TURNS = Hinge("case", "door", face_to_border(1, 0), sign_for_opening(1, face_to_border(1, 0), 2))


def carried(nodes, contacts, motion=TURNS, fixed_to=()):
    graph = FunctionalGraph("made", tuple(nodes), (motion, *(Contact(a, b) for a, b in contacts)))
    return {part: moving_body for moving_body, part in carried_parts(graph, dict(fixed_to))}


def test_posts_and_bar_go_with_the_door_whatever_they_are_called():
    found = carried(
        [CASE, DOOR, *POSTS, BAR], [("door", "post_a"), ("door", "post_b"), ("post_a", "bar"), ("bar", "post_b")]
    )
    assert found == {"post_a": "door", "post_b": "door", "bar": "door"}


def test_what_also_touches_the_case_stays():
    assert carried([CASE, DOOR, POSTS[0]], [("door", "post_a"), ("post_a", "case")]) == {}


def test_a_part_between_two_doors_belongs_to_neither():
    second = replace(DOOR, id="second")
    motion = replace(TURNS, child="second")
    graph = FunctionalGraph(
        "made", (CASE, DOOR, second, BAR), (TURNS, motion, Contact("door", "bar"), Contact("second", "bar"))
    )
    assert carried_parts(graph, {}) == ()


def test_what_lies_behind_a_door_stays():
    behind = node("vase", (0.2, 0.1, 0.2), (0.3, 0.2, 0.3))
    assert carried([CASE, DOOR, behind], [("door", "vase")]) == {}


def test_a_plate_larger_than_the_door_stays():
    wall = node("wall", (-1, -0.05, 0), (2, -0.02, 1))
    assert carried([CASE, DOOR, wall], [("door", "wall")]) == {}


def test_a_shelf_is_not_carried():
    shelf = node("shelf", (0.1, -0.06, 0.4), (0.4, -0.02, 0.42), PartLabel.SHELF)
    assert carried([CASE, DOOR, shelf], [("door", "shelf")]) == {}


@pytest.mark.parametrize("fixed_to", [{}, {"post_a": "drawer"}])
def test_what_a_drawer_holds_goes_with_it_and_what_its_handle_holds(fixed_to):
    drawer = node("drawer", (0, 0, 0), (0.5, 0.5, 0.3), PartLabel.DRAWER)
    divider = node("insert", (0.2, 0.1, 0.05), (0.21, 0.4, 0.2))
    post = node("post_a", (0.2, -0.03, 0.1), (0.21, 0, 0.11))
    rose = node("rose", (0.19, -0.04, 0.1), (0.22, -0.03, 0.11))
    contacts = [("drawer", "insert"), ("drawer", "post_a"), ("post_a", "rose")]
    found = carried([CASE, drawer, divider, post, rose], contacts, Rail("case", "drawer", 2), fixed_to)
    assert found == dict.fromkeys({"insert", "post_a", "rose"} - set(fixed_to), "drawer")
