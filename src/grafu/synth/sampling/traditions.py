"""Ways of building furniture: what one is, and for each, tables of what its makers choose. It draws nothing itself.

The tables state weights: what is sold, and the habits seen in the real development models. A tradition correlates the
choices, for a shaker leaf on a hairpin leg is rare. First come the boards, backs, drawer boxes and handles that all
makers choose from, lengths in metres.
"""

from collections.abc import Mapping
from typing import Literal, final

from grafu.dataclass import dataclass
from grafu.synth.case.construction import BaseKind, TopKind
from grafu.synth.case.legs import LegShape
from grafu.synth.fronts.hold import HandleStyle
from grafu.synth.fronts.layout import Between, DrawerBox, LeafStyle
from grafu.synth.fronts.setting import Mount
from grafu.synth.sampling.chance import Span

# Melamine board is sold in 15, 16, 18, 19 and 22 mm, plywood in 9, 12, 18; solid wood in 20 and 22. The bare models of
# modelling sites round them (20, 25) or exaggerate them (30 to 50).
MELAMINE = {0.01: 1.0, 0.012: 1.5, 0.013: 1.0, 0.015: 1.0, 0.016: 4.0, 0.018: 5.0, 0.019: 3.0, 0.022: 0.7}
PLYWOOD = {0.009: 3.5, 0.012: 4.0, 0.016: 2.0, 0.019: 3.0}
SOLID = {0.018: 2.0, 0.02: 4.0, 0.022: 3.0, 0.025: 2.0, 0.03: 0.7, 0.035: 0.5}
ROUNDED = {0.01: 1.0, 0.015: 1.5, 0.018: 3.0, 0.02: 4.0, 0.025: 2.0, 0.03: 1.5, 0.04: 1.0, 0.05: 0.7}

# Backs are hardboard of 3 to 5 mm, thin plywood, or a board like the case (solid furniture, 49182: 35 mm).
THIN_BACK = {0.003: 3.0, 0.004: 3.0, 0.006: 2.0, 0.009: 1.5, 0.018: 0.5}
ANY_BACK = {0.003: 2.0, 0.006: 2.0, 0.01: 1.5, 0.018: 2.0, 0.025: 0.7}

# Modelled drawers: two in three are whole boxes, the others were simplified.
BOXES: dict[DrawerBox, float] = {
    "whole": 6.0,
    "no bottom": 0.8,
    "shell": 1.0,
    "front only": 1.2,
    "floating": 1.0,
    "four walls": 1.0,
}
CRUDE_BOXES: dict[DrawerBox, float] = {"whole": 4.0, "no bottom": 0.5, "shell": 2.0, "front only": 3.5}

# Real handles: thin bars on modern kitchens, arched bars and cups on framed ones, knobs and bails on old furniture.
# About one front in fourteen has none: it is pushed, or held by a grip or its edge. With twice as many, 30 % of made
# doors showed no handle, and 8 % of the real ones do (2 of 26).
Handles = Mapping[HandleStyle, float]
BARS: Handles = {
    "bar-round": 3.0, "bar-square": 2.0, "bar-slim": 3.0, "bar-tee": 3.0, "bar-strip": 1.0, "bar-profile": 1.0
}  # fmt: skip
CLASSIC_BARS: Handles = {"bar-arched": 4.0, "bar-round": 2.0, "bar-tee": 1.0, "bar-square": 1.0}
CUPS: Handles = {"cup-shell": 3.0, "cup-square": 1.0, "cup-slim": 1.0}
KNOBS: Handles = {
    "knob-round": 4.0,
    "knob-flat": 2.0,
    "knob-mushroom": 2.0,
    "knob-square": 1.0,
    "knob-cone": 1.0,
    "knob-turned": 1.0,
}
OLD_KNOBS: Handles = {"knob-round": 3.0, "knob-turned": 3.0, "knob-mushroom": 2.0, "knob-flat": 1.0}
DROPS: Handles = {"bail": 3.0, "ring": 2.0, "bar-arched": 1.0}
NONE: Handles = {"none": 1.0}


