"""Tables that become longer: two halves of a top that slide apart, or draw leaves under a top."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Literal, final

from grafu.articulation.articulated_object import Coupling
from grafu.asset.part import AnnotatedJoint, Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.edges import Slide
from grafu.synth.case.legs import Leg, LegShape
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, Span, assemble, plank
from grafu.synth.pieces.finish import PLAIN, Finish
from grafu.synth.tables.table_parts import table_legs
from grafu.vocabulary import PartLabel

_SINK = 0.002  # metres between a draw leaf and the top above it
_INSET = 0.06  # metres by which apron and legs stand back from the top's edges
_BEARER = 0.1  # metres: how wide the board is that carries the top between two draw leaves


@final
@dataclass(frozen=True, slots=True)
class ExtendingTable:
    """A table, metres: its halves slide apart, the second following the first, or two draw leaves come out.

    `travel` is how far each comes out, over its own length.

    Raises:
        ValueError: if `travel` is not between 0 and 1.
    """

    name: str = "table"
    kind: Literal["halves", "draw leaves"] = "halves"
    width: float = 1.4
    depth: float = 0.8
    height: float = 0.74
    top: float = 0.022
    leg: float = 0.06
    apron: float = 0.08
    travel: float = 0.7
    finish: Finish = PLAIN
    leg_shape: LegShape = "square"
    leg_foot: float = 0.6

    def __post_init__(self) -> None:
        if not 0 < self.travel < 1:
            raise ValueError(f"`ExtendingTable.travel` must be between 0 and 1: got {self.travel}")


def make_extending_table(spec: ExtendingTable) -> Asset:
    """Returns the table with the true joints of its leaves; positive values bring them out."""
    asset = assemble(spec.name, [*_frame(spec), *_leaves(spec)])
    if spec.kind == "draw leaves":
        return asset
    first, second = asset.joints
    follows: AnnotatedJoint = replace(second, coupling=Coupling(first.part))
    return replace(asset, joints=(first, follows))


def _under(spec: ExtendingTable) -> float:
    """Returns the height of the frame's upper side: below the halves, or below the draw leaves."""
    return spec.height - (spec.top if spec.kind == "halves" else 2 * spec.top + _SINK)


def _frame(spec: ExtendingTable) -> Iterator[PieceDraft]:
    """Yields legs and aprons."""
    x, y, high = spec.width / 2 - _INSET, spec.depth / 2 - _INSET, _under(spec)
    leg, wood = Leg(spec.leg_shape, spec.leg, spec.leg_foot), spec.finish.case
    yield from table_legs(leg, (x - spec.leg / 2, y - spec.leg / 2), high, spec.apron, spec.finish)
    z, thick = high - spec.apron, spec.leg / 3
    inner = x - spec.leg
    for sy in (-1, 1):
        near = sorted((sy * y, sy * (y - thick)))
        yield plank(PartLabel.BAR, "apron", wood, ((-inner, near[0], z), (inner, near[1], high)))
    for sx in (-1, 1):
        near = sorted((sx * x, sx * (x - thick)))
        yield plank(PartLabel.BAR, "apron", wood, ((near[0], spec.leg - y, z), (near[1], y - spec.leg, high)))


def _leaves(spec: ExtendingTable) -> Iterator[PieceDraft]:
    """Yields the halves; or the top, the bearer below it and the draw leaves on either side of that."""
    high, x, y = spec.height, spec.width / 2, spec.depth / 2
    if spec.kind == "halves":
        yield from (_leaf(spec, side, 0.0, x, (high - spec.top, high)) for side in (-1, 1))
        return
    low, middle = _under(spec), _BEARER / 2
    yield plank(PartLabel.TOP_PANEL, "top", spec.finish.front, ((-x, -y, high - spec.top), (x, y, high)))
    yield plank(
        PartLabel.BAR, "bearer", spec.finish.front, ((-middle, -y + _INSET, low), (middle, y - _INSET, high - spec.top))
    )
    yield from (_leaf(spec, side, middle + _SINK, x, (low, low + spec.top)) for side in (-1, 1))


def _leaf(spec: ExtendingTable, side: int, start: float, end: float, heights: tuple[float, float]) -> PieceDraft:
    """Returns a leaf from `start` to `end` on one side of the middle, with its motion outwards."""
    low, high = sorted((side * start, side * end))
    span: Span = ((low, -spec.depth / 2, heights[0]), (high, spec.depth / 2, heights[1]))
    axis = Axis(vec3((low + high) / 2, 0.0, sum(heights) / 2), vec3(float(side), 0.0, 0.0))
    motion = PieceMotion(Slide.joint_type, axis, spec.travel * (high - low))
    stem = "top_half" if spec.kind == "halves" else "extension_leaf"
    return replace(plank(PartLabel.TOP_PANEL, stem, spec.finish.front, span), motion=motion)
