"""Draws the still part of a cabinet for a style: its case with base, top, sides, back, bottom and face frame.

A family states what it allows (`Build`); the style's tradition weighs what is allowed.
"""

from collections.abc import Mapping
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.synth.case.case import Case
from grafu.synth.case.construction import (
    Back,
    BackKind,
    Base,
    BaseKind,
    Bottom,
    BottomKind,
    FaceFrame,
    FrameKind,
    SideKind,
    Sides,
    Stretcher,
    Top,
    TopEdge,
    TopKind,
)
from grafu.synth.case.legs import Leg, LegShape
from grafu.synth.sampling.chance import Span, between, chance, count, only, pick
from grafu.synth.sampling.style import BOARDED, MakerStyle

# How backs are modelled: nearly all are full sheets; the half and split ones are cheap furniture's.
BACKS: Mapping[BackKind, float] = {"full": 0.74, "split": 0.21, "half": 0.02, "none": 0.03}
WIDE_BACK = 0.7  # metres: wider hardboard backs of furniture sold in boxes come in two halves
BOTTOMS: Mapping[BottomKind, float] = {"between": 0.74, "sheet": 0.1, "under": 0.14, "none": 0.02}
SIDES: Mapping[SideKind, float] = {"panel": 0.83, "framed": 0.05, "double": 0.12}
CLASSIC_SIDES: Mapping[SideKind, float] = {"panel": 0.63, "framed": 0.26, "double": 0.11}
# A face frame is one part in tidy models, its bars one by one in kitchen models (44781, 45001, 45463, 45940).
FRAMES: Mapping[FrameKind, float] = {"bars": 0.65, "one": 0.35}
BARE_STANDS, BARE_BACKLESS = 0.6, 0.3  # of bare pieces: on nothing, without a back
# Makers whose shelves touch the fronts also give edges strips and backs nailers (41003, 41085), others less often.
THOROUGH, LOOSE, TOUCH = 1.7, 0.6, 0.003  # factors; metres
STRIPS = 0.12  # frameless cases whose panels have edge strips although their maker draws none elsewhere
FLUSH_TOP, SHOWN_TOP = 0.35, 0.75  # tops that overhang: over fronts that end with the case's sides, and else
BEYOND = 0.05  # overlay cases whose sides run on to the fronts' outer faces
RAIL, RAIL_HEIGHTS = 0.12, (0.03, 0.09)  # tops with a bar below their front edge; metres
SKIRT = 0.2  # pieces on square legs or posts whose room below is closed by boards (22692)
NAILED = 0.47  # backs with rails: 8 of the 17 models have them
NAILED_BANDED = 0.85  # of pieces whose maker draws edge bands
EDGES: Mapping[TopEdge, float] = {"square": 0.72, "chamfered": 0.1, "rounded": 0.12, "moulded": 0.05, "cornice": 0.02}
ORNATE_EDGES: Mapping[TopEdge, float] = {
    "square": 0.3,
    "chamfered": 0.15,
    "rounded": 0.2,
    "moulded": 0.25,
    "cornice": 0.1,
}
STRETCHERS: Mapping[Stretcher, float] = {"none": 0.75, "sides": 0.05, "H": 0.07, "box": 0.06, "shelf": 0.07}
HEIGHTS: Mapping[BaseKind, Span] = {  # metres: what a floor is swept under, and what a foot is tall
    "none": (0.0, 0.0),
    "plinth": (0.05, 0.15),
    "toe kick": (0.08, 0.14),
    "legs": (0.08, 0.25),
    "posts": (0.08, 0.4),
    "sled": (0.08, 0.22),
}
FOOT_HEIGHTS: Mapping[LegShape, Span] = {
    "pad": (0.004, 0.02), "block": (0.02, 0.08), "bun": (0.04, 0.1), "caster": (0.04, 0.09)
}  # fmt: skip


@final
@dataclass(frozen=True, slots=True)
class Build:
    """What a family allows of its cases: kinds of bases and tops, and how tall its legs are (None: as usual)."""

    bases: tuple[BaseKind, ...] = ("none", "plinth", "toe kick", "legs", "posts", "sled")
    tops: tuple[TopKind, ...] = ("between", "over")
    legs: Span | None = None
    open_back: bool = False
    framed: bool = True
    moulded: bool = True
    top_thickness: Span | None = None


ANY = Build()
WALL_HUNG = Build(bases=("none",), tops=("between",))


def draw_case(
    rng: np.random.Generator, style: MakerStyle, size: tuple[float, float, float], build: Build = ANY
) -> Case:
    """Returns a case of the given outer size (width, depth, height) in this style; a bare one without ornament.

    Raises:
        ValueError: if its panels leave no room inside.
    """
    width, depth, height = size
    base = draw_base(rng, style, size, build)
    framed = style.frame > 0 and build.framed and base.kind != "posts"
    top = _top(rng, style, build)
    moulding = style.moulding if build.moulded and top.kind in ("between", "over") and base.kind != "posts" else 0.0
    classic = style.tradition in ("shaker", "ornate")
    plain_side = base.kind == "posts" or style.panel < 0.012
    return Case(
        width=width,
        height=height,
        depth=depth,
        panel=style.panel,
        back=_back(rng, style, build, width),
        base=base,
        top=top,
        frame=_frame(rng, style) if framed else _strips(rng, style, build, base),
        sides=_sides(rng, style, CLASSIC_SIDES if classic else SIDES, plain_side or style.bare),
        bottom=_bottom(rng, base),
        moulding=moulding if height > 0.7 else 0.0,
        moulding_at="top" if chance(rng, 0.8) else "bottom",
        pilaster=between(rng, (0.03, 0.05)) if framed and style.tradition == "ornate" and chance(rng, 0.12) else 0.0,
    )


