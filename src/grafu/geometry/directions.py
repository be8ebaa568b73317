"""Directions spread evenly around a point."""

from functools import lru_cache

import numpy as np

from grafu.geometry.arrays import Points, frozen_array


@lru_cache(maxsize=8)
def directions_around(count: int) -> Points:
    """Returns unit vectors spread evenly over all directions, from above down (a golden-angle spiral)."""
    turn = np.arange(count) * np.pi * (3.0 - np.sqrt(5.0))
    height = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    ring = np.sqrt(1.0 - height**2)
    return np.asarray(frozen_array(np.column_stack([ring * np.cos(turn), ring * np.sin(turn), height])))