def mixed(*ratios: tuple[float, Handles]) -> dict[HandleStyle, float]:
    """Returns one table in which each of the given tables has its fraction."""
    table: dict[HandleStyle, float] = {}
    for ratio, handles in ratios:
        for handle, weight in handles.items():
            table[handle] = table.get(handle, 0.0) + ratio * weight / sum(handles.values())
    return table


TraditionName = Literal[
    "frameless", "face frame", "shaker", "mid-century", "office", "minimal", "ornate", "flat-pack", "appliance"
]


@final
@dataclass(frozen=True, slots=True)
class Tradition:
    """What the makers of one tradition choose: tables of weights, spans in metres, fractions from 0 to 1.

    `leaf` is a piece's door style, and the fraction `plain_drawers` of pieces has slab drawer fronts beside it. `bare`
    is the fraction drawn with the fewest parts that still make a piece (46408 has 8, 49182 has 10), `framed` that with
    a face frame, `moulded` with a moulding, `muntin` with an upright between the doors of a pair. `opening` is how far
    doors swing, degrees.
    """

    panel: Mapping[float, float]
    front: Mapping[float, float]
    back: Mapping[float, float]
    mount: Mapping[Mount, float]
    gap: Span
    leaf: Mapping[LeafStyle, float]
    handle: Mapping[HandleStyle, float]
    box: Mapping[DrawerBox, float]
    between: Mapping[Between, float]
    base: Mapping[BaseKind, float]
    leg: Mapping[LegShape, float]
    top: Mapping[TopKind, float]
    bare: float = 0.22
    plain_drawers: float = 0.3
    framed: float = 0.0
    moulded: float = 0.0
    muntin: float = 0.02
    overhang: Span = (0.0, 0.03)
    opening: Span = (90.0, 120.0)


