"""Where on a front a handle belongs, best first: from the motion, from habit, and from the model's other handles.

It casts no rays.
"""

from collections.abc import Iterator, Sequence
from typing import final

import numpy as np

from grafu.additions.handle.config import HandleConfig
from grafu.additions.handle.relief import Relief
from grafu.additions.handle.style import Sibling
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3, Vec3
from grafu.scene.front import Side

TURNS: dict[Side, Mat3] = {  # about b: where the template's upper side comes to lie
    "top": np.eye(3),
    "bottom": np.diag([-1.0, 1.0, -1.0]),
    "left": np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]),
    "right": np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]),
}


@final
@dataclass(frozen=True, slots=True)
class Spot:
    """Places (u, v) of one handle, or of two side by side, metres, and where the template's upper side points."""

    places: tuple[tuple[float, float], ...]
    above: Side
    why: str

    @property
    def turn(self) -> Mat3:
        """The turn about b, from the handle's frame to the front's."""
        return TURNS[self.above]


@final
@dataclass(frozen=True, slots=True)
class Extent:
    """What a handle takes of a front, metres: along its long side and across it; `turns`: whether it may stand."""

    along: float
    across: float
    turns: bool
    at_edge: bool = False


def spots_on(
    relief: Relief, extent: Extent, siblings: Sequence[Sibling], hint: Vec3 | None, config: HandleConfig
) -> Iterator[Spot]:
    """Yields spots for a handle of an extent on a front, best first; the handle fits in the outline at each.

    `hint` is where a handle was predicted, in the object frame; a door is like its siblings instead, if they have any.
    """
    usual = _by_habit(relief, extent, siblings, hint, config)
    if not config.count and config.offset == (0.0, 0.0):
        yield from usual
        return
    for spot in usual:
        yield from _as_chosen(relief, extent, spot, config)


def _by_habit(
    relief: Relief, extent: Extent, siblings: Sequence[Sibling], hint: Vec3 | None, config: HandleConfig
) -> Iterator[Spot]:
    side = relief.front.held
    copied = side in ("left", "right") and any(q.front.held in ("left", "right") for q in siblings)
    if hint is not None and not copied:
        yield from _hinted(relief, extent, hint, side, config)
    if side is None:
        yield from _on_drawer(relief, extent, siblings, config)
    elif side in ("left", "right"):
        yield from _on_door(relief, extent, siblings, side, config)
    else:
        yield from _on_flap(relief, extent, side, config)


def _as_chosen(relief: Relief, extent: Extent, spot: Spot, config: HandleConfig) -> Iterator[Spot]:
    """Yields a usual spot with as many handles as are chosen, side by side along the front's longer side, moved."""
    places = np.array(spot.places)
    if config.count:
        along = 0 if relief.outline.size[0] >= relief.outline.size[2] else 1
        low, side = float(relief.outline.low[2 * along]), float(relief.outline.size[2 * along])
        level = spot.above in ("top", "bottom")
        if (
            config.count > 1
            and config.count * (extent.along if level is (along == 0) else extent.across) > config.both * side
        ):
            return
        places = np.repeat(places.mean(axis=0)[None], config.count, axis=0)
        if config.count > 1:
            places[:, along] = low + (np.arange(config.count) + 0.5) / config.count * side
    places = places + np.array(config.offset)
    yield from _fitting(relief, extent, [(float(u), float(v)) for u, v in places], spot.above, spot.why, config)


def _hinted(relief: Relief, extent: Extent, hint: Vec3, side: Side | None, config: HandleConfig) -> Iterator[Spot]:
    u, _, v = relief.front.to_front(hint[None])[0].tolist()
    box = relief.outline
    if not (box.low[0] < u < box.high[0] and box.low[2] < v < box.high[2]):
        return
    ratio = {"left": box.high[0] - u, "right": u - box.low[0]}.get(side or "", np.inf) / box.size[0]
    ratio = min(ratio, {"bottom": box.high[2] - v, "top": v - box.low[2]}.get(side or "", np.inf) / box.size[2])
    if ratio >= config.free:
        upright = extent.turns and side in ("left", "right")
        yield from _fitting(relief, extent, [(u, v)], _above(side, upright, extent), "where it was predicted", config)


def _above(side: Side | None, upright: bool, extent: Extent) -> Side:
    if upright:
        return "right" if side == "right" else "left"
    return "bottom" if side == "bottom" and extent.at_edge else "top"


def _on_drawer(relief: Relief, extent: Extent, siblings: Sequence[Sibling], config: HandleConfig) -> Iterator[Spot]:
    s, box = relief.factor, relief.outline
    middle, height = float(box.center[0]), float(box.size[2])
    level = 0.5 if height <= s * config.high else 1.0 - max(config.from_top_ratio, s * config.from_top / height)
    alike = [q for q in siblings if q.front.held is None]
    if alike:
        near = min(alike, key=lambda q: abs(q.front.height - relief.front.height))
        level = float(near.box.center[2]) / near.front.height
    if extent.at_edge:
        level = 1.0
    pairs = box.size[0] > s * config.wide and 2 * extent.along < config.both * box.size[0]
    wants_two = _pairs(alike) if alike else pairs
    for ratio in dict.fromkeys((level, *config.trials.levels)):
        v = float(box.low[2]) + ratio * height
        if wants_two:
            apart = [float(box.low[0]) + part * float(box.size[0]) for part in (0.25, 0.75)]
            yield from _fitting(relief, extent, [(u, v) for u in apart], "top", "two on a wide drawer", config)
        for aside in config.trials.drawer_shifts:
            u = middle + aside * float(box.size[0])
            yield from _fitting(relief, extent, [(u, v)], "top", "centred on the drawer", config)


