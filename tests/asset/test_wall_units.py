"""What hangs on a wall is known by its name or by how high it is drawn, and by nothing else."""

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
