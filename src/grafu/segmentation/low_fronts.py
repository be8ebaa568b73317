"""Fronts lower or narrower than others: drawers of tables and of chests for plans, and what is in line with others.

It asks geometry alone.
"""

from collections.abc import Sequence

import numpy as np

from grafu.segmentation.candidates import candidates
from grafu.segmentation.config import DivisionConfig, SegmentationConfig
from grafu.segmentation.fronts import FrontShells, fronts_among
from grafu.segmentation.surroundings import Scale, overlaps
from grafu.segmentation.view import MaskOfShells, ShellsView


def with_low(
    view: ShellsView, may: MaskOfShells, fronts: tuple[FrontShells, ...], config: SegmentationConfig
) -> tuple[FrontShells, ...]:
    """Returns the fronts with the smaller ones beside them: low ones with a handle or a box, and what is in line.

    The former are the drawers of a table or of a chest for plans, the latter the top drawers and the narrow door of a
    row of kitchen units.
    """
    division = config.division
    taken = {shell for front in fronts for shell in front.all_shells}
    left = may.copy()  # what is a front already, or lies before one, is not looked at again
    left[[*taken]] = False
    for front in fronts:
        left &= overlaps(view, front.shells[0]) <= 0
    free = candidates(view, left, config.candidates, (division.lowest, division.flattest)).tolist()
    shorter, extent = view.size[:, :2].min(axis=1), Scale.of(view).extent
    low = {k for k in free if view.size[k, 0] > view.size[k, 1] and shorter[k] >= division.low * extent[k]}
    plates = [front.shells[0] for front in fronts]
    in_line = _in_line(view, free, plates, division)
    in_line |= _in_line(view, free, [*plates, *in_line], division)  # the corner of a column and a row of such
    found = fronts_among(view, np.array([k for k in free if k in low | in_line], dtype=np.int64), config)
    kept = (f for f in found if f.shells[0] in in_line or f.is_held or f.has_box)
    return (*fronts, *(front for front in kept if not taken & front.all_shells))


def _in_line(view: ShellsView, free: Sequence[int], plates: Sequence[int], config: DivisionConfig) -> set[int]:
    """Returns the plates that are as deep as a front of their object, and have two of its ends: in a row or column.

    One front alone may have a panel below it that is as wide.
    """
    return {k for k in free if _is_in_line(view, k, [p for p in plates if view.owner[p] == view.owner[k]], config)}


def _is_in_line(view: ShellsView, shell: int, plates: list[int], config: DivisionConfig) -> bool:
    size = view.size[shell, :2]
    if len(plates) < 2 or size.max() > config.slender * size.min():
        return False
    near = config.level * float(Scale.of(view).extent[shell])
    ends = np.maximum(np.abs(view.low[plates] - view.low[shell]), np.abs(view.high[plates] - view.high[shell])) <= near
    return bool((ends[:, 2] & (ends[:, 0] | ends[:, 1])).any())
