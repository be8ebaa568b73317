"""Bathrooms: washstands, low and wide, mostly hung on a wall and closed by one or two drawers as wide as they are."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.case.construction import Top
from grafu.synth.families.built import cabinet_of, draw_size
from grafu.synth.families.layouts import doors_across, drawer_stack
from grafu.synth.fronts.layout import Layout
from grafu.synth.sampling.carpentry import Site
from grafu.synth.sampling.casework import Build, draw_case
from grafu.synth.sampling.chance import between, chance, pick
from grafu.synth.sampling.style import draw_style
from grafu.synth.sampling.traditions import TraditionName

BATH: Mapping[TraditionName, float] = {"frameless": 0.62, "minimal": 0.15, "flat-pack": 0.15, "shaker": 0.08}
HUNG = Build(
    bases=("none", "legs"), tops=("between", "none", "stretchers"), legs=(0.1, 0.25), moulded=False, framed=False
)
FRONTS = {1: 0.4, 2: 0.42, 0: 0.18}  # drawers above each other; 0: doors
SLABS = 0.35  # washstands with a slab on them, for a basin that stands on it or hangs in it
HAND = Site(hand=0.8)  # it hangs a hand's breadth above the knee


def washstand(rng: np.random.Generator) -> Cabinet:
    """Returns a washstand: drawers over its whole width, or doors below a basin."""
    style = draw_style(rng, BATH)
    size = draw_size(rng, (0.5, 1.3), (0.36, 0.52), (0.3, 0.6))
    drawers = pick(rng, FRONTS)
    layout: Layout = drawer_stack(rng, style, drawers) if drawers else doors_across(rng, size[0])
    case = draw_case(rng, style, size, HUNG)
    if chance(rng, SLABS):
        over = between(rng, (0.003, 0.015)) if chance(rng, 0.2) else 0.0
        slab = Top("over", between(rng, (0.012, 0.04)), over, sink=not drawers and chance(rng, 0.5))
        case = replace(case, top=slab)
    return cabinet_of(rng, "washstand", style, case, layout, HAND)
