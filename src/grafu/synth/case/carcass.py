"""All still parts of a case together, in the order that people list them, and what stands before its panels.

That is the face frame, edge strips, mouldings and pilasters.
"""

from collections.abc import Iterator

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.case.bases import base_pieces
from grafu.synth.case.case import Case
from grafu.synth.case.panels import back_pieces, bottom_pieces, side_pieces
from grafu.synth.case.tops import top_pieces
from grafu.synth.pieces.assembly import Corner, PieceDraft, Span, both_sides, plank, solid, straight
from grafu.synth.pieces.finish import Finish
from grafu.synth.pieces.shapes import arched_rail
from grafu.vocabulary import PartLabel

MOULDING_DEPTH = 0.02  # metres that a moulding juts out before the fronts
PILASTER_DEPTH = 0.012  # metres that a pilaster does


def frame_pieces(case: Case, finish: Finish, out: float) -> Iterator[PieceDraft]:
    """Yields frame, moulding and pilasters; `out` is the y of the fronts' outer faces."""
    x = case.width / 2 - (case.panel if case.sides.beyond else 0.0)
    if case.face is not None:
        yield from _frame(case, finish)
    if case.moulding:
        low = case.crown - case.moulding if case.moulding_at == "top" else case.foot
        span = ((-x, out - MOULDING_DEPTH, low), (x, case.front, low + case.moulding))
        yield plank(PartLabel.BAR, "moulding", finish.case, span)
    if case.width / 2 - case.pilaster < x - 1e-4:
        low, high = case.foot, case.crown
        if case.moulding:
            low, high = (low, high - case.moulding) if case.moulding_at == "top" else (low + case.moulding, high)
        span = ((case.width / 2 - case.pilaster, out - PILASTER_DEPTH, low), (x, case.front, high))
        for _, at in both_sides(span):
            yield plank(PartLabel.BAR, "pilaster", finish.case, at)


def _frame(case: Case, finish: Finish) -> Iterator[PieceDraft]:
    spans, face = [*_stiles(case), *_rails(case)], case.face
    assert face is not None
    if face.kind != "one":
        for stem, (low, high) in spans:
            stem = "edge_strip" if face.kind == "strips" else stem
            yield solid(PartLabel.BAR, stem, finish.case, [_member(case, stem, low, high)])
        return
    meshes = [_member(case, stem, low, high) for stem, (low, high) in spans]
    yield solid(PartLabel.FACE_FRAME, "face_frame", finish.case, meshes)


def _member(case: Case, stem: str, low: Corner, high: Corner) -> TriangleMesh:
    """Returns a stile or rail; the lower rail may be arched."""
    if case.face is not None and case.face.arched and stem == "rail" and high[2] <= case.opening.z0 + 1e-9:
        return arched_rail(Box(vec3(*low), vec3(*high)), 0.6 * (high[2] - low[2]))
    return straight(low, high)


def _stiles(case: Case) -> Iterator[tuple[str, Span]]:
    """Yields the stiles, left and right; corner posts are stiles already."""
    face, low, high = case.face, case.foot, case.crown
    if case.posts or face is None:
        return
    x = case.width / 2 - (case.panel if case.sides.beyond else 0.0)
    inner = case.width / 2 - (case.panel if face.kind == "strips" else face.width)
    if x - inner > 1e-4:
        for _, span in both_sides(((inner, case.front, low), (x, case.carcass, high))):
            yield "stile", span


def _rails(case: Case) -> Iterator[tuple[str, Span]]:
    """Yields the lower and the upper rail between the stiles, where they have a height."""
    face, o = case.face, case.opening
    assert face is not None
    x = case.width / 2 - (case.panel if face.kind == "strips" else face.width)
    for low, high in ((case.foot, o.z0), (o.z1, case.crown)):
        if high - low > 1e-4:
            yield "rail", ((-x, case.front, low), (x, case.carcass, high))


def case_pieces(case: Case, finish: Finish, out: float) -> tuple[PieceDraft, ...]:
    """Returns the still parts of a case; `out` is the y of the fronts' outer faces, which a moulding juts beyond."""
    return (
        *side_pieces(case, finish),
        *bottom_pieces(case, finish),
        *back_pieces(case, finish),
        *top_pieces(case, finish),
        *base_pieces(case, finish),
        *frame_pieces(case, finish, out),
    )
