"""Which places in compartments get a panel: counts shared out, `auto` by size, predicted ones where they were expected.

What is there already counts: a cabinet with one shelf that is to have two gets one more. It cuts no panels.

Shelves and dividers that the completed graph expects, each brought into the compartment that it lies in.
"""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import final

import numpy as np

from grafu.additions.interior.compartments import Compartment
from grafu.additions.interior.config import InteriorConfig, Sizes
from grafu.additions.step import PanelHint
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.refusal import Asked, Reason, Refusal
from grafu.vocabulary import PartLabel

FLAT = 1e-3
"""Fraction of its largest side that a flat box counts as thick."""


@final
@dataclass(frozen=True, slots=True)
class Arrangement:
    """How many panels one compartment gets; `shelf_at` are heights in metres instead of equal spaces.

    Shelves slope down to the front by `angle` radians.
    """

    shelves: int = 0
    dividers: int = 0
    shelf_at: tuple[float, ...] = ()
    divider_at: tuple[float, ...] = ()
    angle: float = 0.0


def stacked(compartments: Sequence[Compartment], sizes: Sizes, config: InteriorConfig) -> list[list[int]]:
    """Returns the compartments that only shelves part from one another, from below: the columns."""
    return _grouped(compartments, lambda _: 2, sizes, config)


def rowed(compartments: Sequence[Compartment], sizes: Sizes, config: InteriorConfig) -> list[list[int]]:
    """Returns the compartments that only dividers part from one another: the rows."""
    return _grouped(compartments, lambda c: c.side_axis, sizes, config)


def shared_out(lengths: Sequence[float], present: int, wanted: int, thickness: float, least: float) -> list[int]:
    """Returns how many panels each of some spaces gets, so that the largest space left is as small as can be.

    Args:
        lengths: the spaces in metres.
        present: how many panels part those spaces from one another.
        wanted: how many panels there should be in all.
        thickness: of a panel.
        least: no space gets a panel that would leave less than this, metres.
    """
    counts = [0] * len(lengths)
    for _ in range(max(wanted - present, 0)):
        left = [_pitch(length, n, thickness) for length, n in zip(lengths, counts, strict=True)]
        after = [_pitch(length, n + 1, thickness) for length, n in zip(lengths, counts, strict=True)]
        able = [k for k, pitch in enumerate(after) if pitch >= least]
        if not able:
            break
        counts[max(able, key=lambda k: left[k])] += 1
    return counts


def by_size(compartment: Compartment, sizes: Sizes, config: InteriorConfig) -> Arrangement:
    """Returns the panels that suit a compartment's size (`auto`)."""
    size, most = compartment.box.size, config.most_panels
    height, width = float(size[2]), float(size[compartment.side_axis])
    if compartment.is_chest:
        return Arrangement(dividers=min(max(round(width / sizes.divider_pitch) - 1, 0), 2))
    if width < config.slim * sizes.least_side:
        return Arrangement()
    if is_for_hanging(compartment, sizes):
        above = height - sizes.hanging_height - sizes.thickness
        hat = float(compartment.box.high[2]) - min(above, sizes.shelf_pitch) - sizes.thickness / 2
        return Arrangement(shelf_at=(hat,)) if above >= sizes.hat else Arrangement()
    shelves = min(max(round(height / sizes.shelf_pitch) - 1, 0), most)
    pitch = sizes.divider_pitch * (config.doors_pitch if compartment.behind else 1.0)
    is_low = shelves == 0 and width >= config.low * height
    dividers = min(max(round(width / pitch) - 1, 0), most) if is_low else 0
    return Arrangement(shelves, dividers)


def is_for_hanging(compartment: Compartment, sizes: Sizes) -> bool:
    """Whether a compartment behind doors is as tall, wide and deep as a wardrobe's."""
    size = compartment.box.size
    depth, width = float(size[compartment.depth_axis]), float(size[compartment.side_axis])
    wide = min(depth, width) >= sizes.hanging_depth
    return bool(compartment.behind) and wide and float(size[2]) >= sizes.hanging_height


def spaced(low: float, high: float, count: int, thickness: float) -> list[float]:
    """Returns the middles of equally spaced panels between two walls."""
    pitch = _pitch(high - low, count, thickness)
    return [low + (k + 1) * pitch + (k + 0.5) * thickness for k in range(count)]


