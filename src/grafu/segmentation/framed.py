"""Stiles, rails and panels of one framed front, found by how they fit together. It asks no names.

Two parallel bars of one length with two bars across between their ends are a frame. With panels in it, that touch it or
reach into it and are set back, they are one front; inset fronts leave a gap to their face frame.
"""

from collections.abc import Iterator
from typing import Final

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from grafu.segmentation.candidates import Scale
from grafu.segmentation.view import MaskOfShells, View

_BAR = 1.5  # times as long as wide
_DEEP = 2.0  # times its width: how thick a bar is at most
_THICK = 0.1  # of its object's largest side
_SAME = 0.004  # of it: how far ends of one frame differ
_GAP = 0.0007  # of it: how far a panel may lie from its frame
_GROOVE = 0.6  # of a bar's width: how far others reach into it
_FILLED = 0.5  # of a frame's inside: what its panels cover


def framed(view: View) -> list[tuple[int, ...]]:
    """Returns the shells of each framed front, a shell in one at most; frames that share a bar are none."""
    scale = Scale.of(view)
    size, extent = view.size, scale.extent
    found: list[tuple[int, ...]] = []
    for along in (1, 0):
        across = 1 - along
        slender = (size[:, along] >= _BAR * size[:, across]) & (size[:, 2] <= _THICK * extent)
        bars = slender & (size[:, 2] <= _DEEP * size[:, across]) & (size[:, across] > 0)
        for pair in _pairs(view, bars, along, extent * _SAME):
            members = _filled(view, pair, along, extent[pair[0]])
            if members:
                found.append(members)
    return _without_shared(found)


def merged(view: View, groups: list[tuple[int, ...]]) -> tuple[View, list[tuple[int, ...]]]:
    """Returns the view with the shells of each group as one, and for each new shell those that it is made of."""
    count = len(view.owner)
    ends = np.array([(group[0], shell) for group in groups for shell in group], dtype=np.int64).reshape(-1, 2)
    graph = coo_matrix((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), (count, count))
    total, number = connected_components(graph, directed=False)
    order = np.argsort(number, kind="stable")
    starts = np.searchsorted(number[order], np.arange(total))
    members = [tuple(shells.tolist()) for shells in np.split(order, starts[1:])]
    seen = np.where(view.seen >= 0, number[view.seen], -1).astype(np.int64)
    return View(
        view.owner[order][starts],
        np.minimum.reduceat(view.low[order], starts, axis=0),
        np.maximum.reduceat(view.high[order], starts, axis=0),
        np.add.reduceat(view.faced[order], starts, axis=0),
        seen,
        view.depth,
        view.origin,
        view.cell,
    ), members


def _pairs(view: View, bars: MaskOfShells, along: int, same: np.ndarray) -> Iterator[tuple[int, int]]:
    """Yields bars of one object side by side, with the same ends and depths: the nearest first."""
    low, high, across = view.low, view.high, 1 - along
    for bar in np.flatnonzero(bars).tolist():
        beside = bars & (view.owner == view.owner[bar]) & (low[:, across] > high[bar, across])
        ends = np.maximum(np.abs(low[:, along] - low[bar, along]), np.abs(high[:, along] - high[bar, along]))
        depths = np.maximum(np.abs(low[:, 2] - low[bar, 2]), np.abs(high[:, 2] - high[bar, 2]))
        others = np.flatnonzero(beside & (ends <= same[bar]) & (depths <= same[bar]))
        for other in others[np.argsort(low[others, across], kind="stable")].tolist():
            yield bar, other


def _filled(view: View, pair: tuple[int, int], along: int, extent: float) -> tuple[int, ...]:
    """Returns the pair with the bars across and the panels between, empty where they are no filled frame."""
    first, second = pair
    across: Final = 1 - along
    low, high, same = view.low, view.high, _SAME * extent
    groove = _GROOVE * view.size[first, across]
    left, right = high[first, across], low[second, across]
    between = (low[:, across] >= left - groove - same) & (high[:, across] <= right + groove + same)
    inside = (low[:, along] >= low[first, along] - same) & (high[:, along] <= high[first, along] + same)
    level = (low[:, 2] >= low[first, 2] - same) & (high[:, 2] <= high[first, 2] + same)
    within = between & inside & level & (view.owner == view.owner[first])
    spans = within & (low[:, across] <= left + same) & (high[:, across] >= right - same)
    low_ends = spans & (np.abs(low[:, along] - low[first, along]) <= same)
    high_ends = spans & (np.abs(high[:, along] - high[first, along]) <= same)
    rails = low_ends ^ high_ends
    if not ((low_ends & rails).any() and (high_ends & rails).any()):
        return ()
    opening = high[low_ends & rails, along].min(), low[high_ends & rails, along].max()
    panels = within & ~rails
    panels[[first, second]] = False
    if not panels.any() or not _fits(view, panels, pair, along, opening, extent):
        return ()
    return (*pair, *np.flatnonzero(rails).tolist(), *np.flatnonzero(panels).tolist())


def _fits(
    view: View, panels: MaskOfShells, pair: tuple[int, int], along: int, opening: tuple[float, float], extent: float
) -> bool:
    """Whether panels fill a frame's inside, without gaps to it and not before it."""
    across, gap = 1 - along, _GAP * extent
    left, right = view.high[pair[0], across], view.low[pair[1], across]
    inner = float((right - left) * (opening[1] - opening[0]))
    area = float(np.prod(view.size[panels][:, :2], axis=1).sum())
    touches = view.low[panels, across].min() <= left + gap and view.high[panels, across].max() >= right - gap
    touches &= view.low[panels, along].min() <= opening[0] + gap and view.high[panels, along].max() >= opening[1] - gap
    set_back = view.high[panels, 2].max() < view.high[pair[0], 2] - 0.02 * view.size[pair[0], 2]
    return bool(touches and set_back and inner > 0 and area >= _FILLED * inner)


def _without_shared(found: list[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """Returns the groups of which no other has a shell, smaller ones first, unless one holds the other."""
    kept: list[tuple[int, ...]] = []
    for group in sorted(found, key=len):
        if not any(set(group) & set(other) for other in kept):
            kept.append(group)
    return kept
