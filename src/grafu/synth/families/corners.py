"""Cabinets for a room's corner: with an angled front, or L-shaped with a straight door on one wing or on both."""

import numpy as np

from grafu.synth.cabinets.corner import CornerCabinet, InnerCorner
from grafu.synth.families.kitchen import KITCHEN
from grafu.synth.fronts.layout import Door, Rect, Side
from grafu.synth.sampling.carpentry import fitted, needed_gap
from grafu.synth.sampling.chance import between, chance
from grafu.synth.sampling.fittings import fit_door
from grafu.synth.sampling.style import Style, draw_style

FRONT = Rect(0.0, 0.4, 0.1, 0.75)  # metres: about what a corner's door closes


def corner_cabinet(rng: np.random.Generator) -> CornerCabinet | InnerCorner:
    """Returns a corner unit: six in ten have an angled front, the others are L-shaped."""
    style = draw_style(rng, KITCHEN)
    return _angled(rng, style) if chance(rng, 0.6) else _inner(rng, style)


def _angled(rng: np.random.Generator, style: Style) -> CornerCabinet:
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
    )


def _inner(rng: np.random.Generator, style: Style) -> InnerCorner:
    """Returns an L-shaped unit; its doors hang at the far ends, as the shape demands."""
    depth, post = between(rng, (0.3, 0.6)), between(rng, (0.05, 0.09))
    along = depth + post + between(rng, (0.28, 0.5))
    base = between(rng, (0.08, 0.14)) if depth > 0.4 else 0.0
    return InnerCorner(
        along_x=along,
        along_y=along if chance(rng, 0.7) else depth + post + between(rng, (0.28, 0.5)),
        depth=depth,
        height=between(rng, (0.72, 0.9)),
        panel=style.panel,
        post=post,
        door=_door(rng, style, "right"),
        second=_door(rng, style, "left") if chance(rng, 0.6) else None,
        shelves=1 if chance(rng, 0.6) else 0,
        base=base,
        recess=between(rng, (0.02, 0.07)),
        topped=chance(rng, 0.6),
        front=style.front,
        gap=max(style.gap, needed_gap(Door(), Rect(0.0, 0.28, 0.0, 0.6), style.front)),
        finish=style.finish,
    )


def _door(rng: np.random.Generator, style: Style, side: Side | None = None) -> Door:
    """Returns a door in the style, on the given side."""
    if side is not None:
        return fit_door(rng, Door(), side, FRONT, style, 1.05)
    door = fitted(rng, Door(), FRONT, style)
    assert isinstance(door, Door)
    return door
