"""A mean and its 95 % confidence interval: a percentile bootstrap over objects. Tables are written elsewhere."""

from collections.abc import Sequence
from typing import final

import numpy as np
from scipy import stats

from grafu.dataclass import dataclass

RESAMPLES = 10_000
SEED = 20_250_601
LEVEL = 0.95
_BLOCK = 2_000_000  # draws at once: a few hundred models never fill more than some tens of megabytes


@final
@dataclass(frozen=True, slots=True)
class Figure:
    """A number with the ends of its confidence interval, and how many objects it rests on."""

    value: float
    low: float
    high: float
    count: int


def mean_of(values: Sequence[float]) -> Figure | None:
    """Returns the mean over objects; None where there is none."""
    return ratio_of(values, [1.0] * len(values))


def ratio_of(sums: Sequence[float], counts: Sequence[float]) -> Figure | None:
    """Returns the sum of all sums over the sum of all counts (a mean over parts), objects being what is drawn anew.

    None where all counts are 0.

    Raises:
        ValueError: if the two are not as long.
    """
    if len(sums) != len(counts):
        raise ValueError(f"`counts` must be as many as `sums`: got {len(counts)} and {len(sums)}")
    known = [(s, c) for s, c in zip(sums, counts, strict=True) if c > 0]
    if not known:
        return None
    array = np.array(known, dtype=np.float64)
    value = float(array[:, 0].sum() / array[:, 1].sum())
    low, high = _interval(array) if len(known) > 1 else (value, value)
    return Figure(value, low, high, len(known))


def difference_of(later: Sequence[float], earlier: Sequence[float]) -> Figure | None:
    """Returns the mean of paired differences, object by object.

    Raises:
        ValueError: if the two are not as long.
    """
    return mean_of([a - b for a, b in zip(later, earlier, strict=True)])


def _interval(array: np.ndarray) -> tuple[float, float]:
    """Returns the ends of the interval of the ratio; the resamples are the same in each run."""
    found = stats.bootstrap(
        (array[:, 0], array[:, 1]),
        lambda sums, counts, axis: sums.sum(axis=axis) / counts.sum(axis=axis),
        paired=True,
        vectorized=True,
        n_resamples=RESAMPLES,
        batch=max(1, _BLOCK // len(array)),
        confidence_level=LEVEL,
        method="percentile",
        random_state=np.random.default_rng(SEED),
    ).confidence_interval
    return float(found.low), float(found.high)
