"""What carries the raised leaves of a drop-leaf table: brackets and gate legs that swing out, lopers that slide out."""

from collections.abc import Iterator
from math import pi
from typing import Literal, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.appearance import Material
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.edges import Hinge, Slide
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, Span, plank, solid
from grafu.synth.pieces.shapes import prism_along_x
from grafu.synth.sampling.chance import between, chance
from grafu.vocabulary import PartLabel

_SEAM = 0.001  # metres between a support and what it passes
_MIDDLE = 0.006  # metres from the middle of the table to the nearer ends of two supports
_TIP = 0.4  # of a bracket's height: what is left of it at its free end
_RAIL = 0.04  # metres: how high the rails of a gate are
_STRETCHER = 0.14  # metres above the floor: the lower rail of a gate, and the one of the table behind it
_SLOT = 0.0015  # metres between a loper and the apron around it
_PROUD = 0.012  # metres that a swinging support stays off the legs of the frame, which stand out beside the apron
_TRAVEL = 0.6  # of a loper's length: how far it comes out
_BACK = 1.5  # times the distance from the table's middle to its apron: how long a loper is at most


@final
@dataclass(frozen=True, slots=True)
class LeafSupports:
    """`count` supports of each leaf; they reach out by `reach` of its length, and are `thickness` metres thick.

    `inwards`: two that swing have their pins apart, and lie folded towards each other.

    Raises:
        ValueError: if there are neither one nor two, or `reach` is not between 0 and 1.
    """

    kind: Literal["bracket", "gate", "loper"] = "bracket"
    count: int = 1
    reach: float = 0.7
    thickness: float = 0.018
    inwards: bool = True

    def __post_init__(self) -> None:
        if self.count not in (1, 2) or not 0 < self.reach < 1:
            raise ValueError(f"`LeafSupports` must be one or two that reach less than a leaf: got {self.count}")


@final
@dataclass(frozen=True, slots=True)
class TableEnd:
    """The frame of a table at one end, metres: `side` is -1 at the left end and 1 at the right one.

    `face` is how far from the middle the apron's outer face is, `board` how thick the apron; `free` is half of what is
    free between the legs, `under` the underside of the top; `drop` is how long the leaf is.
    """

    side: float
    face: float
    board: float
    free: float
    under: float
    apron: float
    drop: float
    wood: Material

    def span(self, x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]) -> Span:
        """Returns a board between two distances from the middle outwards, two places along, and two heights."""
        (x0, x1), (y0, y1) = sorted((self.side * x[0], self.side * x[1])), sorted(y)
        return (x0, y0, z[0]), (x1, y1, z[1])


def drawn_supports(rng: np.random.Generator, depth: float) -> LeafSupports:
    """Returns supports of random kind and size for a table of a depth."""
    kinds: tuple[Literal["bracket", "gate", "loper"], ...] = ("bracket", "gate", "loper")
    kind = kinds[int(rng.integers(len(kinds)))]
    count = 2 if depth > 0.85 and kind != "gate" and chance(rng, 0.6) else 1
    thickness = between(rng, (0.024, 0.032) if kind == "gate" else (0.014, 0.022))
    return LeafSupports(kind, count, between(rng, (0.55, 0.9)), thickness, chance(rng, 0.5))


def apron_of(frame: TableEnd, supports: LeafSupports | None) -> Iterator[Span]:
    """Yields the boards of the apron, with slots where lopers pass it."""
    x, low = (frame.face - frame.board, frame.face), frame.under - frame.apron
    if supports is None or supports.kind != "loper":
        yield frame.span(x, (-frame.free, frame.free), (low, frame.under))
        return
    half, sill = supports.thickness / 2 + _SLOT, frame.under - _SEAM - _height(frame) - _SLOT
    yield frame.span(x, (-frame.free, frame.free), (low, sill))
    ends = [-frame.free, *(y + off for y in _places(frame, supports) for off in (-half, half)), frame.free]
    for first, last in zip(ends[::2], ends[1::2], strict=True):
        yield frame.span(x, (first, last), (sill, frame.under))


def bars_of(frame: TableEnd, supports: LeafSupports | None) -> Iterator[Span]:
    """Yields the stretcher beside which gates lie folded."""
    if supports is not None and supports.kind == "gate":
        z = _STRETCHER, _STRETCHER + _RAIL
        yield frame.span((frame.face - frame.board, frame.face), (-frame.free, frame.free), z)


