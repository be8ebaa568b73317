"""Kitchens: base, wall, tall, sink and corner cabinets, islands, rows of units.

Sizes are the trade's: base units 300 to 1200 mm wide, 550 to 650 deep, 720 to 900 high; wall units 300 to 370 deep.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.case.construction import Top
from grafu.synth.families.built import Size, build_cabinet, cabinet_of, draw_size
from grafu.synth.families.layouts import doors_across, doors_beside_drawers, doors_under_drawers, drawer_stack
from grafu.synth.fronts.layout import Bay, Blank, Door, Layout, Pair, Row, Stack
from grafu.synth.sampling.carpentry import FREE, Site
from grafu.synth.sampling.casework import WALL_HUNG, Build, draw_case
from grafu.synth.sampling.chance import between, chance, count, pick
from grafu.synth.sampling.style import Style, chunky, draw_style, pushed
from grafu.synth.sampling.traditions import TraditionName

KITCHEN: Mapping[TraditionName, float] = {
    "frameless": 0.42,
    "face frame": 0.38,
    "minimal": 0.1,
    "shaker": 0.06,
    "flat-pack": 0.04,
}
BASE = Build(
    bases=("toe kick", "plinth", "legs", "none"),
    tops=("between", "over", "none", "stretchers", "corner blocks"),
    legs=(0.08, 0.15),
    moulded=False,
)
TALL = Build(bases=("toe kick", "plinth", "legs", "none"), tops=("between", "over"), legs=(0.05, 0.15))
NARROW = 0.09  # base units for bottles, towels, trays
BRIDGES = 0.41  # wall units that are wide and low, over a hood or a fridge (46408)
ON_WALL = Site(hand=-0.3)  # a wall unit hangs 1.35 m above the floor
BASE_FRONTS = {"doors": 0.33, "under drawers": 0.31, "drawers": 0.25, "beside": 0.05, "open": 0.06}


def base_cabinet(rng: np.random.Generator) -> Cabinet:
    """Returns a base unit: doors, doors under drawers, or drawers alone."""
    style = pushed(rng, draw_style(rng, KITCHEN), 0.06)
    size = draw_size(rng, (0.15, 0.3) if chance(rng, NARROW) else (0.3, 1.2), (0.42, 0.65), (0.72, 0.9))
    return build_cabinet(rng, "base_cabinet", style, size, base_layout(rng, style, size), BASE)


def base_layout(rng: np.random.Generator, style: Style, size: Size) -> Layout:
    """Returns the fronts of a base unit of this size."""
    width, _, height = size
    kind = pick(rng, BASE_FRONTS)
    if kind == "drawers":
        return drawer_stack(rng, style, count(rng, 2, 5))
    if kind == "under drawers":
        return doors_under_drawers(rng, style, width, height)
    if kind == "beside" and width > 0.7:
        return doors_beside_drawers(rng, style, width, count(rng, 3, 4))
    if kind == "open":
        return Stack((doors_across(rng, width), Bay()), (between(rng, (1.0, 2.5)), 1.0))
    return doors_across(rng, width)


def wall_cabinet(rng: np.random.Generator) -> Cabinet:
    """Returns a wall unit: doors, or a lift-up flap where it is wide and low (four in five of those)."""
    style = chunky(rng, draw_style(rng, KITCHEN), 0.06)
    bridge = chance(rng, BRIDGES)
    size = draw_size(rng, (0.6, 1.25) if bridge else (0.2, 1.0), (0.28, 0.38), (0.28, 0.42) if bridge else (0.3, 0.95))
    return build_cabinet(
        rng, "wall_cabinet", style, size, wall_layout(rng, style, size), WALL_HUNG, _beside(rng, ON_WALL)
    )


def wall_layout(rng: np.random.Generator, style: Style, size: Size) -> Layout:
    """Returns the fronts of a wall unit of this size."""
    width, _, height = size
    if width > 1.5 * height and chance(rng, 0.8):
        return Door("top")
    if height > 0.6 and width > 0.5 and chance(rng, 0.08):
        return Stack((Door("top"), Door("top")), between=style.between)
    doors = doors_across(rng, width)
    if height > 0.6 and chance(rng, 0.08):
        return Stack((Bay(), doors), (1.0, between(rng, (1.5, 3.0))))
    return doors


def tall_cabinet(rng: np.random.Generator) -> Cabinet:
    """Returns a tall unit: doors above doors, above drawers, or one door over all its height."""
    style = draw_style(rng, KITCHEN)
    size = draw_size(rng, (0.25, 0.95), (0.3, 0.62), (1.35, 2.35))
    layout = tall_layout(rng, style, size)
    return build_cabinet(rng, "tall_cabinet", style, size, layout, TALL, _beside(rng, FREE))


def tall_layout(rng: np.random.Generator, style: Style, size: Size) -> Layout:
    """Returns the fronts of a tall unit of this size."""
    width = size[0]
    doors = doors_across(rng, width)
    kind = pick(rng, {"two": 0.42, "one": 0.28, "drawers": 0.17, "niche": 0.08, "three": 0.05})
    if kind == "one":
        return doors
    low = between(rng, (0.25, 1.4))
    if kind == "drawers":
        return Stack((drawer_stack(rng, style, count(rng, 2, 4)), doors), (low, 1.5), style.between)
    if kind == "niche":
        return Stack((drawer_stack(rng, style, count(rng, 1, 2)), Bay(), doors), (1.0, 0.8, 1.2))
    cells = (doors,) * (2 if kind == "two" else 3)
    return Stack(cells, (low, *(1.0 for _ in cells[1:])), style.between)


def sink_cabinet(rng: np.random.Generator) -> Cabinet:
    """Returns a sink unit: doors, mostly under a false drawer front, a worktop with a basin or none at all."""
    style = draw_style(rng, KITCHEN)
    size = draw_size(rng, (0.6, 1.2), (0.5, 0.65), (0.72, 0.9))
    doors: Layout = Pair() if size[0] > 0.65 else Door()
    if chance(rng, 0.7):
        share = between(rng, (0.14, 0.2)) / 0.75
        blank: Layout = Row((Blank(), Blank())) if size[0] > 0.8 and chance(rng, 0.5) else Blank()
        doors = Stack((doors, blank), (1.0 - share, share), "rail" if style.between == "panel" else style.between)
    case = draw_case(rng, style, size, BASE)
    if chance(rng, 0.5):
        thick, over = between(rng, (0.02, 0.05)), between(rng, (0.0, 0.03))
        case = replace(case, moulding=0.0, top=Top("over", thick, over, sink=True))
    return cabinet_of(rng, "sink_cabinet", style, case, doors)


def _beside(rng: np.random.Generator, site: Site) -> Site:
    """Returns the site, in one of five cases with a wall or a tall unit on one side."""
    if not chance(rng, 0.2):
        return site
    return Site("left" if chance(rng, 0.5) else "right", site.hand)
