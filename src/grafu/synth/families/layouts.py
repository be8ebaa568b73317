"""Layouts of bare fronts of many families: doors across a width, stacks and rows of drawers, a free grammar.

Hinges, leaves and handles are left at their defaults: `carpentry` decides them.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from grafu.synth.fronts.gliding import Sliding
from grafu.synth.fronts.hold import HandleStyle
from grafu.synth.fronts.layout import Between, Blank, CellRow, Door, Drawer, Layout, OpenCell, Pair, Stack
from grafu.synth.sampling.carpentry import drawer_heights
from grafu.synth.sampling.chance import between, chance, count, pick, weights
from grafu.synth.sampling.style import MakerStyle

WIDEST_DOOR = 0.62  # metres: wider single doors are rare, wider openings have a pair
WIDEST_PAIR = 1.15
WIDE, THREE_LEAVES = 1.7, 0.4  # metres; of sliding doors across more than that: three leaves
LEAST_POCKET, POCKETS = 0.9, 0.1  # metres; of wider pieces with sliding doors: one goes into a pocket
LEAST_BESIDE, ALONE = 1.2, 0.6  # metres; of wider pieces with sliding doors: nothing beside these
BEHIND = 0.09  # doors of deep cases with drawers behind them: of 41 development models three
INNER_TRAYS = 0.5  # of those: pull-out shelves, low trays far above each other
INNER_KNOBS: Mapping[HandleStyle, float] = {
    "knob-round": 1.0,
    "none": 2.0,
}  # drawers behind doors are low: their handles must fit the room


def doors_across(rng: np.random.Generator, width: float) -> Layout:
    """Returns one door, a pair, or a row of them, as many as a carpenter would put across this width."""
    if width < 0.4 or (width < WIDEST_DOOR and chance(rng, 0.55)):
        return Door()
    if width < WIDEST_PAIR:
        return Pair() if chance(rng, 0.86) else CellRow((Door(), Door()))
    number = max(2, round(width / between(rng, (0.4, 0.6))))
    pairs, single = divmod(number, 2)
    cells: list[Layout] = [Pair()] * pairs
    if chance(rng, 0.25):
        return CellRow((Door(),) * number)
    if single:
        cells.insert(pick(rng, {0: 1.0, pairs: 1.0}), Door())
    return CellRow(tuple(cells), tuple(1.0 if isinstance(cell, Door) else 2.0 for cell in cells))


def drawer_stack(rng: np.random.Generator, style: MakerStyle, number: int) -> Layout:
    """Returns drawers above each other, parted as the style states."""
    if number == 1:
        return Drawer()
    return Stack((Drawer(),) * number, drawer_heights(rng, number), style.between)


def drawer_row(rng: np.random.Generator, number: int, spread: float = 0.0) -> Layout:
    """Returns drawers side by side, parted by panels: their slides need a wall."""
    if number == 1:
        return Drawer()
    return CellRow((Drawer(),) * number, weights(rng, number, spread))


def drawer_grid(rng: np.random.Generator, style: MakerStyle, columns: int, rows: int) -> Layout:
    """Returns drawers in rows, or in columns parted by uprights from top to bottom."""
    if columns == 1:
        return drawer_stack(rng, style, rows)
    if chance(rng, 0.5):
        return CellRow((drawer_stack(rng, style, rows),) * columns)
    row = drawer_row(rng, columns)
    return Stack((row,) * rows, drawer_heights(rng, rows), _level(style))


def doors_under_drawers(rng: np.random.Generator, style: MakerStyle, width: float, height: float) -> Layout:
    """Returns doors with a drawer above, or one above each door, or a false front."""
    below = doors_across(rng, width)
    number = 1 if width < 0.6 or chance(rng, 0.45) else 2 if width < 1.3 else round(width / 0.55)
    above = drawer_row(rng, number) if chance(rng, 0.9) else Blank()
    ratio = between(rng, (0.13, 0.19)) / max(height - 0.1, 0.3)
    return Stack((below, above), (1.0 - ratio, ratio), _level(style))


def doors_beside_drawers(rng: np.random.Generator, style: MakerStyle, width: float, number: int) -> Layout:
    """Returns a stack of drawers with doors on one side of it or on both."""
    drawers = drawer_stack(rng, style, number)
    if width > 1.0 and chance(rng, 0.5):
        if chance(rng, 0.65):
            return CellRow((Door(), drawers, Door()), (1.0, between(rng, (0.8, 1.5)), 1.0))
        side = drawer_stack(rng, style, number)
        return CellRow((side, Pair(), side), (1.0, between(rng, (1.2, 2.0)), 1.0))
    doors: Layout = Pair() if width > 0.9 and chance(rng, 0.6) else Door()
    cells = (doors, drawers) if chance(rng, 0.5) else (drawers, doors)
    wide = 1.5 if isinstance(doors, Pair) else 1.0
    return CellRow(cells, (wide, 1.0) if cells[0] is doors else (1.0, wide))


def free_layout(rng: np.random.Generator, style: MakerStyle, width: float, height: float, depth: int = 3) -> Layout:
    """Returns a random layout: the opening is split into rows and stacks down to `depth`, each cell then filled."""
    splits = {"row": max(width - 0.5, 0.0), "stack": max(height - 0.45, 0.0), "leaf": 0.4 if depth < 3 else 0.1}
    kind = pick(rng, splits) if depth > 0 else "leaf"
    if kind == "leaf":
        return free_leaf(rng, style, width, height)
    number = count(rng, 2, 3) if (width if kind == "row" else height) > 0.9 else 2
    ratios = weights(rng, number, pick(rng, {0.0: 0.5, 0.4: 0.5})) or (1.0,) * number
    whole = sum(ratios)
    if kind == "row":
        cells = tuple(free_layout(rng, style, width * ratio / whole, height, depth - 1) for ratio in ratios)
        return CellRow(cells, ratios)
    cells = tuple(free_layout(rng, style, width, height * ratio / whole, depth - 1) for ratio in ratios)
    return Stack(cells, ratios, "panel" if any(isinstance(cell, OpenCell) for cell in cells) else _level(style))


def free_leaf(rng: np.random.Generator, style: MakerStyle, width: float, height: float) -> Layout:
    """Returns what fills one opening of this size: doors, drawers, a flap, or nothing."""
    low = height < 0.3
    kinds = {
        "doors": 0.1 if low else 4.0,
        "drawers": 3.0 if height < 1.2 else 0.2,
        "flap": 1.0 if height < 0.55 and width > 1.4 * height else 0.02,
        "bay": 1.2,
    }
    match pick(rng, kinds):
        case "doors":
            return doors_across(rng, width)
        case "drawers":
            number = max(1, round(height / between(rng, (0.14, 0.3))))
            return drawer_grid(rng, style, 2, number) if width > 1.0 else drawer_stack(rng, style, min(number, 5))
        case "flap":
            return Door("top" if chance(rng, 0.4) else "bottom")
        case _:
            return OpenCell()


def sliding_across(rng: np.random.Generator, width: float, ratio: float = THREE_LEAVES) -> Sliding:
    """Returns sliding doors across a width: two leaves, three (in this fraction of draws) where it is wide."""
    return Sliding(leaves=3 if width > WIDE and chance(rng, ratio) else 2)


def sliding_or(rng: np.random.Generator, ratio: float, width: float, barn: float = 0.0) -> Layout | None:
    """Returns sliding doors as the whole front, at these chances in the opening or before it; None otherwise.

    Two leaves close all of it, or its middle or one side beside open shelves or drawers.
    """
    kind = pick(rng, {"none": 1.0 - ratio - barn, "bypass": ratio, "barn": barn})
    if kind == "none":
        return None
    if kind == "barn":
        return Sliding("barn", 1)
    if width > LEAST_POCKET and chance(rng, POCKETS):
        return Sliding("pocket", 1)
    doors = sliding_across(rng, width)
    if width < LEAST_BESIDE or chance(rng, ALONE):
        return doors
    aside: Layout = OpenCell() if chance(rng, 0.5) else Stack((Drawer(),) * count(rng, 2, 3), (), "nothing")
    if width > WIDE and chance(rng, 0.4):
        return CellRow((aside, Sliding(), aside), (1.0, between(rng, (2.0, 3.0)), 1.0))
    cells: tuple[Layout, ...] = (aside, doors) if chance(rng, 0.5) else (doors, aside)
    return CellRow(cells, tuple(1.0 if cell is aside else between(rng, (1.8, 2.8)) for cell in cells))


def _level(style: MakerStyle) -> Between:
    """Returns what lies between rows of fronts: what the style puts there."""
    return style.between


def with_inner_drawers(rng: np.random.Generator, layout: Layout, width: float) -> Layout:
    """Returns the layout with drawers, and open room above them, behind a few of its doors; seldom."""
    match layout:
        case CellRow(cells=cells):
            ratios = layout.weights or (1.0,) * len(cells)
            widths = [width * ratio / sum(ratios) for ratio in ratios]
            return replace(layout, cells=tuple(map(partial(with_inner_drawers, rng), cells, widths)))
        case Stack(cells=cells):
            return replace(layout, cells=tuple(with_inner_drawers(rng, cell, width) for cell in cells))
        case Door(hinge="left" | "right") | Pair():
            if width > 0.35 and layout.behind is None and chance(rng, BEHIND):
                return replace(layout, behind=_inner_drawers(rng))
    return layout


def _inner_drawers(rng: np.random.Generator) -> Layout:
    if chance(rng, INNER_TRAYS):
        return Stack((Drawer(box="tray", handle="none"),) * count(rng, 1, 3), between="nothing")
    knob = pick(rng, INNER_KNOBS)
    drawers = (Drawer(handle=knob),) * count(rng, 1, 3)
    return Stack((*drawers, OpenCell()), (*(1.0 for _ in drawers), between(rng, (1.0, 3.0))))
