"""Offices and tables: filing cabinets, desks, writing desks, tables with drawers, vanities; fridges and ovens."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from grafu.synth.cabinet import Cabinet
from grafu.synth.carpentry import Site, fitted
from grafu.synth.casework import Build
from grafu.synth.chance import between, chance, count, pick, weights
from grafu.synth.desk import Desk
from grafu.synth.families.built import build_cabinet, draw_size
from grafu.synth.families.layouts import drawer_stack
from grafu.synth.layout import Blank, Door, Drawer, Layout, Pair, Rect, Row, Stack
from grafu.synth.style import Style, draw_style
from grafu.synth.table import Table
from grafu.synth.traditions import TraditionName

OFFICE: Mapping[TraditionName, float] = {"office": 0.5, "minimal": 0.2, "flat-pack": 0.2, "shaker": 0.1}
HOME: Mapping[TraditionName, float] = {
    "shaker": 0.3, "mid-century": 0.22, "ornate": 0.2, "minimal": 0.18, "flat-pack": 0.1
}  # fmt: skip
DESK: Mapping[TraditionName, float] = {
    "office": 0.3, "minimal": 0.2, "mid-century": 0.17, "shaker": 0.13, "ornate": 0.1, "flat-pack": 0.1
}  # fmt: skip
STAND = Site(hand=0.9)


def filing_cabinet(rng: np.random.Generator) -> Cabinet:
    """Returns a filing cabinet: two to five like drawers, the lowest deeper on pedestals on casters."""
    style = replace(draw_style(rng, OFFICE), leaf="slab", drawer_leaf="slab", frame=0.0)
    mobile = chance(rng, 0.45)
    size = draw_size(rng, (0.35, 0.5), (0.42, 0.65), (0.5, 0.75) if mobile else (0.7, 1.4))
    number = count(rng, 2, 3) if mobile else count(rng, 2, 5)
    shares = (2.0, *(1.0 for _ in range(number - 1))) if mobile and chance(rng, 0.6) else ()
    layout = Stack((Drawer(),) * number, shares, style.between)
    build = Build(bases=("legs", "none", "plinth"), legs=(0.03, 0.08), moulded=False, framed=False)
    return build_cabinet(rng, "filing_cabinet", style, size, layout, build, STAND)


def desk(rng: np.random.Generator) -> Desk:
    """Returns a desk with one or two pedestals of drawers, a door now and then."""
    style = draw_style(rng, DESK)
    width, depth, height = draw_size(rng, (1.0, 1.9), (0.5, 0.85), (0.7, 0.78))
    pedestal = between(rng, (0.3, 0.48))
    both = width > 1.25 and chance(rng, 0.5)
    room = Rect(0.0, pedestal, 0.05, height - 0.05)
    first = fitted(rng, _pedestal(rng, style), room, style, STAND)
    second = fitted(rng, _pedestal(rng, style), room, style, STAND) if both else None
    left, right = (first, second) if chance(rng, 0.5) else (second, first)
    return Desk(
        width=width,
        depth=depth,
        height=height,
        top=between(rng, (0.018, 0.06)),
        pedestal_width=pedestal,
        left=left,
        right=right,
        finish=style.finish,
    )


def _pedestal(rng: np.random.Generator, style: Style) -> Layout:
    kind = pick(rng, {"drawers": 0.72, "door": 0.1, "mixed": 0.18})
    if kind == "drawers":
        return drawer_stack(rng, style, count(rng, 2, 4))
    if kind == "door":
        return Door()
    return Stack((Door(), Drawer()), (between(rng, (2.0, 3.0)), 1.0), style.between)


def writing_desk(rng: np.random.Generator) -> Table:
    """Returns a desk on legs with one to three drawers in its apron."""
    style = draw_style(rng, HOME)
    size = draw_size(rng, (0.8, 1.5), (0.45, 0.75), (0.7, 0.8))
    return _table(rng, "writing_desk", style, size, count(rng, 1, 3), (0.09, 0.16), False)


def drawer_table(rng: np.random.Generator) -> Table:
    """Returns a table with drawers: side tables, consoles, dining and coffee tables, on one side or two."""
    style = draw_style(rng, HOME)
    kind = pick(rng, {"side": 0.38, "console": 0.25, "coffee": 0.17, "dining": 0.2})
    sizes = {
        "side": ((0.35, 0.7), (0.35, 0.55), (0.45, 0.8)),
        "console": ((0.8, 1.5), (0.28, 0.45), (0.7, 0.9)),
        "coffee": ((0.8, 1.3), (0.5, 0.8), (0.35, 0.5)),
        "dining": ((1.3, 2.3), (0.75, 1.0), (0.68, 0.78)),
    }
    number = {"side": 1, "console": count(rng, 1, 4), "coffee": count(rng, 1, 2), "dining": count(rng, 1, 4)}[kind]
    two_sided = kind in ("dining", "coffee") and chance(rng, 0.4)
    return _table(rng, "drawer_table", style, draw_size(rng, *sizes[kind]), number, (0.08, 0.22), two_sided)


def vanity(rng: np.random.Generator) -> Table:
    """Returns a dressing table with small drawers."""
    style = draw_style(rng, HOME)
    size = draw_size(rng, (0.75, 1.3), (0.38, 0.55), (0.7, 0.8))
    return _table(rng, "vanity", style, size, count(rng, 2, 3), (0.1, 0.2), False)


def _table(
    rng: np.random.Generator,
    name: str,
    style: Style,
    size: tuple[float, float, float],
    number: int,
    apron: tuple[float, float],
    two_sided: bool,
) -> Table:
    """Returns a table with this many drawers in its apron."""
    width, depth, height = size
    leg = min(between(rng, (0.03, 0.08)), width / 7)
    zone = min(between(rng, apron), 0.35 * height)
    drawers: Layout = Row((Drawer(),) * number, weights(rng, number, 0.2 if chance(rng, 0.3) else 0.0), "nothing")
    room = Rect(leg - width / 2, width / 2 - leg, height - zone, height)
    return Table(
        name=name,
        width=width,
        depth=depth,
        height=height,
        top=between(rng, (0.015, 0.045)),
        leg=leg,
        apron=zone,
        has_aprons=chance(rng, 0.85),
        two_sided=two_sided,
        layout=fitted(rng, drawers if number > 1 else Drawer(), room, style, STAND),
        finish=style.finish,
    )


def fridge(rng: np.random.Generator) -> Cabinet:
    """Returns a fridge-like box: one thick door or two above each other, or a pair over a drawer."""
    style = draw_style(rng, {"appliance": 1.0})
    style = replace(style, front=max(style.front, between(rng, (0.03, 0.08))), carry="middle", gap=0.006)
    tall = chance(rng, 0.75)
    size = draw_size(rng, (0.5, 0.92), (0.5, 0.65), (1.4, 2.0) if tall else (0.75, 0.95))
    kind = pick(rng, {"two": 0.6, "pair": 0.2, "one": 0.2}) if tall else "one"
    layouts: dict[str, Layout] = {
        "two": Stack((Door(), Door()), (between(rng, (0.5, 1.8)), 1.0), "panel"),
        "pair": Stack((Drawer(), Pair()), (1.0, between(rng, (1.5, 2.2))), "panel"),
        "one": Door(),
    }
    return build_cabinet(rng, "fridge", style, size, layouts[kind], Build(bases=("none", "plinth"), tops=("between",)))


def oven(rng: np.random.Generator) -> Cabinet:
    """Returns an oven- or dishwasher-like box: a door that drops down, a control panel above, a drawer below."""
    style = replace(draw_style(rng, {"appliance": 1.0}), carry="middle")
    size = draw_size(rng, (0.45, 0.75), (0.5, 0.62), (0.55, 0.95))
    door = Door("bottom", leaf="glass" if chance(rng, 0.6) else "slab")
    panel = Blank(name="control_panel")
    cells: tuple[Layout, ...] = (door, panel) if chance(rng, 0.85) else (door,)
    shares: tuple[float, ...] = (1.0, between(rng, (0.15, 0.3)))[: len(cells)]
    if chance(rng, 0.35):
        cells, shares = (Drawer(), *cells), (between(rng, (0.2, 0.4)), *shares)
    build = Build(bases=("none", "plinth", "legs"), tops=("between", "over"), legs=(0.03, 0.1))
    return build_cabinet(rng, "oven", style, size, Stack(cells, shares, "nothing"), build, STAND)
