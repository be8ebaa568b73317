"""Axis-aligned boxes: what two have in common, and what holds several."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box

corners = st.tuples(*[st.integers(-8, 8)] * 3).map(lambda c: np.array(c, dtype=np.float64))
sizes = st.tuples(*[st.integers(1, 6)] * 3).map(lambda c: np.array(c, dtype=np.float64))
boxes = st.builds(lambda low, size: Box(low, low + size), corners, sizes)


def cubes(box: Box) -> set[tuple[int, ...]]:
    """Returns the unit cubes that fill a box with whole corners."""
    return {tuple(k) for k in (np.argwhere(np.ones(box.size.astype(int))) + box.low.astype(int)).tolist()}


@given(boxes, boxes)
def test_what_two_have_in_common_is_counted_in_unit_cubes(a: Box, b: Box) -> None:
    shared, joint = cubes(a) & cubes(b), cubes(a) | cubes(b)
    assert a.shared_volume(b) == pytest.approx(len(shared))
    assert a.intersection_over_union(b) == pytest.approx(len(shared) / len(joint))
    assert a.intersection_over_union(b) == pytest.approx(b.intersection_over_union(a))


def test_sheets_have_volume_once_they_are_grown() -> None:
    sheet = Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 0.0))

    assert sheet.intersection_over_union(sheet) == 0.0
    assert sheet.intersection_over_union(sheet, 0.01) == pytest.approx(1.0)


@given(st.lists(boxes, min_size=1, max_size=5))
def test_the_box_around_several_is_that_of_their_corners(some: list[Box]) -> None:
    assert Box.enclosing(iter(some)) == Box.around(np.vstack([box.corners() for box in some]))
