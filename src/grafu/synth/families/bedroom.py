"""Bedrooms and halls: wardrobes, dressers, nightstands, shoe cabinets, apothecary chests, chests with a lid."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.cabinets.chest import Chest
from grafu.synth.case.case import Case
from grafu.synth.families.built import build_cabinet, draw_size
from grafu.synth.families.layouts import doors_across, drawer_grid, drawer_row, drawer_stack, sliding_across
from grafu.synth.fronts.gliding import Folding
from grafu.synth.fronts.hold import Inside
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Layout, LeafStyle, OpenCell, Pair, Rect, Stack, Tilt
from grafu.synth.sampling.carpentry import PieceSite, fitted
from grafu.synth.sampling.casework import EDGES, ORNATE_EDGES, Build, draw_base
from grafu.synth.sampling.chance import between, chance, count, pick
from grafu.synth.sampling.style import MakerStyle, chunky, draw_style, pushed
from grafu.synth.sampling.traditions import TraditionName

BEDROOM: Mapping[TraditionName, float] = {
    "shaker": 0.24, "mid-century": 0.18, "flat-pack": 0.22, "minimal": 0.18, "ornate": 0.14, "frameless": 0.04
}  # fmt: skip
OVER = Build(tops=("over", "between"), legs=(0.06, 0.25))
LOW_LEGS = Build(tops=("between", "over"), legs=(0.05, 0.16), bases=("none", "plinth", "legs"))
HANGING = Inside(rod=True)
DOMED = 0.2  # lids of chests, as of old travelling chests
SLIDING, FOLDING = 0.25, 0.04  # of wardrobes
SLIDING_MIRRORS = 0.2  # of sliding wardrobes: mirrors are what they are bought for
MIRRORS = 0.06  # wardrobe doors with a mirror
# nightstands and dressers are a little below the hand of someone who stands before them
STAND = PieceSite(hand=0.9)


def wardrobe(rng: np.random.Generator) -> Cabinet:
    """Returns a wardrobe: tall doors in a row, sliding in one of four, folding in few; drawers below or beside them."""
    style = draw_style(rng, BEDROOM)
    kind = pick(rng, {"hinged": 1.0 - SLIDING - FOLDING, "sliding": SLIDING, "folding": FOLDING})
    widths = {"hinged": (0.6, 2.4), "sliding": (1.1, 2.6), "folding": (0.7, 1.2)}
    size = draw_size(rng, widths[kind], (0.5, 0.68) if kind == "sliding" else (0.45, 0.65), (1.6, 2.35))
    if kind != "hinged":
        return build_cabinet(rng, "wardrobe", style, size, _gliding(rng, style, kind, size[0]), LOW_LEGS)
    doors = _hung(rng, doors_across(rng, size[0]))
    kind = pick(rng, {"doors": 0.56, "drawers below": 0.22, "above": 0.13, "open": 0.09})
    if kind == "drawers below":
        number = max(1, round(size[0] / between(rng, (0.5, 0.9))))
        row = drawer_row(rng, number)
        low = (row,) * count(rng, 1, 2)
        layout: Layout = Stack((*low, doors), (*(0.14 for _ in low), 1.0), style.between)
    elif kind == "above":
        layout = Stack((doors, doors_across(rng, size[0])), (between(rng, (2.5, 4.5)), 1.0), style.between)
    elif kind == "open" and size[0] > 1.0:
        open_part = Stack((drawer_stack(rng, style, count(rng, 2, 4)), OpenCell()), (between(rng, (0.4, 1.0)), 1.0))
        layout = CellRow((doors, open_part) if chance(rng, 0.5) else (open_part, doors), (2.0, 1.0))
    else:
        layout = doors
    return build_cabinet(rng, "wardrobe", style, size, layout, LOW_LEGS)


def _gliding(rng: np.random.Generator, style: MakerStyle, kind: str, width: float) -> Layout:
    """Returns the sliding or folding doors of a wardrobe, above drawers or below doors now and then."""
    rod = HANGING if chance(rng, 0.5) else Inside()
    leaf: LeafStyle = "mirror" if chance(rng, SLIDING_MIRRORS) else "slab"
    doors: Layout = Folding("left" if chance(rng, 0.5) else "right", inside=rod, shelves=1)
    if kind == "sliding":
        doors = replace(sliding_across(rng, width), leaf=leaf, inside=rod, shelves=1 if rod.rod else 0)
    rest = pick(rng, {"doors": 0.72, "drawers below": 0.18, "above": 0.1})
    if rest == "drawers below":
        return Stack((drawer_row(rng, max(1, round(width / 0.7))), doors), (0.14, 1.0), style.between)
    if rest == "above":
        return Stack((doors, doors_across(rng, width)), (between(rng, (2.5, 4.5)), 1.0), "panel")
    return doors


def dresser(rng: np.random.Generator) -> Cabinet:
    """Returns a dresser: drawers in rows and columns, sometimes with a door beside them."""
    style = pushed(rng, draw_style(rng, BEDROOM), 0.38)
    style = chunky(rng, style, 0.07)
    size = draw_size(rng, (0.4, 1.7), (0.38, 0.55), (0.45, 1.35))
    width, _, height = size
    columns = 1 if width < 0.75 or (width < 1.15 and chance(rng, 0.25)) else 2 if width < 1.3 or chance(rng, 0.7) else 3
    rows = max(2, round(height / between(rng, (0.15, 0.28))))
    layout = drawer_grid(rng, style, columns, min(rows, 4 if columns == 3 else 6))
    if columns == 1 and width > 0.6 and chance(rng, 0.35):
        small = drawer_row(rng, 2 if chance(rng, 0.7) else 3)
        layout = Stack((*(Drawer(),) * (min(rows, 5) - 1), small), (), style.between)
    if columns > 1 and chance(rng, 0.12):
        layout = CellRow((layout, Door()), (float(columns), 1.0))
    return build_cabinet(rng, "dresser", style, size, layout, OVER, STAND)


def nightstand(rng: np.random.Generator) -> Cabinet:
    """Returns a nightstand: one to three drawers, an open bay, a door."""
    style = chunky(rng, pushed(rng, draw_style(rng, BEDROOM), 0.25), 0.28)
    size = draw_size(rng, (0.35, 0.8), (0.3, 0.48), (0.32, 0.75))
    kind = pick(rng, {"drawers": 0.45, "drawer over bay": 0.3, "drawer over door": 0.17, "door": 0.08})
    layouts: dict[str, Layout] = {
        "drawers": drawer_stack(rng, style, count(rng, 1, 3)),
        "drawer over bay": Stack((OpenCell(), Drawer()), (between(rng, (1.0, 2.0)), 1.0)),
        "drawer over door": Stack((Door(), Drawer()), (between(rng, (1.5, 2.5)), 1.0), style.between),
        "door": Door(),
    }
    tall_legs = chance(rng, 0.3) and size[2] > 0.55
    build = Build(tops=("over", "between"), legs=(0.25, 0.35) if tall_legs else (0.06, 0.2))
    return build_cabinet(rng, "nightstand", style, size, layouts[kind], build, STAND)


def shoe_cabinet(rng: np.random.Generator) -> Cabinet:
    """Returns a shoe cabinet: tilting fronts above each other, a drawer on top now and then."""
    style = draw_style(rng, {"flat-pack": 0.5, "minimal": 0.25, "frameless": 0.15, "shaker": 0.1})
    style = replace(style, moulding=0.0)
    size = draw_size(rng, (0.45, 1.1), (0.2, 0.36), (0.6, 1.3))
    rows = max(1, min(4, round(size[2] / between(rng, (0.32, 0.45)))))
    tilt: Layout = CellRow((Tilt(), Tilt())) if size[0] > 0.8 else Tilt()
    cells: tuple[Layout, ...] = (tilt,) * rows
    ratios: tuple[float, ...] = (1.0,) * rows
    if chance(rng, 0.3):
        cells, ratios = (*cells, drawer_row(rng, 2 if size[0] > 0.8 else 1)), (*ratios, 0.45)
    return build_cabinet(rng, "shoe_cabinet", style, size, Stack(cells, ratios), LOW_LEGS, STAND)


def apothecary(rng: np.random.Generator) -> Cabinet:
    """Returns a chest of many small drawers, to 24 of them."""
    style = pushed(rng, draw_style(rng, {"shaker": 0.45, "ornate": 0.25, "flat-pack": 0.2, "minimal": 0.1}))
    columns, rows = pick(
        rng,
        {
            (3, 3): 2.0,
            (3, 4): 2.0,
            (4, 3): 1.5,
            (4, 4): 1.5,
            (3, 5): 1.0,
            (5, 3): 1.0,
            (4, 5): 0.6,
            (5, 4): 0.6,
            (6, 3): 0.6,
            (4, 6): 0.4,
            (6, 4): 0.4,
        },
    )
    size = (columns * between(rng, (0.18, 0.3)), between(rng, (0.28, 0.45)), 0.1 + rows * between(rng, (0.13, 0.2)))
    if columns * rows > 12:  # each in a box of its own would make more parts than a model may have
        column = drawer_stack(rng, replace(style, between="nothing"), rows)
        return build_cabinet(rng, "apothecary", style, size, CellRow((column,) * columns), OVER, STAND)
    return build_cabinet(rng, "apothecary", style, size, drawer_grid(rng, style, columns, rows), OVER, STAND)


def chest(rng: np.random.Generator) -> Chest:
    """Returns a chest with a lid, long or cubic."""
    style = draw_style(rng, BEDROOM)
    size = draw_size(rng, (0.5, 1.3), (0.35, 0.55), (0.35, 0.6))
    base = draw_base(rng, style, size, Build(bases=("none", "plinth", "legs"), legs=(0.03, 0.1)))
    box = Case(width=size[0], depth=size[1], height=size[2], panel=max(style.panel, 0.012), base=base)
    within = chance(rng, 0.25)
    drawers: Layout | None = None
    if not within and size[2] > 0.42 and chance(rng, 0.2):
        number = 1 if size[0] < 0.7 else 2
        drawers = fitted(rng, drawer_row(rng, number), Rect(0.0, size[0], 0.0, 0.2), style, STAND)
    return Chest(
        box=box,
        lid=between(rng, (0.015, 0.04)),
        overhang=0.0 if within else between(rng, (0.0, 0.03)),
        opening=between(rng, (1.4, 1.75)),
        finish=style.finish,
        within=within,
        dome=between(rng, (0.03, 0.15)) if chance(rng, DOMED) else 0.0,
        edge="square" if within else pick(rng, ORNATE_EDGES if style.tradition == "ornate" else EDGES),
        drawers=drawers,
        drawers_ratio=between(rng, (0.35, 0.5)),
    )


def _hung(rng: np.random.Generator, layout: Layout) -> Layout:
    """Returns wardrobe doors with rods and few shelves behind, drawers inside now and then."""
    if isinstance(layout, CellRow):
        return replace(layout, cells=tuple(_hung(rng, cell) for cell in layout.cells))
    if not isinstance(layout, Door | Pair) or layout.behind is not None or chance(rng, 0.4):
        return layout
    return replace(layout, inside=HANGING, shelves=1, leaf="mirror" if chance(rng, MIRRORS) else "slab")
