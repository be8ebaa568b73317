"""Pieces of a front whose names begin as that of the front: stiles and trims around a panel (`left_door_trim_top`).

They lie beside the panel, so no outline covers them; their common beginning and their contact tell that they are one.
"""

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.labels import sense_of
from grafu.asset.names import CAMEL, singular, spoken
from grafu.asset.part import Part
from grafu.asset.pieces import in_words, with_pieces
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios

# Where a beginning may end: before a sign or a capital letter that another word follows; numbers tell wholes apart.
_ENDS: Final = re.compile(rf"{CAMEL.pattern}|(?=[ _.:-]+[^\W\d_])")


@final
@dataclass(frozen=True, slots=True)
class LeafPieceConfig:
    """Which pieces hang together with their front.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    touch: float = 0.004
    """How far a piece lies from the front, or from another piece, at most (fraction of the object's diagonal)."""
    plate: float = 0.25
    """Greatest thickness of the front and all its pieces (fraction of its shorter other side): no box is one."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_leaf_pieces(
    parts: tuple[Part, ...], whole: Box, config: LeafPieceConfig = LeafPieceConfig()
) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts in which pieces of a front are joined to the one part of their beginning that is a whole.

    Where several are, as of doors that are numbered behind their word, nothing is joined.

    Args:
        parts: labelled parts in any one frame.
        whole: the box around them, for tolerances.
        config: the tolerances.
    """
    named: dict[str, list[Part]] = {}
    for part in parts:
        beginning = _beginning(part.source.name) if part.label.is_movable and part.carried_by is None else ""
        if beginning:
            named.setdefault(beginning, []).append(part)
    found: dict[str, list[Part]] = {}
    for members in named.values():
        fronts = [part for part in members if _names_whole(part.source.name)]
        if len(fronts) == 1:
            (front,) = fronts
            pieces = _hanging(front, [p for p in members if p is not front], config.touch * whole.diagonal)
            if pieces and _is_plate(Box.enclosing(part.box for part in (front, *pieces)), front.box, config):
                found[front.id] = pieces
    joined = {piece.id: front for front, pieces in found.items() for piece in pieces}
    seen = (replace(part, labelled_by="shape") if part.id in found else part for part in parts)  # it hides no front
    kept = tuple(with_pieces(part, found.get(part.id, []), joined) for part in seen if part.id not in joined)
    return kept, [f"{in_words(pieces)} joined to {front}" for front, pieces in found.items()]


def _beginning(name: str) -> str:
    """Returns the shortest beginning of a name that names one door or drawer; empty where none does."""
    ends = (*(match.start() for match in _ENDS.finditer(name)), len(name))
    return next((name[:end] for end in ends if end and _names_whole(name[:end])), "")


def _names_whole(name: str) -> bool:
    """Whether a name is that of one door or drawer and of no piece of it; what it belongs to may stand before."""
    sense, said = sense_of(name), spoken(name)
    is_one = sense.label.is_movable and not (sense.is_piece or sense.is_blurred)
    return bool(is_one and said) and all(singular(word) == word for word in said[-1:])


def _hanging(front: Part, pieces: Sequence[Part], touch: float) -> list[Part]:
    """Returns the pieces that touch a front, or one that does."""
    reached, left, held = [front], list(pieces), list[Part]()
    while reached:
        box = reached.pop().box
        near = [piece for piece in left if piece.box.overlaps(box, touch)]
        left = [piece for piece in left if piece not in near]
        held += near
        reached += near
    return [piece for piece in pieces if any(piece is one for one in held)]


def _is_plate(box: Box, front: Box, config: LeafPieceConfig) -> bool:
    """Whether a front with its pieces is still a plate, as thin along the same axis."""
    across = np.delete(box.size, front.thin_axis)
    return bool(box.size[front.thin_axis] <= config.plate * across.min())
