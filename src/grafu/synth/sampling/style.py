"""What one maker keeps the same over one piece of furniture: thicknesses, mount, leaves, handles, colours.

`draw_style` draws a style within a tradition (`traditions`): choices that go together in real furniture are drawn
together, once for the whole piece, so that all its doors look alike. It places nothing.
"""

from collections.abc import Mapping
from dataclasses import replace
from math import radians
from typing import Literal, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.appearance import Material
from grafu.synth.fronts.hold import Grip, HandleStyle
from grafu.synth.fronts.layout import CURVED, Between, DrawerBox, LeafStyle
from grafu.synth.fronts.setting import Mount
from grafu.synth.pieces.finish import BEECH, BIRCH, GLASS, OAK, STEEL, Finish
from grafu.synth.sampling.chance import Span, between, chance, only, pick, spread
from grafu.synth.sampling.traditions import KNOBS, TRADITIONS, Tradition, TraditionName

WOODS = (
    BEECH,
    OAK,
    BIRCH,
    Material("walnut", (0.30, 0.19, 0.12, 1.0), roughness=0.6),
    Material("mahogany", (0.36, 0.14, 0.09, 1.0), roughness=0.5),
    Material("pine", (0.78, 0.60, 0.38, 1.0), roughness=0.75),
)
PAINTS = (
    Material("white paint", (0.90, 0.90, 0.88, 1.0), roughness=0.5),
    Material("grey paint", (0.55, 0.57, 0.58, 1.0), roughness=0.5),
    Material("black paint", (0.10, 0.10, 0.11, 1.0), roughness=0.5),
    Material("blue paint", (0.24, 0.34, 0.44, 1.0), roughness=0.5),
    Material("green paint", (0.38, 0.46, 0.38, 1.0), roughness=0.5),
)
METALS = (
    STEEL,
    Material("brass", (0.71, 0.58, 0.30, 1.0), metallic=1.0, roughness=0.4),
    Material("black metal", (0.08, 0.08, 0.08, 1.0), metallic=0.5, roughness=0.5),
)


def draw_finish(rng: np.random.Generator) -> Finish:
    """Returns a finish: the case in one material, the fronts in the same (two in three) or another."""
    materials = dict.fromkeys(WOODS + PAINTS, 1.0)
    case = pick(rng, materials)
    front = case if chance(rng, 0.65) else pick(rng, materials)
    return Finish(case, front, case if chance(rng, 0.5) else BIRCH, pick(rng, dict.fromkeys(METALS, 1.0)), GLASS)


Carry = Literal["reach", "middle", "corner", "top line", "middle line"]

# Where a piece carries the handles of its side-hung doors. "reach": as near to the hand as the free edge allows (high
# on base units, low on wall units); "top line" is the lying bar in the middle of the upper or lower edge, which states
# nothing about the hinge (3 of the 17 development models); "middle line" is an ornamental ring or knob in the middle.
CARRIES: Mapping[Carry, float] = {"reach": 0.4, "middle": 0.26, "corner": 0.1, "top line": 0.21, "middle line": 0.03}
KNOB_CARRIES: Mapping[Carry, float] = {
    "reach": 0.42,
    "middle": 0.34,
    "corner": 0.18,
    "top line": 0.03,
    "middle line": 0.03,
}

# Kitchens carry lying bars at the hand's edge more often: 45001, 45463, 45940, 46408 of eight.
KITCHEN_CARRIES: Mapping[Carry, float] = {
    "reach": 0.36, "middle": 0.17, "corner": 0.1, "top line": 0.33, "middle line": 0.04
}  # fmt: skip
KITCHENS: frozenset[TraditionName] = frozenset({"frameless", "face frame"})

