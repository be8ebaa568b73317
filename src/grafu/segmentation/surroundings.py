"""What stands around one shell as it is seen: before it, behind it, beside it. It asks no names and finds no fronts."""

from typing import Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import median, row_medians
from grafu.segmentation.config import CandidateConfig
from grafu.segmentation.view import MaskOfShells, ScalarsOfShells, ShellsView
from grafu.shapes import Float

NO_AREA: Final = 1e-300
RING_CELLS: Final = 3
"""Rays around a shell that show what lies beside it."""


@final
@dataclass(frozen=True, slots=True)
class Scale:
    """The size of the object that holds each shell."""

    extent: ScalarsOfShells
    outline: ScalarsOfShells  # the area of the object as it is seen
    depth: ScalarsOfShells

    @classmethod
    def of(cls, view: ShellsView) -> "Scale":
        """Returns the scale of each shell."""
        known: Scale | None = view.remembered.get(cls)
        if known is None:
            known = view.remembered[cls] = cls._measured(view)
        return known

    @classmethod
    def _measured(cls, view: ShellsView) -> "Scale":
        count = int(view.owner.max()) + 1
        low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
        np.minimum.at(low, view.owner, view.low)
        np.maximum.at(high, view.owner, view.high)
        size = (high - low)[view.owner]
        return cls(np.asarray(size.max(axis=1)), size[:, 0] * size[:, 1], np.asarray(size[:, 2]))


def within(view: ShellsView, shell: int, near: float) -> MaskOfShells:
    """Returns for each shell whether its outline lies in that of `shell`, which it may leave by `near`."""
    inside = (view.low[:, :2] >= view.low[shell, :2] - near) & (view.high[:, :2] <= view.high[shell, :2] + near)
    found = np.asarray(inside.all(axis=1))
    found[shell] = False
    return found


def overlaps(view: ShellsView, shell: int) -> ScalarsOfShells:
    """Returns which fraction of the outline of `shell` that of each shell covers."""
    low = np.maximum(view.low[:, :2], view.low[shell, :2])
    high = np.minimum(view.high[:, :2], view.high[shell, :2])
    size = view.size[shell, :2]
    return np.prod(np.maximum(high - low, 0.0), axis=1) / max(float(size[0] * size[1]), NO_AREA)


def is_seen(view: ShellsView, shell: int, is_frame: bool, near: float, config: CandidateConfig) -> bool:
    """Whether little hides a shell, and most of its outline shows it or what it holds."""
    rows, columns = view.window(shell)
    first, depth = view.seen[rows, columns], view.depth[rows, columns]
    own = within(view, shell, near) & (view.low[:, 2] <= view.high[shell, 2] + config.before * near)
    own[shell] = True
    is_own = (first >= 0) & own[first]
    hidden = (first >= 0) & ~is_own & (depth > view.high[shell, 2] + near)
    return bool(hidden.mean() <= config.hidden and (is_frame or is_own.mean() >= config.seen))


def has_handle(view: ShellsView, shell: int, near: float, config: CandidateConfig) -> bool:
    """Whether something small stands out of the middle of a body as deep as a drawer: a knob or a bar, of no panel."""
    if view.size[shell, 2] < view.size[shell, :2].min():
        return False
    on = within(view, shell, 0.0) & (np.abs(view.low[:, 2] - view.high[shell, 2]) <= near)
    on &= view.high[:, 2] > view.high[shell, 2] + near
    on &= np.prod(view.size[:, :2], axis=1) <= config.handle * np.prod(view.size[shell, :2])
    middles = np.abs((view.low + view.high - view.low[shell] - view.high[shell])[:, :2]) / 2
    return bool((on & (middles <= near).any(axis=1)).any())


def has_room(view: ShellsView, shell: int, least: float, config: CandidateConfig) -> bool:
    """Whether what stands behind a shell reaches farther back than the shell is thick.

    Behind that room, the boards of a back that is drawn in boards count together.
    """
    covers = overlaps(view, shell)
    covers[shell] = 0.0
    beyond = view.high[:, 2] <= view.low[shell, 2] - least
    behind = covers > config.hidden
    if covers[beyond].sum() > config.hidden:
        behind |= beyond & (covers > 0)
    if not behind.any():
        return False
    back, thick = float(view.low[behind, 2].min()), float(view.size[shell, 2])
    if float(view.low[shell, 2]) - back >= min(least, thick):
        return True
    return float(view.high[shell, 2]) - back >= 2 * least and thick > least


def is_flanked(view: ShellsView, shell: int, scale: Scale, config: CandidateConfig) -> bool:
    """Whether a body stands in another's outline, or between two others as tall and deep: a drawer in its case."""
    low, high = view.low, view.high
    near = config.flank_reach * (config.near * float(scale.extent[shell]))
    level = np.minimum(high, high[shell]) - np.maximum(low, low[shell]) >= config.level * view.size[shell]
    around = (low[:, :2] <= low[shell, :2] + near).all(axis=1) & (high[:, :2] >= high[shell, :2] - near).all(axis=1)
    larger = np.prod(view.size[:, :2], axis=1) > config.larger * float(np.prod(view.size[shell, :2]))
    if (around & larger & level[:, 2]).any():
        return True
    beside = level[:, 1] & level[:, 2]
    left = beside & (np.abs(high[:, 0] - low[shell, 0]) <= near)
    right = beside & (np.abs(low[:, 0] - high[shell, 0]) <= near)
    return bool(left.any() and right.any())


