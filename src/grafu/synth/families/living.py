"""Living rooms: sideboards, TV stands, lowboards, bookcases, display cabinets, shelves, racks, pieces of any kind.

Racks have shelves between slats, uprights or ladders, over drawers or a door.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.cabinets.rack import Rack
from grafu.synth.case.construction import Sides
from grafu.synth.families.built import build_cabinet, cabinet_of, draw_size
from grafu.synth.families.layouts import (
    doors_across,
    doors_beside_drawers,
    drawer_row,
    drawer_stack,
    free_layout,
    sliding_or,
)
from grafu.synth.fronts.gliding import Sliding
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Layout, LeafStyle, OpenCell, Pair, Stack
from grafu.synth.sampling.carpentry import PieceSite
from grafu.synth.sampling.casework import Build, draw_case
from grafu.synth.sampling.chance import between, chance, count, pick, weights
from grafu.synth.sampling.style import MakerStyle, draw_style
from grafu.synth.sampling.traditions import TraditionName

RACKS: Mapping[TraditionName, float] = {"minimal": 0.6, "flat-pack": 0.4}
PLAIN = Build(
    ("none", "plinth", "legs"), ("between", "over"), (0.04, 0.15), open_back=True, framed=False, moulded=False
)
HELD = Build(("none",), ("between", "over"), framed=False, moulded=False)
STAND = PieceSite(hand=0.9)


def rack(rng: np.random.Generator) -> Cabinet | Rack:
    """Returns shelves over drawers or a door: one case throughout, or a small cabinet between uprights."""
    style = replace(draw_style(rng, RACKS), frame=0.0, moulding=0.0)
    return _cased(rng, style) if chance(rng, 0.45) else _held(rng, style)


def _cased(rng: np.random.Generator, style: MakerStyle) -> Cabinet:
    size = draw_size(rng, (0.45, 1.0), (0.28, 0.42), (1.1, 2.1))
    number = count(rng, 1, 3)
    case = replace(draw_case(rng, style, size, PLAIN), sides=Sides("slats" if chance(rng, 0.4) else "metal"))
    layout = Stack(
        (_low(rng, style, number), OpenCell(shelves=count(rng, 2, 4))), (0.22 * number, between(rng, (0.9, 1.4)))
    )
    return cabinet_of(rng, "rack", style, case, layout, STAND)


def _held(rng: np.random.Generator, style: MakerStyle) -> Rack:
    number = count(rng, 1, 3)
    size = (between(rng, (0.45, 0.95)), between(rng, (0.3, 0.42)), 0.04 + number * between(rng, (0.16, 0.26)))
    cabinet = build_cabinet(rng, "rack", style, size, _low(rng, style, number), HELD, STAND)
    lift = between(rng, (0.04, 0.35))
    return Rack(
        cabinet=cabinet,
        height=lift + size[2] + between(rng, (0.7, 1.3)),
        kind=pick(rng, {"ladder": 0.5, "pole": 0.2, "panel": 0.3}),
        upright=between(rng, (0.015, 0.03)),
        deep=between(rng, (0.02, 0.045)),
        lift=lift,
        shelves=count(rng, 2, 5),
        shelf=pick(rng, {style.panel: 0.6, 0.014: 0.4}),
        shelf_depth=between(rng, (0.55, 1.0)),
        brackets=chance(rng, 0.8),
        metal=chance(rng, 0.65),
    )


def _low(rng: np.random.Generator, style: MakerStyle, number: int) -> Layout:
    return drawer_stack(rng, style, number) if chance(rng, 0.75) else Door()


LIVING: Mapping[TraditionName, float] = {
    "shaker": 0.22, "mid-century": 0.26, "minimal": 0.2, "ornate": 0.14, "flat-pack": 0.14, "frameless": 0.04
}  # fmt: skip
LOW = Build(tops=("over", "between"), legs=(0.08, 0.3))
PLAIN_LOW = replace(LOW, tops=("between",))
TOPPED = 0.3  # lowboards of any build; the others are boxes without a top of their own
SLENDER = Build(tops=("between", "over"), legs=(0.04, 0.15), open_back=True, bases=("none", "plinth", "legs"))
ONE_FLAP = 0.5  # lowboards that a single flap closes, up to its widest in the trade
WIDEST_FLAP = 1.8  # metres
WIDEST_DRAWER = 1.7  # metres: wider TV stands have several beside each other
TOWERS = 0.2  # bookcases as narrow as one row of discs
CLOSED: Mapping[Layout, float] = {Door(): 3.0, Drawer(): 1.0, Stack((Drawer(), Drawer()), (), "nothing"): 1.0}
GLASS: Mapping[LeafStyle, float] = {"glass": 0.65, "muntins": 0.35}


# Of sideboards, TV stands and lowboards, and of bookcases; a door on a rail before the case, of the first two and these
SLIDING, FEW, BARN = 0.08, 0.02, 0.01
PANES, NARROWEST_SLIDING = 0.18, 0.7  # of display cabinets as wide as this, one in ten of all; metres


def sideboard(rng: np.random.Generator) -> Cabinet:
    """Returns a sideboard: doors, few of which slide, drawers beside or above them, an open bay now and then."""
    style = draw_style(rng, LIVING)
    size = draw_size(rng, (0.8, 2.0), (0.33, 0.5), (0.6, 1.0))
    width = size[0]
    kind = pick(rng, {"beside": 0.32, "above": 0.22, "doors": 0.2, "bay": 0.14, "flap": 0.12})
    sliding = sliding_or(rng, SLIDING, width, BARN)
    if sliding is not None:
        layout = sliding
    elif kind == "beside":
        layout = doors_beside_drawers(rng, style, width, count(rng, 2, 4))
    elif kind == "above":
        row = drawer_row(rng, 2 if width < 1.2 else count(rng, 2, 4))
        layout = Stack((doors_across(rng, width), row), (between(rng, (2.5, 4.0)), 1.0), style.between)
    elif kind == "doors":
        layout = doors_across(rng, width)
    elif kind == "flap":
        layout = _beside_flap(rng, style, width)
    else:
        bay: Layout = OpenCell() if chance(rng, 0.5) else Stack((Drawer(), OpenCell()), (1.0, between(rng, (1.0, 2.0))))
        cells: tuple[Layout, ...] = (Door(), bay, Door()) if width > 1.1 else (Door(), bay)
        layout = CellRow(cells, weights(rng, len(cells), 0.25))
    return build_cabinet(rng, "sideboard", style, size, layout, LOW, STAND)


def _beside_flap(rng: np.random.Generator, style: MakerStyle, width: float) -> Layout:
    """Returns a column whose upper front drops down as a bar's or a desk's does, with doors or drawers beside it."""
    below: Mapping[Layout, float] = {Pair(): 0.3, Drawer(): 0.35, OpenCell(): 0.2, Stack((Drawer(), Drawer())): 0.15}
    column = Stack((pick(rng, below), Door("bottom")), (between(rng, (0.8, 1.6)), 1.0), style.between)
    aside: Layout = drawer_stack(rng, style, count(rng, 2, 4)) if chance(rng, 0.45) else Door()
    cells: tuple[Layout, ...] = (column, aside) if chance(rng, 0.5) else (aside, column)
    if width > 1.3 and chance(rng, 0.6):
        cells = (Door(), column, aside)
    return CellRow(cells, tuple(between(rng, (1.2, 1.6)) if cell is column else 1.0 for cell in cells))


def tv_stand(rng: np.random.Generator) -> Cabinet:
    """Returns a low TV stand: open bays between drawers and doors, few of which slide."""
    style = draw_style(rng, LIVING)
    size = draw_size(rng, (1.0, 2.9), (0.33, 0.5), (0.3, 0.65))
    low = style.between
    fronts: Mapping[Layout, float] = {Door(): 0.45, Drawer(): 0.3, Stack((Drawer(), Drawer()), (), low): 0.25}
    closed = pick(rng, fronts)
    kind = pick(rng, {"sides": 0.45, "below": 0.23, "middle": 0.13, "row": 0.09, "drawers": 0.1})
    sliding = sliding_or(rng, SLIDING, size[0], BARN)
    if sliding is not None:
        layout: Layout = sliding
    elif kind == "sides":
        layout = CellRow((closed, OpenCell(), closed), (1.0, between(rng, (0.9, 1.8)), 1.0))
    elif kind == "below":
        layout = Stack((drawer_row(rng, count(rng, 2, 3)), OpenCell()), (between(rng, (0.8, 1.4)), 1.0))
    elif kind == "drawers" and size[0] < WIDEST_DRAWER:
        layout = drawer_stack(rng, style, count(rng, 1, 2))
    elif kind == "middle":
        layout = CellRow((OpenCell(), Pair() if isinstance(closed, Door) else closed, OpenCell()), (1.0, 1.4, 1.0))
    else:
        layout = CellRow((closed,) * count(rng, 2, 4))
    return build_cabinet(rng, "tv_stand", style, size, layout, LOW, STAND)


def lowboard(rng: np.random.Generator) -> Cabinet:
    """Returns a lowboard: flaps that drop down (mostly) or lift up, drawers or bays beside them."""
    style = draw_style(rng, {"minimal": 0.33, "frameless": 0.32, "mid-century": 0.16, "flat-pack": 0.19})
    size = draw_size(rng, (1.0, 2.9), (0.35, 0.5), (0.25, 0.6))
    flap = Door("bottom" if chance(rng, 0.8) else "top")
    columns = max(1, round(size[0] / between(rng, (0.6, 0.95))))
    if size[0] < WIDEST_FLAP and chance(rng, ONE_FLAP):
        columns = 1
    cells: list[Layout] = [flap] * columns
    if columns > 1 and chance(rng, 0.4):
        cells[count(rng, 0, columns - 1)] = OpenCell() if chance(rng, 0.5) else Drawer()
    if chance(rng, 0.3):
        cells = [Stack((cell, OpenCell()), (1.0, between(rng, (0.4, 0.8)))) for cell in cells]
    layout = CellRow(tuple(cells)) if columns > 1 else cells[0]
    layout = sliding_or(rng, SLIDING, size[0]) or layout
    return build_cabinet(rng, "lowboard", style, size, layout, LOW if chance(rng, TOPPED) else PLAIN_LOW, STAND)


def bookcase(rng: np.random.Generator) -> Cabinet:
    """Returns a bookcase: open shelves above doors or drawers."""
    style = draw_style(rng, LIVING)
    tower = chance(rng, TOWERS)
    size = draw_size(rng, (0.22, 0.4) if tower else (0.35, 1.6), (0.18, 0.3) if tower else (0.24, 0.42), (1.2, 2.2))
    width, _, height = size
    low: Layout = doors_across(rng, width) if chance(rng, 0.75) else drawer_stack(rng, style, count(rng, 1, 3))
    bay = OpenCell(shelves=max(2, round(0.65 * height / between(rng, (0.2, 0.4)))))
    above: Layout = bay
    if width > 0.9:
        above = CellRow((bay,) * (2 if width < 1.35 else 3))
    kind = pick(rng, {"below": 0.72, "all": 0.1, "middle": 0.18})
    sliding = sliding_or(rng, FEW, 0.0, BARN) if width > NARROWEST_SLIDING else None
    if sliding is not None:
        glazed = sliding if not isinstance(sliding, Sliding) else replace(sliding, pane=chance(rng, 0.5))
        layout: Layout = Stack((glazed, above), (1.0, between(rng, (1.3, 2.6))))
    elif kind == "all":
        layout = CellRow((doors_across(rng, width / 2), bay)) if width > 0.8 else doors_across(rng, width)
    elif kind == "middle":
        layout = Stack((OpenCell(shelves=1), low, replace(bay, shelves=2)), (1.0, 0.8, 1.4))
    else:
        layout = Stack((low, above), (1.0, between(rng, (1.3, 2.6))))
    return build_cabinet(rng, "bookcase", style, size, layout, SLENDER, STAND)


def display_cabinet(rng: np.random.Generator) -> Cabinet:
    """Returns a cabinet with glass doors or sliding panes, over all its height or above plain doors or drawers."""
    style = draw_style(rng, LIVING)
    size = draw_size(rng, (0.35, 1.4), (0.3, 0.45), (1.1, 2.1))
    glass = pick(rng, GLASS)
    slides = size[0] > NARROWEST_SLIDING and chance(rng, PANES)
    tall: Layout = Door(leaf=glass) if size[0] < 0.55 else Pair(leaf=glass)
    if size[0] > 1.1:
        tall = CellRow((Door(leaf=glass), Pair(leaf=glass)), (1.0, 2.0)) if chance(rng, 0.4) else Pair(leaf=glass)
    if slides:
        tall = Sliding(pane=True) if chance(rng, 0.6) else Sliding(leaf="glass")
    if chance(rng, 0.5):
        low = doors_across(rng, size[0]) if chance(rng, 0.6) else drawer_row(rng, 1 if size[0] < 0.7 else 2)
        ratio = between(rng, (1.5, 3.0)) if not isinstance(low, Drawer) else 6.0
        tall = Stack((low, tall), (1.0, ratio), style.between)
    return build_cabinet(rng, "display_cabinet", style, size, tall, replace(SLENDER, open_back=False))


def open_shelf(rng: np.random.Generator) -> Cabinet:
    """Returns an open shelf in a grid, a few of its cells closed by a door or a drawer."""
    style = draw_style(rng, {"minimal": 0.45, "flat-pack": 0.3, "mid-century": 0.15, "frameless": 0.1})
    columns, rows = count(rng, 1, 4), count(rng, 2, 5)
    pitch = between(rng, (0.3, 0.42))
    size = (columns * pitch * between(rng, (1.0, 1.3)), between(rng, (0.28, 0.42)), rows * pitch)
    closed = between(rng, (0.1, 0.45))

    def cell() -> Layout:
        if not chance(rng, closed):
            return OpenCell()
        return pick(rng, CLOSED)

    stacks = [Stack(tuple(cell() for _ in range(rows))) for _ in range(columns)]
    if all(isinstance(c, OpenCell) for stack in stacks for c in stack.cells):
        stacks[0] = replace(stacks[0], cells=(Door(), *stacks[0].cells[1:]))
    layout: Layout = CellRow(tuple(stacks)) if columns > 1 else stacks[0]
    return build_cabinet(rng, "open_shelf", style, size, layout, replace(SLENDER, moulded=False, framed=False), STAND)


def free_form(rng: np.random.Generator) -> Cabinet:
    """Returns a cabinet of any size whose front is split at random into rows and stacks."""
    style = draw_style(rng, dict.fromkeys(LIVING, 1.0) | {"office": 1.0, "face frame": 1.0})
    size = draw_size(rng, (0.4, 2.2), (0.3, 0.65), (0.4, 2.2))
    layout = free_layout(rng, style, size[0], size[2], count(rng, 2, 3) if size[0] * size[2] < 2.0 else 2)
    if isinstance(layout, OpenCell):
        layout = doors_across(rng, size[0])
    return build_cabinet(rng, "cabinet", style, size, layout)
