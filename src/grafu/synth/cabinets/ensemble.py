"""Several cabinets as one piece: a hutch on a base, kitchen units side by side, bridges over a gap."""

from collections.abc import Iterator
from math import pi
from typing import final

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.synth.cabinets.cabinet import Cabinet, cabinet_pieces
from grafu.synth.pieces.assembly import PieceDraft, assemble
from grafu.synth.pieces.finish import surface_of
from grafu.synth.pieces.shapes import board
from grafu.vocabulary import PartLabel

Corner = tuple[float, float, float]


@final
@dataclass(frozen=True, slots=True)
class Placed:
    """A cabinet and where the middle of its footprint stands, metres; `turned` faces +Y instead of -Y."""

    spec: Cabinet
    at: Corner = (0.0, 0.0, 0.0)
    turned: bool = False


@final
@dataclass(frozen=True, slots=True)
class Slab:
    """A still board of its own between two corners, metres: a worktop over several units, a panel, a post."""

    label: PartLabel
    stem: str
    low: Corner
    high: Corner


@final
@dataclass(frozen=True, slots=True)
class Ensemble:
    """Cabinets and the boards that join them. Members may touch; they must not overlap.

    Raises:
        ValueError: if there is no member.
    """

    name: str
    members: tuple[Placed, ...]
    boards: tuple[Slab, ...] = ()

    def __post_init__(self) -> None:
        if not self.members:
            raise ValueError("`Ensemble` must have a member: got none")


def make_ensemble(spec: Ensemble) -> Asset:
    """Returns the ensemble with its true joints.

    Raises:
        ValueError: if a member's layout leaves some cell no room.
    """
    return assemble(spec.name, list(_pieces(spec)))


def _pieces(spec: Ensemble) -> Iterator[PieceDraft]:
    for member in spec.members:
        turn = rotation_matrix(vec3(0.0, 0.0, 1.0), pi if member.turned else 0.0)
        T = from_rotation(turn, vec3(*member.at))
        yield from (piece.transformed(T) for piece in cabinet_pieces(member.spec))
    finish = spec.members[0].spec.finish
    for slab in spec.boards:
        yield PieceDraft(slab.label, slab.stem, (surface_of(board(slab.low, slab.high), finish.case),))