def most_that_fit(length: float, thickness: float, least: float) -> int:
    """Returns how many panels fit into a length so that every space left is at least `least`."""
    return max(int((length - least) / (least + thickness) + 1e-9), 0)


def _pitch(length: float, count: int, thickness: float) -> float:
    return (length - count * thickness) / (count + 1)


def _grouped(
    compartments: Sequence[Compartment],
    axis_of: Callable[[Compartment], int],
    sizes: Sizes,
    config: InteriorConfig,
) -> list[list[int]]:
    order = sorted(range(len(compartments)), key=lambda k: float(compartments[k].box.low[axis_of(compartments[k])]))
    groups: list[list[int]] = []
    for k in order:
        axis = axis_of(compartments[k])
        home = next((g for g in groups if _follows(compartments[g[-1]], compartments[k], axis, sizes, config)), None)
        if home is None:
            groups.append([k])
        else:
            home.append(k)
    return groups


def _follows(one: Compartment, other: Compartment, axis: int, sizes: Sizes, config: InteriorConfig) -> bool:
    """Whether a compartment comes next to another along an axis, parted by a board alone, behind the same doors."""
    if (one.opening, one.behind) != (other.opening, other.behind):
        return False
    gap = float(other.box.low[axis] - one.box.high[axis])
    across = [k for k in range(3) if k not in (axis, one.depth_axis)]
    alike = all(
        _overlap(one.box, other.box, k) >= config.alike * min(one.box.size[k], other.box.size[k]) for k in across
    )
    return alike and -sizes.cell <= gap <= config.between * sizes.thickness


def _overlap(one: Box, other: Box, axis: int) -> float:
    return float(np.minimum(one.high, other.high)[axis] - np.maximum(one.low, other.low)[axis])


def placed_hints(
    compartments: Sequence[Compartment], hints: Sequence[PanelHint], sizes: Sizes, config: InteriorConfig
) -> tuple[list[Arrangement], list[Refusal]]:
    """Returns what each compartment gets, and the refusals of hints that have no place."""
    middles: list[dict[PartLabel, list[float]]] = [{PartLabel.SHELF: [], PartLabel.DIVIDER: []} for _ in compartments]
    lost: list[Refusal] = []
    for hint in hints:
        number = _home(compartments, hint, config.hint_reach)
        if number is None:
            lost.append(_lost(hint, Reason.NO_COMPARTMENT, "lies in no compartment"))
            continue
        compartment, present = compartments[number], middles[number][hint.label]
        axis = 2 if hint.label is PartLabel.SHELF else compartment.side_axis
        if axis == 2 and compartment.is_chest:
            lost.append(_lost(hint, Reason.UNSUITABLE, "is a shelf in a chest that opens upwards"))
            continue
        at = _nearest_place(float(hint.box.center[axis]), compartment.box, axis, present, sizes)
        if at is None:
            lost.append(_lost(hint, Reason.NO_ROOM, "finds no room beside what is there"))
            continue
        present.append(at)
    found = [
        Arrangement(shelf_at=tuple(sorted(m[PartLabel.SHELF])), divider_at=tuple(sorted(m[PartLabel.DIVIDER])))
        for m in middles
    ]
    return found, lost


def _lost(hint: PanelHint, reason: Reason, why: str) -> Refusal:
    return Refusal(hint.label.value, reason, f"`{hint.id}` {why}", Asked.INTERIOR)


def _home(compartments: Sequence[Compartment], hint: PanelHint, reach: float) -> int | None:
    """Returns the compartment that a hint overlaps most, else the nearest if it is near; None: there is none."""
    if not compartments:
        return None
    overlaps = [_shared_part(compartment.box, hint.box) for compartment in compartments]
    best = int(np.argmax(overlaps))
    if overlaps[best] > 0:
        return best
    gaps = [c.box.gap(hint.box) / float(c.box.size.min()) for c in compartments]
    nearest = int(np.argmin(gaps))
    return nearest if gaps[nearest] <= reach else None


def _shared_part(one: Box, other: Box) -> float:
    """Returns the product of the fractions of `other`'s sides that lie in `one`; flat sides count by their place."""
    low, high = np.maximum(one.low, other.low), np.minimum(one.high, other.high)
    sides = np.maximum(other.size, FLAT * float(other.size.max()) + 1e-9)
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
