"""Which shells could be the front of a door or a drawer, seen from one side. It asks no names and joins nothing.

A front is a plate with a rectangular outline that little stands before and that has room behind it, or a drawer drawn
as one body between two walls.
"""

from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.geometry.arrays import Indices
from grafu.segmentation.view import MaskOfShells, ScalarsOfShells, View

_PLATE = 0.35  # of its shorter side: how thick a front is at most
_LEAST = 0.05  # of its object's largest side: the shorter side of a front
_MOST_NARROW = 12.0  # times as long as wide
_FULL = 0.5  # of its outline: what a front's faces cover, unless it is a frame
_RING = 0.08  # of its outline: what a frame's faces cover
_HIDDEN = 0.3  # of its outline: how much of it others may hide
_SEEN = 0.5  # of its outline: how much of it, or of what it holds, is seen
_ROOM = 0.3  # of its shorter side: how deep what it closes is
_BODY = 0.6  # of its object's outline: the largest drawer drawn as one body
_NO_AREA = 1e-300
NEAR = 0.01  # of its object's largest side: how far off something still touches, how far it may stand out


@final
@dataclass(frozen=True, slots=True)
class Scale:
    """The size of the object that holds each shell, and what counts as touching in it."""

    extent: ScalarsOfShells
    outline: ScalarsOfShells  # the area of the object as it is seen

    @classmethod
    def of(cls, view: View) -> "Scale":
        """Returns the scale of each shell."""
        count = int(view.owner.max()) + 1
        low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
        np.minimum.at(low, view.owner, view.low)
        np.maximum.at(high, view.owner, view.high)
        size = (high - low)[view.owner]
        return cls(np.asarray(size.max(axis=1)), size[:, 0] * size[:, 1])

    @property
    def near(self) -> ScalarsOfShells:
        """How far off something still touches a shell."""
        return NEAR * self.extent


def candidates(view: View, open_to: MaskOfShells) -> Indices:
    """Returns the shells that could be fronts, the largest first.

    Args:
        view: what is seen.
        open_to: for each shell whether its object may be cut.
    """
    scale, size = Scale.of(view), view.size
    shorter, longer = size[:, :2].min(axis=1), size[:, :2].max(axis=1)
    area = size[:, 0] * size[:, 1]
    cover = np.minimum(view.faced[:, 2] / np.maximum(area, _NO_AREA), 1.0)
    large = (shorter >= _LEAST * scale.extent) & (longer <= _MOST_NARROW * shorter)
    plate = (size[:, 2] <= _PLATE * shorter) & (cover >= _RING)
    body = (size[:, 2] > _PLATE * shorter) & (cover >= 0.8) & (area <= _BODY * scale.outline)
    found = np.flatnonzero(open_to & large & (plate | body))
    found = found[np.argsort(-area[found], kind="stable")]
    kept = [
        k
        for k in found.tolist()
        if _is_seen(view, k, bool(cover[k] < _FULL), float(scale.near[k]))
        and _has_room(view, k, _ROOM * float(shorter[k]))
        and (plate[k] or _is_flanked(view, k, scale))
    ]
    return np.array(kept, dtype=np.int64)


def within(view: View, shell: int, near: float) -> MaskOfShells:
    """Returns for each shell whether its outline lies in that of `shell`, which it may leave by `near`."""
    inside = (view.low[:, :2] >= view.low[shell, :2] - near) & (view.high[:, :2] <= view.high[shell, :2] + near)
    found = np.asarray(inside.all(axis=1))
    found[shell] = False
    return found


def overlaps(view: View, shell: int) -> ScalarsOfShells:
    """Returns which fraction of the outline of `shell` that of each shell covers."""
    low = np.maximum(view.low[:, :2], view.low[shell, :2])
    high = np.minimum(view.high[:, :2], view.high[shell, :2])
    size = view.size[shell, :2]
    return np.prod(np.maximum(high - low, 0.0), axis=1) / max(float(size[0] * size[1]), _NO_AREA)


def _is_seen(view: View, shell: int, is_frame: bool, near: float) -> bool:
    """Whether little hides a shell, and most of its outline shows it or what it holds."""
    rows, columns = view.window(shell)
    first, depth = view.seen[rows, columns], view.depth[rows, columns]
    own = within(view, shell, near)
    own[shell] = True
    is_own = (first >= 0) & own[first]
    hidden = (first >= 0) & ~is_own & (depth > view.high[shell, 2] + near)
    return bool(hidden.mean() <= _HIDDEN and (is_frame or is_own.mean() >= _SEEN))


def _has_room(view: View, shell: int, least: float) -> bool:
    """Whether what stands behind a shell reaches farther back than the shell is thick."""
    behind = overlaps(view, shell) > _HIDDEN
    behind[shell] = False
    if not behind.any():
        return False
    back, thick = float(view.low[behind, 2].min()), float(view.size[shell, 2])
    if float(view.low[shell, 2]) - back >= min(least, thick):
        return True
    return float(view.high[shell, 2]) - back >= 2 * least and thick > least


def _is_flanked(view: View, shell: int, scale: Scale) -> bool:
    """Whether a body stands in another's outline, or between two others as tall and deep: a drawer in its case."""
    low, high = view.low, view.high
    near = 5 * float(scale.near[shell])
    level = np.minimum(high, high[shell]) - np.maximum(low, low[shell]) >= 0.5 * view.size[shell]
    around = (low[:, :2] <= low[shell, :2] + near).all(axis=1) & (high[:, :2] >= high[shell, :2] - near).all(axis=1)
    larger = np.prod(view.size[:, :2], axis=1) > 1.1 * float(np.prod(view.size[shell, :2]))
    if (around & larger & level[:, 2]).any():
        return True
    beside = level[:, 1] & level[:, 2]
    left = beside & (np.abs(high[:, 0] - low[shell, 0]) <= near)
    right = beside & (np.abs(low[:, 0] - high[shell, 0]) <= near)
    return bool(left.any() and right.any())
