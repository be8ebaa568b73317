"""All still parts of a case together, in the order that people list them. It knows no fronts."""

from grafu.synth.case.bases import base_pieces
from grafu.synth.case.case import Case
from grafu.synth.case.frame import frame_pieces
from grafu.synth.case.panels import back_pieces, bottom_pieces, side_pieces
from grafu.synth.case.tops import top_pieces
from grafu.synth.pieces.assembly import Piece
from grafu.synth.pieces.finish import Finish


def case_pieces(case: Case, finish: Finish, out: float) -> tuple[Piece, ...]:
    """Returns the still parts of a case; `out` is the y of the fronts' outer faces, which a moulding juts beyond."""
    return (
        *side_pieces(case, finish),
        *bottom_pieces(case, finish),
        *back_pieces(case, finish),
        *top_pieces(case, finish),
        *base_pieces(case, finish),
        *frame_pieces(case, finish, out),
    )
