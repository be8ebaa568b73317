"""A mean and its 95 % confidence interval, by drawing objects anew. It knows no tables."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

import numpy as np

RESAMPLES = 10_000
SEED = 20_250_601
_LEVEL = (2.5, 97.5)
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
    low, high = np.percentile(_resampled(array), _LEVEL)
    return Figure(value, float(low), float(high), len(known))


def difference_of(later: Sequence[float], earlier: Sequence[float]) -> Figure | None:
    """Returns the mean of paired differences, object by object.

    Raises:
        ValueError: if the two are not as long.
    """
    return mean_of([a - b for a, b in zip(later, earlier, strict=True)])


def _resampled(array: np.ndarray) -> np.ndarray:
    """Returns the ratio of each resample, always drawn the same way."""
    rng, n = np.random.default_rng(SEED), len(array)
    found, per_block = [], max(1, _BLOCK // n)
    for start in range(0, RESAMPLES, per_block):
        count = min(per_block, RESAMPLES - start)
        drawn = array[rng.integers(0, n, (count, n))].sum(axis=1)
        found.append(drawn[:, 0] / drawn[:, 1])
    return np.concatenate(found)
