"""How furniture is cut into parts: joined, in pieces, in planks, handles within doors."""

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.synth.noise.segmentation import (
    fresh_ids,
    in_pieces,
    in_planks,
    is_board,
    with_attached_joined,
    with_box_apart,
    with_edge_strip,
    with_front_alone,
    with_joined,
)
from grafu.vocabulary import PartLabel
from sketches import board, door, drawer, handle, sketch

ASSET = sketch(
    board("side_1", PartLabel.SIDE_PANEL, (0.0, 0.0, 0.0), (0.02, 0.5, 0.8)),
    door("door", (0.0, -0.02, 0.0), (0.6, -0.001, 0.4), "left"),
    handle("grip", "door", (0.5, -0.04, 0.2)),
    board("side_2", PartLabel.SIDE_PANEL, (0.58, 0.0, 0.0), (0.6, 0.5, 0.8)),
    drawer("drawer", (0.03, -0.02, 0.41), (0.57, 0.4, 0.6)),
)


def area(asset: Asset) -> float:
    return sum(part.mesh.area for part in asset.parts)


def test_joined_parts_stand_where_the_first_stood() -> None:
    joined = with_joined(ASSET, ("side_1", "side_2"), PartLabel.MISC, "case")

    assert [p.id for p in joined.parts] == ["case", "door", "grip", "drawer"]
    assert joined.part("case").label is PartLabel.MISC
    assert area(joined) == pytest.approx(area(ASSET))


@pytest.mark.parametrize("ids", [("side_1",), ("side_1", "door"), ("side_1", "grip")])
def test_only_several_still_parts_are_joined(ids: tuple[str, ...]) -> None:
    with pytest.raises(ValueError, match="two or more still parts"):
        with_joined(ASSET, ids, PartLabel.MISC, "case")


def test_a_handle_within_its_door_is_no_part_any_more() -> None:
    joined = with_attached_joined(ASSET, ("grip",))

    assert "grip" not in [p.id for p in joined.parts]
    assert joined.part("door").box.low[1] == pytest.approx(-0.04)
    assert joined.joints == ASSET.joints


def test_a_board_in_planks_fills_the_same_box() -> None:
    planks = in_planks(ASSET, "side_1", 4, 1)
    made = [p for p in planks.parts if p.id.startswith("side_1_piece")]

    assert len(made) == 4
    assert {p.label for p in made} == {PartLabel.SIDE_PANEL}
    assert sum(p.box.volume for p in made) == pytest.approx(ASSET.part("side_1").box.volume)


def test_an_edge_strip_is_a_part_of_its_own() -> None:
    cut = with_edge_strip(ASSET, "side_1", 0.02)
    rest, strip = [p for p in cut.parts if p.id.startswith("side_1_piece")]

    assert strip.label is PartLabel.MISC
    assert strip.box.size[1] == pytest.approx(0.02)
    assert rest.box.low[1] == pytest.approx(strip.box.high[1])


def test_surfaces_become_pieces() -> None:
    frame = with_joined(ASSET, ("side_1", "side_2"), PartLabel.FACE_FRAME, "frame")

    pieces = in_pieces(frame, "frame", PartLabel.BAR)

    assert [p.label for p in pieces.parts[:2]] == [PartLabel.BAR, PartLabel.BAR]
    assert len(pieces.parts) == len(ASSET.parts)


@pytest.mark.parametrize("part", ["door", "grip", "drawer"])
def test_what_moves_is_never_cut(part: str) -> None:
    assert in_planks(ASSET, part, 3, 2) == ASSET
    assert in_pieces(ASSET, part) == ASSET


def test_a_drawer_s_boards_ride_on_its_front() -> None:
    apart = with_box_apart(ASSET, "drawer")
    boards = [p for p in apart.parts if p.id.startswith("drawer_board")]

    assert apart.part("drawer").box.size[1] == pytest.approx(0.018)
    assert [len(p.surfaces) for p in boards] == [1, 2]  # the back stays with a flank: it does not reach the front
    assert {p.carried_by for p in boards} == {"drawer"}
    assert np.allclose(apart.box.size, ASSET.box.size)


def test_a_drawer_s_front_is_left_alone_where_it_was() -> None:
    alone = with_front_alone(ASSET, "drawer")
    front, before = alone.part("drawer"), ASSET.part("drawer")

    assert front.box.size[1] == pytest.approx(0.018)
    assert np.allclose(front.box.low[[0, 1]], before.box.low[[0, 1]])
    assert [p for p in alone.parts if p.id != "drawer"] == [p for p in ASSET.parts if p.id != "drawer"]
    assert with_front_alone(alone, "drawer") == alone


def test_a_door_has_no_box() -> None:
    assert with_box_apart(ASSET, "door") == ASSET
    assert with_front_alone(ASSET, "door") == ASSET


def test_fresh_ids_are_new() -> None:
    assert fresh_ids(ASSET, "side", 2) == ["side_3", "side_4"]
    assert fresh_ids(ASSET, "shelf", 1) == ["shelf_1"]


def test_boards_are_told_from_other_shapes() -> None:
    assert is_board(ASSET.part("side_1"))
    assert not is_board(ASSET.part("drawer"))
