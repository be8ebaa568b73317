"""Which shells, and which frames of several, could be the front of a door or a drawer, seen from one side.

A front is a plate with a rectangular outline that little stands before and that has room behind it, or a drawer drawn
as one body between two walls. It asks no names.

Two parallel bars of one length with two bars across between their ends are a frame. With panels in it, that touch it or
reach into it and are set back, and with the muntins that part these, they are one front; inset fronts leave a gap to
their face frame.
"""

from collections.abc import Iterator
from typing import Final

import numpy as np

from grafu.geometry.arrays import Indices
from grafu.geometry.components import linked
from grafu.segmentation.config import CandidateConfig, FrameConfig, SegmentationConfig
from grafu.segmentation.surroundings import (
    NO_AREA,
    Scale,
    bulge,
    has_handle,
    has_room,
    is_before_case,
    is_flanked,
    is_leaf_in_frame,
    is_recess,
    is_seen,
)
from grafu.segmentation.view import MaskOfShells, ShellsView


def candidates(
    view: ShellsView, open_to: MaskOfShells, config: CandidateConfig, sizes: tuple[float, float] | None = None
) -> Indices:
    """Returns the shells that could be fronts, the largest first.

    Args:
        view: what is seen.
        open_to: for each shell whether its object may be cut.
        config: the thresholds.
        sizes: others than `least` and `most_narrow` of the config.
    """
    least, most_narrow = sizes or (config.least, config.most_narrow)
    scale, size = Scale.of(view), view.size
    shorter, longer = size[:, :2].min(axis=1), size[:, :2].max(axis=1)
    area = size[:, 0] * size[:, 1]
    cover = np.minimum(view.faced[:, 2] / np.maximum(area, NO_AREA), 1.0)
    large = (shorter >= least * scale.extent) & (longer <= most_narrow * shorter)
    thick = size[:, 2].copy()
    for k in np.flatnonzero(open_to & large & (thick > config.plate * shorter) & (thick <= config.bowed * shorter)):
        thick[k] -= bulge(view, int(k), config)
    plate = (thick <= config.plate * shorter) & (cover >= config.ring)
    body = (thick > config.plate * shorter) & (cover >= config.solid)
    body &= area <= config.body * scale.outline
    found = np.flatnonzero(open_to & large & (plate | body))
    found = found[np.argsort(-area[found], kind="stable")]
    could_be: dict[int, bool] = view.remembered.setdefault((candidates, config), {})
    for shell in found.tolist():
        if shell not in could_be:  # the same shell is asked for of several objects, and of several sizes
            could_be[shell] = _stands_as_front(view, shell, bool(plate[shell]), float(cover[shell]), scale, config)
    return np.array([shell for shell in found.tolist() if could_be[shell]], dtype=np.int64)


def _stands_as_front(
    view: ShellsView, k: int, is_plate: bool, cover: float, scale: Scale, config: CandidateConfig
) -> bool:
    """Whether a plate, or else a body, has room behind it or stands in its case, and is seen."""
    size, near = view.size[k], config.near * float(scale.extent[k])
    shorter = float(size[:2].min())
    is_beam = not is_plate and size[:2].max() >= config.beam * shorter and size[2] <= config.square * shorter
    return bool(
        (
            (not is_plate and has_handle(view, k, near, config))
            or (
                has_room(view, k, config.room * shorter, config)
                and not is_beam
                and (is_plate or is_flanked(view, k, scale, config) or is_before_case(view, k, near, config))
            )
            or (is_plate and is_leaf_in_frame(view, k, scale, config))
        )
        and not is_recess(view, k, scale, config)  # rays come last: many views are never asked for any
        and is_seen(view, k, cover < config.full, near, config)
    )


