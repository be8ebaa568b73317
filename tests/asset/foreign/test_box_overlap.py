"""What two boxes have in common."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.asset.foreign.box_overlap import intersection_over_union
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box

corners = st.tuples(*[st.integers(-8, 8)] * 3).map(lambda c: np.array(c, dtype=np.float64))
sizes = st.tuples(*[st.integers(1, 6)] * 3).map(lambda c: np.array(c, dtype=np.float64))
boxes = st.builds(lambda low, size: Box(low, low + size), corners, sizes)


@given(boxes, boxes)
def test_it_is_counted_in_unit_cubes(a: Box, b: Box) -> None:
    def cubes(box: Box) -> set[tuple[int, ...]]:
        return {tuple(k) for k in (np.argwhere(np.ones(box.size.astype(int))) + box.low.astype(int)).tolist()}

    shared, joint = cubes(a) & cubes(b), cubes(a) | cubes(b)
    assert intersection_over_union(a, b) == pytest.approx(len(shared) / len(joint))
    assert intersection_over_union(a, b) == pytest.approx(intersection_over_union(b, a))


def test_sheets_have_volume_once_they_are_grown() -> None:
    sheet = Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 0.0))

    assert intersection_over_union(sheet, sheet) == 0.0
    assert intersection_over_union(sheet, sheet, 0.01) == pytest.approx(1.0)
