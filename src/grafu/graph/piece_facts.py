"""What is known of a whole piece of furniture beside its functional graph, and the same as codes."""

from collections.abc import Mapping, Sequence, Set
from dataclasses import field
from typing import NamedTuple, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.graph.arrays import NONE
from grafu.shapes import Int64
from grafu.vocabulary import PieceKind

STATIC = ""
"""The body of parts that do not move."""


@final
@dataclass(frozen=True)
class PieceFacts:
    """The kind of the piece, which parts are drawn ajar, and the moving part that each part moves as one with.

    `bodies` names for each part the moving part of its rigid body (a handle's is its door), `STATIC` for what stands.
    None, and no bodies, mean that it is not known.
    """

    kind: PieceKind | None = None
    ajar: Set[str] | None = None
    bodies: Mapping[str, str] = field(default_factory=dict)


NOT_KNOWN = PieceFacts()
PIECES: tuple[PieceKind, ...] = tuple(PieceKind)


class FactCodes(NamedTuple):
    """The facts about n parts as codes; `NONE` is what is not known.

    `bodies` are 0 for what stands, else 1 more than the place of the moving part that a part moves as one with; `ajar`
    is 0 or 1, `kind` a place in `PIECES`.
    """

    bodies: Int64[np.ndarray, " n"]
    ajar: Int64[np.ndarray, " n"]
    kind: int


def fact_codes(facts: PieceFacts, names: Sequence[str]) -> FactCodes:
    """Returns the facts about the parts of these ids, in their order.

    Raises:
        KeyError: if a part moves as one with one that is none of these.
    """
    numbers = {STATIC: 0} | {name: place + 1 for place, name in enumerate(names)}
    bodies = [numbers[facts.bodies[name]] if name in facts.bodies else NONE for name in names]
    ajar = [NONE if facts.ajar is None else int(name in facts.ajar) for name in names]
    kind = NONE if facts.kind is None else PIECES.index(facts.kind)
    return FactCodes(np.array(bodies, dtype=np.int64), np.array(ajar, dtype=np.int64), kind)


def facts_of(codes: FactCodes, names: Sequence[str]) -> PieceFacts:
    """Returns the facts that codes state; of a piece without parts it is not known what is drawn ajar."""
    body_of = zip(names, codes.bodies.tolist(), strict=True)
    bodies = {name: names[body - 1] if body else STATIC for name, body in body_of if body != NONE}
    drawn = codes.ajar.tolist()
    ajar = None if NONE in drawn or not drawn else frozenset(names[k] for k, is_ajar in enumerate(drawn) if is_ajar)
    return PieceFacts(None if codes.kind == NONE else PIECES[codes.kind], ajar, bodies)
