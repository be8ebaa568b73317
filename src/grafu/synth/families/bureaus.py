"""Bureaus: drawers or doors below a writing room with a slanted flap."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from grafu.synth.cabinets.bureau import Bureau
from grafu.synth.families.built import build_cabinet, draw_size
from grafu.synth.families.layouts import drawer_stack
from grafu.synth.fronts.layout import Door, Layout, Pair, Rect
from grafu.synth.sampling.carpentry import Site, fitted
from grafu.synth.sampling.casework import Build
from grafu.synth.sampling.chance import between, chance, count
from grafu.synth.sampling.style import draw_style
from grafu.synth.sampling.traditions import TraditionName

HOME: Mapping[TraditionName, float] = {"ornate": 0.35, "shaker": 0.35, "mid-century": 0.3}
STAND = Site(hand=0.9)
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
