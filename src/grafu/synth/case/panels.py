"""The carcass of a case: sides, back and bottom in all their constructions."""

from collections.abc import Iterator

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Sides
from grafu.synth.pieces.assembly import Corner, PieceDraft, Span, both_sides, plank, solid
from grafu.synth.pieces.finish import Finish
from grafu.synth.pieces.shapes import bow_fronted_board
from grafu.vocabulary import PartLabel

UPRIGHT = 0.03  # metres: the depth of a metal upright's tube


def side_pieces(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    """Yields the sides."""
    x, t = case.width / 2, case.panel
    y0, y1, low = case.carcass - case.sides.beyond, case.depth / 2, _foot(case)
    if case.posts:
        y0, y1 = case.posts - case.depth / 2, case.depth / 2 - case.posts
    span = ((x - t, y0, low), (x, y1, case.crown))
    if case.sides.kind == "panel":
        for side, at in both_sides(span):
            yield plank(PartLabel.SIDE_PANEL, f"side_panel_{side}", finish.case, at)
    elif case.sides.kind == "double":
        for stem, x0, x1 in (("side_panel", x - t / 2, x), ("inner_side_panel", x - t, x - t / 2)):
            for side, at in both_sides(((x0, y0, low), (x1, y1, case.crown))):
                yield plank(PartLabel.SIDE_PANEL, f"{stem}_{side}", finish.case, at)
    elif case.sides.kind != "none":
        yield from {"framed": _framed, "slats": _slatted, "metal": _metal}[case.sides.kind](case.sides, finish, span)


def back_pieces(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    """Yields the back's panels and rails."""
    back, low, high = case.back, case.foot, case.crown
    if case.top.kind == "stretchers" and not back.rails:
        high -= case.top.width
    x = case.width / 2 - (case.posts or case.panel)
    y = case.inner_back
    if back.planted:
        x, y = case.width / 2 - 0.002, case.depth / 2
    if back.kind == "half":
        high = low + 0.5 * (high - low)
    halves = ((-x, 0.0, "back_panel_left"), (0.0, x, "back_panel_right"))
    for x0, x1, stem in halves if back.kind == "split" else ((-x, x, "back_panel"),):
        if back.kind != "none":
            yield plank(PartLabel.BACK_PANEL, stem, finish.case, ((x0, y, low), (x1, y + back.thickness, high)))
    yield from _back_rails(case, finish)


def bottom_pieces(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    """Yields the bottom, if there is one."""
    bottom, low = case.bottom, case.floor
    if bottom.kind == "none":
        return
    if case.lies_under:
        x, o = case.width / 2 + bottom.overhang, bottom.overhang
        box = Box(vec3(-x, case.front - o, low), vec3(x, case.depth / 2, low + case.bottom_thickness))
        mesh = bow_fronted_board(box, bottom.belly) if bottom.belly else TriangleMesh.box_mesh(box)
        yield solid(PartLabel.BOTTOM_PANEL, "bottom_panel", finish.case, [mesh])
        return
    spans = level_spans(case, low, low + case.bottom_thickness)
    yield plank(PartLabel.BOTTOM_PANEL, "bottom_panel", finish.case, *spans)


def level_spans(case: Case, low: float, high: float) -> tuple[Span, ...]:
    """Returns the boards of a level panel between the sides, notched around corner posts."""
    x, y0, y1 = case.width / 2 - case.panel, case.carcass, case.inner_back
    if case.posts <= case.panel:
        return (((-x, y0, low), (x, y1, high)),)
    near, far, narrow = case.posts - case.depth / 2, case.depth / 2 - case.posts, case.width / 2 - case.posts
    middle = ((-x, near, low), (x, min(far, y1), high))
    ends = [((-narrow, y0, low), (narrow, near, high)), ((-narrow, far, low), (narrow, y1, high))]
    return (middle, *(end for end in ends if end[1][1] - end[0][1] > 1e-4))


def _foot(case: Case) -> float:
    return 0.0 if case.base.kind == "plinth" and not case.lies_under else case.foot


def _framed(sides: Sides, finish: Finish, span: Span) -> Iterator[PieceDraft]:
    """Yields two stiles, two rails and a thin panel between them on either side."""
    (x0, y0, z0), (x1, y1, z1) = span
    w = min(sides.frame, (y1 - y0) / 4, (z1 - z0) / 4)
    middle = (x0 + x1) / 2
    bars: list[tuple[str, Span]] = [
        ("side_stile", ((x0, y0, z0), (x1, y0 + w, z1))),
        ("side_stile", ((x0, y1 - w, z0), (x1, y1, z1))),
        ("side_rail", ((x0, y0 + w, z0), (x1, y1 - w, z0 + w))),
        ("side_rail", ((x0, y0 + w, z1 - w), (x1, y1 - w, z1))),
    ]
    infill = ((middle - 0.003, y0 + w, z0 + w), (middle + 0.003, y1 - w, z1 - w))
    for side, at in both_sides(infill):
        yield plank(PartLabel.SIDE_PANEL, f"side_panel_{side}", finish.case, at)
    for stem, bar in bars:
        for _, at in both_sides(bar):
            yield plank(PartLabel.BAR, stem, finish.case, at)


def _slatted(sides: Sides, finish: Finish, span: Span) -> Iterator[PieceDraft]:
    """Yields upright slats between two bars on either side."""
    (x0, y0, z0), (x1, y1, z1) = span
    rail, count = min(0.04, (z1 - z0) / 6), sides.slats
    pitch = (y1 - y0) / count
    for low, high in ((z0, z0 + rail), (z1 - rail, z1)):
        for _, at in both_sides(((x0, y0, low), (x1, y1, high))):
            yield plank(PartLabel.BAR, "side_rail", finish.case, at)
    for k in range(count):
        slat = ((x0, y0 + k * pitch, z0 + rail), (x1, y0 + (k + 0.55) * pitch, z1 - rail))
        for _, at in both_sides(slat):
            yield plank(PartLabel.BAR, "slat", finish.case, at)


def _metal(_sides: Sides, finish: Finish, span: Span) -> Iterator[PieceDraft]:
    """Yields two uprights and two bars between them on either side."""
    (x0, y0, z0), (x1, y1, z1) = span
    d = min(UPRIGHT, (y1 - y0) / 5)
    bars: tuple[tuple[str, Corner, Corner], ...] = (
        ("upright", (x0, y0, z0), (x1, y0 + d, z1)),
        ("upright", (x0, y1 - d, z0), (x1, y1, z1)),
        ("bracket", (x0, y0 + d, z1 - d), (x1, y1 - d, z1)),
        ("bracket", (x0, y0 + d, z0), (x1, y1 - d, z0 + d)),
    )
    for stem, low, high in bars:
        for _, at in both_sides((low, high)):
            yield plank(PartLabel.BAR, stem, finish.metal, at)


def _back_rails(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    """Yields level rails across the back, the lowest at the bottom and the highest below the top."""
    rails, height = case.back.rails, case.back.rail
    x, y = case.width / 2 - (case.posts or case.panel), case.depth / 2
    low, high = case.floor + case.bottom_thickness, case.crown - case.top_thickness - height
    for k in range(rails):
        z = high if rails == 1 else low + (high - low) * k / (rails - 1)
        span = ((-x, y - case.panel, z), (x, y, z + height))
        yield plank(PartLabel.BAR, "back_rail", finish.case, span)
