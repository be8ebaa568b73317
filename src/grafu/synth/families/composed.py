"""Pieces of several cabinets: hutches on a base, kitchen islands with two fronts, rows of kitchen units."""

from dataclasses import replace
from math import pi

import numpy as np

from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.cabinets.ensemble import Ensemble, Placed, Slab
from grafu.synth.case.construction import Base
from grafu.synth.families.bedroom import OVER
from grafu.synth.families.built import build_cabinet, cabinet_of
from grafu.synth.families.kitchen import BASE, KITCHEN, ON_WALL, base_layout, tall_layout, wall_layout
from grafu.synth.families.layouts import doors_across, doors_under_drawers, drawer_stack
from grafu.synth.families.living import GLASS, LIVING
from grafu.synth.fronts.layout import CellRow, Layout, OpenCell, Pair, Side, Stack
from grafu.synth.sampling.carpentry import PieceSite
from grafu.synth.sampling.casework import Build, draw_case
from grafu.synth.sampling.chance import between, chance, count, pick
from grafu.synth.sampling.style import MakerStyle, draw_style
from grafu.vocabulary import PartLabel

UNIT_WIDTHS = {0.3: 1.0, 0.4: 1.5, 0.45: 1.0, 0.5: 1.5, 0.6: 3.0, 0.8: 1.5, 0.9: 1.0}  # metres: the trade's modules

PLAIN_UNITS = 0.75  # of kitchens: with all that single cabinets have, many would have more parts than a model may have
WALL_PANEL = 0.85  # of kitchens with wall units: what hangs on a wall is mostly drawn with a piece of it
FILLER = 0.05  # metres between base units and a tall one: a door beside it opens square, its handle has room


def hutch(rng: np.random.Generator) -> Ensemble:
    """Returns a buffet: a shallower cabinet, open, glazed or closed, on a deeper one."""
    style = draw_style(rng, LIVING)
    width, depth, height = between(rng, (0.8, 1.7)), between(rng, (0.4, 0.55)), between(rng, (0.75, 0.95))
    low = build_cabinet(
        rng, "hutch", style, (width, depth, height), doors_under_drawers(rng, style, width, height),
        replace(OVER, tops=("over",), moulded=False), PieceSite(hand=0.9),
    )  # fmt: skip
    shelf = replace(style, frame=0.0, mount="overlay") if chance(rng, 0.3) else style
    above = (width * between(rng, (0.9, 1.0)), depth * between(rng, (0.55, 0.75)), between(rng, (0.7, 1.15)))
    doors: Layout = Pair(leaf=pick(rng, GLASS)) if chance(rng, 0.55) else doors_across(rng, above[0])
    layout = pick(rng, {"doors": 0.5, "open": 0.2, "bay below": 0.3})
    fronts = {
        "doors": doors,
        "open": CellRow((OpenCell(shelves=2), OpenCell(shelves=2))) if above[0] > 0.9 else OpenCell(shelves=2),
        "bay below": Stack((OpenCell(), doors), (1.0, between(rng, (1.5, 3.0)))),
    }[layout]
    high = build_cabinet(
        rng, "hutch", shelf, above, fronts, Build(bases=("none",), tops=("over", "between")), PieceSite(hand=0.2)
    )
    back = (depth - above[1]) / 2
    return Ensemble("hutch", (Placed(low), Placed(high, (0.0, back, height))))


def island(rng: np.random.Generator) -> Cabinet:
    """Returns a kitchen island: fronts to -Y, and fronts or open shelves to +Y, under one worktop."""
    style = replace(draw_style(rng, KITCHEN), moulding=0.0, leaf="slab" if chance(rng, 0.3) else "shaker")
    size = between(rng, (0.9, 1.9)), between(rng, (0.6, 1.0)), between(rng, (0.8, 0.95))
    other = OpenCell(shelves=count(rng, 1, 3)) if chance(rng, 0.5) else doors_across(rng, size[0])
    build = Build(("toe kick", "plinth", "none", "legs"), ("over",), legs=(0.05, 0.12), top_thickness=(0.02, 0.05))
    case = draw_case(rng, style, size, build)
    front = _island_front(rng, style, size[0], size[2])
    return cabinet_of(rng, "island", style, case, front, PieceSite(hand=0.95), rear=other)


def _island_front(rng: np.random.Generator, style: MakerStyle, width: float, height: float) -> Layout:
    if width > 1.2 and chance(rng, 0.5):
        return CellRow((drawer_stack(rng, style, 3), doors_across(rng, width * 0.6)), (1.0, between(rng, (1.2, 2.0))))
    return doors_under_drawers(rng, style, width, height) if chance(rng, 0.6) else doors_across(rng, width)


