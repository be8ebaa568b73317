"""The judge of handles: which bodies have one, what a new one hits along its path, and what hits it."""

from dataclasses import replace
from math import pi

import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.judging.handles import handle_faults, with_handles
from grafu.judging.piece import JudgedBody, JudgedMotion, JudgedPart, JudgedPiece, Origin
from grafu.vocabulary import PartLabel

Point = tuple[float, float, float]
SKIN = 0.001


def part(name: str, low: Point, high: Point, label=PartLabel.MISC, origin: Origin = "input") -> JudgedPart:
    return JudgedPart(name, TriangleMesh.box_mesh(Box(vec3(*low), vec3(*high))), label, origin)


def door(origin: Origin = "added") -> JudgedBody:
    """A door of 0.5 m before the case, pinned at x = 0; its handle stands out 40 mm."""
    leaf = part("leaf", (0.0, -0.02, 0.0), (0.5, 0.0, 0.8), PartLabel.DOOR)
    grip = part("grip", (0.44, -0.06, 0.4), (0.46, -0.02, 0.5), PartLabel.HANDLE, origin)
    motion = JudgedMotion(True, Axis(vec3(0.0, -0.02, 0.0), vec3(0.0, 0.0, -1.0)), 0.0, pi / 2)
    return JudgedBody("door", (leaf, grip), motion)


def drawer(y: float = 0.0) -> JudgedBody:
    """A drawer behind the door that slides 0.4 m out towards -Y."""
    front = part("front", (0.1, y, 0.2), (0.43, y + 0.02, 0.6), PartLabel.DRAWER)
    motion = JudgedMotion(False, Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0)), 0.0, 0.4)
    return JudgedBody("drawer", (front,), motion)


CASE = (part("back", (0.0, 0.48, 0.0), (0.5, 0.5, 0.8)),)


def test_a_handle_in_free_air_has_no_fault() -> None:
    assert handle_faults(JudgedPiece(CASE, (door(),)), SKIN) == []


def test_what_a_handle_hits_along_its_path_is_named() -> None:
    wall = part("wall", (-0.1, -0.6, 0.3), (-0.01, -0.4, 0.6))
    assert handle_faults(JudgedPiece((*CASE, wall), (door(),)), SKIN) == [("grip", "meets", "wall")]


def test_handles_of_the_input_are_not_judged() -> None:
    wall = part("wall", (-0.1, -0.6, 0.3), (-0.01, -0.4, 0.6))
    assert handle_faults(JudgedPiece((*CASE, wall), (door("input"),)), SKIN) == []


def test_a_drawer_that_comes_out_through_a_closed_doors_handle_strikes_it() -> None:
    assert handle_faults(JudgedPiece(CASE, (door(), drawer())), SKIN) == []  # 10 mm beside it
    wide = replace(drawer(), parts=(part("front", (0.1, 0.0, 0.2), (0.49, 0.02, 0.6)),))
    assert handle_faults(JudgedPiece(CASE, (door(), wide)), SKIN) == [("grip", "is struck by", "drawer")]


def test_a_drawer_that_waits_for_the_door_does_not() -> None:
    wide = replace(drawer(), parts=(part("front", (0.1, 0.0, 0.2), (0.49, 0.02, 0.6)),), starts={"door": pi / 2})
    assert handle_faults(JudgedPiece(CASE, (door(), wide)), SKIN) == []


@pytest.mark.parametrize(("origin", "found"), [("input", True), ("added", True), ("hardware", False)])
def test_a_handle_is_a_part_that_is_no_hardware(origin: Origin, found: bool) -> None:
    assert with_handles(JudgedPiece(CASE, (door(origin), drawer()))) == {"door": found, "drawer": False}