def draw_base(
    rng: np.random.Generator, style: MakerStyle, size: tuple[float, float, float], build: Build = ANY
) -> Base:
    """Returns what a case of this size stands on."""
    width, depth, height = size
    kind = pick(rng, only(style.rules.base, build.bases))
    if style.bare and "none" in build.bases and chance(rng, BARE_STANDS):
        kind = "none"
    leg = draw_leg(rng, style, min(width, depth))
    span = build.legs if kind in ("legs", "posts", "sled") and build.legs else HEIGHTS[kind]
    if kind == "legs" and leg.shape in FOOT_HEIGHTS:
        span = FOOT_HEIGHTS[leg.shape]
    tall = min(between(rng, span), 0.5 * height)
    stretcher: Stretcher = pick(rng, STRETCHERS) if kind in ("legs", "posts") and tall > 0.18 else "none"
    apron = between(rng, (0.3, 0.6)) * tall if kind == "legs" and tall > 0.1 and chance(rng, 0.15) else 0.0
    return Base(
        kind=kind,
        height=tall,
        leg=leg,
        inset=between(rng, (0.0, 0.03)),
        recess=between(rng, (0.0, 0.08)),
        boards=pick(rng, {1: 0.15, 2: 0.15, 3: 0.2, 4: 0.5}),
        stretcher=stretcher,
        stretcher_at=between(rng, (0.15, 0.6)),
        apron=apron,
        arched=chance(rng, 0.5),
        skirt=chance(rng, SKIRT),
    )


def draw_leg(rng: np.random.Generator, style: MakerStyle, side: float) -> Leg:
    """Returns a leg of the style's tradition for furniture whose smaller side is `side` metres."""
    thick = min(between(rng, (0.025, 0.065)), side / 7)
    return Leg(pick(rng, style.rules.leg), thick, between(rng, (0.4, 0.8)), between(rng, (0.05, 0.18)))


def _top(rng: np.random.Generator, style: MakerStyle, build: Build) -> Top:
    kind = pick(rng, only(style.rules.top, build.tops))
    rail = between(rng, RAIL_HEIGHTS) if not style.bare and chance(rng, RAIL) else 0.0
    if kind != "over":
        thick = 0.0 if kind != "between" or chance(rng, 0.85) else between(rng, (0.9, 1.6)) * style.panel
        return Top(kind, thick, width=between(rng, (0.05, 0.12)), rail=rail)
    thick = between(rng, build.top_thickness or (style.panel, min(1.8 * style.panel, style.panel + 0.02)))
    ornate = style.tradition in ("ornate", "shaker")
    flush = style.tradition in BOARDED and style.mount == "overlay" and style.reveal is not None
    return Top(
        "over",
        thick if build.top_thickness or chance(rng, 0.6) else 0.0,
        overhang=between(rng, style.rules.overhang) if chance(rng, FLUSH_TOP if flush else SHOWN_TOP) else 0.0,
        edge=pick(rng, ORNATE_EDGES if ornate else EDGES),
        rim=between(rng, (0.02, 0.1)) if chance(rng, 0.04) else 0.0,
        rail=rail,
    )


def _back(rng: np.random.Generator, style: MakerStyle, build: Build, width: float) -> Back:
    if style.bare:
        return Back("none" if chance(rng, BARE_BACKLESS) else "full", style.back, planted=chance(rng, 0.3))
    kind: BackKind = "none" if build.open_back and chance(rng, 0.5) else pick(rng, BACKS)
    if kind == "full" and width > WIDE_BACK and style.tradition == "flat-pack" and chance(rng, 0.5):
        kind = "split"
    ratio = NAILED_BANDED if style.banded else NAILED * _care(style)
    rails = count(rng, 3 if style.banded else 2, 3) if chance(rng, ratio) else 0
    return Back(kind, style.back, rails=rails or (2 if kind == "none" else 0), planted=chance(rng, 0.3))


def _care(style: MakerStyle) -> float:
    """Returns how much likelier than on average the maker adds strips and nailers."""
    return THOROUGH if style.setback <= TOUCH else LOOSE


def _bottom(rng: np.random.Generator, base: Base) -> Bottom:
    kind = pick(rng, only(BOTTOMS, ("between", "sheet", "none") if base.kind in ("toe kick", "posts") else BOTTOMS))
    overhang = between(rng, (0.005, 0.025)) if kind == "under" and chance(rng, 0.5) else 0.0
    return Bottom(kind, overhang=overhang)


def _strips(rng: np.random.Generator, style: MakerStyle, build: Build, base: Base) -> FaceFrame | None:
    """Returns edge strips on the panels of a frameless case, as some kitchen models have them; mostly none."""
    if not build.framed or base.kind == "posts" or style.mount == "inset":
        return None
    if not (style.banded or chance(rng, STRIPS * _care(style))):
        return None
    return FaceFrame(style.panel, "strips", 0.001 if chance(rng, 0.5) else 0.0)


def _sides(rng: np.random.Generator, style: MakerStyle, table: Mapping[SideKind, float], plain: bool) -> Sides:
    kind = "panel" if plain else pick(rng, table)
    if kind != "panel" or style.frame or style.mount == "inset" or not chance(rng, BEYOND):
        return Sides(kind)
    return Sides(kind, beyond=style.front + style.seat + pick(rng, {0.0: 0.5, 0.005: 0.25, 0.015: 0.25}))


def _frame(rng: np.random.Generator, style: MakerStyle) -> FaceFrame:
    rail = style.frame * between(rng, (0.8, 1.5)) if chance(rng, 0.3) else 0.0
    return FaceFrame(style.frame, pick(rng, FRAMES), 0.018 if style.panel < 0.012 else 0.0, rail, chance(rng, 0.05))
