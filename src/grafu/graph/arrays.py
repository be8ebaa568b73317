"""A functional graph as arrays of codes and boxes, and the codes.

The codes of edges are the authors', 0 to 4, and behind them our kinds; those of labels are the order of `PartLabel`.
All edges of a moving part state one motion, so that a motion is a property of the part here. That one part follows
another is left out.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, freeze_arrays
from grafu.graph.edges import Attached, Contact, Edge, Hinge, ends_of, kind_of
from grafu.graph.functional_graph import FunctionalGraph, paper_edges
from grafu.shapes import Bool, Float64, Int64
from grafu.vocabulary import EdgeKind, PartLabel

KindSet = Literal["paper", "all"]
"""The kinds of edges that a network knows: the paper's four, or `slide` and `turn` and motions on moving parts, too."""

CONTACT, HINGE, RAIL, ATTACHED, NULL, SLIDE, TURN = range(7)
ALONG = (RAIL, SLIDE, TURN)  # the kinds whose motion is a signed axis
KIND_CODES: Mapping[EdgeKind, int] = MappingProxyType(
    {
        EdgeKind.CONTACT: CONTACT,
        EdgeKind.HINGE: HINGE,
        EdgeKind.RAIL: RAIL,
        EdgeKind.ATTACHED: ATTACHED,
        EdgeKind.SLIDE: SLIDE,
        EdgeKind.TURN: TURN,
    }
)
KIND_OF: Mapping[int, EdgeKind] = MappingProxyType({code: kind for kind, code in KIND_CODES.items()})
EDGE_WORDS = tuple(KIND_OF[code].value if code in KIND_OF else "none" for code in range(7))
EDGE_CODES: Mapping[KindSet, int] = MappingProxyType({"paper": NULL + 1, "all": TURN + 1})
"""How many codes of edges there are, that of no edge among them."""
NONE = -1  # there is no such motion, or it is not known
LABELS: tuple[PartLabel, ...] = tuple(PartLabel)  # the place is the code; `unknown` is the last
LABEL_CODES = {label: code for code, label in enumerate(LABELS)}
DOOR, DRAWER, HANDLE, UNKNOWN = (
    LABEL_CODES[label] for label in (PartLabel.DOOR, PartLabel.DRAWER, PartLabel.HANDLE, PartLabel.UNKNOWN)
)


@final
@dataclass(frozen=True, eq=False, slots=True)
class GraphArrays(ArrayValue):
    """A graph of n nodes. `boxes` are centres and half sizes.

    `edges` are codes, symmetric, null where there is none; `child[i, j]` states that i hangs on j: it is the moving
    part or the handle of their edge. `border`, `sign` and `slide` are motion codes, `NONE` for parts without such a
    motion; `slide` is the signed axis of a rail, a slide or a turn.
    """

    labels: Int64[np.ndarray, " n"]
    boxes: Float64[np.ndarray, "n 6"]
    edges: Int64[np.ndarray, "n n"]
    child: Bool[np.ndarray, "n n"]
    border: Int64[np.ndarray, " n"]
    sign: Int64[np.ndarray, " n"]
    slide: Int64[np.ndarray, " n"]

    def __post_init__(self) -> None:
        freeze_arrays(self)


def graph_arrays(graph: FunctionalGraph, kinds: KindSet = "all") -> GraphArrays:
    """Returns the graph as arrays, nodes in its order, boxes in the object frame, metres.

    With the paper's `kinds`, what they cannot state is a contact (`paper_edges`).
    """
    place = {node.id: k for k, node in enumerate(graph.nodes)}
    count = len(place)
    edges, child = np.full((count, count), NULL), np.zeros((count, count), dtype=bool)
    motion = np.full((3, count), NONE)
    for edge in graph.edges if kinds == "all" else paper_edges(graph):
        first, second = (place[end] for end in ends_of(edge))
        edges[first, second] = edges[second, first] = KIND_CODES[kind_of(edge)]
        child[second, first] = not isinstance(edge, Contact)
        motion[:, second] = np.maximum(motion[:, second], _motion(edge))
    lows = np.array([n.box.low for n in graph.nodes]).reshape(-1, 3)
    highs = np.array([n.box.high for n in graph.nodes]).reshape(-1, 3)
    labels = np.array([LABEL_CODES[n.label] for n in graph.nodes], dtype=np.int64)
    return GraphArrays(labels, np.hstack([(lows + highs) / 2, (highs - lows) / 2]), edges, child, *motion)


def _motion(edge: Edge) -> tuple[int, int, int]:
    if isinstance(edge, Contact | Attached):
        return NONE, NONE, NONE
    return (edge.border, edge.sign, NONE) if isinstance(edge, Hinge) else (NONE, NONE, edge.axis)
