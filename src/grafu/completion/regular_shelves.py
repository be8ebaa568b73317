"""Shelves that are missing from a regular row: those that are left stand at whole multiples of one distance.

What is above and below the row belongs to it: in a bookcase whose shelves divide it evenly, the gap where two are
missing is three times as high as the others. It asks the boxes alone, and no network.
"""

from collections.abc import Iterator, Sequence
from typing import final

import numpy as np

from grafu.completion.decode_config import RegularConfig
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel

_UP = 2


@final
@dataclass(frozen=True)
class MissingShelf:
    """The box of a shelf that a regular row lacks, and in 0..1 how regular the row is (1: exactly)."""

    box: Box
    score: float


def missing_shelves(graph: FunctionalGraph, config: RegularConfig) -> tuple[MissingShelf, ...]:
    """Returns the shelves that regular rows of at least two shelves lack."""
    extent = float(graph.box.size.max())
    shelves = [node for node in graph.labelled(PartLabel.SHELF) if _is_level_board(node.box, config.thin)]
    found: list[MissingShelf] = []
    for row in _rows(shelves, config.aligned * extent):
        if len(row) >= 2:
            found += _missing_in(row, _ends(row, graph.nodes, config, extent), config, extent)
    return tuple(shelf for shelf in found if not _is_taken(shelf.box, graph.nodes, config, extent))


def _is_taken(place: Box, nodes: Sequence[PartNode], config: RegularConfig, extent: float) -> bool:
    """Whether a flat part of any label lies about there."""
    near = (n.box for n in nodes if abs(float(n.box.center[_UP] - place.center[_UP])) < config.least * extent)
    return any(_covers(box, place, config) for box in near)


def _is_level_board(box: Box, thin: float) -> bool:
    return bool(box.size[_UP] < thin * min(box.size[:_UP]))


def _rows(shelves: Sequence[PartNode], aligned: float) -> list[list[PartNode]]:
    """Returns the shelves right above each other, from below, whose outlines agree within `aligned` metres."""
    rows: list[list[PartNode]] = []
    for shelf in sorted(shelves, key=lambda node: float(node.box.low[_UP])):
        home = next((row for row in rows if _apart(row[-1].box, shelf.box) <= aligned), None)
        if home is None:
            rows.append([shelf])
        else:
            home.append(shelf)
    return rows


def _apart(a: Box, b: Box) -> float:
    return float(max(np.abs(a.low - b.low)[:_UP].max(), np.abs(a.high - b.high)[:_UP].max()))


def _ends(
    row: Sequence[PartNode], nodes: Sequence[PartNode], config: RegularConfig, extent: float
) -> tuple[float | None, float | None]:
    """Returns the heights at which boards close a row below and above; None where none does."""
    first, last, slack = row[0].box, row[-1].box, config.slack * extent
    boards = [n.box for n in nodes if n not in row and not n.label.is_movable and _covers(n.box, first, config)]
    below = [float(box.high[_UP]) for box in boards if box.high[_UP] <= first.low[_UP] + slack]
    above = [float(box.low[_UP]) for box in boards if box.low[_UP] >= last.high[_UP] - slack]
    return max(below, default=None), min(above, default=None)


def _covers(board: Box, shelf: Box, config: RegularConfig) -> bool:
    """Whether a board lies over, or under, most of a shelf."""
    shared = np.minimum(board.high, shelf.high)[:_UP] - np.maximum(board.low, shelf.low)[:_UP]
    flat = board.size[_UP] <= config.flat * min(board.size[:_UP])
    return bool(flat and (shared > 0).all() and shared.prod() >= config.covers * shelf.size[:_UP].prod())


def _missing_in(
    row: Sequence[PartNode], ends: tuple[float | None, float | None], config: RegularConfig, extent: float
) -> list[MissingShelf]:
    """Returns the shelves that a row lacks; where an end fits no pattern, and enough shelves are left, without it."""
    below, above = ends
    tries = [(below, above, config.pair if len(row) == 2 else config.several)]
    if len(row) > 2:
        tries += [(below, None, config.several), (None, above, config.several)]
    for low, high, tolerance in tries:
        found = list(_between(row, low, high, tolerance, config, extent))
        if found:
            return found
    return []


def _between(
    row: Sequence[PartNode],
    below: float | None,
    above: float | None,
    tolerance: float,
    config: RegularConfig,
    extent: float,
) -> Iterator[MissingShelf]:
    """Yields the shelves that a row lacks between two heights, if all its gaps are multiples of one pitch.

    At least half of the gaps must be the pitch itself: one narrow gap among wide ones states no pitch. `tolerance` is
    how far a gap may be from it (fraction of the pitch).
    """
    thick = float(np.median([node.box.size[_UP] for node in row]))
    tops = [*([] if below is None else [below]), *(float(node.box.high[_UP]) for node in row)]
    undersides = [*(float(node.box.low[_UP]) for node in row), *([] if above is None else [above])]
    if below is None:
        undersides = undersides[1:]
    sizes = np.array([high - low + thick for low, high in zip(tops, undersides, strict=False)])
    if not len(sizes) or sizes.min() <= thick + config.least * extent:
        return
    counts = np.maximum(np.round(sizes / sizes.min()), 1)
    pitch = float(sizes.sum() / counts.sum())
    off = float(np.abs(sizes / counts - pitch).max()) / pitch
    if off > tolerance or counts.max() > config.most + 1 or 2 * int((counts == 1).sum()) < len(counts):
        return
    pattern = row[0].box
    for low, size, count in zip(tops, sizes, counts, strict=False):
        for number in range(1, int(count)):
            center = np.array(pattern.center)
            center[_UP] = low - thick / 2 + number * size / count
            yield MissingShelf(Box.from_center(center, pattern.half), 1.0 - off)