TRADITIONS: dict[TraditionName, Tradition] = {
    "frameless": Tradition(
        panel=MELAMINE,
        bare=0.35,
        front={0.013: 1.0, 0.016: 3.0, 0.018: 4.0, 0.019: 3.0, 0.022: 1.0},
        back=THIN_BACK,
        mount={"overlay": 0.96, "inset": 0.04},
        gap=(0.0015, 0.004),
        leaf={"slab": 0.62, "shaker": 0.2, "chamfered": 0.05, "rounded": 0.06, "glass": 0.05, "mirror": 0.02},
        handle=mixed((0.76, BARS), (0.08, CLASSIC_BARS), (0.1, KNOBS), (0.06, NONE)),
        box=BOXES,
        between={"nothing": 0.62, "rail": 0.23, "panel": 0.15},
        base={"plinth": 0.3, "toe kick": 0.35, "legs": 0.15, "none": 0.2},
        leg={"round": 3.0, "pad": 1.0, "square": 1.0},
        top={"between": 0.5, "over": 0.28, "none": 0.07, "stretchers": 0.15},
    ),
    "face frame": Tradition(
        panel=PLYWOOD,
        bare=0.0,
        front={0.013: 1.5, 0.016: 1.5, 0.017: 2.0, 0.019: 3.5, 0.022: 1.0},
        back=THIN_BACK,
        mount={"overlay": 0.82, "inset": 0.18},
        gap=(0.002, 0.005),
        leaf={
            "slab": 0.3,
            "shaker": 0.36,
            "raised panel": 0.14,
            "chamfered": 0.05,
            "two panels": 0.04,
            "glass": 0.05,
            "arched rail": 0.03,
            "planks": 0.03,
        },
        handle=mixed((0.27, BARS), (0.31, CLASSIC_BARS), (0.06, CUPS), (0.31, KNOBS), (0.05, NONE)),
        box=BOXES,
        between={"rail": 0.72, "panel": 0.1, "nothing": 0.13, "frame": 0.05},
        base={"toe kick": 0.65, "plinth": 0.15, "legs": 0.08, "none": 0.12},
        leg={"square": 2.0, "tapered": 1.0, "bun": 1.0},
        top={"between": 0.25, "over": 0.25, "none": 0.08, "stretchers": 0.32, "corner blocks": 0.1},
        framed=1.0,
        muntin=0.3,
    ),
    "shaker": Tradition(
        panel=SOLID,
        front={0.018: 1.0, 0.02: 3.0, 0.022: 2.0, 0.025: 0.5},
        back=ANY_BACK,
        mount={"inset": 0.7, "overlay": 0.3},
        gap=(0.001, 0.004),
        leaf={
            "shaker": 0.45,
            "slab": 0.16,
            "chamfered": 0.05,
            "glass": 0.06,
            "two panels": 0.06,
            "muntins": 0.07,
            "planks": 0.06,
            "louvred": 0.05,
            "raised panel": 0.04,
            "swept frame": 0.035,
        },
        handle=mixed((0.58, KNOBS), (0.16, CLASSIC_BARS), (0.15, CUPS), (0.05, DROPS), (0.06, NONE)),
        box=BOXES,
        between={"rail": 0.42, "panel": 0.3, "nothing": 0.15, "frame": 0.13},
        base={"legs": 0.4, "posts": 0.3, "plinth": 0.2, "none": 0.1},
        leg={"tapered": 4.0, "square": 3.0, "turned": 2.0, "block": 1.0, "bun": 1.0},
        top={"over": 0.85, "between": 0.15},
        framed=0.55,
        moulded=0.15,
        muntin=0.2,
        overhang=(0.008, 0.035),
    ),
    "mid-century": Tradition(
        panel={0.016: 1.0, 0.018: 3.0, 0.02: 3.0, 0.025: 2.0, 0.03: 0.6},
        front={0.016: 1.0, 0.018: 3.0, 0.02: 3.0},
        back=ANY_BACK,
        mount={"inset": 0.62, "overlay": 0.38},
        gap=(0.001, 0.004),
        leaf={"slab": 0.72, "rounded": 0.1, "chamfered": 0.08, "bowed": 0.04, "louvred": 0.05, "swept": 0.03},
        handle=mixed((0.45, KNOBS), (0.36, BARS), (0.05, DROPS), (0.14, NONE)),
        box=BOXES,
        between={"nothing": 0.42, "panel": 0.33, "rail": 0.17, "frame": 0.08},
        base={"legs": 0.75, "posts": 0.05, "sled": 0.08, "plinth": 0.06, "none": 0.06},
        leg={"cone": 4.0, "splayed": 4.0, "tapered": 2.0, "hairpin": 1.5, "round": 1.0, "square": 1.0},
        top={"between": 0.55, "over": 0.45},
        muntin=0.03,
        overhang=(0.0, 0.02),
    ),
    "office": Tradition(
        panel={0.018: 3.0, 0.019: 3.0, 0.022: 1.5, 0.025: 2.0},
        front={0.018: 4.0, 0.019: 3.0},
        back=THIN_BACK,
        mount={"overlay": 0.85, "inset": 0.15},
        gap=(0.0015, 0.004),
        leaf={"slab": 0.88, "rounded": 0.07, "glass": 0.05},
        handle=mixed((0.69, BARS), (0.16, KNOBS), (0.08, CUPS), (0.07, NONE)),
        box=BOXES,
        between={"nothing": 0.7, "rail": 0.2, "panel": 0.1},
        base={"plinth": 0.3, "none": 0.35, "legs": 0.25, "sled": 0.1},
        leg={"caster": 4.0, "round": 2.0, "pad": 2.0, "square": 1.0},
        top={"over": 0.65, "between": 0.35},
        overhang=(0.0, 0.01),
    ),
    "minimal": Tradition(
        panel=ROUNDED,
        bare=0.46,
        front={0.01: 1.0, 0.015: 1.0, 0.018: 2.0, 0.02: 4.0, 0.025: 1.0, 0.03: 0.7, 0.04: 0.3},
        back=ANY_BACK,
        mount={"overlay": 0.65, "inset": 0.35},
        gap=(0.0005, 0.005),
        leaf={"slab": 0.9, "chamfered": 0.03, "rounded": 0.03, "glass": 0.04},
        handle=mixed((0.5, BARS), (0.34, KNOBS), (0.16, NONE)),
        box=CRUDE_BOXES,
        between={"nothing": 0.45, "panel": 0.45, "rail": 0.1},
        base={"none": 0.45, "plinth": 0.2, "legs": 0.25, "sled": 0.05, "posts": 0.05},
        leg={"square": 4.0, "round": 3.0, "block": 2.0, "cone": 1.0, "splayed": 1.0, "hairpin": 1.0},
        top={"between": 0.6, "over": 0.4},
        overhang=(0.0, 0.02),
    ),
    "ornate": Tradition(
        panel=SOLID,
        front={0.02: 2.0, 0.022: 2.0, 0.025: 2.0, 0.03: 0.5},
        back=ANY_BACK,
        mount={"inset": 0.72, "overlay": 0.28},
        gap=(0.001, 0.003),
        leaf={
            "raised panel": 0.25,
            "shaker": 0.15,
            "two panels": 0.08,
            "chamfered": 0.12,
            "slab": 0.1,
            "bowed": 0.06,
            "swept": 0.03,
            "glass": 0.05,
            "muntins": 0.08,
            "arched rail": 0.06,
            "half arched": 0.02,
            "arched": 0.02,
            "swept frame": 0.06,
        },
        handle=mixed((0.46, OLD_KNOBS), (0.38, DROPS), (0.12, CLASSIC_BARS), (0.04, NONE)),
        box=BOXES,
        between={"rail": 0.5, "panel": 0.25, "nothing": 0.1, "frame": 0.15},
        base={"legs": 0.5, "plinth": 0.35, "posts": 0.1, "none": 0.05},
        leg={"turned": 3.0, "cabriole": 3.0, "bun": 3.0, "tapered": 1.0, "block": 1.0},
        top={"over": 0.95, "between": 0.05},
        plain_drawers=0.4,
        framed=0.5,
        moulded=0.45,
        muntin=0.25,
        overhang=(0.015, 0.05),
    ),
    "flat-pack": Tradition(
        panel={0.015: 3.0, 0.016: 4.0, 0.018: 2.0, 0.012: 0.7},
        bare=0.36,
        front={0.015: 3.0, 0.016: 3.0, 0.018: 2.0, 0.012: 0.7},
        back={0.003: 6.0, 0.004: 3.0, 0.002: 1.0},
        mount={"overlay": 0.8, "inset": 0.2},
        gap=(0.002, 0.005),
        leaf={"slab": 0.7, "shaker": 0.18, "rounded": 0.05, "glass": 0.05, "mirror": 0.02},
        handle=mixed((0.48, KNOBS), (0.43, BARS), (0.09, NONE)),
        box={"whole": 5.0, "no bottom": 1.0, "shell": 1.0, "front only": 2.0},
        between={"nothing": 0.55, "panel": 0.3, "rail": 0.15},
        base={"none": 0.3, "plinth": 0.35, "legs": 0.3, "posts": 0.05},
        leg={"square": 3.0, "round": 3.0, "pad": 3.0, "cone": 1.0, "caster": 1.0},
        top={"over": 0.55, "between": 0.45},
        muntin=0.03,
        overhang=(0.0, 0.015),
    ),
    "appliance": Tradition(
        panel={0.02: 2.0, 0.03: 2.0, 0.04: 2.0, 0.05: 1.0},
        front={0.02: 1.0, 0.03: 1.0, 0.04: 1.0, 0.06: 1.5, 0.08: 0.7},
        back={0.01: 1.0, 0.03: 1.0, 0.05: 1.0},
        mount={"overlay": 1.0},
        gap=(0.003, 0.008),
        leaf={"slab": 0.6, "rounded": 0.4},
        handle=mixed((0.92, BARS), (0.08, NONE)),
        box=CRUDE_BOXES,
        between={"nothing": 1.0},
        base={"none": 0.5, "plinth": 0.2, "legs": 0.3},
        leg={"round": 2.0, "pad": 2.0, "block": 1.0},
        top={"between": 0.7, "over": 0.3},
        muntin=0.0,
        overhang=(0.0, 0.0),
        opening=(90.0, 110.0),
    ),
}
