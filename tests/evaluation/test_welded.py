"""Welded furniture as a test set: its fronts are found again by the reader, under the names of the true parts."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.evaluation.dataset import ModelRef, category_of, find_models, given_model
from grafu.evaluation.welded import WELDED, Weld, weld_of, welded
from grafu.vocabulary import PartLabel
from predictions import cabinet

CABINET = cabinet()
MOVING = {joint.part for joint in CABINET.joints}
WELDS: tuple[Weld, ...] = ("fronts in one segment", "all in one mesh")


def boxes(asset: Asset) -> dict[str, np.ndarray]:
    return {part.id: np.concatenate([part.box.low, part.box.high]) for part in asset.parts}


@pytest.mark.parametrize("how", WELDS)
def test_fronts_that_were_welded_are_found_where_they_were(how: Weld) -> None:
    found, true = boxes(welded(CABINET, how)), boxes(CABINET)
    assert set(found) >= MOVING
    assert max(np.abs(found[name] - true[name]).max() for name in MOVING) < 0.05


@pytest.mark.parametrize("how", WELDS)
def test_nothing_of_the_truth_is_given_but_ids(how: Weld) -> None:
    given = welded(CABINET, how)
    assert given.joints == ()
    words = {CABINET.part(name).source.name for name in MOVING}
    assert not words & {part.source.name for part in given.parts}


def test_a_mesh_in_which_no_front_is_found_is_given_as_it_is() -> None:
    board = replace(CABINET, parts=CABINET.parts[:1], joints=())
    given = welded(board, "all in one mesh")
    assert [part.id for part in given.parts] == [WELDED]


def test_ids_stay_unique() -> None:
    given = welded(CABINET, "all in one mesh")
    assert len({part.id for part in given.parts}) == len(given.parts)


def test_boards_stay_parts_where_only_fronts_are_welded() -> None:
    given = welded(CABINET, "fronts in one segment")
    boards = {part.id for part in CABINET.parts if part.label in (PartLabel.SIDE_PANEL, PartLabel.BACK_PANEL)}
    assert boards
    assert boards <= {part.id for part in given.parts}


def test_pieces_are_asked_for_by_seed_and_number() -> None:
    refs = find_models("welded:7:3")
    assert [ref.id for ref in refs] == [f"welded_7_{k:07d}" for k in range(3)]
    assert [category_of(ref) for ref in refs] == [weld_of(k) for k in range(3)]


def test_a_method_is_given_the_model_itself_where_it_is_not_welded() -> None:
    assert given_model(ModelRef("a", "made", seed=1, number=2), CABINET) is CABINET
    assert given_model(ModelRef("a", WELDED, seed=1, number=1), CABINET) is not CABINET
