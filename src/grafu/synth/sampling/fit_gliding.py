"""Fronts that slide, fold, rise or pull out, one at a time in the style of their piece: leaf, hold, grip, shelves."""

from collections.abc import Mapping
from dataclasses import replace
from math import radians

import numpy as np

from grafu.synth.fronts.gliding import Folding, Lift, PullOut, Sliding
from grafu.synth.fronts.hold import Grip, HandleStyle, Hold
from grafu.synth.fronts.layout import LeafStyle, Rect
from grafu.synth.sampling.chance import Span, between, chance, pick
from grafu.synth.sampling.fittings import draw_inside, draw_shelves, handle_of, leaf_of, plain_hold
from grafu.synth.sampling.style import MakerStyle

# Leaves that pass one another are flat: what bulges or is arched stays on hinged doors.
FLAT: frozenset[LeafStyle] = frozenset(
    {
        "slab", "chamfered", "rounded", "planks", "shaker", "glass", "mirror", "raised panel", "two panels", "muntins",
        "louvred",
    }
)  # fmt: skip
# Sliding doors are mostly drawn by something cut into them: a bar would keep them from passing one another.
CUT: Mapping[Grip, float] = {"slot": 0.3, "finger hole": 0.25, "edge channel": 0.3, "scoop": 0.15}
CUT_IN = 0.6  # of sliding slabs
# On others, where a style's own fronts would be pushed
SMALL_HELD: Mapping[HandleStyle, float] = {"knob-round": 0.3, "knob-flat": 0.4, "bar-slim": 0.3}
TRACKS: Mapping[Span, float] = {(0.0, 0.0): 0.45, (0.003, 0.008): 0.3, (0.012, 0.04): 0.25}  # metres: rails, if drawn
RUNNERS = 0.3  # of pull-outs: the runner below is drawn
STEEP: Mapping[bool, Span] = {True: (88.5, 89.5), False: (65.0, 85.0)}  # degrees: arms of inset and overlay flaps
RODS = 0.6  # of parallel lifts: a rod joins their arms


def fit_sliding(rng: np.random.Generator, sliding: Sliding, room: Rect, style: MakerStyle) -> Sliding:
    """Returns the sliding doors with leaf, handle or grip, rails and shelves; a pane stays plain."""
    width = room.width / {"bypass": sliding.leaves, "shutter": 1}.get(sliding.kind, 2)
    leaf = "slab" if sliding.pane else _flat(rng, sliding.leaf, style, replace(room, x1=room.x0 + width))
    grip: Grip = pick(rng, CUT) if leaf == "slab" and chance(rng, CUT_IN) else "none"
    usual: HandleStyle = style.handle if style.handle != "none" or style.bare else pick(rng, SMALL_HELD)
    handle = "none" if grip != "none" else handle_of(sliding.handle, usual, grip)
    along = 0.5 if chance(rng, 0.8) else float(np.clip((1.0 - room.z0) / room.height, 0.2, 0.8))
    return replace(
        sliding,
        leaf=leaf,
        handle=handle,
        hold=_short(replace(plain_hold(style, handle), place="free edge", along=along)),
        grip=grip,
        shelves=draw_shelves(rng, sliding.shelves, room, False, style),
        inside=draw_inside(rng, sliding.inside, leaf, style),
        lap=between(rng, (0.02, 0.05)),
        left_first=chance(rng, 0.5) and sliding.leaves != 3,  # a handle between two leaves in front would stop them
        track=between(rng, pick(rng, TRACKS)),
    )


def fit_folding(rng: np.random.Generator, folding: Folding, room: Rect, style: MakerStyle) -> Folding:
    """Returns the folding doors with leaf, handle or grip at the seam (below, where they fold up) and shelves."""
    half = replace(room, x1=room.center[0])
    leaf = _flat(rng, folding.leaf, style, half)
    grip: Grip = style.grip if leaf == "slab" and style.grip != "lip" else "none"
    handle = handle_of(folding.handle, style.handle, grip)
    hold = _short(plain_hold(style, handle))
    return replace(
        folding,
        leaf=leaf,
        handle=handle,
        hold=hold if folding.side == "top" else replace(hold, place="free edge", along=0.5),
        grip=grip,
        shelves=draw_shelves(rng, folding.shelves, room, False, style),
        inside=draw_inside(rng, folding.inside, leaf, style),
    )


def fit_lift(rng: np.random.Generator, lift: Lift, room: Rect, style: MakerStyle) -> Lift:
    """Returns the lifted flap with leaf, handle or grip near its lower edge, and its arms."""
    leaf = _flat(rng, lift.leaf, style, room)
    grip: Grip = style.grip if leaf == "slab" and style.grip != "lip" else "none"
    handle = handle_of(lift.handle, style.handle, grip)
    return replace(
        lift,
        leaf=leaf,
        handle=handle,
        angle=radians(between(rng, STEEP[style.mount == "inset"])),
        rise=between(rng, (0.6, 1.0)),
        start=between(rng, (0.08, 0.2)),
        rod=chance(rng, RODS),
        hold=_short(plain_hold(style, handle)),
        grip=grip,
    )


def fit_pull_out(rng: np.random.Generator, front: PullOut, room: Rect, style: MakerStyle) -> PullOut:
    """Returns the pull-out with leaf, handle or grip: held as a drawer is, or by an upright bar."""
    leaf = _flat(rng, front.leaf, style, room)
    grip: Grip = style.grip if leaf == "slab" else "none"
    handle = handle_of(front.handle, style.handle, grip)
    upright = room.height > 2 * room.width and handle.startswith("bar") and chance(rng, 0.6)
    hold = replace(plain_hold(style, handle), orientation="upright" if upright else "usual")
    high = not upright and chance(rng, 0.6)
    return replace(
        front,
        leaf=leaf,
        handle=handle,
        hold=replace(hold, place="top edge") if high else hold,
        grip=grip,
        travel=between(rng, (0.6, 0.9)),
        runner=chance(rng, RUNNERS),
    )


def _flat(rng: np.random.Generator, asked: LeafStyle, style: MakerStyle, room: Rect) -> LeafStyle:
    leaf = leaf_of(rng, asked, style.leaf, room, False)
    return leaf if leaf in FLAT else "slab"


def _short(hold: Hold) -> Hold:
    """Returns the hold of a handle that does not run along the whole leaf."""
    return replace(hold, ratio=min(hold.ratio, 0.6))