def kitchen_units(rng: np.random.Generator) -> Ensemble:
    """Returns kitchen units side by side under one worktop, mostly wall units above, now and then a tall one."""
    style = replace(
        draw_style(rng, KITCHEN),
        moulding=0.0,
        reveal=None,
        runners=False,
        bare=chance(rng, PLAIN_UNITS),
        opening=pi / 2,
    )  # further doors would strike neighbours
    height, depth = between(rng, (0.72, 0.88)), between(rng, (0.52, 0.62))
    widths = [pick(rng, UNIT_WIDTHS) for _ in range(3 if chance(rng, 0.3) else 2)]
    whole = sum(widths)
    build = replace(BASE, tops=("between", "none", "stretchers"), bases=("plinth", "toe kick"))
    lows = [_unit(rng, style, (w, depth, height), build) for w in widths]
    base = lows[0].case.base
    lows = [_flush(unit, base) for unit in lows]
    members = [Placed(unit, (x, 0.0, 0.0)) for unit, x in zip(lows, _middles(widths), strict=True)]
    reach = -depth / 2 - style.front - style.seat - style.panel - 0.015
    thick = between(rng, (0.02, 0.04))
    top = Slab(PartLabel.TOP_PANEL, "worktop", (-whole / 2, reach, height), (whole / 2, depth / 2, height + thick))
    boards = [top]
    tall_side = pick(rng, {0: 0.7, -1: 0.15, 1: 0.15})
    if chance(rng, 0.65 if len(widths) == 2 else 0.3):
        hung = _wall_units(rng, style, widths, depth, height + thick + between(rng, (0.45, 0.6)), tall_side)
        members += hung
        if hung and chance(rng, WALL_PANEL):
            panel = _wall_panel(rng, hung, whole, (depth / 2, height + thick))
            boards = [replace(top, high=(whole / 2, panel.low[1], height + thick)), panel]
    if tall_side:
        width = pick(rng, UNIT_WIDTHS)
        size = (width, depth, between(rng, (1.9, 2.2)))
        tall = build_cabinet(
            rng, "kitchen", style, size, tall_layout(rng, style, size), replace(build, tops=("between",))
        )
        members.append(Placed(_flush(tall, base), (tall_side * (whole / 2 + FILLER + width / 2), 0.0, 0.0)))
        boards.append(_filler(tall_side * whole / 2, tall_side, depth, (base.height, height)))
    return Ensemble("kitchen", tuple(members), tuple(boards))


def _unit(rng: np.random.Generator, style: MakerStyle, size: tuple[float, float, float], build: Build) -> Cabinet:
    return build_cabinet(rng, "kitchen", style, size, base_layout(rng, style, size), build)


def _filler(x: float, side: int, depth: float, heights: tuple[float, float]) -> Slab:
    """Returns the board between the base units, that end at x, and a tall unit: handles need the room it closes."""
    low, high = sorted((x, x + side * FILLER))
    y = -depth / 2
    return Slab(PartLabel.BAR, "filler", (low, y, heights[0]), (high, y + 0.018, heights[1]))


def _wall_panel(rng: np.random.Generator, hung: list[Placed], width: float, edge: tuple[float, float]) -> Slab:
    """Returns the board behind wall units, from the worktop's back edge (y, z) up, which joins the two."""
    backs = (unit.spec.case.back for unit in hung)
    y = edge[0] + max(back.thickness if back.planted else 0.0 for back in backs)
    ratio = 1.0 if chance(rng, 0.5) else between(rng, (0.1, 0.5))  # a splashback ends behind the units
    top = max(unit.at[2] + ratio * unit.spec.case.height for unit in hung)
    high = (width / 2, y + between(rng, (0.006, 0.02)), top)
    return Slab(PartLabel.MISC, "wall_panel", (-width / 2, y, edge[1] - 0.02), high)


def _flush(unit: Cabinet, base: Base) -> Cabinet:
    """Returns the unit on this base, with nothing that juts out beyond its fronts into its neighbours' doors."""
    case = unit.case
    plain = replace(case, base=base, bottom=replace(case.bottom, overhang=0.0), top=replace(case.top, overhang=0.0))
    return replace(unit, case=plain)


def _wall_units(
    rng: np.random.Generator, style: MakerStyle, widths: list[float], depth: float, low: float, tall_side: int
) -> list[Placed]:
    """Returns wall units over the base units, flush with the back."""
    high, deep = between(rng, (0.4, 0.8)), between(rng, (0.3, 0.37))
    build = Build(bases=("none",), tops=("between",), moulded=False)
    placed = []
    for k, (width, x) in enumerate(zip(widths, _middles(widths), strict=True)):
        if chance(rng, 0.12):
            continue  # a hood, a window
        wall: Side | None = (
            "left" if tall_side < 0 and k == 0 else "right" if tall_side > 0 and k == len(widths) - 1 else None
        )
        size = (width, deep, high)
        unit = build_cabinet(
            rng, "kitchen", style, size, wall_layout(rng, style, size), build, PieceSite(wall, ON_WALL.hand)
        )
        placed.append(Placed(_flush(unit, unit.case.base), (x, (depth - deep) / 2, low)))
    return placed


def _middles(widths: list[float]) -> list[float]:
    starts = np.cumsum([0.0, *widths[:-1]]) - sum(widths) / 2
    return [float(start) + width / 2 for start, width in zip(starts, widths, strict=True)]
