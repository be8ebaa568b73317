"""Wall units with flaps that lift upright, or two leaves above each other that fold up: specimens for tests.

Their joints are not stated: a test states how they move.
"""

from dataclasses import replace
from typing import final

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.synth.cabinets.cabinet import Cabinet, cabinet_pieces
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Base
from grafu.synth.fronts.layout import Door
from grafu.synth.fronts.setting import Mount
from grafu.synth.pieces.assembly import PieceDraft, assemble, plank
from grafu.vocabulary import PartLabel

WALL_UNIT = Case(0.9, 0.4, 0.35, base=Base("none"))


@final
@dataclass(frozen=True, slots=True)
class WallUnit:
    """A wall unit, metres: one flap over its whole front, or `leaves` of equal height above each other.

    Raises:
        ValueError: if there are neither one nor two leaves.
    """

    name: str = "wall_unit"
    case: Case = WALL_UNIT
    leaves: int = 1
    mount: Mount = "overlay"
    front: float = 0.018
    gap: float = 0.003
    shelves: int = 0

    def __post_init__(self) -> None:
        if self.leaves not in (1, 2):
            raise ValueError(f"`WallUnit.leaves` must be 1 or 2: got {self.leaves}")


def make_wall_unit(spec: WallUnit) -> Asset:
    """Returns the wall unit without stated joints; its flap is `door`, of two leaves `door_1` is the upper one."""
    flap = Door("top", handle="none", shelves=spec.shelves)
    cabinet = Cabinet(spec.name, spec.case, flap, spec.mount, spec.front, spec.gap)
    pieces = [replace(piece, motion=None) for piece in cabinet_pieces(cabinet)]
    if spec.leaves == 1:
        return assemble(spec.name, pieces)
    others = [piece for piece in pieces if piece.label is not PartLabel.DOOR]
    door = next(piece for piece in pieces if piece.label is PartLabel.DOOR)
    halves = _halves(door.surfaces[0].mesh.box, spec.gap)
    return assemble(spec.name, [*others, *(_leaf(half, cabinet) for half in halves)])


def _halves(box: Box, gap: float) -> tuple[Box, Box]:
    """Returns a front parted in two of equal height, the upper one first, with a seam between."""
    middle = float(box.center[2])
    upper, lower = box.low.copy(), box.high.copy()
    upper[2], lower[2] = middle + gap / 2, middle - gap / 2
    return Box(upper, box.high), Box(box.low, lower)


def _leaf(box: Box, cabinet: Cabinet) -> PieceDraft:
    low, high = ((float(p[0]), float(p[1]), float(p[2])) for p in (box.low, box.high))
    return plank(PartLabel.DOOR, "door", cabinet.finish.front, (low, high))
