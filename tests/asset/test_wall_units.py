"""What hangs on a wall is known by its name, by how high it is drawn, or because it would fall backwards."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.articulation.base import BaseKind
from grafu.asset.part import Asset, Frame
from grafu.asset.wall_units import hangs_on_wall
from grafu.pipeline.settings import Settings
from grafu.pipeline.standing import base_of
from grafu.vocabulary import PartLabel
from sketches import board, sketch


def cabinet(name: str, height: float = 0.7, hanging: float = 0.0, aside: float = 0.0, part: str = "side") -> Asset:
    low, high = (-0.3, -0.2, 0.0), (0.3, 0.2, height)
    made = sketch(board(f"{part}_1", PartLabel.UNKNOWN, low, high), board(f"{part}_2", PartLabel.UNKNOWN, low, high))
    T = np.eye(4)
    T[:3, 3] = (aside, 0.0, -hanging)
    parts = tuple(replace(p, source=replace(p.source, name=p.id)) for p in made.parts)
    return replace(made, name=name, parts=parts, frame=Frame(T, "+Z", "-Y", 1.0))


@pytest.mark.parametrize(
    "name",
    ["WallCabinet.001", "wall_cabinet_60", "IKEA wall-mounted", "Hängeschrank", "Wandschrank", "Kitchen Upper Cabinet"],
)
def test_a_name_says_so(name):
    assert "name" in hangs_on_wall(cabinet(name))
    assert base_of(cabinet(name), Settings()) is BaseKind.WALL
    assert base_of(cabinet(name), Settings(base=BaseKind.FREE)) is BaseKind.FREE


def test_names_of_most_parts_say_so_and_of_some_do_not():
    assert hangs_on_wall(cabinet("model", part="wall_cabinet"))
    mixed = replace(
        cabinet("model", part="wall_cabinet"), parts=(cabinet("m").parts[0], cabinet("m", part="wall_cabinet").parts[1])
    )
    assert not hangs_on_wall(mixed)


@pytest.mark.parametrize("name", ["cabinet", "base_cabinet", "upper", "wallnut_cabinet", "wall", "bed with wall"])
def test_other_names_say_nothing(name):
    assert hangs_on_wall(cabinet(name)) == ""
    assert base_of(cabinet(name), Settings()) is None


def test_what_is_tall_stands_whatever_it_is_called():
    assert hangs_on_wall(cabinet("wall unit", height=2.1)) == ""
    assert hangs_on_wall(cabinet("cabinet", height=2.1, hanging=1.4)) == ""


@pytest.mark.parametrize(
    ("hanging", "aside", "hangs"),
    [(1.4, 0.0, True), (0.9, 0.0, False), (2.5, 0.0, False), (1.4, 3.0, False), (-0.35, 0.0, False)],
)
def test_the_input_has_it_hanging_above_its_own_floor(hanging, aside, hangs):
    found = hangs_on_wall(cabinet("model", hanging=hanging, aside=aside))
    assert bool(found) == hangs
    assert not hangs or "1.40 m" in found


def ladder_shelf(posts: float, feet_behind: float | None = None, door: bool = False) -> Asset:
    """Shelves 0.3 m deep on two posts 30 mm deep, whose front is at `posts`, 1.8 m tall.

    `feet_behind` is how high above the floor two more posts end at the rear.
    """
    made = [
        board(f"shelf_{k}", PartLabel.SHELF, (-0.4, -0.15, 0.3 * k), (0.4, 0.15, 0.3 * k + 0.02)) for k in (1, 3, 5)
    ]
    rows = [(posts, 0.0)] if feet_behind is None else [(posts, 0.0), (0.12, feet_behind)]
    for row, (y, low) in enumerate(rows):
        for side, x in enumerate((-0.42, 0.4)):
            made.append(board(f"post_{row}_{side}", PartLabel.BAR, (x, y, low), (x + 0.02, y + 0.03, 1.8)))
    if door:
        made.append(board("door_1", PartLabel.DOOR, (-0.4, 0.13, 0.0), (0.4, 0.15, 0.4)))
    return sketch(*made)


@pytest.mark.parametrize("door", [False, True])
def test_what_would_fall_backwards_leans_on_the_wall_and_a_door_does_not_carry_it(door):
    shelf = ladder_shelf(-0.15, door=door)
    assert "leans on a wall" in hangs_on_wall(shelf)
    assert base_of(shelf, Settings()) is BaseKind.WALL


@pytest.mark.parametrize("feet_behind", [0.0, 0.05])
def test_what_has_feet_behind_stands_even_where_they_are_short(feet_behind):
    assert hangs_on_wall(ladder_shelf(-0.15, feet_behind)) == ""


def test_what_would_fall_forwards_or_stands_on_its_middle_does_not_lean_on_the_wall():
    assert hangs_on_wall(ladder_shelf(0.12)) == ""
    assert hangs_on_wall(ladder_shelf(-0.02)) == ""
