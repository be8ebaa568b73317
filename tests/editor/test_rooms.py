"""Handles stay on their front: the room to move them ends at its borders, wherever they were moved before."""

import numpy as np
import pytest

from grafu.editor.rooms import room_on
from grafu.geometry.box import Box

FRONT = Box(np.array([0.0, 0.0, 0.0]), np.array([0.6, 0.02, 0.4]))


def handle(x: float, z: float, wide: float = 0.1) -> Box:
    return Box(np.array([x, -0.03, z]), np.array([x + wide, 0.0, z + 0.02]))


def flat(room) -> list[float]:
    return [*room[0], *room[1]]


def test_the_room_ends_at_the_borders_and_is_where_it_is_whatever_was_moved():
    assert flat(room_on([FRONT], [handle(0.2, 0.1)], is_upright=True)) == pytest.approx([-0.2, 0.3, -0.1, 0.28])
    moved = room_on([FRONT], [handle(0.25, 0.08)], is_upright=True, offset=(0.05, -0.02))
    assert flat(moved) == pytest.approx([-0.2, 0.3, -0.1, 0.28])


def test_two_handles_are_moved_as_far_as_the_first_that_meets_a_border():
    both = [handle(0.1, 0.1), handle(0.4, 0.2)]
    assert flat(room_on([FRONT], both, is_upright=True)) == pytest.approx([-0.1, 0.1, -0.1, 0.18])


def test_a_handle_as_long_as_its_front_is_moved_across_it_alone():
    assert flat(room_on([FRONT], [handle(-0.1, 0.1, wide=0.8)], is_upright=True)) == pytest.approx([0, 0, -0.1, 0.28])


def test_on_a_front_that_lies_each_way_is_its_longest_side():
    assert flat(room_on([FRONT], [handle(0.2, 0.1)], is_upright=False, offset=(0.1, 0.0))) == pytest.approx(
        [-0.5, 0.7, -0.6, 0.6]
    )
