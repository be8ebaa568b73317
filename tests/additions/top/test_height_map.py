"""Heights above the floor: the same in one batch as in many, and in bounded memory."""

import tracemalloc

import numpy as np
import pytest

from grafu.additions.top import height_map
from grafu.additions.top.height_map import Grid, heights_of

GRID = Grid(np.zeros(2), 0.01, 160, 160)


def slanted_sheets(count: int, seed: int = 5) -> np.ndarray:
    """Returns triangles that each cover much of the grid, at random heights."""
    random = np.random.default_rng(seed)
    flat = np.array([[0.0, 0.0], [1.6, 0.0], [0.0, 1.6]]) + random.uniform(-0.3, 0.3, (count, 3, 2))
    return np.concatenate([flat, random.uniform(0.0, 1.0, (count, 3, 1))], axis=2)


def test_many_large_triangles_take_bounded_memory() -> None:
    tracemalloc.start()
    heights_of(slanted_sheets(3000), GRID)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()

    assert peak < 400e6


def test_batches_change_no_height(monkeypatch: pytest.MonkeyPatch) -> None:
    sheets = slanted_sheets(60)
    at_once = heights_of(sheets, GRID)

    monkeypatch.setattr(height_map, "CELLS_AT_ONCE", 30_000)

    np.testing.assert_array_equal(heights_of(sheets, GRID), at_once)


def test_the_highest_of_several_triangles_counts_in_each_cell() -> None:
    sheets = slanted_sheets(40)

    one_by_one = np.max([heights_of(sheets[i : i + 1], GRID) for i in range(len(sheets))], axis=0)

    np.testing.assert_array_equal(heights_of(sheets, GRID), one_by_one)