def framed(view: ShellsView, segmentation: SegmentationConfig) -> list[tuple[int, ...]]:
    """Returns the shells of each framed front, a shell in one at most; frames that share a bar are none.

    A bar is as long as the shorter side of a front at least.
    """
    size, extent, config = view.size, Scale.of(view).extent, segmentation.frames
    found: list[tuple[int, ...]] = []
    for along in (1, 0):
        across = 1 - along
        slender = (size[:, along] >= config.bar * size[:, across]) & (size[:, 2] <= config.thick * extent)
        bars = slender & (size[:, 2] <= config.deep * size[:, across]) & (size[:, across] > 0)
        bars &= size[:, along] >= segmentation.candidates.least * extent
        for bar, others in _pairs(view, bars, along, extent * config.same):
            near = _level_with(view, bar, along, config.same * extent[bar], config.pane)
            around, numbers = view.of_shells(near), {shell: k for k, shell in enumerate(near.tolist())}
            for other in others:
                members = _filled(around, (numbers[bar], numbers[other]), along, extent[bar], config)
                if members:
                    found.append(tuple(near[[*members]].tolist()))
    return _without_shared(found)


def halves(view: ShellsView, config: SegmentationConfig) -> list[tuple[int, ...]]:
    """Returns the pairs of plates that are mirror images, meet in a seam, and have one handle or the like across it.

    A front that was drawn as one half and mirrored is such a pair. Two doors that meet have a handle each, and none
    across their seam.
    """
    size, scale = view.size, Scale.of(view)
    same, near = config.frames.same * scale.extent, config.candidates.near * scale.extent
    area = size[:, 0] * size[:, 1]
    plates = np.flatnonzero(size[:, :2].min(axis=1) >= config.candidates.least * scale.extent / 2)
    found: list[tuple[int, ...]] = []
    for k in plates.tolist():
        seam = float(view.high[k, 0])
        beside = plates[(view.owner[plates] == view.owner[k]) & (np.abs(view.low[plates, 0] - seam) <= same[k])]
        if not len(beside):
            continue
        ends = np.maximum(np.abs(view.low[beside] - view.low[k]), np.abs(view.high[beside] - view.high[k]))[:, 1:]
        alike = beside[(np.abs(size[beside] - size[k]).max(axis=1) <= same[k]) & (ends.max(axis=1) <= same[k])]
        if len(alike) != 1:
            continue
        across = (np.abs(view.low[:, 0] + view.high[:, 0] - 2 * seam) <= same[k]) & (size[:, 0] > 2 * near[k])
        across &= (view.low[:, 1:] >= view.low[k, 1:] - near[k]).all(axis=1) & (view.high[:, 1] <= view.high[k, 1])
        face = view.high[k, 2] - min(float(near[k]), float(size[k, 2]) / 2)  # what ends farther back is a board behind
        across &= (area <= config.members.handle_area * area[k]) & (view.high[:, 2] >= face)
        if across.any():
            found.append((k, int(alike[0])))
    return _without_shared(found)


def merged(view: ShellsView, groups: list[tuple[int, ...]]) -> tuple[ShellsView, list[tuple[int, ...]]]:
    """Returns the view with the shells of each group as one, and for each new shell those that it is made of."""
    count = len(view.owner)
    if not groups:
        return view, [(k,) for k in range(count)]
    ends = np.array([(group[0], shell) for group in groups for shell in group], dtype=np.int64).reshape(-1, 2)
    number = linked(count, ends[:, 0], ends[:, 1])
    order = np.argsort(number, kind="stable")
    starts = np.searchsorted(number[order], np.arange(int(number.max(initial=-1)) + 1))
    members = [tuple(shells.tolist()) for shells in np.split(order, starts[1:])]
    return ShellsView(
        view.owner[order][starts],
        np.minimum.reduceat(view.low[order], starts, axis=0),
        np.maximum.reduceat(view.high[order], starts, axis=0),
        np.add.reduceat(view.faced[order], starts, axis=0),
        number[view.shell].astype(np.int64),
        view.rays,
    ), members


def _pairs(view: ShellsView, bars: MaskOfShells, along: int, same: np.ndarray) -> Iterator[tuple[int, list[int]]]:
    """Yields each bar with those of its object beside it that have the same ends and depths: the nearest first."""
    low, high, across = view.low, view.high, 1 - along
    for bar in np.flatnonzero(bars).tolist():
        beside = bars & (view.owner == view.owner[bar]) & (low[:, across] > high[bar, across])
        ends = np.maximum(np.abs(low[:, along] - low[bar, along]), np.abs(high[:, along] - high[bar, along]))
        depths = np.maximum(np.abs(low[:, 2] - low[bar, 2]), np.abs(high[:, 2] - high[bar, 2]))
        others = np.flatnonzero(beside & (ends <= same[bar]) & (depths <= same[bar]))
        if len(others):
            yield bar, others[np.argsort(low[others, across], kind="stable")].tolist()