def _pairs(siblings: Sequence[Sibling]) -> bool:
    """Whether the model's drawers have two handles each."""
    return len(siblings) >= 2 * len({id(s.front) for s in siblings})


def _on_door(
    relief: Relief, extent: Extent, siblings: Sequence[Sibling], side: Side, config: HandleConfig
) -> Iterator[Spot]:
    box, above = relief.outline, _above(side, extent.turns, extent)
    alike = [q for q in siblings if q.front.held in ("left", "right")]
    upright = extent.turns and (not alike or any(q.is_upright for q in alike))
    if not upright:
        above = _above(side, False, extent)
    tall = extent.along if upright else extent.across
    heights = [*_sibling_heights(relief, alike, config), _usual_height(relief, tall, config)]
    heights.append(float(box.center[2]))
    why = "opposite the hinge" if relief.front.hinge else "at the edge that it is pushed from"
    for inset in _insets(relief, extent, alike, upright, config):
        u = float(box.low[0]) + inset if side == "left" else float(box.high[0]) - inset
        for height in dict.fromkeys(heights):
            for aside in config.trials.shifts:
                v = height + aside * float(box.size[2])
                yield from _fitting(relief, extent, [(u, v)], above, why, config)


def _insets(
    relief: Relief, extent: Extent, alike: Sequence[Sibling], upright: bool, config: HandleConfig
) -> list[float]:
    """Returns how far from the free edge the handle's middle may lie, best first."""
    s, box = relief.factor, relief.outline
    wide = extent.across if upright else extent.along
    if extent.at_edge:
        return [wide / 2 + s * config.margin]
    usual = min(s * config.inset, config.inset_ratio * float(box.size[0]))
    if not upright:
        usual = max(usual, wide / 2 + config.end_inset_ratio * usual)
    found = [_sibling_inset(q) for q in alike]
    return list(dict.fromkeys([*found[:1], *(ratio * usual for ratio in config.trials.insets)]))


def _sibling_inset(sibling: Sibling) -> float:
    u = float(sibling.box.center[0])
    return u if sibling.front.held == "left" else sibling.front.width - u


def _sibling_heights(relief: Relief, alike: Sequence[Sibling], config: HandleConfig) -> list[float]:
    """Returns how high the handle of the most similar door would be on this one."""
    if not alike:
        return []
    front, box = relief.front, relief.outline
    near = min(
        alike, key=lambda q: abs(q.front.height - front.height) + abs(float(q.front.origin[2] - front.origin[2]))
    )
    v, height = float(near.box.center[2]), near.front.height
    if abs(v / height - 0.5) < config.central:
        return [float(box.low[2]) + v / height * float(box.size[2])]
    if v > height / 2:
        return [float(box.high[2]) - (height - v)]
    return [float(box.low[2]) + v]


def _usual_height(relief: Relief, tall: float, config: HandleConfig) -> float:
    """Returns v of the handle's middle on a door of which nothing else is known."""
    s, box, front = relief.factor, relief.outline, relief.front
    low, high = float(box.low[2]), float(box.high[2])
    height = high - low
    if float(front.up[2]) < config.lid or height <= s * config.short:
        return (low + high) / 2
    lower_edge = float(front.origin[2]) + low - relief.floor  # above the floor
    end = min(s * config.from_end, config.from_end_ratio * height) + tall / 2
    wanted = s * config.reach_height - lower_edge
    if height >= s * config.tall:
        end = config.tall_end_ratio * height
        return low + min(max(wanted, end), height - end)
    if wanted >= height:
        return high - end
    return low + end if wanted <= 0 else low + min(max(wanted, end), height - end)


def _on_flap(relief: Relief, extent: Extent, side: Side, config: HandleConfig) -> Iterator[Spot]:
    s, box = relief.factor, relief.outline
    usual = min(s * config.inset, config.inset_ratio * float(box.size[2]))
    insets = (
        [extent.across / 2 + s * config.margin] if extent.at_edge else [ratio * usual for ratio in config.trials.insets]
    )
    for inset in insets:
        v = float(box.low[2]) + inset if side == "bottom" else float(box.high[2]) - inset
        for aside in config.trials.shifts:
            u = float(box.center[0]) + aside * float(box.size[0])
            above = _above(side, False, extent)
            yield from _fitting(relief, extent, [(u, v)], above, "at the free edge", config)


def _fitting(
    relief: Relief,
    extent: Extent,
    places: Sequence[tuple[float, float]],
    above: Side,
    why: str,
    config: HandleConfig,
) -> Iterator[Spot]:
    """Yields the spot with its places moved inside the outline, unless the handle is too large for it."""
    box, margin = relief.outline, relief.factor * config.margin
    level = above in ("top", "bottom")
    half = np.array([extent.along, extent.across] if level else [extent.across, extent.along]) / 2 + margin
    low, high = box.low[[0, 2]] + half, box.high[[0, 2]] - half
    if np.all(low <= high):
        inside = [np.clip(place, low, high) for place in places]
        yield Spot(tuple((float(u), float(v)) for u, v in inside), above, why)
