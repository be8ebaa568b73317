"""Doors and drawers with handles do not face up or down: they show which way is up where no name does."""

import pytest

from furniture_rooms import Boxes, cabinet, island, meshes_of, numbered, table
from grafu.asset.fronts_above import has_fronts_above
from grafu.asset.part import Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.vocabulary import PartLabel


def parts_of(boxes: Boxes) -> tuple[Part, ...]:
    return tuple(
        Part(name, PartLabel.UNKNOWN, (Surface(mesh),), PartSource(name))
        for name, mesh in zip(boxes, meshes_of(boxes), strict=True)
    )


def lying(boxes: Boxes) -> Boxes:
    """The boxes as a program with Y up would see them: what stood along Z lies along it."""
    return {n: ((a[0], a[2], -b[1]), (b[0], b[2], -a[1])) for n, (a, b) in boxes.items()}


@pytest.mark.parametrize("boxes", [cabinet(""), cabinet("", turned=True), island()], ids=["ahead", "behind", "both"])
def test_fronts_that_would_face_up_or_down_show_it(boxes: Boxes) -> None:
    assert has_fronts_above(parts_of(numbered(boxes)), "+Y", "+Z")
    assert not has_fronts_above(parts_of(numbered(boxes)), "+Z", "+Y")
    assert has_fronts_above(parts_of(numbered(lying(boxes))), "+Z", "+Y")


CUPS = {f"cup {k}": ((x, -0.05, 0.75), (x + 0.08, 0.03, 0.85)) for k, x in enumerate((-0.4, 0.0, 0.4))}


@pytest.mark.parametrize("boxes", [table(), {**table(), **CUPS}], ids=["table", "with cups"])
def test_what_stands_on_a_table_shows_nothing(boxes: Boxes) -> None:
    assert not has_fronts_above(parts_of(boxes), "+Z", "+Y")


def test_one_front_shows_nothing() -> None:
    lid = {n: box for n, box in cabinet("").items() if "drawer" not in n and n != "handle-11"}
    assert not has_fronts_above(parts_of(lying(lid)), "+Z", "+Y")
