"""Records of any kind, for Hypothesis: graphs that no carpenter made, with every sort of edge, word and defect."""

import numpy as np
from hypothesis import strategies as st

from grafu.data.pair import Record
from grafu.data.shards_arrays import DEFECT_KINDS
from grafu.geometry.box import Box
from grafu.geometry.sampling import PointCloud
from grafu.graph.edges import Attached, Contact, Edge, Hinge, Rail
from grafu.graph.edit import as_contacts, relabelled, without_nodes
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.synth.specimen import Defect
from grafu.vocabulary import PartLabel

words = st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=12)
metres = st.floats(-3.0, 3.0)
sides = st.one_of(st.just(0.0), st.floats(1e-6, 2.0))


@st.composite
def nodes(draw: st.DrawFn, node_id: str) -> PartNode:
    low = np.array([draw(metres) for _ in range(3)])
    size = np.array([draw(sides) for _ in range(3)])
    count = draw(st.integers(0, 5))
    ratios = np.random.default_rng(draw(st.integers(0, 99))).random((count, 3))
    points = PointCloud(low + ratios * size) if count else None
    transparent = draw(st.floats(0.0, 1.0))
    return PartNode(node_id, draw(st.sampled_from(PartLabel)), Box(low, low + size), points, draw(words), transparent)


@st.composite
def edges(draw: st.DrawFn, parent: PartNode, child: PartNode, moving: set[str]) -> Edge:
    """Draws an edge that the type system allows; a part moves by one edge at most."""
    if child.id not in moving and draw(st.booleans()):
        moving.add(child.id)
        if parent.label.is_support and child.label is PartLabel.DOOR:
            return Hinge(parent.id, child.id, draw(st.sampled_from([0, 1, 2, 3])), draw(st.sampled_from([0, 1])))
        if parent.label.is_support and child.label is PartLabel.DRAWER:
            return Rail(parent.id, child.id, draw(st.sampled_from([0, 1, 2, 3, 4, 5])))
        if parent.label.is_movable and child.label is PartLabel.HANDLE:
            return Attached(parent.id, child.id)
    return Contact(parent.id, child.id)


@st.composite
def truths(draw: st.DrawFn, model_id: str) -> FunctionalGraph:
    made = [draw(nodes(i)) for i in draw(st.lists(words, unique=True, max_size=7))]
    pairs = [(a, b) for i, a in enumerate(made) for b in made[i + 1 :]]
    chosen = draw(st.lists(st.sampled_from(pairs), unique_by=lambda p: (p[0].id, p[1].id))) if pairs else []
    moving: set[str] = set()
    ends = [(b, a) if a.label.is_movable and b.label.is_support else (a, b) for a, b in chosen]
    return FunctionalGraph(model_id, tuple(made), tuple(draw(edges(a, b, moving)) for a, b in ends))


@st.composite
def records(draw: st.DrawFn) -> Record:
    model_id = draw(words)
    truth = draw(truths(model_id))
    some = st.sets(st.sampled_from([n.id for n in truth.nodes])) if truth.nodes else st.just(set())
    given = without_nodes(as_contacts(truth), draw(some))
    unknown = {n.id: PartLabel.UNKNOWN for n in given.nodes if draw(st.booleans())}
    defects = draw(st.lists(st.builds(Defect, st.sampled_from(DEFECT_KINDS), st.lists(words).map(tuple)), max_size=3))
    removable = frozenset(draw(some))
    return Record(model_id, draw(words), relabelled(given, unknown), truth, removable, tuple(defects))
