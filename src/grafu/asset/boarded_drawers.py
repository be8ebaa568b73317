"""Drawers whose boards are named as theirs, and whose front is not: the plates that the box of boards ends at.

It looks at names and boxes, in any frame of axes. A front may be one plate, or a frame with an infill, and may have
bands and mouldings.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.labels import is_piece
from grafu.asset.names import spoken
from grafu.asset.part import Part
from grafu.asset.pieces import in_words, with_pieces
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.vocabulary import PartLabel

_BOARDS = frozenset({"side", "back", "bottom", "base", "floor"})
_FRONTS = frozenset({"front", "face"})


@final
@dataclass(frozen=True, slots=True)
class BoardedDrawerConfig:
    """Which plates are the front of a box of boards.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    touch: float = 0.0006
    """How far apart boards and plates that hang together lie at most (fraction of the diagonal of all)."""
    beside: float = 0.003
    """How far a band or a moulding stands out of the front (fraction of the diagonal of all)."""
    thin: float = 0.6
    """Greatest thickness of a front (fraction of its shorter other side)."""
    board: float = 0.2
    """Greatest thickness of a board that is no drawer by itself (fraction of its shorter other side)."""
    most: float = 4.0
    """Greatest outline of a front (fraction of the outline of its box): what is larger is a wall of the piece."""

    def __post_init__(self) -> None:
        require_positive(self, "most")
        require_ratios(self, "touch", "beside", "thin", "board")


@final
@dataclass(frozen=True)
class _Front:
    """The axis along which a box of boards ends at plates, whether at its upper end, and these."""

    axis: int
    is_upper: bool
    plates: tuple[Part, ...]


def with_boarded_drawers(
    parts: tuple[Part, ...], whole: Box, config: BoardedDrawerConfig = BoardedDrawerConfig()
) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts in which the boards of a drawer and the plates that they end at are one, and notes on that.

    A box that touches what is called a drawer or a front has its front by name, and stays. So does one that ends at
    plates on two sides, and one that shares a plate with another. A thin board that is joined to nothing, with no
    drawer beside it, is no drawer by itself: its shape tells what it is.

    Args:
        parts: labelled parts in any one frame.
        whole: the box around them, for tolerances.
        config: the tolerances.
    """
    touch = config.touch * whole.diagonal
    boards = [p for p in parts if p.label is PartLabel.DRAWER and p.carried_by is None and _is_board(p)]
    if len(boards) < 2:
        return parts, []
    others = [p for p in parts if p.label is not PartLabel.HANDLE and not any(p is board for board in boards)]
    found: list[tuple[list[Part], _Front]] = []
    for box in _hanging_together(boards, touch):
        front = _front(box, others, touch, config) if len(box) > 1 else None
        if front is not None:
            found.append((box, front))
    plates = [plate.id for _, front in found for plate in front.plates]
    alone = [(box, front) for box, front in found if all(plates.count(plate.id) == 1 for plate in front.plates)]
    members: dict[str, list[Part]] = {}
    for box, front in alone:
        face = max(front.plates, key=lambda p: float(np.prod(np.delete(p.box.size, front.axis))))
        free = [p for p in others if p.id not in plates and not p.label.is_movable]
        pieces = [*front.plates, *_on_front(front, free, touch, config.beside * whole.diagonal)]
        members[face.id] = [p for p in (*pieces, *box) if p is not face]
    joined = {piece.id: host for host, pieces in members.items() for piece in pieces}
    loose = {p.id for p in boards if p.id not in joined and _is_loose(p, parts, boards, touch, config)}
    kept = tuple(_joined(p, members, joined) for p in parts if p.id not in joined)
    kept = tuple(replace(p, label=PartLabel.UNKNOWN, labelled_by="none") if p.id in loose else p for p in kept)
    return kept, [
        f"{in_words(pieces)} joined to {host}, the front that they end at" for host, pieces in members.items()
    ]


def _is_board(part: Part) -> bool:
    said = set(spoken(part.source.name))
    return is_piece(part.source.name) and bool(said & _BOARDS) and not said & _FRONTS


def _is_loose(
    board: Part, parts: Sequence[Part], boards: Sequence[Part], touch: float, config: BoardedDrawerConfig
) -> bool:
    """Whether a board of a drawer is no drawer by itself: it is thin, and no drawer's front or body is beside it."""
    thin, other = np.sort(board.box.size)[:2]
    if float(thin) > config.board * float(other):
        return False
    drawers = (p for p in parts if p.label is PartLabel.DRAWER and not any(p is one for one in boards))
    return not any(p.box.overlaps(board.box, touch) for p in drawers)


