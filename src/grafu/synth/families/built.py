"""From a style, a size and a layout of bare fronts to a cabinet."""

import numpy as np

from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.case.case import Case
from grafu.synth.families.layouts import with_inner_drawers
from grafu.synth.fronts.layout import Layout
from grafu.synth.sampling.carpentry import FREE, PieceSite, fitted, needed_gap
from grafu.synth.sampling.casework import ANY, Build, draw_case
from grafu.synth.sampling.chance import Span, between, spread
from grafu.synth.sampling.style import MakerStyle

INNER_DEPTH = 0.42  # metres: drawers behind doors need some length
INNER_HEIGHT = 1.2  # metres: families of tall pieces say themselves what is behind their doors
Size = tuple[float, float, float]


def draw_size(rng: np.random.Generator, width: Span, depth: Span, height: Span) -> Size:
    """Returns a size (width, depth, height) in metres: depth and height drawn evenly, of widths each doubling alike."""
    return spread(rng, width), between(rng, depth), between(rng, height)


def build_cabinet(
    rng: np.random.Generator,
    name: str,
    style: MakerStyle,
    size: Size,
    layout: Layout,
    build: Build = ANY,
    site: PieceSite = FREE,
) -> Cabinet:
    """Returns the cabinet with every front decided and gaps wide enough for its doors to turn.

    Raises:
        ValueError: if the size leaves some part no room.
    """
    return cabinet_of(rng, name, style, draw_case(rng, style, size, build), layout, site)


def cabinet_of(
    rng: np.random.Generator,
    name: str,
    style: MakerStyle,
    case: Case,
    layout: Layout,
    site: PieceSite = FREE,
    rear: Layout | None = None,
) -> Cabinet:
    """Returns a cabinet with this case, its fronts decided; `rear` faces +Y.

    Raises:
        ValueError: if the case leaves some front no room.
    """
    room = case.opening
    if case.depth > INNER_DEPTH and case.height < INNER_HEIGHT:
        layout = with_inner_drawers(rng, layout, room.width)
    fronts = fitted(rng, layout, room, style, site)
    behind = None if rear is None else fitted(rng, rear, room, style, site)
    gaps = [needed_gap(sides, room, style.front) for sides in (fronts, behind) if sides is not None]
    return Cabinet(
        name=name,
        case=case,
        layout=fronts,
        mount=style.mount,
        front=style.front,
        gap=max(style.gap, *gaps),
        seat=style.seat,
        lap=style.lap,
        slide_gap=style.slide_gap,
        finish=style.finish,
        rear=behind,
        ratio=between(rng, (0.45, 0.65)),
        reveal=style.reveal,
    )