def _level_with(view: ShellsView, bar: int, along: int, same: float, pane: float) -> Indices:
    """Returns the shells of a bar's object that reach beyond none of its ends, nor before it or behind it.

    So are panes, of the thickness `pane` of the bar's at most, that are another object.
    """
    low, high = view.low, view.high
    inside = (low[:, along] >= low[bar, along] - same) & (high[:, along] <= high[bar, along] + same)
    level = (low[:, 2] >= low[bar, 2] - same) & (high[:, 2] <= high[bar, 2] + same)
    own = view.owner == view.owner[bar]
    return np.flatnonzero(inside & level & (own | (view.size[:, 2] <= pane * view.size[bar, 2])))


def _filled(view: ShellsView, pair: tuple[int, int], along: int, extent: float, config: FrameConfig) -> tuple[int, ...]:
    """Returns the pair with the bars across and the panels between, empty where they are no filled frame.

    The view shows the shells that are level with the pair. Panes of another object fill a frame, too, and are left out.
    Panels are set back behind the face of the frame, or reach into it on all sides: inset fronts do neither.
    """
    first, second = pair
    across: Final = 1 - along
    low, high, same, own = view.low, view.high, config.same * extent, view.owner == view.owner[first]
    bar = float(view.size[first, across])
    groove = config.groove * bar
    left, right = high[first, across], low[second, across]
    between = (low[:, across] >= left - groove - same) & (high[:, across] <= right + groove + same)
    spans = between & (low[:, across] <= left + same) & (high[:, across] >= right - same)
    low_ends = spans & (np.abs(low[:, along] - low[first, along]) <= same)
    high_ends = spans & (np.abs(high[:, along] - high[first, along]) <= same)
    rails = (low_ends ^ high_ends) & own
    if not ((low_ends & rails).any() and (high_ends & rails).any()):
        return ()
    opening = high[low_ends & rails, along].min(), low[high_ends & rails, along].max()
    filling = between & ~rails & (own | _is_set_back(view, first, config))
    filling[[first, second]] = False
    muntins = filling & ~_is_set_back(view, first, config) & (view.size[:, :2].min(axis=1) <= config.muntin * bar)
    panels = filling & ~muntins
    in_grooves = (low[:, across] < left - same) & (high[:, across] > right + same)
    in_grooves &= (low[:, along] < opening[0] - same) & (high[:, along] > opening[1] + same)
    if not panels.any() or not (_is_set_back(view, first, config) | in_grooves)[panels].all():
        return ()
    if not _fits(view, filling, pair, along, opening, config.gap * extent, config.filled):
        return ()
    return (*pair, *np.flatnonzero(rails).tolist(), *np.flatnonzero(filling & own).tolist())


def _is_set_back(view: ShellsView, bar: int, config: FrameConfig) -> MaskOfShells:
    """Whether each shell lies behind the face of a frame."""
    return np.asarray(view.high[:, 2] < view.high[bar, 2] - config.set_back * view.size[bar, 2])


def _fits(
    view: ShellsView,
    panels: MaskOfShells,
    pair: tuple[int, int],
    along: int,
    opening: tuple[float, float],
    gap: float,
    filled: float,
) -> bool:
    """Whether panels fill a frame's inside, with gaps to it of `gap` at most: `filled` of its area at least."""
    across = 1 - along
    left, right = view.high[pair[0], across], view.low[pair[1], across]
    inner = float((right - left) * (opening[1] - opening[0]))
    area = float(np.prod(view.size[panels][:, :2], axis=1).sum())
    touches = view.low[panels, across].min() <= left + gap and view.high[panels, across].max() >= right - gap
    touches &= view.low[panels, along].min() <= opening[0] + gap and view.high[panels, along].max() >= opening[1] - gap
    return bool(touches and inner > 0 and area >= filled * inner)


def _without_shared(found: list[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """Returns the groups of which no other has a shell, smaller ones first, unless one holds the other."""
    kept: list[tuple[int, ...]] = []
    for group in sorted(found, key=len):
        if not any(set(group) & set(other) for other in kept):
            kept.append(group)
    return kept