def _joined(part: Part, members: dict[str, list[Part]], joined: dict[str, str]) -> Part:
    made = with_pieces(part, members.get(part.id, []), joined)
    return replace(made, label=PartLabel.DRAWER, labelled_by="shape") if part.id in members else made


def _hanging_together(parts: Sequence[Part], touch: float) -> list[list[Part]]:
    """Returns the parts in groups of those that touch each other."""
    left, groups = list(parts), list[list[Part]]()
    while left:
        group, reached = [], [left.pop(0)]
        while reached:
            one = reached.pop()
            group.append(one)
            near = [p for p in left if p.box.overlaps(one.box, touch)]
            left = [p for p in left if not any(p is other for other in near)]
            reached += near
        groups.append(group)
    return groups


def _front(boards: Sequence[Part], others: Sequence[Part], touch: float, config: BoardedDrawerConfig) -> _Front | None:
    """Returns the plates that a box of boards ends at, on the one side where there are any; its back is none."""
    box = Box.enclosing(p.box for p in boards)
    near = [p for p in others if p.box.overlaps(box, touch)]
    if any(p.label is PartLabel.DRAWER or set(spoken(p.source.name)) & _FRONTS for p in near):
        return None
    backs = [p for p in boards if "back" in spoken(p.source.name)]
    found = []
    for axis, is_upper in ((axis, is_upper) for axis in range(3) for is_upper in (False, True)):
        end = _end(box, axis, is_upper)
        if any(abs(_end(p.box, axis, is_upper) - end) <= touch and p.box.thin_axis == axis for p in backs):
            continue
        plates = tuple(p for p in near if abs(_end(p.box, axis, not is_upper) - end) <= touch)
        if plates and _is_face_of(Box.enclosing(p.box for p in plates), box, axis, touch, config):
            found.append(_Front(axis, is_upper, plates))
    return found[0] if len(found) == 1 else None


def _end(box: Box, axis: int, is_upper: bool) -> float:
    return float((box.high if is_upper else box.low)[axis])


def _is_face_of(face: Box, box: Box, axis: int, touch: float, config: BoardedDrawerConfig) -> bool:
    """Whether plates cover the end of a box of boards, are thin, and are not much larger."""
    across = np.delete(np.arange(3), axis)
    low, high = face.low[across] - touch, face.high[across] + touch
    covers = bool(np.all(low <= box.low[across]) and np.all(high >= box.high[across]))
    is_thin = float(face.size[axis]) <= config.thin * float(face.size[across].min())
    return covers and is_thin and float(np.prod(face.size[across])) <= config.most * float(np.prod(box.size[across]))


def _on_front(front: _Front, free: Sequence[Part], touch: float, beside: float) -> list[Part]:
    """Returns what hangs together with the plates of a front: in their plane or before it, within their outline."""
    around = Box.enclosing(p.box for p in front.plates)
    across = np.delete(np.arange(3), front.axis)
    low, high = around.low.copy(), around.high.copy()
    low[across], high[across] = low[across] - beside, high[across] + beside
    deep = float(around.size[across].min())
    low[front.axis] -= touch if front.is_upper else deep
    high[front.axis] += deep if front.is_upper else touch
    room = Box(low, high)
    left = [p for p in free if room.contains(p.box.corners()).all()]
    reached, held = list(front.plates), list[Part]()
    while reached:
        box = reached.pop().box
        near = [p for p in left if p.box.overlaps(box, touch)]
        left = [p for p in left if not any(p is other for other in near)]
        held += near
        reached += near
    return held
