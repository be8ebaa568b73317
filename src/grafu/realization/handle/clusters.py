"""Cells that lie together on a relief, and their extents. It knows no fingers."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

import numpy as np
from jaxtyping import Int

from grafu.geometry.arrays import Indices
from grafu.realization.handle.relief import Relief

CellRows = Int[np.ndarray, "k 2"]

_REACH = 2  # cells across which two count as together


@final
@dataclass(frozen=True, eq=False)
class Cluster:
    """Cells that lie together: their indices, and the row numbers that they had among those asked for."""

    cells: CellRows
    rows: Indices

    def extent(self, relief: Relief, axis: int) -> float:
        """Returns the metres that the cells span along u (0) or v (1)."""
        return relief.cell * (float(np.ptp(self.cells[:, axis])) + 1.0)

    def longest_run(self, relief: Relief, axis: int) -> float:
        """Returns the metres of the longest gapless run of cells along u (0) or v (1), steps aside allowed."""
        at = np.unique(self.cells[:, axis])
        runs = np.split(at, np.flatnonzero(np.diff(at) > _REACH) + 1)
        return relief.cell * max((float(run[-1] - run[0]) + 1.0 for run in runs), default=0.0)


def clusters_of(cells: CellRows) -> list[Cluster]:
    """Returns the groups of cells that lie within two cells of one another, largest first; cells may repeat."""
    numbers: dict[tuple[int, int], list[int]] = {}
    for row, (i, j) in enumerate(cells.tolist()):
        numbers.setdefault((i, j), []).append(row)
    left = set(numbers)
    groups: list[list[tuple[int, int]]] = []
    while left:
        found = [left.pop()]
        for i, j in found:
            near = [(a, b) for a in range(i - _REACH, i + _REACH + 1) for b in range(j - _REACH, j + _REACH + 1)]
            found.extend(cell for cell in near if cell in left)
            left.difference_update(near)
        groups.append(found)
    return [_cluster(cells, numbers, group) for group in sorted(groups, key=len, reverse=True)]


def _cluster(cells: CellRows, numbers: dict[tuple[int, int], list[int]], group: Sequence[tuple[int, int]]) -> Cluster:
    rows = np.array(sorted(row for cell in group for row in numbers[cell]), dtype=np.int64)
    return Cluster(cells[rows], rows)
