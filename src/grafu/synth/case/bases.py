"""What cases stand on: plinths, toe kicks, legs and posts with their stretchers and aprons, sleds. No fronts here."""

from collections.abc import Iterator

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Stretcher
from grafu.synth.case.legs import Leg, lean, leg_meshes
from grafu.synth.pieces.assembly import PieceDraft, Span, both_sides, plank, solid
from grafu.synth.pieces.finish import Finish
from grafu.synth.pieces.shapes import arched_rail, board
from grafu.vocabulary import PartLabel

FEET = ("bun", "block", "pad", "caster")
METAL = ("hairpin", "caster")
CORNERS = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))


def base_pieces(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    """Yields everything below the case's bottom, and the corner posts."""
    kind = case.base.kind
    if kind == "plinth":
        yield from _plinth(case, finish)
    elif kind == "toe kick":
        yield from _toe_kick(case, finish, case.base.boards)
    elif kind in ("legs", "posts"):
        yield from _legs(case, finish)
        yield from _below(case, finish)
    elif kind == "sled":
        yield from _sled(case, finish)


def leg_piece(
    leg: Leg, at: tuple[float, float], outward: tuple[float, float], high: float, finish: Finish
) -> PieceDraft:
    """Returns one leg up to the height `high`."""
    material = finish.metal if leg.shape in METAL else finish.case
    stem = "caster" if leg.shape == "caster" else "foot" if leg.shape in FEET else "leg"
    return solid(PartLabel.LEG, stem, material, leg_meshes(leg, at, outward, high))


def waist(leg: Leg) -> float:
    """Returns how wide a leg is where stretchers meet it, metres: shaped legs are thinner than their tops."""
    return leg.thick * (1.0 if leg.shape in ("square", "round") else 0.5)


def stretcher_pieces(
    kind: Stretcher, feet: tuple[float, float], bar: float, z: float, finish: Finish, wide: float
) -> Iterator[PieceDraft]:
    """Yields square bars between legs that stand at (+-x, +-y) and are `wide` at the height `z`."""
    (x, y), h, free = feet, bar / 2, max(wide, bar) / 2
    if kind == "none":
        return
    for _, at in both_sides(((x - h, free - y, z - h), (x + h, y - free, z + h))):
        yield plank(PartLabel.BAR, "stretcher", finish.case, at)
    rows = {"box": (-y, y), "H": (0.0,)}.get(kind, ())
    for middle in rows:
        end = x - (free if kind == "box" else h)
        yield plank(PartLabel.BAR, "stretcher", finish.case, ((-end, middle - h, z - h), (end, middle + h, z + h)))
    if kind == "shelf":
        span = ((h - x, free - y, z - h), (x - h, y - free, z + h))
        yield plank(PartLabel.SHELF, "low_shelf", finish.case, span)


def _plinth(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    if case.lies_under:  # the sides end above: the plinth goes all around
        yield from _toe_kick(case, finish, 4)
        return
    x, y, t = case.width / 2 - case.panel, -case.depth / 2 + case.base.recess, case.panel
    yield plank(PartLabel.BAR, "plinth", finish.case, ((-x, y, 0.0), (x, y + t, case.floor)))


def _toe_kick(case: Case, finish: Finish, boards: int) -> Iterator[PieceDraft]:
    x, y, t, z = case.width / 2, case.depth / 2, case.panel, case.floor
    y0 = case.base.recess - y
    yield plank(PartLabel.SIDE_PANEL, "toe_kick", finish.case, ((t - x, y0, 0.0), (x - t, y0 + t, z)))
    if boards in (2, 4):
        yield plank(PartLabel.SIDE_PANEL, "base_side_panel", finish.case, ((t - x, y - t, 0.0), (x - t, y, z)))
    if boards > 2:
        for _, at in both_sides(((x - t, y0, 0.0), (x, y, z))):
            yield plank(PartLabel.SIDE_PANEL, "base_side_panel", finish.case, at)


def _legs(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    leg, high = case.base.leg, case.floor
    x, y = leg_feet(case)
    for sx, sy in CORNERS:
        at = (sx * x, sy * y)
        if case.base.kind == "legs":
            yield leg_piece(leg, at, (sx, sy), high, finish)
            continue
        h = leg.thick / 2
        straight_leg = leg.shape == "square"
        post = board((at[0] - h, at[1] - h, 0.0 if straight_leg else high), (at[0] + h, at[1] + h, case.crown))
        below = [] if straight_leg else leg_meshes(leg, at, (sx, sy), high)
        yield solid(PartLabel.LEG, "leg", finish.case, [*below, post])


def leg_feet(case: Case) -> tuple[float, float]:
    """Returns how far the legs' middles stand from the case's middle, along x and y."""
    leg = case.base.leg
    inset = 0.0 if case.base.kind == "posts" else case.base.inset
    spare = inset + leg.thick / 2
    return max(case.width / 2 - spare, leg.thick), max(case.depth / 2 - spare, leg.thick)


def _below(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    """Yields the stretchers between the legs and the apron before them."""
    base, feet = case.base, leg_feet(case)
    if base.skirt and base.leg.shape == "square":
        yield from _skirt(case, finish, feet)
        return
    bar = min(0.025, 0.7 * base.leg.thick)
    z = max(base.stretcher_at * (case.floor - base.apron), bar)
    if z + bar < case.floor - base.apron and base.leg.shape not in FEET:
        out = lean(base.leg, z, case.floor)
        there = (feet[0] + out, feet[1] + out)
        yield from stretcher_pieces(base.stretcher, there, bar, z, finish, waist(base.leg))
    if base.apron:
        x, y = feet[0] - base.leg.thick / 2, -feet[1] - base.leg.thick / 2
        low, high = (-x, y, case.floor - base.apron), (x, y + case.panel, case.floor)
        box = Box(vec3(*low), vec3(*high))
        mesh = arched_rail(box, 0.6 * base.apron) if base.arched else board(low, high)
        yield solid(PartLabel.BAR, "apron", finish.case, [mesh])


def _skirt(case: Case, finish: Finish, feet: tuple[float, float]) -> Iterator[PieceDraft]:
    """Yields boards between the legs on all four sides, flush with the legs' outer faces."""
    (x, y), h = feet, case.base.leg.thick / 2
    t = min(case.panel, 2 * h)
    for near in (-y - h, y + h - t):
        span = ((h - x, near, 0.0), (x - h, near + t, case.floor))
        yield plank(PartLabel.SIDE_PANEL, "base_side_panel", finish.case, span)
    for _, at in both_sides(((x + h - t, h - y, 0.0), (x + h, y - h, case.floor))):
        yield plank(PartLabel.SIDE_PANEL, "base_side_panel", finish.case, at)


def _sled(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    """Yields a frame of three bars under either side."""
    w = min(case.base.leg.thick, 0.03)
    x, y = case.width / 2 - case.base.inset, case.depth / 2 - case.base.inset
    z = case.floor
    right: tuple[Span, ...] = (
        ((x - w, -y, 0.0), (x, y, w)),
        ((x - w, -y, w), (x, w - y, z)),
        ((x - w, y - w, w), (x, y, z)),
    )
    both = [both_sides(span) for span in right]
    for k in (0, 1):
        yield plank(PartLabel.LEG, f"sled_{both[0][k][0]}", finish.metal, *(pair[k][1] for pair in both))
