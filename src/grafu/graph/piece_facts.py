"""What is known of a whole piece of furniture beside its functional graph. It computes nothing."""

from collections.abc import Mapping, Set
from dataclasses import dataclass, field
from typing import final

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
