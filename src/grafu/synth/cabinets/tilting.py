"""Shoe cabinets: fronts that tilt about their lower edges, each with a bin behind it, in one mesh or in parts.

They are specimens for tests; the generator's own shoe cabinets have their bins in the meshes of the fronts.
"""

from collections.abc import Iterator
from dataclasses import replace
from math import radians
from typing import final

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.synth.cabinets.cabinet import Cabinet, cabinet_pieces
from grafu.synth.case.case import Case
from grafu.synth.fronts.hold import Hold
from grafu.synth.fronts.layout import CellRow, Layout, Stack, Tilt
from grafu.synth.fronts.setting import Mount
from grafu.synth.pieces.assembly import PieceDraft, assemble
from grafu.vocabulary import PartLabel

NARROW = Case(0.6, 1.0, 0.3)
_BIN = ("bin_side", "bin_side", "bin_floor")  # the last meshes of a front that tilts, in this order


@final
@dataclass(frozen=True, slots=True)
class TiltingFronts:
    """A shoe cabinet, metres: `rows` of `columns` tilting fronts; `in_parts`: whether bins are parts of their own.

    Raises:
        ValueError: if there is no row or no column.
    """

    name: str = "cabinet"
    case: Case = NARROW
    rows: int = 2
    columns: int = 1
    mount: Mount = "overlay"
    front: float = 0.018
    gap: float = 0.003
    opening: float = radians(42)
    in_parts: bool = False

    def __post_init__(self) -> None:
        if self.rows < 1 or self.columns < 1:
            raise ValueError(f"a shoe cabinet needs a row and a column: got {self.rows} and {self.columns}")


def make_tilting_fronts(spec: TiltingFronts) -> Asset:
    """Returns the shoe cabinet with the true joints of its fronts; bins that are parts ride on their fronts."""
    tilt = Tilt(handle="bar-round", opening=spec.opening, hold=Hold())
    row: Layout = tilt if spec.columns == 1 else CellRow((tilt,) * spec.columns)
    layout = row if spec.rows == 1 else Stack((row,) * spec.rows)
    cabinet = Cabinet(spec.name, spec.case, layout, spec.mount, spec.front, spec.gap)
    return assemble(spec.name, list(_pieces(cabinet, spec.in_parts)))


def _pieces(cabinet: Cabinet, in_parts: bool) -> Iterator[PieceDraft]:
    for piece in cabinet_pieces(cabinet):
        if piece.label is not PartLabel.DOOR or not in_parts:
            yield piece
            continue
        leaf, boards = piece.surfaces[: -len(_BIN)], piece.surfaces[-len(_BIN) :]
        own = (PieceDraft(PartLabel.MISC, stem, (board,)) for stem, board in zip(_BIN, boards, strict=True))
        yield replace(piece, surfaces=leaf, attached=(*piece.attached, *own))
