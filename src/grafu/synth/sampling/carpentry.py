"""What a carpenter decides front by front: which side a door hangs on, where its handle sits, what it looks like.

Families give layouts of bare fronts; `fitted` returns them with hinges, leaves, handles, grips, shelves in the style
of the piece. A hinge is drawn first and the handle follows it, so that what a handle tells about its hinge has the
rates stated here. It builds no geometry.
"""

from collections.abc import Iterator
from dataclasses import field, replace
from math import pi
from typing import Literal, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.synth.fronts.gliding import Folding, Lift, PullOut, Sliding, WasteBins
from grafu.synth.fronts.layout import Blank, CellRow, Door, Drawer, Layout, OpenCell, Pair, Rect, Side, Stack, Tilt
from grafu.synth.sampling.chance import between, chance, pick
from grafu.synth.sampling.fit_gliding import fit_folding, fit_lift, fit_pull_out, fit_sliding
from grafu.synth.sampling.fittings import fit_bay, fit_blank, fit_door, fit_drawer, fit_pair, fit_tilt
from grafu.synth.sampling.style import MakerStyle

Habit = Literal["outer", "left", "right"]

SAME_SIDE_PAIR = (
    0.015  # pairs whose doors both hang on one side: an error of modellers, or two single doors drawn as one
)
ROW_HABITS: dict[Habit, float] = {"outer": 0.86, "left": 0.07, "right": 0.07}  # doors side by side
MIXED_HABITS: dict[Habit, float] = {"outer": 0.4, "left": 0.3, "right": 0.3}  # doors beside drawers or open bays
LIKE_BELOW = 0.95  # a door above another one hangs on its side
WALL_SIDE = 0.85  # beside a wall or a tall unit a door hangs there, so that it opens to the room
SQUARE = pi / 2  # doors that hang beside another front open no further: their handles would strike
ARMS = 0.35  # of the rise of a lifted flap: its arms have half of it, and do not set off quite straight out
SMALLEST = 0.03  # metres: a lower or narrower opening has no front
NEAR = 0.02  # metres: openings whose sides agree to this stand above each other


@final
@dataclass(frozen=True, slots=True)
class CellPlace:
    """Where a cell stands: whether nothing is left (or right) of it in the whole piece, and its row's habit."""

    first: bool = True
    last: bool = True
    habit: Habit = "outer"


@final
@dataclass(frozen=True, slots=True)
class PieceSite:
    """What surrounds a piece: a wall (or tall unit) beside it, and the height of a hand in the piece's own frame.

    A hand is 1.05 m above the floor: above a base unit's doors, below a wall unit's.
    """

    wall: Side | None = None
    hand: float = 1.05


FREE = PieceSite()


@final
@dataclass(frozen=True, slots=True)
class _Fitter:
    rng: np.random.Generator
    style: MakerStyle
    site: PieceSite
    hung: list[tuple[float, float, Side]] = field(default_factory=list)  # x0, x1 and side of the doors so far

    def side(self, room: Rect, place: CellPlace) -> Side:
        """Returns the side of a single door, and remembers it for those above."""
        below = next((s for x0, x1, s in self.hung if abs(x0 - room.x0) + abs(x1 - room.x1) < NEAR), None)
        if below is not None and chance(self.rng, LIKE_BELOW):
            return below
        side = self._free_side(place)
        self.hung.append((room.x0, room.x1, side))
        return side

    def _free_side(self, place: CellPlace) -> Side:
        if self.site.wall is not None and chance(self.rng, WALL_SIDE):
            return self.site.wall
        if place.habit != "outer":
            return "left" if place.habit == "left" else "right"
        if place.first != place.last:
            return "left" if place.first else "right"
        return "left" if chance(self.rng, 0.5) else "right"


def fitted(rng: np.random.Generator, layout: Layout, room: Rect, style: MakerStyle, site: PieceSite = FREE) -> Layout:
    """Returns the layout of bare fronts, that divides this room, with every front decided.

    Doors with a level hinge (flaps) keep it; leaves and shelf counts that are not the default ones are kept too.

    Raises:
        ValueError: if some front is left no room.
    """
    return _fit(_Fitter(rng, style, site), layout, room, CellPlace())


def needed_gap(layout: Layout, room: Rect, front: float) -> float:
    """Returns the least gap, metres, in which every door's back edge turns past its neighbour: t squared over 2 w.

    It holds for leaves `front` metres thick that turn about their front edge.
    """
    swings = (swing for leaf, cell in _leaves(layout, room) if (swing := _swing(leaf, cell)))
    narrow = min(swings, default=1.0)
    return front**2 / (2 * narrow) + 0.0001


def _swing(leaf: Layout, cell: Rect) -> float:
    """Returns how far from its pin a leaf ends, metres; of a lifted flap the arms count. 0: it does not turn."""
    if isinstance(leaf, Lift):
        return ARMS * leaf.rise * cell.height
    if not isinstance(leaf, Door | Pair | Tilt | Folding):
        return 0.0
    return min(cell.width, cell.height) / (2 if isinstance(leaf, Pair | Folding) else 1)


