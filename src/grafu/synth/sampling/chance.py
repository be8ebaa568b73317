"""Draws from small tables, with a passed-in generator: a word by its weight, a length between two bounds.

A table is a mapping from what may be drawn to its weight; weights need not sum to 1.
"""

from collections.abc import Iterable, Mapping
from typing import TypeVar

import numpy as np

T = TypeVar("T")
Span = tuple[float, float]


def pick(rng: np.random.Generator, table: Mapping[T, float]) -> T:
    """Returns one key of the table, drawn by weight.

    Raises:
        ValueError: if no weight is above 0.
    """
    left = rng.random() * sum(table.values())
    for key, weight in table.items():
        left -= weight
        if left < 0:
            return key
    raise ValueError(f"`table` must hold a weight above 0: got {dict(table)}")


def between(rng: np.random.Generator, span: Span) -> float:
    """Returns a number drawn evenly from low to high."""
    return span[0] + (span[1] - span[0]) * float(rng.random())


def spread(rng: np.random.Generator, span: Span) -> float:
    """Returns a number from low to high, each doubling alike: as sizes spread that differ by factors."""
    return float(span[0] * (span[1] / span[0]) ** rng.random())


def chance(rng: np.random.Generator, probability: float) -> bool:
    """Returns true with this probability."""
    return bool(rng.random() < probability)


def count(rng: np.random.Generator, low: int, high: int) -> int:
    """Returns a whole number from low to high, both possible."""
    return int(rng.integers(low, high + 1))


def only(table: Mapping[T, float], allowed: Iterable[T]) -> dict[T, float]:
    """Returns the table's entries whose key is allowed; where none has weight, all allowed ones alike."""
    keys = tuple(allowed)
    kept = {key: table[key] for key in keys if table.get(key, 0.0) > 0}
    return kept or dict.fromkeys(keys, 1.0)


def weights(rng: np.random.Generator, number: int, spread: float = 0.0) -> tuple[float, ...]:
    """Returns fractions around 1, each drawn evenly within `spread` of it; none (that is: equal) where spread is 0."""
    return tuple(between(rng, (1.0 - spread, 1.0 + spread)) for _ in range(number)) if spread else ()
