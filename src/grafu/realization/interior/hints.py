"""Shelves and dividers that the completed graph expects, each brought into the compartment that it lies in."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from grafu.geometry.box import Box
from grafu.realization.interior.arrangement import Arrangement
from grafu.realization.interior.compartments import Compartment
from grafu.realization.interior.config import Sizes
from grafu.realization.interior.request import PanelHint
from grafu.vocabulary import PartLabel

_NEAR = 0.5  # of a compartment's own size, outside of which a hint means another one

Lost = tuple[PanelHint, str]


def placed_hints(
    compartments: Sequence[Compartment], hints: Sequence[PanelHint], sizes: Sizes
) -> tuple[list[Arrangement], list[Lost]]:
    """Returns what each compartment gets, and the hints that have no place, with the reason in words."""
    middles: list[dict[PartLabel, list[float]]] = [{PartLabel.SHELF: [], PartLabel.DIVIDER: []} for _ in compartments]
    lost: list[Lost] = []
    for hint in hints:
        number = _home(compartments, hint)
        if number is None:
            lost.append((hint, "lies in no compartment"))
            continue
        compartment, present = compartments[number], middles[number][hint.label]
        axis = 2 if hint.label is PartLabel.SHELF else compartment.side_axis
        if axis == 2 and compartment.is_chest:
            lost.append((hint, "is a shelf in a chest that opens upwards"))
            continue
        at = _nearest_place(float(hint.box.center[axis]), compartment.box, axis, present, sizes)
        if at is None:
            lost.append((hint, "finds no room beside what is there"))
            continue
        present.append(at)
    found = [
        Arrangement(shelf_at=tuple(sorted(m[PartLabel.SHELF])), divider_at=tuple(sorted(m[PartLabel.DIVIDER])))
        for m in middles
    ]
    return found, lost


def _home(compartments: Sequence[Compartment], hint: PanelHint) -> int | None:
    """Returns the compartment that a hint overlaps most, else the nearest if it is near; None: there is none."""
    if not compartments:
        return None
    overlaps = [_overlap(compartment.box, hint.box) for compartment in compartments]
    best = int(np.argmax(overlaps))
    if overlaps[best] > 0:
        return best
    gaps = [c.box.gap(hint.box) / float(c.box.size.min()) for c in compartments]
    nearest = int(np.argmin(gaps))
    return nearest if gaps[nearest] <= _NEAR else None


def _overlap(one: Box, other: Box) -> float:
    """Returns the product of the shares of `other`'s sides that lie in `one`; flat sides count by their place."""
    low, high = np.maximum(one.low, other.low), np.minimum(one.high, other.high)
    sides = np.maximum(other.size, 1e-3 * float(other.size.max()) + 1e-9)
    return float(np.prod(np.clip((high - low + 1e-9) / sides, 0.0, 1.0)))


def _nearest_place(at: float, box: Box, axis: int, present: list[float], sizes: Sizes) -> float | None:
    """Returns the middle nearest to `at` that leaves room to the ends and to panels already placed."""
    room = sizes.least_pitch + sizes.thickness
    ends = float(box.low[axis]) - sizes.thickness / 2, float(box.high[axis]) + sizes.thickness / 2
    stops = sorted([ends[0], *present, ends[1]])
    free = [(a + room, b - room) for a, b in pairwise(stops) if b - a >= 2 * room]
    if not free:
        return None
    return min((float(np.clip(at, low, high)) for low, high in free), key=lambda place: abs(place - at))
