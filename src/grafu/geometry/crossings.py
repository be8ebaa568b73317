"""Where parallel lines cross triangles, every crossing and exactly. It knows no rays that stop, and no materials.

The lines run along the third coordinate through the points of a grid in the first two.
"""

from dataclasses import dataclass
from typing import final

import numpy as np
from jaxtyping import Bool, Float, Int

from grafu.geometry.arrays import ArrayValue, freeze_arrays
from grafu.geometry.mesh import triangle_bounds


@final
@dataclass(frozen=True, eq=False, slots=True)
class Crossings(ArrayValue):
    """Each crossing's line, face, height (the third coordinate), and whether the face looks along the lines.

    Lines are numbered as the grid's points, the second coordinate running fastest. Crossings come line by line, from
    high to low.
    """

    line: Int[np.ndarray, " n"]
    face: Int[np.ndarray, " n"]
    height: Float[np.ndarray, " n"]
    looks_up: Bool[np.ndarray, " n"]

    def __post_init__(self) -> None:
        freeze_arrays(self)


def line_crossings(
    triangles: Float[np.ndarray, "m 3 3"], first: Float[np.ndarray, " a"], second: Float[np.ndarray, " b"]
) -> Crossings:
    """Returns where the lines through the grid of `first` x `second` (both rising) cross the triangles.

    Triangles that stand along the lines are never crossed.
    """
    low, high = triangle_bounds(triangles)
    columns = np.stack([np.searchsorted(first, low[:, 0]), np.searchsorted(first, high[:, 0], "right")])
    rows = np.stack([np.searchsorted(second, low[:, 1]), np.searchsorted(second, high[:, 1], "right")])
    wide, tall = columns[1] - columns[0], rows[1] - rows[0]
    count = wide * tall
    face = np.repeat(np.arange(len(triangles)), count)
    within = np.arange(len(face)) - np.repeat(np.cumsum(count) - count, count)
    i = columns[0, face] + within // np.maximum(tall[face], 1)
    j = rows[0, face] + within % np.maximum(tall[face], 1)
    a, b, c = (triangles[face, k] for k in range(3))
    point = np.stack([first[i], second[j]], axis=1)
    area = _twice_area(a[:, :2], b[:, :2], c[:, :2])
    weights = np.stack(
        [_twice_area(b[:, :2], c[:, :2], point), _twice_area(c[:, :2], a[:, :2], point), np.zeros(len(face))], axis=1
    )
    weights[:, 2] = area - weights[:, 0] - weights[:, 1]
    hit = (area != 0) & np.all(weights * np.sign(area)[:, None] >= 0, axis=1)
    share = weights[hit] / area[hit, None]
    height = share[:, 0] * a[hit, 2] + share[:, 1] * b[hit, 2] + share[:, 2] * c[hit, 2]
    line = i[hit] * len(second) + j[hit]
    order = np.lexsort((-height, line))
    return Crossings(line[order], face[hit][order], height[order], (area[hit] > 0)[order])


def _twice_area(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Returns twice the signed area of flat triangles, positive where they run counter-clockwise."""
    ab, ac = b - a, c - a
    return np.asarray(ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0])
