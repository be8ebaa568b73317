"""Filing cabinets, plan chests, bureaus, and boxes that look like fridges, ovens and dishwashers.

A bureau has drawers or doors below a writing room with a slanted flap.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from grafu.synth.cabinets.bureau import Bureau
from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.families.built import build_cabinet, draw_size
from grafu.synth.families.layouts import drawer_stack
from grafu.synth.fronts.gliding import Sliding
from grafu.synth.fronts.layout import Blank, Door, Drawer, Layout, Pair, Rect, Stack
from grafu.synth.sampling.carpentry import PieceSite, fitted
from grafu.synth.sampling.casework import Build
from grafu.synth.sampling.chance import between, chance, count, pick
from grafu.synth.sampling.style import draw_style, pushed
from grafu.synth.sampling.traditions import TraditionName

HOME: Mapping[TraditionName, float] = {"ornate": 0.35, "shaker": 0.35, "mid-century": 0.3}
STAND = PieceSite(hand=0.9)
LOWER = Build(bases=("none", "plinth", "legs"), tops=("between",), legs=(0.05, 0.25), framed=False, moulded=False)


def bureau(rng: np.random.Generator) -> Bureau:
    """Returns a bureau: mostly on drawers, its top 40 to 60 % as deep as the whole."""
    style = replace(draw_style(rng, HOME), frame=0.0, moulding=0.0, reveal=None)
    size = draw_size(rng, (0.6, 1.0), (0.4, 0.5), (0.62, 0.8))
    below: Layout = drawer_stack(rng, style, count(rng, 2, 4)) if chance(rng, 0.75) else Pair()
    lower = build_cabinet(rng, "bureau", style, size, below, LOWER, STAND)
    rise = between(rng, (0.28, 0.42))
    flap = fitted(rng, Door("bottom"), Rect(0.0, size[0], size[2], size[2] + rise), style, STAND)
    assert isinstance(flap, Door)
    return Bureau(
        lower=replace(lower, case=replace(lower.case, sides=replace(lower.case.sides, beyond=0.0))),
        rise=rise,
        shelf=between(rng, (0.4, 0.6)) * size[1],
        flap=flap,
        holes=count(rng, 3, 7) if chance(rng, 0.7) else 0,
    )


OFFICE: Mapping[TraditionName, float] = {"office": 0.5, "minimal": 0.2, "flat-pack": 0.2, "shaker": 0.1}


SHUTTERS = 0.12  # of filing cabinets without casters: a shutter instead of drawers


def filing_cabinet(rng: np.random.Generator) -> Cabinet:
    """Returns a filing cabinet: two to five like drawers, deeper below on those with casters; few have a shutter."""
    style = pushed(rng, replace(draw_style(rng, OFFICE), leaf="slab", drawer_leaf="slab", frame=0.0))
    mobile = chance(rng, 0.45)
    size = draw_size(rng, (0.35, 0.5), (0.42, 0.65), (0.5, 0.75) if mobile else (0.7, 1.4))
    number = count(rng, 2, 3) if mobile else count(rng, 2, 5)
    ratios = (2.0, *(1.0 for _ in range(number - 1))) if mobile and chance(rng, 0.6) else ()
    layout: Layout = Stack((Drawer(),) * number, ratios, style.between)
    if not mobile and chance(rng, SHUTTERS):
        layout = Sliding("shutter", 1, leaf="louvred")
    build = Build(bases=("legs", "none", "plinth"), legs=(0.03, 0.08), moulded=False, framed=False)
    return build_cabinet(rng, "filing_cabinet", style, size, layout, build, STAND)


def plan_chest(rng: np.random.Generator) -> Cabinet:
    """Returns a chest of many flat drawers, as wide as a drawing or as small as a tool chest."""
    style = pushed(rng, replace(draw_style(rng, OFFICE), leaf="slab", drawer_leaf="slab", frame=0.0, runners=False))
    large = chance(rng, 0.75)
    number = count(rng, 4, 12)
    high = 0.08 + number * between(rng, (0.029, 0.052))
    size = draw_size(rng, (1.0, 1.6) if large else (0.4, 0.75), (0.6, 0.95) if large else (0.3, 0.45), (high, high))
    style = replace(style, between="nothing", length=None if style.length is None else min(style.length, 0.14))
    ratios = (*(2.0,) * count(rng, 1, 2), *(1.0,) * (number - 2)) if chance(rng, 0.3) else ()
    layout = Stack((Drawer(),) * (len(ratios) or number), ratios, "nothing")
    build = Build(bases=("none", "plinth", "legs"), legs=(0.03, 0.12), moulded=False, framed=False)
    return build_cabinet(rng, "plan_chest", style, size, layout, build, STAND)


def fridge(rng: np.random.Generator) -> Cabinet:
    """Returns a fridge-like box: one thick door, two above each other, a pair, or a pair over one drawer or two."""
    style = draw_style(rng, {"appliance": 1.0})
    style = replace(style, front=max(style.front, between(rng, (0.03, 0.08))), carry="middle", gap=0.006)
    tall = chance(rng, 0.75)
    size = draw_size(rng, (0.5, 0.92), (0.5, 0.65), (1.4, 2.0) if tall else (0.75, 0.95))
    kind = pick(rng, {"two": 0.45, "pair": 0.15, "drawers": 0.05, "beside": 0.15, "one": 0.2}) if tall else "one"
    layouts: dict[str, Layout] = {
        "two": Stack((Door(), Door()), (between(rng, (0.5, 1.8)), 1.0), "panel"),
        "pair": Stack((Drawer(), Pair()), (1.0, between(rng, (1.5, 2.2))), "panel"),
        "drawers": Stack((Drawer(), Drawer(), Pair()), (0.6, 0.6, between(rng, (1.5, 2.2))), "panel"),
        "beside": Pair(),
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
    ratios: tuple[float, ...] = (1.0, between(rng, (0.15, 0.3)))[: len(cells)]
    if chance(rng, 0.35):
        cells, ratios = (Drawer(), *cells), (between(rng, (0.2, 0.4)), *ratios)
    build = Build(bases=("none", "plinth", "legs"), tops=("between", "over"), legs=(0.03, 0.1))
    return build_cabinet(rng, "oven", style, size, Stack(cells, ratios, "nothing"), build, STAND)