def supports_of(frame: TableEnd, supports: LeafSupports) -> Iterator[PieceDraft]:
    """Yields the supports of the leaf at one end, with their true joints: out to a right angle, or along themselves."""
    if supports.kind == "loper":
        yield from (_loper(frame, supports, y) for y in _places(frame, supports))
        return
    length = _length(frame, supports)
    if supports.count == 1:
        pins = [(-frame.side * length / 2, frame.side)]
    elif supports.inwards:
        pins = [(sign * (length + _MIDDLE), -sign) for sign in (-1.0, 1.0)]
    else:
        pins = [(sign * (supports.thickness + _MIDDLE), sign) for sign in (-1.0, 1.0)]
    for pin, along in pins:
        boards = _gate if supports.kind == "gate" else _bracket
        yield boards(frame, supports, pin, along, _swing(frame, pin, along))


def _length(frame: TableEnd, supports: LeafSupports) -> float:
    """Returns how long what swings is: less than was asked for where legs or the other one leave no more room."""
    room = 2 * (frame.free - supports.thickness - _PROUD) / supports.count - 2 * _MIDDLE
    return min(supports.reach * frame.drop, room)


def _height(frame: TableEnd) -> float:
    """Returns how high a bracket at its pin and a loper are."""
    return min(_RAIL, frame.apron / 2)


def _swing(frame: TableEnd, pin: float, along: float) -> PieceMotion:
    """Returns the quarter turn out of the frame about a pin; folded, the support points `along` y."""
    axis = Axis(vec3(frame.side * (frame.face + _SEAM), pin, 0.0), vec3(0.0, 0.0, -along * frame.side))
    return PieceMotion(Hinge.joint_type, axis, pi / 2)


def _bracket(frame: TableEnd, supports: LeafSupports, pin: float, along: float, motion: PieceMotion) -> PieceDraft:
    """Returns a plank that tapers from its pin to its end."""
    top, tip = frame.under - _SEAM, pin + along * _length(frame, supports)
    tall = 1.5 * _height(frame)
    outline = [(pin, top - tall), (tip, top - _TIP * tall), (tip, top), (pin, top)]
    x0, x1 = sorted(frame.side * (frame.face + _SEAM + off) for off in (0.0, supports.thickness))
    mesh = prism_along_x(outline if along > 0 else outline[::-1], x0, x1)
    piece = solid(PartLabel.MISC, "bracket", frame.wood, (mesh,))
    return PieceDraft(piece.label, piece.stem, piece.surfaces, motion)


def _gate(frame: TableEnd, supports: LeafSupports, pin: float, along: float, motion: PieceMotion) -> PieceDraft:
    """Returns a post, two rails and a leg that stands on the floor."""
    thick, top = supports.thickness, frame.under - _SEAM
    x = frame.face + _SEAM, frame.face + _SEAM + thick
    tip = pin + along * _length(frame, supports)
    between_posts = (pin + along * thick, tip - along * thick)
    spans = (
        frame.span(x, (pin, pin + along * thick), (_STRETCHER, top)),
        frame.span(x, (tip - along * thick, tip), (0.0, top)),
        frame.span(x, between_posts, (top - _RAIL, top)),
        frame.span(x, between_posts, (_STRETCHER, _STRETCHER + _RAIL)),
    )
    piece = plank(PartLabel.LEG, "gateleg", frame.wood, *spans)
    return PieceDraft(piece.label, piece.stem, piece.surfaces, motion)


def _places(frame: TableEnd, supports: LeafSupports) -> list[float]:
    """Returns where lopers are along the end of the table; those of the other end pass beside them."""
    off = frame.side * supports.thickness
    return [off] if supports.count == 1 else [off - frame.free / 2, off + frame.free / 2]


def _loper(frame: TableEnd, supports: LeafSupports, place: float) -> PieceDraft:
    length, top, half = min(_BACK * frame.face, frame.drop), frame.under - _SEAM, supports.thickness / 2
    x, y = (frame.face - length, frame.face), (place - half, place + half)
    piece = plank(PartLabel.BAR, "loper", frame.wood, frame.span(x, y, (top - _height(frame), top)))
    axis = Axis(vec3(frame.side * frame.face, place, top), vec3(frame.side, 0.0, 0.0))
    return PieceDraft(piece.label, piece.stem, piece.surfaces, PieceMotion(Slide.joint_type, axis, _TRAVEL * length))