def _leaves(layout: Layout, room: Rect) -> Iterator[tuple[Layout, Rect]]:
    if not isinstance(layout, CellRow | Stack):
        yield layout, room
        return
    for cell, part in _divided(layout, room):
        yield from _leaves(cell, part)


def _divided(layout: CellRow | Stack, room: Rect) -> Iterator[tuple[Layout, Rect]]:
    """Yields the cells and, to within the panels between them, their rooms."""
    ratios = layout.weights or (1.0,) * len(layout.cells)
    whole, start = sum(ratios), 0.0
    for cell, ratio in zip(layout.cells, ratios, strict=True):
        low, high = start / whole, (start + ratio) / whole
        if isinstance(layout, CellRow):
            yield cell, replace(room, x0=room.x0 + low * room.width, x1=room.x0 + high * room.width)
        else:
            yield cell, replace(room, z0=room.z0 + low * room.height, z1=room.z0 + high * room.height)
        start += ratio


def _fit(fitter: _Fitter, layout: Layout, room: Rect, place: CellPlace) -> Layout:
    rng, style, site = fitter.rng, fitter.style, fitter.site
    if not isinstance(layout, OpenCell) and min(room.width, room.height) < SMALLEST:
        raise ValueError(f"the layout leaves a front no room: got {room.width:.3f} x {room.height:.3f} m")
    match layout:
        case CellRow():
            return _fit_row(fitter, layout, room, place)
        case Stack():
            cells = tuple(_fit(fitter, cell, part, place) for cell, part in _divided(layout, room))
            return replace(layout, cells=cells)
        case Door():
            flap = layout.hinge in ("top", "bottom")
            side = layout.hinge if flap else fitter.side(room, place)
            door = fit_door(rng, layout, side, room, style, site.hand)
            clear = flap or (place.first if side == "left" else place.last)
            return door if clear else replace(door, opening=min(door.opening, SQUARE))
        case Pair():
            pair = _fit_pair(fitter, layout, room)
            if isinstance(pair, CellRow) or (place.first and place.last):
                return pair
            return replace(pair, opening=min(pair.opening, SQUARE))
        case Drawer():
            return fit_drawer(rng, layout, room, style)
        case Tilt():
            return fit_tilt(layout, style)
        case Sliding():
            return fit_sliding(rng, layout, room, style)
        case Folding():
            return fit_folding(rng, layout, room, style)
        case Lift():
            return fit_lift(rng, layout, room, style)
        case PullOut():
            return fit_pull_out(rng, layout, room, style)
        case WasteBins():
            return layout
        case Blank():
            return fit_blank(layout, room, style)
        case OpenCell():
            return fit_bay(rng, layout, room, style)


def _fit_row(fitter: _Fitter, row: CellRow, room: Rect, place: CellPlace) -> CellRow:
    last = len(row.cells) - 1
    habit = pick(fitter.rng, _habits(row)) if place.habit == "outer" else place.habit
    inner: Habit = "left" if chance(fitter.rng, 0.5) else "right"  # the side of doors between others
    cells = []
    for k, (cell, part) in enumerate(_divided(row, room)):
        first_here, last_here = place.first and k == 0, place.last and k == last
        own = habit if first_here or last_here or habit != "outer" else inner
        cells.append(_fit(fitter, cell, part, CellPlace(first_here, last_here, own)))
    return replace(row, cells=tuple(cells))


def _habits(row: CellRow) -> dict[Habit, float]:
    """Returns how often doors of this row hang where: with nothing but doors in it, they mostly mirror each other."""
    return ROW_HABITS if all(isinstance(cell, Door | Pair) for cell in row.cells) else MIXED_HABITS


def _fit_pair(fitter: _Fitter, pair: Pair, room: Rect) -> Pair | CellRow:
    rng, style = fitter.rng, fitter.style
    if pair.behind is None and chance(rng, SAME_SIDE_PAIR):
        side: Side = "left" if chance(rng, 0.5) else "right"
        halves = tuple(
            fit_door(rng, Door(side, pair.leaf, shelves=pair.shelves), side, part, style, fitter.site.hand)
            for part in _halves(room)
        )
        return CellRow(halves, between="panel")
    return fit_pair(rng, pair, room, style, fitter.site.hand)


def _halves(room: Rect) -> tuple[Rect, Rect]:
    return replace(room, x1=room.center[0]), replace(room, x0=room.center[0])


def drawer_heights(rng: np.random.Generator, number: int) -> tuple[float, ...]:
    """Returns fractions of the height for a stack of drawers, from the bottom: alike, deeper below, or flat on top."""
    pattern = pick(rng, {"alike": 0.45, "deeper below": 0.35, "flat top": 0.2})
    if pattern == "alike" or number == 1:
        return ()
    if pattern == "deeper below":
        step = between(rng, (0.08, 0.35))
        return tuple(1.0 + step * (number - 1 - k) for k in range(number))
    return (*(1.0 for _ in range(number - 1)), between(rng, (0.45, 0.75)))
