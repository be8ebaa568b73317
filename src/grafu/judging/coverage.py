"""The paper's coverage test, by rays: how much of what furniture covers of the floor is covered at its upper end.

It projects all faces to the ground plane and compares the area that is covered near the greatest height with the area
that is covered at all. A mirror or a back that stands above a top hides it from this test, as in the paper; it has no
exceptions, and decides nothing of what is built.
"""

from collections.abc import Sequence
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster


@final
@dataclass(frozen=True, slots=True)
class CoverageTestConfig:
    """The numbers of the coverage test.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    cells: int = 160
    """Rays along the longer side of the plan."""
    band: float = 0.01
    """What ends at most this far below the greatest height is near the top (fraction of the height)."""
    covered: float = 0.6
    """From this ratio on there is a top (the paper's alpha, which it does not state; its code takes this one)."""

    def __post_init__(self) -> None:
        require_positive(self, "cells")
        require_ratios(self, "band", "covered")


def coverage_ratio(meshes: Sequence[TriangleMesh], config: CoverageTestConfig = CoverageTestConfig()) -> float:
    """Returns area near the top over area at all, 0 to 1; 0 where nothing has a face.

    What is thinner than a cell counts only where a ray meets it.
    """
    solid = [mesh for mesh in meshes if len(mesh.faces)]
    if not solid:
        return 0.0
    box = Box.enclosing(mesh.box for mesh in solid)
    low, high = box.low, box.high
    cell = float((high - low)[:2].max()) / config.cells
    if cell <= 0:
        return 0.0
    x, y = (np.arange(low[k] + cell / 2, high[k], cell) for k in (0, 1))
    plan = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    if not len(plan):
        return 0.0
    starts = np.column_stack([plan, np.full(len(plan), high[2] + float((high - low).max()))])
    found = starts[:, 2] - RayCaster(merge_meshes(solid)).along(starts, np.array([0.0, 0.0, -1.0]))
    everything = np.isfinite(found)
    near_top = found >= high[2] - config.band * float(high[2] - low[2])
    return float((near_top & everything).sum() / everything.sum()) if everything.any() else 0.0
