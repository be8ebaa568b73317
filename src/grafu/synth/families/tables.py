"""Desks on pedestals, writing desks, tables with drawers under their tops, dressing tables."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.case.construction import Stretcher
from grafu.synth.case.legs import Leg, LegShape
from grafu.synth.families.built import Size, build_cabinet, draw_size
from grafu.synth.families.layouts import drawer_stack
from grafu.synth.fronts.layout import Between, CellRow, Door, Drawer, Layout, OpenCell, Rect, Stack
from grafu.synth.sampling.carpentry import PieceSite, fitted, needed_gap
from grafu.synth.sampling.casework import EDGES, ORNATE_EDGES, Build, draw_base, draw_leg
from grafu.synth.sampling.chance import Span, between, chance, count, only, pick, spread, weights
from grafu.synth.sampling.style import MakerStyle, draw_style, pushed
from grafu.synth.sampling.traditions import TraditionName
from grafu.synth.tables.desk import Desk
from grafu.synth.tables.drop_leaf import DropLeafTable, drawn_drop_leaf_table
from grafu.synth.tables.extending import ExtendingTable
from grafu.synth.tables.table import DrawerTable

HOME: Mapping[TraditionName, float] = {
    "shaker": 0.3, "mid-century": 0.22, "ornate": 0.2, "minimal": 0.18, "flat-pack": 0.1
}  # fmt: skip
DESK: Mapping[TraditionName, float] = {
    "office": 0.3, "minimal": 0.2, "mid-century": 0.17, "shaker": 0.13, "ornate": 0.1, "flat-pack": 0.1
}  # fmt: skip
STAND = PieceSite(hand=0.9)
ON_TABLE = Build(bases=("none",), tops=("between",), moulded=False, framed=False, open_back=True)
STRETCHERS: Mapping[Stretcher, float] = {"none": 0.6, "sides": 0.1, "H": 0.1, "box": 0.08, "shelf": 0.12}
TABLE_LEGS: tuple[LegShape, ...] = ("square", "tapered", "round", "cone", "turned", "splayed", "cabriole")
UPRIGHT_LEGS: tuple[LegShape, ...] = ("square", "tapered", "round", "cone", "turned")  # beside leaves that hang
# width, depth, height in metres, and how many drawers beside each other
TABLES: Mapping[str, tuple[Span, Span, Span, tuple[int, int]]] = {
    "side": ((0.35, 0.7), (0.35, 0.55), (0.45, 0.8), (1, 1)),
    "console": ((0.8, 1.5), (0.28, 0.45), (0.7, 0.9), (1, 4)),
    "coffee": ((0.8, 1.3), (0.5, 0.8), (0.35, 0.5), (1, 2)),
    "dining": ((1.3, 2.3), (0.75, 1.0), (0.68, 0.78), (1, 4)),
    "long": ((2.0, 3.0), (0.6, 1.05), (0.66, 0.78), (3, 6)),
}
TRAY_ZONE = 0.1  # metres: below a top, for a keyboard's tray and the hands on it
LOW_APRON = 0.06  # metres: a lower one has no room for bars and drawers
KINDS: Mapping[str, float] = {"side": 0.31, "console": 0.18, "coffee": 0.11, "dining": 0.1, "long": 0.34}
# metres: the height of a table's apron, from a pencil drawer's to a drawer's for cutlery or linen
APRONS: Mapping[str, Span] = {
    "side": (0.07, 0.22), "console": (0.042, 0.2), "coffee": (0.05, 0.18), "dining": (0.045, 0.14),
    "long": (0.045, 0.09),
}  # fmt: skip
# Of tables: bars above and below the drawers, a board lengthwise behind them (of those with drawers in a row), panels
# between drawers, a moulding around the top, a back that reaches further down (26608 has most of these)
RAILED, SPINED, PARTED, MOULDED, MODEST = 0.3, 0.45, 0.45, 0.12, 0.1
BOARDED = 0.5  # of tables with such bars: one board with an opening for each drawer (26608)
MIDDLE, TRAY, DESK_TRAY = 0.35, 0.5, 0.25  # of desks with something between their pedestals, a keyboard's tray (32052)
SWIVELLED = 0.3  # of mirrors on dressing tables
FLAT = 0.08  # of tables with drawers in a row: flat ones without fronts (26608)
THICK_LEGS = 0.4  # of small tables: legs and boards thick for their size (20411)


def desk(rng: np.random.Generator) -> Desk:
    """Returns a desk with one or two pedestals of drawers, a door now and then."""
    style = pushed(rng, draw_style(rng, DESK))
    size = draw_size(rng, (1.0, 1.9), (0.5, 0.85), (0.68, 0.78))
    pedestal = between(rng, (0.3, 0.48))
    both = size[0] > 1.2 and chance(rng, 0.5)
    room = Rect(0.0, pedestal, 0.05, size[2] - 0.05)
    bare = _pedestal(rng, style)
    twin = bare if chance(rng, 0.7) else _pedestal(rng, style)
    first = fitted(rng, bare, room, style, STAND)
    second = fitted(rng, twin, room, style, STAND) if both else None
    left, right = (first, second) if chance(rng, 0.5) else (second, first)
    base = draw_base(rng, style, (pedestal, *size[1:]), Build(("none", "plinth", "legs"), legs=(0.03, 0.12)))
    legs = _table_leg(rng, style, 0.5) if not both and chance(rng, 0.45) else None
    return Desk(
        width=size[0],
        depth=size[1],
        height=size[2],
        top=between(rng, (0.018, 0.06)),
        pedestal_width=pedestal,
        left=left,
        right=right,
        finish=style.finish,
        mount=style.mount,
        front=style.front,
        panel=style.panel,
        gap=max(style.gap, needed_gap(first, room, style.front)),
        edge=pick(rng, EDGES),
        legs=legs,
        middle=_middle(rng, style) if chance(rng, MIDDLE) else None,
        modesty=between(rng, (0.3, 0.9)) if chance(rng, 0.45) else 0.0,
        base=base,
        lift=between(rng, (0.03, 0.09)) if chance(rng, 0.12) else 0.0,
        wing=between(rng, (0.4, 0.8)) if right is None and legs is None and chance(rng, 0.15) else 0.0,
        hutch=_hutch(rng, style, size[0], size[1]) if chance(rng, 0.1) else None,
    )


def _pedestal(rng: np.random.Generator, style: MakerStyle) -> Layout:
    kind = pick(rng, {"drawers": 0.72, "door": 0.1, "mixed": 0.18})
    if kind == "drawers":
        return drawer_stack(rng, style, count(rng, 2, 4))
    if kind == "door":
        return Door()
    return Stack((Door(), Drawer()), (between(rng, (2.0, 3.0)), 1.0), style.between)


def _middle(rng: np.random.Generator, style: MakerStyle) -> Layout:
    """Returns what hangs between the pedestals: a drawer, two, or a keyboard tray without a front."""
    drawer = Drawer("tray", handle="none") if chance(rng, TRAY) else Drawer()
    bare: Layout = drawer if chance(rng, 0.8) else CellRow((Drawer(), Drawer()), between="nothing")
    return fitted(rng, bare, Rect(0.0, 0.5, 0.6, 0.7), style, STAND)


def writing_desk(rng: np.random.Generator) -> DrawerTable:
    """Returns a desk on legs with one to three drawers in its apron, a hutch on it now and then."""
    style = draw_style(rng, HOME)
    size = draw_size(rng, (0.8, 1.8), (0.45, 0.75), (0.7, 0.8))
    hutch = _hutch(rng, style, size[0], size[1]) if chance(rng, 0.2) else None
    return _table(rng, "writing_desk", style, size, count(rng, 1, 3), (0.034, 0.1), hutch=hutch)


def drawer_table(rng: np.random.Generator) -> DrawerTable:
    """Returns a table with drawers: side tables, consoles, dining and coffee tables, on one side or two."""
    style = draw_style(rng, HOME)
    kind = pick(rng, KINDS)
    *spans, numbers = TABLES[kind]
    two_sided = kind in ("dining", "coffee", "long") and chance(rng, 0.5)
    size = draw_size(rng, *spans)
    return _table(rng, "drawer_table", style, size, count(rng, *numbers), APRONS[kind], two_sided=two_sided)


def vanity(rng: np.random.Generator) -> DrawerTable:
    """Returns a dressing table with small drawers, mostly with a mirror, which swivels on three in ten of these."""
    style = draw_style(rng, HOME)
    size = draw_size(rng, (0.75, 1.3), (0.38, 0.55), (0.7, 0.8))
    mirror = between(rng, (0.4, 0.9)) if chance(rng, 0.75) else 0.0
    table = _table(rng, "vanity", style, size, count(rng, 2, 3), (0.06, 0.2), mirror=mirror)
    return replace(table, swivel=between(rng, (0.28, 0.6))) if mirror and chance(rng, SWIVELLED) else table


def drop_leaf_table(rng: np.random.Generator) -> DropLeafTable:
    """Returns a table with one leaf or two that hang from its top, straight or half round."""
    style = draw_style(rng, HOME)
    plain = drawn_drop_leaf_table(rng, "drop_leaf_table")
    leg = _table_leg(rng, style, min(plain.width, plain.depth), UPRIGHT_LEGS)
    return replace(
        plain,
        leg=min(leg.thick, plain.width / 5),
        leg_shape=leg.shape,
        leg_foot=leg.foot,
        finish=style.finish,
        is_round=chance(rng, 0.3),
    )


def extending_table(rng: np.random.Generator) -> ExtendingTable:
    """Returns a table whose halves slide apart, or with leaves that come out from under its top."""
    style = draw_style(rng, HOME)
    size = draw_size(rng, (1.0, 2.1), (0.7, 1.05), (0.7, 0.78))
    leg = _table_leg(rng, style, size[1])
    return ExtendingTable(
        "extending_table",
        "halves" if chance(rng, 0.5) else "draw leaves",
        *size,
        top=between(rng, (0.015, 0.035)),
        leg=max(leg.thick, 0.035),
        apron=between(rng, (0.06, 0.12)),
        travel=between(rng, (0.4, 0.8)),
        finish=style.finish,
        leg_shape=leg.shape,
        leg_foot=leg.foot,
    )


def _table(
    rng: np.random.Generator,
    name: str,
    style: MakerStyle,
    size: Size,
    number: int,
    apron: Span,
    two_sided: bool = False,
    hutch: Cabinet | None = None,
    mirror: float = 0.0,
) -> DrawerTable:
    """Returns a table with this many drawers in its apron."""
    width, depth, height = size
    thick = width < 0.8 and chance(rng, THICK_LEGS)
    leg = _table_leg(rng, style, min(width, depth))
    if thick:
        leg = replace(leg, thick=between(rng, (0.045, 0.08)))
    zone = min(spread(rng, apron), 0.35 * height)
    tray = number == 1 and name == "writing_desk" and chance(rng, DESK_TRAY)
    zone = max(zone, TRAY_ZONE) if tray else zone
    rails = between(rng, (0.1, 0.22)) * zone if chance(rng, RAILED) and zone > LOW_APRON and not tray else 0.0
    gaps: Between = "panel" if chance(rng, PARTED) else "nothing"
    drawers: Layout = CellRow((Drawer(),) * number, weights(rng, number, 0.2 if chance(rng, 0.3) else 0.0), gaps)
    if number == 1:
        drawers = Drawer("tray", handle="none") if tray else Drawer()
    elif chance(rng, FLAT) and not rails:
        drawers = CellRow((Drawer("tray", handle="none"),) * number, between=gaps)
    room = Rect(leg.thick - width / 2, width / 2 - leg.thick, height - zone, height)
    low = chance(rng, 0.25)
    return DrawerTable(
        name=name,
        width=width,
        depth=depth,
        height=height,
        top=between(rng, (0.03, 0.07) if thick else (0.015, 0.045)),
        leg=leg.thick,
        apron=zone,
        has_aprons=chance(rng, 0.85),
        two_sided=two_sided,
        layout=fitted(rng, drawers, room, style, STAND),
        finish=style.finish,
        leg_shape=leg.shape,
        leg_foot=leg.foot,
        overhang=between(rng, (0.01, 0.12 * depth)) if chance(rng, 0.6) else 0.0,
        outline="round" if chance(rng, 0.08) and depth > 0.6 else "straight",
        edge=pick(rng, ORNATE_EDGES if style.tradition in ("ornate", "shaker") else EDGES),
        glass=chance(rng, 0.03),
        stretcher=pick(rng, STRETCHERS) if height > 0.4 else "none",
        stretcher_at=between(rng, (0.08, 0.35)),
        arch=between(rng, (0.02, 0.05)) if chance(rng, 0.1) and not rails else 0.0,
        rails=rails,
        boarded=rails > 0 and chance(rng, BOARDED),
        spine=number > 1 and chance(rng, SPINED),
        moulding=between(rng, (0.01, 0.03)) if chance(rng, MOULDED) else 0.0,
        modesty=between(rng, (0.2, 0.7)) if chance(rng, MODEST) else 0.0,
        guides=low and chance(rng, 0.5),
        hutch=hutch,
        mirror=mirror,
        front=style.front,
        gap=style.gap,
    )


def _table_leg(
    rng: np.random.Generator, style: MakerStyle, side: float, shapes: tuple[LegShape, ...] = TABLE_LEGS
) -> Leg:
    """Returns a leg of a shape that carries tables; no feet and casters."""
    return replace(draw_leg(rng, style, side), shape=pick(rng, only(style.rules.leg, shapes)))


def _hutch(rng: np.random.Generator, style: MakerStyle, width: float, depth: float) -> Cabinet:
    """Returns the low cabinet that stands at the back of a desk: pigeonholes and small drawers."""
    size = (width * between(rng, (0.85, 1.0)), depth * between(rng, (0.3, 0.5)), between(rng, (0.18, 0.4)))
    middle: Layout = OpenCell() if chance(rng, 0.6) else Stack((Drawer(), OpenCell()), (1.0, between(rng, (0.8, 1.5))))
    side: Layout = _end(rng)
    layout = CellRow((side, middle, side), (1.0, between(rng, (1.0, 2.0)), 1.0))
    return build_cabinet(rng, "hutch", style, size, layout, ON_TABLE, STAND)


def _end(rng: np.random.Generator) -> Layout:
    """Returns what closes the ends of a hutch: drawers, a small door, or nothing."""
    sides: Mapping[Layout, float] = {Stack((Drawer(), Drawer())): 0.45, Door(): 0.2, OpenCell(): 0.2, Drawer(): 0.15}
    return pick(rng, sides)
