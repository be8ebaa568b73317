"""Boards let into what they end at: grown within it, everything else as it was."""

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.geometry.touching import touching_pairs
from grafu.synth.families.table import draw_made
from grafu.synth.noise.housing import DEEPEST, HOUSED, draw_housing, with_housed_boards
from grafu.synth.pieces.riding import busy_in


def made(index: int) -> Asset:
    return draw_made(np.random.default_rng([3, index]))[1]


def overlaps(asset: Asset) -> int:
    boxes = [part.box for part in asset.parts]
    return sum(bool((a.axis_gaps(b) < -1e-6).all()) for k, a in enumerate(boxes) for b in boxes[k + 1 :])


@pytest.mark.parametrize("index", range(6))
def test_only_still_boards_grow_and_only_into_what_is_there(index: int) -> None:
    tidy = made(index)
    noisy, busy = with_housed_boards(tidy, 0.5), busy_in(tidy)
    whole = [(p.box.low, p.box.high) for p in tidy.parts]
    for before, after in zip(tidy.parts, noisy.parts, strict=True):
        grown = np.maximum(before.box.low - after.box.low, after.box.high - before.box.high)
        assert (grown >= -1e-9).all()
        assert grown.max() <= 0.5 * DEEPEST + 1e-9
        if before.id in busy or before.carried_by:
            assert after is before
        for axis in np.flatnonzero(grown > 1e-9):
            reached = (
                after.box.low[axis] >= min(low[axis] for low, _ in whole) - 1e-9
                and after.box.high[axis] <= max(high[axis] for _, high in whole) + 1e-9
            )
            assert reached
    assert noisy.joints == tidy.joints


def test_furniture_of_exact_boards_overlaps_afterwards() -> None:
    pieces = [made(index) for index in range(6)]
    before, after = (sum(map(overlaps, found)) for found in (pieces, [with_housed_boards(p, 0.5) for p in pieces]))
    assert after > 1.5 * before


def test_what_touched_still_touches() -> None:
    tidy = made(1)
    meshes = [part.mesh for part in tidy.parts]
    pairs = [(i, j) for i in range(len(meshes)) for j in range(i)]
    noisy = [part.mesh for part in with_housed_boards(tidy, 1.0).parts]
    assert set(touching_pairs(meshes, pairs, 1e-4)) <= set(touching_pairs(noisy, pairs, 1e-4))


def test_it_is_drawn_for_a_fraction_of_models() -> None:
    drawn = [draw_housing(np.random.default_rng(k)) for k in range(400)]
    assert np.mean([ratio > 0 for ratio in drawn]) == pytest.approx(HOUSED, abs=0.07)
    assert max(drawn) <= 1.0