def bulge(view: ShellsView, shell: int, config: CandidateConfig) -> float:
    """Returns how much farther out a front comes in one row or column than in another: a bowed one is no thicker.

    What lies near its border does not count: edges may be rounded; nor do steps, such as those of sunk buttons.
    """

    def inner(rays: slice) -> slice:
        border = round(config.border * (rays.stop - rays.start))
        return slice(rays.start + border, rays.stop - border)

    rows, columns = (inner(rays) for rays in view.window(shell))
    depth = np.where(view.seen[rows, columns] == shell, view.depth[rows, columns], np.nan)
    levels = [row_medians(lines) for lines in (depth, depth.T)]
    smooth = (one for one in levels if len(one) > 1 and np.abs(np.diff(one)).max() <= config.step * np.ptp(one))
    return float(max((np.ptp(level) for level in smooth), default=0.0))


def is_leaf_in_frame(view: ShellsView, shell: int, scale: Scale, config: CandidateConfig) -> bool:
    """Whether a plate is the leaf of a door in its frame: high, with nothing behind it, a handle beside its middle."""
    size, near = view.size[shell], config.near * float(scale.extent[shell])
    covers = overlaps(view, shell)
    covers[shell] = 0.0
    behind = (covers > config.hidden) & (view.low[:, 2] < view.low[shell, 2] - near)
    if size[1] < config.upright * size[0] or behind.any() or not is_flanked(view, shell, scale, config):
        return False
    on = within(view, shell, 0.0) & (np.abs(view.low[:, 2] - view.high[shell, 2]) <= near)
    on &= np.prod(view.size[:, :2], axis=1) <= config.knob * size[:2].prod()
    on &= view.high[:, 2] > view.high[shell, 2] + near
    aside = np.abs(view.low + view.high - view.low[shell] - view.high[shell])[:, 0] / 2
    return bool((on & (aside >= config.aside * size[0])).any())


def is_before_case(view: ShellsView, shell: int, near: float, config: CandidateConfig) -> bool:
    """Whether a body stands right before a deeper one of its object that fills its outline: the door of an icebox."""
    if view.size[shell, 2] > config.thick_plate * view.size[shell, :2].min():
        return False
    behind = (view.owner == view.owner[shell]) & (np.abs(view.high[:, 2] - view.low[shell, 2]) <= near)
    behind &= view.size[:, 2] >= config.deeper * view.size[shell, 2]
    behind[shell] = False
    return bool((overlaps(view, shell)[behind] >= config.backed).any())


def is_recess(view: ShellsView, shell: int, scale: Scale, config: CandidateConfig) -> bool:
    """Whether what is seen of a shell lies far behind its rim and what is seen around it: an open compartment."""
    rows, columns = view.window(shell)
    inside = view.depth[rows, columns][view.seen[rows, columns] == shell]
    if not len(inside):
        return False
    high = float(view.high[shell, 2])
    least = max(config.recess * float(scale.depth[shell]), config.sunk * float(view.size[shell, :2].min()))
    if high - float(inside.min()) <= least:
        return False  # wherever its rim is
    around = _depths_around(view, rows, columns)
    rim = min(high, median(around) if len(around) else np.inf)
    return rim - median(inside) > least


def _depths_around(view: ShellsView, rows: slice, columns: slice) -> Float[np.ndarray, " _"]:
    """Returns the depths that the rays around some rows and columns meet."""
    beyond, beside = with_ring(rows, columns)
    strips = (
        view.depth[beyond.start : rows.start, beside],
        view.depth[rows.stop : beyond.stop, beside],
        view.depth[rows, beside.start : columns.start],
        view.depth[rows, columns.stop : beside.stop],
    )
    around = np.concatenate([strip.ravel() for strip in strips])
    return np.asarray(around[around > -np.inf])


def is_behind(view: ShellsView, shell: int, reach: float) -> bool:
    """Whether something stands before a shell below it, above it, or on both sides of it, along most of that side.

    It is looked for as far from the shell as `reach` of its size (fraction), and in the rays around it at least.
    """
    rows, columns = view.window(shell)
    counts = [max(round(reach * (rays.stop - rays.start)), RING_CELLS) for rays in (rows, columns)]
    first = [max(rays.start - count, 0) for rays, count in zip((rows, columns), counts, strict=True)]
    below, above = view.depth[first[0] : rows.start, columns], view.depth[rows.stop : rows.stop + counts[0], columns]
    left, right = view.depth[rows, first[1] : columns.start], view.depth[rows, columns.stop : columns.stop + counts[1]]
    level = float(view.high[shell, 2]) + view.rays.cell
    stands = [bool(rays.size) and float(row_medians(rays).max()) > level for rays in (below, above, left.T, right.T)]
    return stands[0] or stands[1] or (stands[2] and stands[3])


def with_ring(rows: slice, columns: slice) -> tuple[slice, slice]:
    """Returns rows and columns of rays with those around them."""
    rows, columns = (slice(max(rays.start - RING_CELLS, 0), rays.stop + RING_CELLS) for rays in (rows, columns))
    return rows, columns