# A piece whose fronts have no handle: pushed, or held by something cut into the front.
GRIPS: Mapping[Grip, float] = {
    "none": 0.42, "edge channel": 0.18, "lip": 0.1, "scoop": 0.14, "slot": 0.08, "finger hole": 0.08
}  # fmt: skip
BAR_LENGTHS = (0.09, 0.55)  # metres, as sold; real median: 0.38 of the front
KNOB_LENGTHS = (0.013, 0.04)  # metres: the knobs of real models are this wide (45963: 13 mm)
PROTRUSIONS = (0.016, 0.046)  # metres: how far real bars stand off, from strips to thick rods
INSETS = (0.016, 0.07)  # metres from an edge to its handle's middle: the widest doors have it nearest to their edge
PITCHES = ((0.25, 0.4), (0.13, 0.23))  # metres between shelves: usual ones, and close ones as for linen or cans
CLOSE_SHELVES, CLOSE_BANDED = 0.42, 0.7  # of pieces: 46456 and 49182 have three and five shelves in low rooms
BARE_HANDLES = 0.3  # of the barest pieces have no handles at all
LIGHT, LIGHT_FRONT = 0.0145, 0.014  # metres: pieces of thin boards have thin fronts too (41003, 45001, 46456)
THICK_BOARDS = (0.028, 0.055)  # metres: of small solid pieces, and of models drawn coarsely
PUSHED = 0.4  # of chests of drawers, beyond what their traditions say: 32052 and 46896 are held by edges alone
# Fronts that end with the case's outer faces: 44781, 45940, 46408, 47315; 22692 has wider ones. Fractions; metres
FLUSH, BEYOND, JUT = 0.6, 0.14, (-0.015, -0.003)
# Frameless boards meet in a plane: their makers leave nothing of the case beside the fronts more often.
BOARDED: frozenset[TraditionName] = frozenset({"frameless", "flat-pack", "office", "minimal", "appliance"})
FLUSH_BOARDS, BEYOND_BOARDS = 0.8, 0.14
# Modellers from catalogues draw the bands on the edges of boards as parts, and then whatever else is there (41003,
# 41085, 44781 of the ten overlay pieces).
BANDED: Mapping[TraditionName, float] = {"flat-pack": 0.75, "frameless": 0.75, "office": 0.6, "minimal": 0.55}
# Metres from the fronts to the shelves behind them: touching (41003), as is usual, and well behind (half of the real).
# Nearly all whose boards are banded and half of those whose doors lie on the case touch; of the others few.
SETBACKS: Mapping[Span, float] = {(0.0, 0.003): 0.2, (0.003, 0.015): 0.35, (0.015, 0.07): 0.45}
FIXED_SHELF = 0.7  # of banded pieces have one behind every seam of their fronts (41003)
TIGHT, TIGHT_BANDED, TIGHT_SHELVES = 0.5, 0.9, 0.65  # fractions: doors on the case; shelves at the fronts
LONG_RATIO = 0.08  # pieces whose handles run along (nearly) the whole front: profiles and long bars
PLAIN_ON_DRAWERS: frozenset[LeafStyle] = frozenset(
    {
        "glass", "mirror", "muntins", "louvred", "arched rail", "two panels", "swept", "swept frame", "half arched",
        "arched", "planks",
    }
)  # fmt: skip


@final
@dataclass(frozen=True, slots=True)
class MakerStyle:
    """The choices of one maker for one piece, metres and radians.

    `lap` is the most that overlay fronts cover of a panel, `reveal` what they leave of the case's outer edges (None:
    the gap; below 0: they jut out), `frame` the width of a face frame (0: frameless). `carry` states where side-hung
    doors carry their handles, `length` how long handles are (None: each handle's own), `full` that they run along the
    whole front; `knob` is a knob's width, `protrusion` how far bars stand off (None: their own). `pitch` is the height
    of a shelf's room, `setback` how far behind the fronts shelves end; `banded` boards have the bands on
    their edges drawn as parts. A `bare` piece was modelled with the least: no
    base, no fittings.
    """

    tradition: TraditionName
    panel: float
    front: float
    back: float
    mount: Mount
    gap: float
    seat: float
    lap: float
    reveal: float | None
    frame: float
    muntin: float
    moulding: float
    leaf: LeafStyle
    drawer_leaf: LeafStyle
    handle: HandleStyle
    drawer_handle: HandleStyle
    grip: Grip
    carry: Carry
    length: float | None
    full: bool
    knob: float | None
    protrusion: float | None
    inset: float
    drawer_high: bool
    box: DrawerBox
    between: Between
    opening: float
    travel: float
    runners: bool
    slide_gap: float
    pitch: float
    setback: float
    banded: bool
    bare: bool
    finish: Finish

    @property
    def rules(self) -> Tradition:
        """The tables of the style's tradition."""
        return TRADITIONS[self.tradition]


