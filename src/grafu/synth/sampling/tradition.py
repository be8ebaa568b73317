"""What a tradition of building furniture is: tables of weights, spans, shares. It names none (see `traditions`)."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, final

from grafu.synth.case.construction import BaseKind, TopKind
from grafu.synth.case.legs import LegShape
from grafu.synth.fronts.hold import HandleStyle
from grafu.synth.fronts.layout import Between, DrawerBox, LeafStyle
from grafu.synth.fronts.setting import Mount
from grafu.synth.sampling.chance import Span

TraditionName = Literal[
    "frameless", "face frame", "shaker", "mid-century", "office", "minimal", "ornate", "flat-pack", "appliance"
]


@final
@dataclass(frozen=True, slots=True)
class Tradition:
    """What the makers of one tradition choose: tables of weights, spans in metres, shares from 0 to 1.

    `leaf` is a piece's door style, and the share `plain_drawers` of pieces has slab drawer fronts beside it. `bare`
    is the share drawn with the fewest parts that still make a piece (46408 has 8, 49182 has 10), `framed` that with a
    face frame, `moulded` with a moulding, `muntin` with an upright between the doors of a pair. `opening` is how far
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
