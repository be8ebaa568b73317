"""Racks: shelves between slats, uprights or ladders, over drawers or a door."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.cabinets.rack import Rack
from grafu.synth.case.construction import Sides
from grafu.synth.families.built import build_cabinet, cabinet_of, draw_size
from grafu.synth.families.layouts import drawer_stack
from grafu.synth.fronts.layout import Bay, Door, Layout, Stack
from grafu.synth.sampling.carpentry import Site
from grafu.synth.sampling.casework import Build, draw_case
from grafu.synth.sampling.chance import between, chance, count, pick
from grafu.synth.sampling.style import Style, draw_style
from grafu.synth.sampling.traditions import TraditionName

RACKS: Mapping[TraditionName, float] = {"minimal": 0.6, "flat-pack": 0.4}
PLAIN = Build(
    ("none", "plinth", "legs"), ("between", "over"), (0.04, 0.15), open_back=True, framed=False, moulded=False
)
HELD = Build(("none",), ("between", "over"), framed=False, moulded=False)
STAND = Site(hand=0.9)


def rack(rng: np.random.Generator) -> Cabinet | Rack:
    """Returns shelves over drawers or a door: one case throughout, or a small cabinet between uprights."""
    style = replace(draw_style(rng, RACKS), frame=0.0, moulding=0.0)
    return _cased(rng, style) if chance(rng, 0.45) else _held(rng, style)


def _cased(rng: np.random.Generator, style: Style) -> Cabinet:
    size = draw_size(rng, (0.45, 1.0), (0.28, 0.42), (1.1, 2.1))
    number = count(rng, 1, 3)
    case = replace(draw_case(rng, style, size, PLAIN), sides=Sides("slats" if chance(rng, 0.4) else "metal"))
    layout = Stack((_low(rng, style, number), Bay(shelves=count(rng, 2, 4))), (0.22 * number, between(rng, (0.9, 1.4))))
    return cabinet_of(rng, "rack", style, case, layout, STAND)


def _held(rng: np.random.Generator, style: Style) -> Rack:
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


def _low(rng: np.random.Generator, style: Style, number: int) -> Layout:
    return drawer_stack(rng, style, number) if chance(rng, 0.75) else Door()
