"""Doors right above each other: one that does not tell its side hangs on that of the others."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from grafu.completion.decode_config import ColumnConfig
from grafu.completion.rows import across_axis
from grafu.geometry.arrays import Scalars
from grafu.graph.functional_graph import PartNode
from grafu.graph.motion import face_to_border, signed_axis

_LEAST = 1e-9  # no probability is less, so that ratios are finite


def agreed_borders(
    doors: Sequence[PartNode], borders: Mapping[str, Scalars], config: ColumnConfig = ColumnConfig()
) -> dict[str, Scalars]:
    """Returns 1 for each of the four borders that an unsure door of a column may take, and 0 for the side it does not.

    `borders` are the probabilities of the four borders, each door seen for itself; doors look to -Y. The unsure door
    follows the surest one of its column; where that tells nothing either, the column hangs on the right.
    """
    found: dict[str, Scalars] = {}
    for column in _columns([door for door in doors if door.box.thin_axis != 2], config):
        sides = [_sides(door) for door in column]
        alone = np.array([borders[door.id][list(side)] for door, side in zip(column, sides, strict=True)])
        alone = np.maximum(alone, _LEAST) / np.maximum(alone, _LEAST).sum(axis=1, keepdims=True)
        surest = int(np.argmax(alone.max(axis=1)))
        is_tied = float(np.ptp(alone[surest])) <= config.tied
        other = 0 if is_tied else 1 - int(np.argmax(alone[surest]))
        for k, (door, side) in enumerate(zip(column, sides, strict=True)):
            if (k != surest or is_tied) and alone[k].max() < config.unsure:
                found[door.id] = np.ones(4)
                found[door.id][side[other]] = 0.0
    return found


def _sides(door: PartNode) -> tuple[int, int]:
    """Returns the borders at the low and the high side of an upright door."""
    axis, thin = across_axis(door), door.box.thin_axis
    return face_to_border(thin, signed_axis(axis, False)), face_to_border(thin, signed_axis(axis, True))


def _columns(doors: Sequence[PartNode], config: ColumnConfig) -> Iterator[list[PartNode]]:
    """Yields upright doors of one width and plane, each right above the one before it, in columns of two and more."""
    left = sorted(doors, key=lambda door: float(door.box.low[2]))
    while left:
        column = [left.pop(0)]
        while (upper := next((d for d in left if _is_right_above(column[-1], d, config)), None)) is not None:
            column.append(upper)
            left.remove(upper)
        if len(column) > 1:
            yield column


def _is_right_above(lower: PartNode, upper: PartNode, config: ColumnConfig) -> bool:
    thin, across = lower.box.thin_axis, across_axis(lower)
    if upper.box.thin_axis != thin:
        return False
    width = float(max(lower.box.size[across], upper.box.size[across]))
    aside = max(abs(float(end[0][across] - end[1][across])) for end in _ends(lower, upper))
    deep = abs(float(lower.box.center[thin] - upper.box.center[thin]))
    gap = float(upper.box.low[2] - lower.box.high[2])
    height = float(min(lower.box.size[2], upper.box.size[2]))
    return aside <= config.aligned * width and deep <= config.aligned * width and abs(gap) <= config.between * height


def _ends(lower: PartNode, upper: PartNode) -> tuple[tuple[np.ndarray, np.ndarray], ...]:
    return (lower.box.low, upper.box.low), (lower.box.high, upper.box.high)
