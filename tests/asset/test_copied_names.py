"""Copies of a cabinet have the names of the first: each place has its own drawer, and one drawer is one wherever."""

import numpy as np
import pytest

from grafu.asset.drafts import PartDraft, parts_of_drafts
from grafu.asset.part import Part
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh

PIECES = {
    "front": ((0.0, 0.0, 0.0), (0.4, 0.02, 0.2)),
    "box": ((0.02, 0.02, 0.02), (0.38, 0.4, 0.15)),
    "handle": ((0.15, -0.03, 0.1), (0.25, 0.0, 0.11)),
}


def drafts(end: str = "", x: float = 0.0, pieces: tuple[str, ...] = tuple(PIECES)) -> list[PartDraft]:
    made = []
    for name in pieces:
        low, high = (np.array(corner) + np.array([x, 0.0, 0.0]) for corner in PIECES[name])
        surface = Surface(TriangleMesh.box_mesh(Box(low, high)))
        made.append(PartDraft(f"drawer_1_{name}{end}", (surface,)))
    return made


def drawers(found: tuple[Part, ...]) -> list[tuple[str, int]]:
    return [(part.id, len(part.surfaces)) for part in found if part.label.value == "drawer"]


@pytest.mark.parametrize("end", ["", ".001", "_2"])
def test_copies_that_lie_apart_are_drawers_of_their_own_with_their_own_handles(end: str) -> None:
    found = parts_of_drafts([*drafts(), *drafts(end, 1.0)])
    assert drawers(found) == [("drawer_1", 2), ("drawer_1_2", 2)]
    handles = [part for part in found if part.label.value == "handle"]
    assert [handle.carried_by for handle in handles] == ["drawer_1", "drawer_1_2"]


def test_pieces_of_one_drawer_are_one_though_two_of_its_pieces_have_one_name() -> None:
    two_sides = [*drafts(), *drafts(".001", 0.01, ("box",))]
    assert drawers(parts_of_drafts(two_sides)) == [("drawer_1", 3)]


def test_pieces_with_names_of_their_own_are_one_drawer_though_drawn_apart() -> None:
    exploded = [*drafts(pieces=("front",)), *drafts(x=1.0, pieces=("box",))]
    assert drawers(parts_of_drafts(exploded)) == [("drawer_1", 2)]
