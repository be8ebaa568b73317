"""The tops of cases: panels between and over the sides, moulded, with sinks, stretchers, corner blocks. No fronts."""

from collections.abc import Iterator

from grafu.geometry.appearance import Material
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Top
from grafu.synth.case.panels import level_spans
from grafu.synth.pieces.assembly import PieceDraft, Span, both_sides, plank, solid
from grafu.synth.pieces.finish import Finish
from grafu.synth.pieces.shapes import board, bow_fronted_board, table_board
from grafu.vocabulary import PartLabel

BASIN_WALL = 0.003  # metres
BASIN_DEPTH = 0.15  # metres: a usual kitchen sink
MOULDED_STEP = 0.012  # metres by which the lower board of a moulded top stands back


def top_pieces(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    """Yields the top and what belongs to it."""
    kind, wood = case.top.kind, finish.glass if case.top.glass else finish.case
    if kind == "between":
        spans = level_spans(case, case.height - case.top_thickness, case.height)
        yield plank(PartLabel.TOP_PANEL, "top_panel", wood, *spans)
    elif kind == "over":
        yield from _over(case.top, over_box(case), wood, finish)
        yield from _rim(case, finish)
        if case.top.sink:
            yield _basin(sink_hole(over_box(case)), case.height, finish)
    elif kind == "stretchers":
        yield from _stretchers(case, finish)
    elif kind == "corner blocks":
        yield from _corner_blocks(case, finish)
    if case.top_rail:
        x, high = case.width / 2 - case.panel, case.height - case.top_thickness
        span = ((-x, case.carcass, high - case.top_rail), (x, case.carcass + case.panel, high))
        yield plank(PartLabel.BAR, "top_rail", finish.case, span)


def over_box(case: Case) -> Box:
    """Returns the box of a top that lies over the sides."""
    top = case.top
    x, y0 = case.width / 2 + top.overhang + top.sides, case.front - top.overhang - top.front
    return Box(vec3(-x, y0, case.crown), vec3(x, case.depth / 2 + top.back, case.height))


def _over(top: Top, box: Box, wood: Material, finish: Finish) -> Iterator[PieceDraft]:
    """Yields the top that lies over the sides, a cornice in two parts."""
    meshes = top_meshes(top, box)
    if top.edge == "cornice" and len(meshes) == 2:
        yield solid(PartLabel.BAR, "cornice", finish.case, meshes[:1])
        meshes = meshes[1:]
    yield solid(PartLabel.TOP_PANEL, "top_panel", wood, meshes)


def top_meshes(top: Top, box: Box) -> list[TriangleMesh]:
    """Returns the solids of a straight top that fills the box."""
    if top.sink:
        return _around(box, sink_hole(box))
    if top.edge in ("moulded", "cornice"):
        middle, step = float(box.center[2]), MOULDED_STEP
        lower = Box(box.low + vec3(step, step, 0.0), vec3(box.high[0] - step, box.high[1], middle))
        upper = Box(vec3(box.low[0], box.low[1], middle), box.high)
        return [TriangleMesh.box_mesh(lower), TriangleMesh.box_mesh(upper)]
    if top.edge == "square":
        return [bow_fronted_board(box, top.belly) if top.belly else TriangleMesh.box_mesh(box)]
    return [table_board(box, 0.45 * float(box.size[2]), top.edge == "rounded")]


def sink_hole(box: Box) -> Box:
    """Returns the cut-out of a basin in the middle of a top."""
    half = vec3(min(0.27, 0.36 * float(box.size[0])), 0.34 * float(box.size[1]), float(box.half[2]))
    return Box.from_center(box.center, half)


def _around(box: Box, hole: Box) -> list[TriangleMesh]:
    (x0, y0, z0), (x1, y1, z1) = box.low.tolist(), box.high.tolist()
    (a0, b0, _), (a1, b1, _) = hole.low.tolist(), hole.high.tolist()
    return [
        board((x0, y0, z0), (a0, y1, z1)),
        board((a1, y0, z0), (x1, y1, z1)),
        board((a0, y0, z0), (a1, b0, z1)),
        board((a0, b1, z0), (a1, y1, z1)),
    ]


def _basin(hole: Box, rim: float, finish: Finish) -> PieceDraft:
    (x0, y0, _), (x1, y1, _) = hole.low.tolist(), hole.high.tolist()
    w, low = BASIN_WALL, rim - BASIN_DEPTH
    spans: tuple[Span, ...] = (
        ((x0, y0, low), (x1, y1, low + w)),
        ((x0, y0, low + w), (x0 + w, y1, rim + w)),
        ((x1 - w, y0, low + w), (x1, y1, rim + w)),
        ((x0 + w, y0, low + w), (x1 - w, y0 + w, rim + w)),
        ((x0 + w, y1 - w, low + w), (x1 - w, y1, rim + w)),
    )
    return plank(PartLabel.MISC, "basin", finish.metal, *spans)


def _rim(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    if case.top.rim:
        box = over_box(case)
        (x0, _, _), (x1, y1, z1) = box.low.tolist(), box.high.tolist()
        yield plank(PartLabel.BAR, "splashback", finish.case, ((x0, y1 - case.panel, z1), (x1, y1, z1 + case.top.rim)))


def _stretchers(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    """Yields flat bars along both sides, an upright one at the back and, without a face frame, a flat one in front."""
    t, h, inner = case.panel, case.height, case.width / 2 - max(case.panel, case.posts)
    w = min(case.top.width, inner / 3, (case.inner_back - case.carcass) / 4)
    y0, y1 = case.carcass, case.inner_back
    if case.posts > t:
        y0, y1 = case.posts - case.depth / 2, min(y1, case.depth / 2 - case.posts)
    for _, at in both_sides(((inner - w, y0, h - t), (inner, y1, h))):
        yield plank(PartLabel.BAR, "top_stretcher", finish.case, at)
    if not case.back.rails:
        yield _back_stretcher(case, finish, inner)
    if case.face is None:
        yield plank(PartLabel.BAR, "top_stretcher", finish.case, ((w - inner, y0, h - t), (inner - w, y0 + w, h)))


def _back_stretcher(case: Case, finish: Finish, inner: float) -> PieceDraft:
    """Returns the upright bar in line with the back, which ends below it."""
    y1 = max(case.depth / 2, case.inner_back + 0.006)
    span = ((-inner, case.inner_back, case.height - case.top.width), (inner, y1, case.height))
    return plank(PartLabel.BAR, "top_stretcher", finish.case, span)


def _corner_blocks(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    w, h, x = case.top.width, case.height, case.width / 2 - max(case.panel, case.posts)
    for y in (case.carcass, case.inner_back - w):
        for _, at in both_sides(((x - w, y, h - case.panel), (x, y + w, h))):
            yield plank(PartLabel.MISC, "corner_block", finish.case, at)
