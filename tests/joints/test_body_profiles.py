"""The outer width of a drawer, column by column of rays: the median of those that met it."""

import numpy as np
import pytest

from grafu.joints.rail.body_region import _medians


@pytest.mark.parametrize("missing", [0.0, 0.3, 0.8, 1.0])
@pytest.mark.parametrize("cells", [1, 2, 7, 24])
def test_each_column_has_the_median_of_numpy_to_the_last_digit(missing: float, cells: int) -> None:
    rng = np.random.default_rng(cells)
    flanks = rng.normal(size=(2, 40, cells))
    flanks[rng.random(flanks.shape) < missing] = np.nan

    met = [[column[np.isfinite(column)] for column in flank] for flank in flanks]
    expected = [[np.median(column) if len(column) else np.nan for column in flank] for flank in met]

    assert np.array_equal(_medians(flanks), np.array(expected), equal_nan=True)
