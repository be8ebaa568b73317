"""Boards that frame an infill, and thin fields on a panel, are one leaf; panelling and doors in face frames are not."""

from dataclasses import replace

import pytest

from grafu.asset.framed_leaves import with_framed_leaves
from grafu.asset.labels import label_of
from grafu.asset.part import Part, PartSource
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel
from small_scenes import box


def _part(name: str, low, high) -> Part:
    return replace(box(name, low, high), label=label_of(name), source=PartSource(name))


def _frame(depth: float = 0.02) -> list[Part]:
    return [
        _part("stile_left", (0.0, -depth, 0.0), (0.08, 0.0, 0.8)),
        _part("stile_right", (0.42, -depth, 0.0), (0.5, 0.0, 0.8)),
        _part("rail_top", (0.08, -depth, 0.7), (0.42, 0.0, 0.8)),
        _part("rail_bottom", (0.08, -depth, 0.0), (0.42, 0.0, 0.1)),
    ]


PANEL = _part("center_panel", (0.07, -0.014, 0.09), (0.43, -0.006, 0.71))
SLAB = _part("slab", (0.08, -0.02, 0.1), (0.42, 0.0, 0.7))
HANDLE = _part("handle", (0.04, -0.05, 0.35), (0.05, -0.02, 0.45))
CASE = [
    _part("left_board", (0.0, 0.001, 0.0), (0.02, 0.4, 0.8)),
    _part("right_board", (0.48, 0.001, 0.0), (0.5, 0.4, 0.8)),
    _part("rear_board", (0.02, 0.39, 0.02), (0.48, 0.4, 0.78)),
    _part("upper_board", (0.02, 0.001, 0.78), (0.48, 0.4, 0.8)),
    _part("lower_board", (0.02, 0.001, 0.0), (0.48, 0.4, 0.02)),
]


def _joined(*parts: Part) -> dict[str, Part]:
    made = [*parts, *CASE]
    kept, _ = with_framed_leaves(tuple(made), Box.enclosing(part.box for part in made))
    assert {board.id for board in CASE} <= {part.id for part in kept}
    return {part.id: part for part in kept if part.id not in {board.id for board in CASE}}


def test_a_frame_with_a_panel_and_a_handle_is_a_leaf_and_the_case_behind_stays() -> None:
    kept = _joined(*_frame(), PANEL, HANDLE)

    assert {*kept} == {"center_panel", "handle"}
    assert kept["center_panel"].label is PartLabel.UNKNOWN
    assert kept["center_panel"].box.size.tolist() == pytest.approx([0.5, 0.02, 0.8])


def test_a_frame_of_which_one_board_is_named_as_a_door_is_a_door() -> None:
    stile, *others = _frame()
    named = replace(stile, label=PartLabel.DOOR, source=PartSource("door_stile"))

    assert _joined(named, *others, PANEL)["center_panel"].label is PartLabel.DOOR


def test_panelling_without_a_handle_stays() -> None:
    assert {*_joined(*_frame(), PANEL)} == {*(part.id for part in _frame()), "center_panel"}


def test_a_door_in_a_face_frame_stays_though_there_is_no_seam() -> None:
    assert "slab" in _joined(*_frame(), SLAB, HANDLE)
    assert len(_joined(*_frame(), SLAB, HANDLE)) == 6


def test_bands_around_a_panel_as_thick_as_they_are_of_it() -> None:
    bands = [
        _part("band_a", (0.078, -0.02, 0.1), (0.08, 0.0, 0.7)),
        _part("band_b", (0.42, -0.02, 0.1), (0.422, 0.0, 0.7)),
        _part("band_c", (0.078, -0.02, 0.098), (0.422, 0.0, 0.1)),
        _part("band_d", (0.078, -0.02, 0.7), (0.422, 0.0, 0.702)),
    ]

    assert {*_joined(SLAB, *bands)} == {"slab"}


@pytest.mark.parametrize(
    ("low", "high", "is_joined"),
    [
        ((0.14, -0.026, 0.16), (0.36, -0.02, 0.64), True),
        ((0.14, -0.04, 0.16), (0.36, -0.02, 0.64), False),
        ((0.09, -0.026, 0.16), (0.31, -0.02, 0.64), False),
        ((0.22, -0.026, 0.36), (0.28, -0.02, 0.44), False),
    ],
    ids=["a field", "as thick as a door", "beside the middle", "a badge"],
)
def test_a_thin_field_in_the_middle_of_a_panel_is_of_it(low, high, is_joined: bool) -> None:
    assert ("infill" not in _joined(SLAB, _part("infill", low, high))) is is_joined


@pytest.mark.parametrize(("depth", "is_leaf"), [(0.03, True), (0.1, False)])
def test_the_boards_of_a_shallow_case_on_edge_around_its_door_are_no_frame_of_it(depth: float, is_leaf: bool) -> None:
    """A medicine cabinet is hardly deeper than a stile is wide; bands may be a little thicker than the panel."""
    door = replace(_part("door", (0.0, -0.02, 0.0), (0.6, 0.0, 0.7)))
    boards = [
        _part("side_a", (-0.016, -0.02, 0.0), (0.0, depth - 0.02, 0.7)),
        _part("side_b", (0.6, -0.02, 0.0), (0.616, depth - 0.02, 0.7)),
        _part("board_c", (0.0, -0.02, -0.016), (0.6, depth - 0.02, 0.0)),
        _part("board_d", (0.0, -0.02, 0.7), (0.6, depth - 0.02, 0.716)),
    ]
    made = (door, *boards)
    kept, _ = with_framed_leaves(made, Box.enclosing(part.box for part in made))

    assert (len(kept) == 1) is is_leaf


def test_folded_edges_of_a_sheet_frame_it() -> None:
    skin = _part("skin", (0.0, -0.02, 0.0), (0.5, -0.019, 0.3))
    edges = [
        _part("edge_a", (-0.001, -0.02, 0.0), (0.0, 0.0, 0.3)),
        _part("edge_b", (0.5, -0.02, 0.0), (0.501, 0.0, 0.3)),
        _part("edge_c", (0.0, -0.02, -0.001), (0.5, 0.0, 0.0)),
        _part("edge_d", (0.0, -0.02, 0.3), (0.5, 0.0, 0.301)),
    ]

    assert {*_joined(skin, *edges)} == {"skin"}
