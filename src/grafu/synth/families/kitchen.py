"""Kitchens and bathrooms: base, wall, tall, sink and corner cabinets, rows of units, washstands.

Sizes are the trade's: base units 300 to 1200 mm wide, 550 to 650 deep, 720 to 900 high; wall units 300 to 370 deep.
Corner cabinets have an angled front, or are L-shaped with a straight door on one wing or on both. Washstands are low
and wide, mostly hung on a wall and closed by one or two drawers as wide as they are.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.cabinets.corner import CornerCabinet, InnerCorner
from grafu.synth.cabinets.folding import FoldingCorner
from grafu.synth.case.construction import Top
from grafu.synth.families.built import Size, build_cabinet, cabinet_of, draw_size
from grafu.synth.families.layouts import doors_across, doors_beside_drawers, doors_under_drawers, drawer_stack
from grafu.synth.fronts.gliding import Folding, Lift, PullOut, Sliding, WasteBins
from grafu.synth.fronts.layout import Blank, CellRow, Door, Drawer, Layout, OpenCell, Pair, Rect, Side, Stack
from grafu.synth.sampling.carpentry import FREE, PieceSite, fitted, needed_gap
from grafu.synth.sampling.casework import WALL_HUNG, Build, draw_case
from grafu.synth.sampling.chance import between, chance, count, pick
from grafu.synth.sampling.fit_gliding import FLAT
from grafu.synth.sampling.fittings import fit_door
from grafu.synth.sampling.style import MakerStyle, chunky, draw_style, pushed
from grafu.synth.sampling.traditions import TraditionName

BATH: Mapping[TraditionName, float] = {"frameless": 0.62, "minimal": 0.15, "flat-pack": 0.15, "shaker": 0.08}
HUNG = Build(
    bases=("none", "legs"), tops=("between", "none", "stretchers"), legs=(0.1, 0.25), moulded=False, framed=False
)
FRONTS = {1: 0.4, 2: 0.42, 0: 0.18}  # drawers above each other; 0: doors
SLABS = 0.35  # washstands with a slab on them, for a basin that stands on it or hangs in it
HAND = PieceSite(hand=0.8)  # it hangs a hand's breadth above the knee


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
ON_WALL = PieceSite(hand=-0.3)  # a wall unit hangs 1.35 m above the floor
# Metres: base units whose front mostly pulls out; fractions of those, and of slim tall units; of base units with bins
SLIM, PULL_OUTS, PANTRIES = (0.15, 0.4), 0.25, 0.25
LEAST_BINS, WASTE = 0.3, 0.045  # metres
FOLDING_CORNERS, POST = 0.3, 0.004  # of L-shaped corner units; metres that the post is wider than its leaves are thick
CAROUSELS = 0.3  # of corner units
SHUTTERS, LEAST_SHUTTER = 0.03, 0.35  # of higher wall units: one panel that goes up behind a board; metres
FLAPS = {"turns": 0.88, "folds": 0.06, "lifts": 0.06}  # of wall units with a flap: how it goes up
BASE_FRONTS = {"doors": 0.33, "under drawers": 0.31, "drawers": 0.25, "beside": 0.05, "open": 0.06}


def base_cabinet(rng: np.random.Generator) -> Cabinet:
    """Returns a base unit: doors, doors under drawers, drawers alone; racks or bins that come out."""
    style = pushed(rng, draw_style(rng, KITCHEN), 0.06)
    size = draw_size(rng, (0.15, 0.3) if chance(rng, NARROW) else (0.3, 1.2), (0.42, 0.65), (0.72, 0.9))
    return build_cabinet(rng, "base_cabinet", style, size, base_layout(rng, style, size), BASE)


def base_layout(rng: np.random.Generator, style: MakerStyle, size: Size) -> Layout:
    """Returns the fronts of a base unit of this size."""
    width, _, height = size
    if SLIM[0] <= width <= SLIM[1] and chance(rng, PULL_OUTS):
        return PullOut(number=2 if chance(rng, 0.7) else 3)
    if width > LEAST_BINS and chance(rng, WASTE):
        return _waste(rng, style, width)
    kind = pick(rng, BASE_FRONTS)
    if kind == "drawers":
        return drawer_stack(rng, style, count(rng, 2, 5))
    if kind == "under drawers":
        return doors_under_drawers(rng, style, width, height)
    if kind == "beside" and width > 0.7:
        return doors_beside_drawers(rng, style, width, count(rng, 3, 4))
    if kind == "open":
        return Stack((doors_across(rng, width), OpenCell()), (between(rng, (1.0, 2.5)), 1.0))
    return doors_across(rng, width)


def _waste(rng: np.random.Generator, style: MakerStyle, width: float) -> Layout:
    """Returns a front with bins behind it: they come out with it, or slide out once the door is open."""
    if width < 0.62 and chance(rng, 0.5):
        drawn: Layout = PullOut("bins", count(rng, 1, 3))
        return drawn if chance(rng, 0.6) else Stack((drawn, Drawer()), (between(rng, (3.0, 5.0)), 1.0), style.between)
    room = between(rng, (0.45, 0.9)), between(rng, (0.6, 0.95))
    bins = WasteBins(1 if width < 0.45 else count(rng, 1, 2), *room, chance(rng, 0.5), between(rng, (0.55, 0.75)))
    return Door(behind=bins) if width < 0.6 else Pair(behind=bins)


def wall_cabinet(rng: np.random.Generator) -> Cabinet:
    """Returns a wall unit: doors; a flap that turns, folds or is lifted up on four in five that are wide and low."""
    style = chunky(rng, draw_style(rng, KITCHEN), 0.06)
    bridge = chance(rng, BRIDGES)
    size = draw_size(rng, (0.6, 1.25) if bridge else (0.2, 1.0), (0.28, 0.38), (0.28, 0.42) if bridge else (0.3, 0.95))
    return build_cabinet(
        rng, "wall_cabinet", style, size, wall_layout(rng, style, size), WALL_HUNG, _beside(rng, ON_WALL)
    )


def wall_layout(rng: np.random.Generator, style: MakerStyle, size: Size) -> Layout:
    """Returns the fronts of a wall unit of this size."""
    width, _, height = size
    if width > 1.5 * height and chance(rng, 0.8):
        return _flap(rng)
    if height > 0.6 and width > 0.5 and chance(rng, 0.08):
        return Stack((Door("top"), Door("top")), between=style.between)
    if height > 0.6 and width > LEAST_SHUTTER and chance(rng, SHUTTERS):
        return Sliding("shutter", 1, leaf="louvred" if chance(rng, 0.6) else "slab")
    doors = doors_across(rng, width)
    if height > 0.6 and chance(rng, 0.08):
        return Stack((OpenCell(), doors), (1.0, between(rng, (1.5, 3.0))))
    return doors


def _flap(rng: np.random.Generator) -> Layout:
    """Returns a front that goes up: it turns, two leaves of it fold, or arms lift it."""
    kind = pick(rng, FLAPS)
    if kind == "turns":
        return Door("top")
    return Folding("top") if kind == "folds" else Lift()


def tall_cabinet(rng: np.random.Generator) -> Cabinet:
    """Returns a tall unit: doors above doors, above drawers, one over all its height, or a rack that pulls out."""
    style = draw_style(rng, KITCHEN)
    size = draw_size(rng, (0.25, 0.95), (0.3, 0.62), (1.35, 2.35))
    layout = tall_layout(rng, style, size)
    return build_cabinet(rng, "tall_cabinet", style, size, layout, TALL, _beside(rng, FREE))


def tall_layout(rng: np.random.Generator, style: MakerStyle, size: Size) -> Layout:
    """Returns the fronts of a tall unit of this size."""
    width = size[0]
    if width < SLIM[1] and size[1] > 0.45 and chance(rng, PANTRIES):
        return _pantry(rng, style, size[2])
    doors = doors_across(rng, width)
    kind = pick(rng, {"two": 0.42, "one": 0.28, "drawers": 0.17, "niche": 0.08, "three": 0.05})
    if kind == "one":
        return doors
    low = between(rng, (0.25, 1.4))
    if kind == "drawers":
        return Stack((drawer_stack(rng, style, count(rng, 2, 4)), doors), (low, 1.5), style.between)
    if kind == "niche":
        return Stack((drawer_stack(rng, style, count(rng, 1, 2)), OpenCell(), doors), (1.0, 0.8, 1.2))
    cells = (doors,) * (2 if kind == "two" else 3)
    return Stack(cells, (low, *(1.0 for _ in cells[1:])), style.between)


def _pantry(rng: np.random.Generator, style: MakerStyle, height: float) -> Layout:
    """Returns a rack behind a slim front over all its height, or below a door."""
    trays = max(3, round(height / between(rng, (0.3, 0.5))))
    if chance(rng, 0.6):
        return PullOut(number=trays)
    return Stack((PullOut(number=max(2, trays - 2)), Door()), (between(rng, (1.5, 2.5)), 1.0), style.between)


def sink_cabinet(rng: np.random.Generator) -> Cabinet:
    """Returns a sink unit: doors, mostly under a false drawer front, a worktop with a basin or none at all."""
    style = draw_style(rng, KITCHEN)
    size = draw_size(rng, (0.6, 1.2), (0.5, 0.65), (0.72, 0.9))
    doors: Layout = Pair() if size[0] > 0.65 else Door()
    if chance(rng, 0.7):
        ratio = between(rng, (0.14, 0.2)) / 0.75
        blank: Layout = CellRow((Blank(), Blank())) if size[0] > 0.8 and chance(rng, 0.5) else Blank()
        doors = Stack((doors, blank), (1.0 - ratio, ratio), "rail" if style.between == "panel" else style.between)
    case = draw_case(rng, style, size, BASE)
    if chance(rng, 0.5):
        thick, over = between(rng, (0.02, 0.05)), between(rng, (0.0, 0.03))
        case = replace(case, moulding=0.0, top=Top("over", thick, over, sink=True))
    return cabinet_of(rng, "sink_cabinet", style, case, doors)


def _beside(rng: np.random.Generator, site: PieceSite) -> PieceSite:
    """Returns the site, in one of five cases with a wall or a tall unit on one side."""
    if not chance(rng, 0.2):
        return site
    return PieceSite("left" if chance(rng, 0.5) else "right", site.hand)


FRONT = Rect(0.0, 0.4, 0.1, 0.75)  # metres: about what a corner's door closes


def corner_cabinet(rng: np.random.Generator) -> CornerCabinet | InnerCorner | FoldingCorner:
    """Returns a corner unit: six in ten have an angled front, the others are L-shaped, their doors folding in few."""
    style = draw_style(rng, KITCHEN)
    return _angled(rng, style) if chance(rng, 0.6) else _inner(rng, style)


def _angled(rng: np.random.Generator, style: MakerStyle) -> CornerCabinet:
    wall = chance(rng, 0.5)
    depth = between(rng, (0.3, 0.38)) if wall else between(rng, (0.45, 0.6))
    along = depth + between(rng, (0.28, 0.45))
    return CornerCabinet(
        along_x=along,
        along_y=along if chance(rng, 0.8) else depth + between(rng, (0.28, 0.45)),
        depth=depth,
        height=between(rng, (0.55, 0.95)),
        panel=style.panel,
        frame=max(style.frame, between(rng, (0.025, 0.05))),
        door=_door(rng, style),
        mount=style.mount,
        finish=style.finish,
        trays=count(rng, 2, 3) if chance(rng, CAROUSELS) else 0,
    )


def _inner(rng: np.random.Generator, style: MakerStyle) -> InnerCorner | FoldingCorner:
    """Returns an L-shaped unit; its doors hang at the far ends, as the shape demands, or on one another."""
    folds = chance(rng, FOLDING_CORNERS)
    depth, post = between(rng, (0.3, 0.6)), style.front + POST if folds else between(rng, (0.05, 0.09))
    along = depth + post + between(rng, (0.28, 0.5))
    base = between(rng, (0.08, 0.14)) if depth > 0.4 else 0.0
    case = InnerCorner(
        along_x=along,
        along_y=along if chance(rng, 0.7) else depth + post + between(rng, (0.28, 0.5)),
        depth=depth,
        height=between(rng, (0.72, 0.9)),
        panel=style.panel,
        post=post,
        door=_door(rng, style, "right"),
        second=_door(rng, style, "left") if chance(rng, 0.6) else None,
        shelves=1 if chance(rng, 0.6) else 0,
        trays=count(rng, 2, 3) if chance(rng, CAROUSELS) else 0,
        base=base,
        recess=between(rng, (0.02, 0.07)),
        topped=chance(rng, 0.6),
        front=style.front,
        gap=max(style.gap, needed_gap(Door(), Rect(0.0, 0.28, 0.0, 0.6), style.front)),
        finish=style.finish,
    )
    if not folds:
        return case
    flat = replace(case.door, leaf=case.door.leaf if case.door.leaf in FLAT else "slab")
    return FoldingCorner(case=replace(case, door=flat, second=None), side="left" if chance(rng, 0.5) else "right")


def _door(rng: np.random.Generator, style: MakerStyle, side: Side | None = None) -> Door:
    """Returns a door in the style, on the given side."""
    if side is not None:
        return fit_door(rng, Door(), side, FRONT, style, 1.05)
    door = fitted(rng, Door(), FRONT, style)
    assert isinstance(door, Door)
    return door
