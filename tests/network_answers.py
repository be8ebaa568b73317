"""A network by hand: what it states about a graph is written down in words, and what is not said is unlikely.

Asked about a graph, it answers by the ids of its nodes, so that added parts and the order of parts change nothing else.
"""

from dataclasses import dataclass, field

import numpy as np

from grafu.completion.features import GraphFeatures, Scores, graph_features
from grafu.geometry.box import Box
from grafu.graph.arrays import EDGE_CODES, KIND_CODES, LABELS, NULL
from grafu.graph.edges import Contact, ends_of
from grafu.graph.edit import with_edges
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import EdgeKind, PartLabel, PieceKind

FREE = 4
SURE = 6.0  # the logit of what is said; of everything else it is 0 or less


@dataclass
class Answers:
    """What to say: probabilities as logits by node id, or `free0`, `free1`, ... for free slots."""

    labels: dict[str, PartLabel | dict[PartLabel, float]] = field(default_factory=dict)
    kinds: dict[tuple[str, str], EdgeKind | dict[EdgeKind, float]] = field(default_factory=dict)
    parents: dict[tuple[str, str], float] = field(default_factory=dict)
    no_parent: float = 0.0
    mounts: dict[tuple[str, str], float] = field(default_factory=dict)
    hinges: dict[str | tuple[str, str], tuple[int, int]] = field(default_factory=dict)
    slides: dict[str | tuple[str, str], int] = field(default_factory=dict)
    added: list[list[tuple[PartLabel, Box, str | None]]] = field(default_factory=list)  # one list for each pass
    bodies: dict[tuple[str, str], float] = field(default_factory=dict)
    ajar: dict[str, float] = field(default_factory=dict)
    piece: dict[PieceKind, float] = field(default_factory=dict)
    passes: int = 0

    def about(self, graph: FunctionalGraph) -> "Network":
        """Returns the network that is to be asked about this graph, and about it with parts added."""
        return Network(self, [node.id for node in graph.nodes], graph)


@dataclass
class Network:
    """Tells nodes by their boxes: `names` are those of the graph, then of what was added, in order."""

    said: Answers
    names: list[str]
    graph: FunctionalGraph

    def __call__(self, features: GraphFeatures) -> Scores:
        """Returns the scores for the next pass."""
        n = len(features.labels)
        names = self.names + [f"new{k}" for k in range(n - len(self.names))] + [f"free{k}" for k in range(FREE)]
        said, s = self.said, n + FREE
        fired = said.added[said.passes] if said.passes < len(said.added) else []
        said.passes += 1
        scores = _Blank(s, names)
        for name, label in said.labels.items():
            scores.label(name, label)
        for (child, parent), kind in said.kinds.items():
            scores.kind(child, parent, kind)
        scores.pairs("parent", said.parents)
        scores.pairs("hinge_target", said.mounts)
        for where, (border, sign) in said.hinges.items():
            scores.motion("border", where, border)
            scores.motion("sign", where, sign)
        for where, axis in said.slides.items():
            scores.motion("slide", where, axis)
        scores.pairs("body", said.bodies | {(b, a): logit for (a, b), logit in said.bodies.items()})
        for name, logit in said.ajar.items():
            scores.arrays["ajar"][scores.place[name]] = logit
        for kind, logit in said.piece.items():
            scores.arrays["piece"][list(PieceKind).index(kind)] = logit
        for k, (label, box, parent) in enumerate(fired):
            scores.fire(n + k, label, (box.center - features.origin) / features.scale, box.half / features.scale)
            if parent is not None:
                scores.pairs("parent", {(f"free{k}", parent): SURE})
                scores.kind(f"free{k}", parent, EdgeKind.ATTACHED)
        return scores.done(said.no_parent)


class _Blank:
    """Scores that say nothing yet."""

    def __init__(self, s: int, names: list[str]) -> None:
        self.place = {name: k for k, name in enumerate(names)}
        f32 = np.float32
        self.arrays = {
            "exists": np.full(s, -SURE, f32),
            "category": np.zeros((s, len(LABELS)), f32),
            "centre": np.zeros((s, 3), f32),
            "half": np.full((s, 3), 0.1, f32),
            "edge": np.zeros((s, s, EDGE_CODES["all"]), f32),
            "parent": np.zeros((s, s), f32),
            "hinge_target": np.zeros((s, s), f32),
            "border": np.zeros((s, s, 4), f32),
            "sign": np.zeros((s, s, 2), f32),
            "slide": np.zeros((s, s, 6), f32),
            "body": np.full((s, s), -SURE, f32),
            "ajar": np.full(s, -SURE, f32),
            "piece": np.zeros(len(PieceKind), f32),
        }
        self.arrays["edge"][..., NULL] = SURE

    def label(self, name: str, label: PartLabel | dict[PartLabel, float]) -> None:
        for one, logit in label.items() if isinstance(label, dict) else [(label, SURE)]:
            self.arrays["category"][self.place[name], LABELS.index(one)] = logit

    def kind(self, a: str, b: str, kind: EdgeKind | dict[EdgeKind, float]) -> None:
        i, j = self.place[a], self.place[b]
        for one, logit in kind.items() if isinstance(kind, dict) else [(kind, 2 * SURE)]:
            self.arrays["edge"][i, j, KIND_CODES[one]] = self.arrays["edge"][j, i, KIND_CODES[one]] = logit

    def pairs(self, name: str, logits: dict[tuple[str, str], float]) -> None:
        for (child, parent), logit in logits.items():
            self.arrays[name][self.place[child], self.place[parent]] = logit

    def motion(self, name: str, where: str | tuple[str, str], code: int) -> None:
        child, parent = where if isinstance(where, tuple) else (where, None)
        j = slice(None) if parent is None else self.place[parent]
        self.arrays[name][self.place[child], j, code] = SURE

    def fire(self, slot: int, label: PartLabel, centre: np.ndarray, half: np.ndarray) -> None:
        self.arrays["exists"][slot] = SURE
        self.arrays["category"][slot, LABELS.index(label)] = SURE
        self.arrays["centre"][slot], self.arrays["half"][slot] = centre, half

    def done(self, no_parent: float) -> Scores:
        return Scores(**self.arrays, parent_abstain=no_parent, hinge_abstain=0.0)


def silent(graph: FunctionalGraph) -> Scores:
    """Returns the scores of a network that states nothing at all about a graph."""
    return Answers().about(graph)(graph_features(graph))


def of_doors_and_drawers(truth: FunctionalGraph) -> FunctionalGraph:
    """The truth without the motions of knobs, buttons, racks and what else is neither door nor drawer."""
    others = (e for e in truth.motions if not truth.node(e.child).label.is_movable)
    return with_edges(truth, [Contact(*ends_of(edge)) for edge in others])
