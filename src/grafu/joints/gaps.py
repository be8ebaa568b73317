"""How far apart moving and static pieces are, at one pose and over a motion."""

from collections.abc import Callable, Sequence
from itertools import product

import numpy as np

from grafu.geometry.arrays import Mat4
from grafu.geometry.intersection import MeshCollider
from grafu.joints.limits import PoseFunction

_POSES = 5  # what moves slides or turns along itself: a gap, where there is one, opens steadily
_TOUCHING = 1e-4  # metres: no narrower gap is measured


def gap_between(ends: Sequence[MeshCollider], held: Sequence[MeshCollider], T: Mat4, enough: float = 0.0) -> float:
    """Returns the distance in metres of the nearest two pieces, the moving ones posed at T.

    Of a gap no wider than `enough` metres it may be any that is no wider: it is looked for no further.
    """
    for end in ends:
        end.place(T)
    nearest = float("inf")
    pairs = sorted(((one.box_gap(other), k, one, other) for k, (one, other) in enumerate(product(ends, held))))
    for least, _, one, other in pairs:
        if least >= nearest:
            break
        nearest = min(nearest, one.distance(other))
        if nearest <= max(_TOUCHING, enough):
            break
    return nearest


def widest_gap(gap_at: Callable[[float, float], float], upper: float, as_drawn: int = 0) -> float:
    """Returns the widest gap in metres from rest to `upper`; of what stands off as it is drawn, how far it grows.

    The gap that is drawn is the widest of the first `as_drawn` poses: that at rest, and, for what leaves a stop behind
    it, the next. `gap_at` takes a value and `enough`, as in `gap_between`: gaps open, so the farthest pose is measured
    first, and others only as far as they may be wider.
    """
    values = np.linspace(0.0, upper, _POSES).tolist()
    drawn = max((gap_at(value, 0.0) for value in values[:as_drawn]), default=0.0)
    widest = drawn
    for value in reversed(values[as_drawn:]):
        widest = max(widest, gap_at(value, widest))
    return widest - drawn


def gap_growth(
    ends: Sequence[MeshCollider], held: Sequence[MeshCollider], motion: PoseFunction, upper: float, is_slide: bool
) -> float:
    """Returns by how much the gap between moving and static pieces grows from what is drawn to `upper`, in metres."""
    return widest_gap(
        lambda value, enough: gap_between(ends, held, motion(value), enough), upper, drawn_poses(is_slide)
    )


def drawn_poses(is_slide: bool) -> int:
    """Returns how many of the first poses show the gap that is drawn: what slides may rest against a stop."""
    return 2 if is_slide else 1