def draw_style(rng: np.random.Generator, traditions: Mapping[TraditionName, float]) -> MakerStyle:
    """Returns a style of one of these traditions, drawn by their weights."""
    name = pick(rng, traditions)
    rules = TRADITIONS[name]
    mount = pick(rng, rules.mount)
    bare = chance(rng, rules.bare)
    leaf, panel = pick(rng, rules.leaf), pick(rng, rules.panel)
    handle: HandleStyle = "none" if bare and chance(rng, BARE_HANDLES) else pick(rng, rules.handle)
    grip: Grip = pick(rng, GRIPS) if handle == "none" and leaf == "slab" else "none"
    frame = between(rng, (0.025, 0.055)) if chance(rng, rules.framed) and not bare else 0.0
    banded = mount == "overlay" and not (frame or bare) and chance(rng, BANDED.get(name, 0.0))
    tight = banded or chance(rng, TIGHT)
    full = chance(rng, 0.6 if handle == "bar-profile" else LONG_RATIO)
    return MakerStyle(
        tradition=name,
        panel=panel,
        front=min(pick(rng, rules.front), LIGHT_FRONT) if panel < LIGHT else pick(rng, rules.front),
        back=pick(rng, rules.back),
        mount=mount,
        gap=between(rng, rules.gap),
        # real doors of models touch the case more often than not; bumpers and play make up to 3 mm
        seat=0.0002 if tight else between(rng, (0.0005, 0.003)),
        # fronts cover all of a panel, or leave a visible reveal as face frames do in every second piece
        lap=between(rng, (0.01, 0.02)) if chance(rng, 0.45 if frame else 0.08) else 1.0,
        reveal=_reveal(rng, name),
        frame=frame,
        muntin=between(rng, (0.02, 0.07)) if chance(rng, rules.muntin) and not bare else 0.0,
        moulding=between(rng, (0.03, 0.08)) if chance(rng, rules.moulded) and not bare else 0.0,
        leaf=leaf,
        drawer_leaf=_drawer_leaf(rng, leaf, rules),
        handle=handle,
        drawer_handle=_drawer_handle(rng, handle, rules),
        grip=grip,
        carry=pick(rng, _carries(name, handle)),
        length=None if chance(rng, 0.2) else spread(rng, BAR_LENGTHS),
        full=full,
        knob=None if chance(rng, 0.3) else spread(rng, KNOB_LENGTHS),
        protrusion=None if chance(rng, 0.4) else between(rng, PROTRUSIONS),
        inset=spread(rng, INSETS),
        drawer_high=chance(rng, 0.3),
        box=pick(rng, rules.box),
        between=_between(rng, rules, bare, banded),
        opening=radians(between(rng, rules.opening)),
        travel=between(rng, (0.55, 0.95)),
        runners=chance(rng, 0.0 if bare else 0.17),
        # slides need 12.5 mm; models are drawn tighter and looser
        slide_gap=pick(rng, {0.0125: 5.0, 0.005: 2.0, 0.002: 1.0, 0.02: 1.0}),
        pitch=between(rng, PITCHES[chance(rng, CLOSE_BANDED if banded else CLOSE_SHELVES)]),
        setback=_setback(rng, tight, banded),
        banded=banded,
        bare=bare,
        finish=draw_finish(rng),
    )


def pushed(rng: np.random.Generator, style: MakerStyle, ratio: float = PUSHED) -> MakerStyle:
    """Returns the style, in this fraction of draws with fronts that are pushed open or drawn by their edge."""
    return replace(style, handle="none", drawer_handle="none") if chance(rng, ratio) else style


def chunky(rng: np.random.Generator, style: MakerStyle, ratio: float) -> MakerStyle:
    """Returns the style, in this fraction of draws with boards that are thick for a small piece."""
    return replace(style, panel=max(style.panel, between(rng, THICK_BOARDS))) if chance(rng, ratio) else style


def _carries(name: TraditionName, handle: HandleStyle) -> Mapping[Carry, float]:
    """Returns where pieces of this tradition carry such handles."""
    if handle.startswith(("knob", "ring")):
        return KNOB_CARRIES
    return KITCHEN_CARRIES if name in KITCHENS else CARRIES


def _reveal(rng: np.random.Generator, name: TraditionName) -> float | None:
    """Returns what overlay fronts leave of the case's outer edges, metres: the gap (None), nothing, or less."""
    flush, beyond = (FLUSH_BOARDS, BEYOND_BOARDS) if name in BOARDED else (FLUSH, BEYOND)
    kind = pick(rng, {"gap": 1.0 - flush - beyond, "flush": flush, "beyond": beyond})
    return None if kind == "gap" else 0.0 if kind == "flush" else between(rng, JUT)


def _between(rng: np.random.Generator, rules: Tradition, bare: bool, banded: bool) -> Between:
    """Returns what parts openings above each other: a fixed shelf in most banded pieces."""
    if bare and chance(rng, 0.5):
        return "nothing"
    return "panel" if banded and chance(rng, FIXED_SHELF) else pick(rng, rules.between)


def _setback(rng: np.random.Generator, tight: bool, banded: bool) -> float:
    """Returns how far behind the fronts shelves end, metres."""
    if tight and chance(rng, TIGHT_BANDED if banded else TIGHT_SHELVES):
        return 0.0
    return between(rng, pick(rng, SETBACKS))


def _drawer_leaf(rng: np.random.Generator, leaf: LeafStyle, rules: Tradition) -> LeafStyle:
    """Returns the drawers' leaf: like the doors', or plainer where the doors' makes no drawer or makers skip it."""
    if leaf in PLAIN_ON_DRAWERS:
        return pick(rng, only(rules.leaf, ("slab", "shaker", "chamfered")))
    return "slab" if leaf not in CURVED and chance(rng, rules.plain_drawers) else leaf


def _drawer_handle(rng: np.random.Generator, handle: HandleStyle, rules: Tradition) -> HandleStyle:
    """Returns the drawers' handle: the doors' own on seven pieces in eight, else cups or knobs beside bars."""
    if handle == "none" or chance(rng, 0.86):
        return handle
    others = {k: v for k, v in rules.handle.items() if k not in ("none", handle)}
    return pick(rng, others or KNOBS)
