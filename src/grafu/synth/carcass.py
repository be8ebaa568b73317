"""All still parts of a case together, in the order that people list them. It knows no fronts."""

from grafu.synth.assembly import Piece
from grafu.synth.bases import base_pieces
from grafu.synth.case import Case
from grafu.synth.finish import Finish
from grafu.synth.frame import frame_pieces
from grafu.synth.panels import back_pieces, bottom_pieces, side_pieces
from grafu.synth.tops import top_pieces


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
