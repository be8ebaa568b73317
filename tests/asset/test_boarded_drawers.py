"""The boards of a drawer, by their names, and the plates that they end at are one drawer, whatever these are called."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.boarded_drawers import with_boarded_drawers
from grafu.asset.labels import label_of
from grafu.asset.part import Part, PartSource
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel
from small_scenes import box

LOW = 0.1
FRAME = [
    ("stile_a", (0.02, -0.02, LOW), (0.08, 0.0, LOW + 0.2)),
    ("stile_b", (0.52, -0.02, LOW), (0.58, 0.0, LOW + 0.2)),
    ("rail_top", (0.08, -0.02, LOW + 0.15), (0.52, 0.0, LOW + 0.2)),
    ("rail_bottom", (0.08, -0.02, LOW), (0.52, 0.0, LOW + 0.05)),
    ("center_panel", (0.07, -0.015, LOW + 0.04), (0.53, -0.005, LOW + 0.16)),
]
SLAB = [("slab", (0.02, -0.02, LOW), (0.58, 0.0, LOW + 0.2)), ("field", (0.1, -0.025, 0.14), (0.5, -0.02, 0.26))]


def _part(name: str, low, high) -> Part:
    made = box(name, low, high)
    return replace(made, label=label_of(name), source=PartSource(name))


def _drawer(front, number: int = 0, rise: float = 0.0, back: bool = True) -> list[Part]:
    boards = [
        ("drawer_side_left", (0.05, 0.0, LOW + 0.02), (0.06, 0.4, LOW + 0.15)),
        ("drawer_side_right", (0.54, 0.0, LOW + 0.02), (0.55, 0.4, LOW + 0.15)),
        ("drawer_bottom", (0.06, 0.0, LOW + 0.02), (0.54, 0.39, LOW + 0.03)),
        *([("drawer_back", (0.06, 0.39, LOW + 0.02), (0.54, 0.4, LOW + 0.15))] if back else []),
    ]
    parts = []
    for name, low, high in [*front, *boards]:
        raised = [(x, y, z + rise) for x, y, z in (low, high)]
        parts.append(replace(_part(name, *raised), id=f"{name}_{number}"))
    return parts


CASE = [
    _part("left_board", (0.0, 0.0, 0.0), (0.018, 0.45, 0.6)),
    _part("right_board", (0.582, 0.0, 0.0), (0.6, 0.45, 0.6)),
    _part("rear_board", (0.0, 0.45, 0.0), (0.6, 0.46, 0.6)),
    _part("rail_below", (0.018, -0.02, 0.07), (0.582, 0.0, 0.095)),
]


def _joined(parts) -> dict[str, Part]:
    whole = Box.enclosing(part.box for part in parts)
    return {part.id: part for part in with_boarded_drawers(tuple(parts), whole)[0]}


@pytest.mark.parametrize(("front", "face"), [(SLAB, "slab_{}"), (FRAME, "rail_top_{}")], ids=["slab", "frame"])
def test_boards_and_what_they_end_at_are_a_drawer_each(front, face: str) -> None:
    parts = [*CASE, *_drawer(front), *_drawer(front, 1, 0.22)]
    kept = _joined(parts)

    drawers = [part for part in kept.values() if part.label is PartLabel.DRAWER]
    assert len(drawers) == 2
    assert {*kept} - {part.id for part in drawers} == {part.id for part in CASE}
    for drawer in drawers:
        assert len(drawer.surfaces) == len(front) + 4
        assert drawer.box.size.tolist() == pytest.approx([0.56, 0.42 + (0.005 if front is SLAB else 0.0), 0.2])


def _loose(name: str, thick: float = 0.01) -> Part:
    return _part(name, (0.06, 0.0, LOW + 0.02), (0.54, 0.39, LOW + 0.02 + thick))


@pytest.mark.parametrize("name", ["drawer_bottom", "fondo cassetto", "fond de tiroir", "trasera cajón", "Schubboden"])
def test_a_board_of_a_drawer_that_is_joined_to_nothing_is_no_drawer(name: str) -> None:
    boards = [_loose(name), _loose("drawer_back")]
    kept = _joined([*CASE, *boards])

    assert {kept[board.id].label for board in boards} == {PartLabel.UNKNOWN}


@pytest.mark.parametrize(
    "boards",
    [
        [_loose("drawer_bottom", 0.2), _loose("drawer_back", 0.2)],
        [_loose("drawer_bottom"), _loose("drawer_back"), _part("drawer", (0.06, -0.02, LOW), (0.54, 0.4, LOW + 0.2))],
    ],
    ids=["a body", "beside its drawer"],
)
def test_what_is_no_mere_board_or_has_its_drawer_keeps_its_name(boards: list[Part]) -> None:
    kept = _joined([*CASE, *boards])

    assert {kept[board.id].label for board in boards} == {PartLabel.DRAWER}


def test_the_back_of_the_piece_is_no_front() -> None:
    """The boards reach the rear board of the piece, and nothing closes them before."""
    low = _part("rear_board", (0.0, 0.45, 0.05), (0.6, 0.46, 0.35))
    case = [*(part for part in CASE if part.id != "rear_board"), low]
    longer = np.array([0.0, 0.05, 0.0])
    boards = [replace(p, surfaces=box("b", p.box.low, p.box.high + longer).surfaces) for p in _drawer([])]

    assert {*_joined([*case, *boards])} == {part.id for part in (*case, *boards)}


def test_boards_with_a_named_front_stay_for_what_joins_by_names() -> None:
    named = [("drawer_front", *SLAB[0][1:])]

    assert {*_joined([*CASE, *_drawer(named)])} == {part.id for part in (*CASE, *_drawer(named))}


def test_one_plate_before_two_boxes_is_the_front_of_neither() -> None:
    wide = _part("panel", (0.02, -0.02, LOW), (0.58, 0.0, 0.52))
    parts = [*CASE, wide, *_drawer([]), *_drawer([], 1, 0.22)]

    assert {*_joined(parts)} == {part.id for part in parts}


@pytest.mark.parametrize(("height", "is_front"), [(0.035, True), (0.025, False)])
def test_a_low_front_is_one_and_a_beam_as_thick_as_high_is_none(height: float, is_front: bool) -> None:
    """Drawers of tool chests are as low as 35 mm, with fronts of 18 mm."""
    slab = ("slab", (0.02, -0.018, LOW), (0.58, 0.0, LOW + height))
    boards = [
        ("drawer_side_left", (0.05, 0.0, LOW + 0.004), (0.06, 0.4, LOW + 0.02)),
        ("drawer_side_right", (0.54, 0.0, LOW + 0.004), (0.55, 0.4, LOW + 0.02)),
        ("drawer_bottom", (0.06, 0.0, LOW + 0.004), (0.54, 0.4, LOW + 0.01)),
    ]
    kept = _joined([*CASE, *(_part(*one) for one in (slab, *boards))])

    assert ("drawer_bottom" not in kept) is is_front
