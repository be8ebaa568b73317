"""What makers choose from, whatever their tradition: boards, backs, drawer boxes and handles, with weights, in metres.

Where the numbers come from is said beside them: trade sizes, what is sold, habits of the real development models.
"""

from collections.abc import Mapping

from grafu.synth.fronts.hold import HandleStyle
from grafu.synth.fronts.layout import DrawerBox

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
