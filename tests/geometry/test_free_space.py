"""Maximal empty boxes against brute force on grids, and grids of cells as boxes."""

from itertools import combinations, product

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from grafu.geometry.arrays import vec3
from grafu.geometry.free_space import cell_boxes, cells_met, maximal_empty_boxes, points_on, without

SIDE = 4
NOTHING = vec3(0.0, 0.0, 0.0)
CONTAINER = np.array([[0.0, 0.0, 0.0], [SIDE, SIDE, SIDE]])

spans = st.tuples(st.integers(0, SIDE), st.integers(0, SIDE)).map(sorted)
boxes = st.lists(st.tuples(spans, spans, spans), max_size=6).map(
    lambda found: np.array(found, dtype=np.float64).reshape(-1, 3, 2).transpose(0, 2, 1)
)


def brute_force(occupied: np.ndarray, least: np.ndarray) -> set[tuple]:
    """All boxes of whole cells that are empty and in no larger empty one."""
    grid = np.zeros((SIDE, SIDE, SIDE), dtype=bool)
    for low, high in occupied.astype(int):
        grid[tuple(slice(a, b) for a, b in zip(low, high, strict=True))] = True
    ranges = list(combinations(range(SIDE + 1), 2))
    empty = [box for box in product(ranges, repeat=3) if not grid[tuple(slice(*r) for r in box)].any()]
    bounds = np.array(empty).reshape(-1, 3, 2)
    lows, highs = bounds[:, None, :, 0], bounds[:, None, :, 1]
    holds = ((bounds[None, :, :, 0] <= lows) & (bounds[None, :, :, 1] >= highs)).all(axis=2)  # [inner, outer]
    top = [box for box, count in zip(empty, holds.sum(axis=1), strict=True) if count == 1]  # each holds itself
    return {box for box in top if all(b - a >= s for (a, b), s in zip(box, least, strict=True))}


def as_ranges(found: np.ndarray) -> set[tuple]:
    return {tuple(zip(low, high, strict=True)) for low, high in found}


@given(boxes, st.tuples(*[st.integers(0, 2)] * 3))
def test_all_maximal_empty_boxes_are_found_and_no_others(occupied, least) -> None:
    found = maximal_empty_boxes(CONTAINER, occupied, np.array(least, dtype=np.float64))

    assert as_ranges(found) == brute_force(occupied, np.array(least))
    assert len(found) == len(as_ranges(found))


@given(boxes, boxes)
def test_taking_one_more_is_as_if_it_had_been_occupied_before(occupied, more) -> None:
    found = maximal_empty_boxes(CONTAINER, occupied, NOTHING)
    for box in more:
        found = without(found, box, NOTHING)

    assert as_ranges(found) == as_ranges(maximal_empty_boxes(CONTAINER, np.concatenate([occupied, more]), NOTHING))


def test_a_shelf_leaves_the_two_spaces_above_and_below_it() -> None:
    shelf = np.array([[[0.0, 0.0, 0.9], [1.0, 0.5, 1.0]]])
    cabinet = np.array([[0.0, 0.0, 0.0], [1.0, 0.5, 2.0]])

    found = maximal_empty_boxes(cabinet, shelf, NOTHING)

    assert sorted((low[2], high[2]) for low, high in found) == [(0.0, 0.9), (1.0, 2.0)]


def test_a_full_or_too_small_container_has_no_empty_box() -> None:
    assert len(maximal_empty_boxes(CONTAINER, CONTAINER[None], NOTHING)) == 0
    assert len(maximal_empty_boxes(CONTAINER, np.zeros((0, 2, 3)), vec3(5.0, 0.0, 0.0))) == 0


@given(st.lists(st.booleans(), min_size=60, max_size=60))
def test_cells_as_boxes_are_the_same_cells_each_once(values) -> None:
    cells = np.array(values).reshape(3, 4, 5)

    count = np.zeros(cells.shape, dtype=int)
    for low, high in cell_boxes(cells):
        count[tuple(slice(a, b) for a, b in zip(low, high, strict=True))] += 1

    assert np.array_equal(count, cells.astype(int))


def test_a_block_of_cells_is_one_box() -> None:
    cells = np.zeros((5, 6, 7), dtype=bool)
    cells[1:4, 2:5, 3:6] = True

    assert cell_boxes(cells).tolist() == [[[1, 2, 3], [4, 5, 6]]]
    assert len(cell_boxes(np.zeros((2, 2, 2), dtype=bool))) == 0


@given(
    st.lists(st.floats(-1.0, 1.0).map(lambda x: round(x, 3)), min_size=9, max_size=9),
    st.lists(st.floats(0.0, 1.0), min_size=2, max_size=2),
)
@example([0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.5, 0.0], [0.0, 0.5])  # its corners lie on one line
@example([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.5, 0.01, 0.0], [0.1, 0.9])  # and nearly so
@settings(max_examples=300)
def test_no_point_of_a_triangle_is_far_from_those_on_it(corners, place) -> None:
    triangle = np.array(corners).reshape(1, 3, 3)
    u, v = sorted(place)
    point = u * triangle[0, 0] + (v - u) * triangle[0, 1] + (1 - v) * triangle[0, 2]

    found = points_on(triangle, 0.1)

    assert np.linalg.norm(found - point, axis=1).min() <= 0.12 + 1e-9
    assert (found >= triangle[0].min(axis=0) - 1e-9).all()
    assert (found <= triangle[0].max(axis=0) + 1e-9).all()


def test_cells_hold_the_points_that_lie_in_the_grid() -> None:
    points = np.array([[0.05, 0.15, 0.25], [9.0, 0.0, 0.0], [-0.01, 0.0, 0.0]])

    grid = cells_met(points, NOTHING, 0.1, (3, 3, 3))

    assert np.argwhere(grid).tolist() == [[0, 1, 2]]


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_box_without_extent_takes_nothing(axis: int) -> None:
    flat = CONTAINER.copy()
    flat[:, axis] = 2.0

    assert as_ranges(without(CONTAINER[None], flat, NOTHING)) == as_ranges(CONTAINER[None])
