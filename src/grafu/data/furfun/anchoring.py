"""The two graphs of one model of a release as one pair: which nodes are the same part. It reads no files."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from grafu.data.pair import NATURAL, GraphPair
from grafu.errors import GraphError
from grafu.graph.edges import Contact, Edge, ends_of, kind_of
from grafu.graph.functional_graph import FunctionalGraph, is_allowed

SAME_PLACE = 0.05  # the authors' (official.md 2.4): centres of one part in both graphs are nearer, in the file's unit
_NOTED = 1e-3  # boxes that differ by more are worth a word; a millimetre where the unit is a metre

EdgeKinds = Mapping[frozenset[str], str]


def paired(
    given: FunctionalGraph, target: FunctionalGraph, kinds: EdgeKinds, model_id: str
) -> tuple[GraphPair, tuple[str, ...]]:
    """Returns the pair of a model's input and functional graph, and what was changed to make it one, in words.

    A node of the input is the node of the target with its name, if their centres are near; another is left out. Box
    and points are the target's then, in which its motion codes are stated. `kinds` are the kinds of the input's edges
    as its file states them: a functional one holds if the target has it too, and takes the target's motion.

    Raises:
        GraphError: if the two share no node.
    """
    anchored = {n.id for n in given.nodes if n.id in target and _distance(given, target, n.id) < SAME_PLACE}
    if not anchored:
        raise GraphError(f"input and functional graph of `{model_id}` must share parts: they have none in common")
    notes = [f"left out a part of the input that the target lacks: {n.id}" for n in given.nodes if n.id not in anchored]
    nodes = tuple(
        replace(n, box=target.node(n.id).box, points=target.node(n.id).points) for n in given.nodes if n.id in anchored
    )
    shift = max(
        float(np.abs(n.box.center - target.node(n.id).box.center).max()) for n in given.nodes if n.id in anchored
    )
    if shift > _NOTED:
        notes.append(f"took the boxes of the functional graph: those of the input lie up to {shift:.3f} beside them")
    bare = FunctionalGraph(target.model_id, nodes)
    true = {frozenset(ends_of(e)): e for e in target.edges}
    edges = tuple(_edge(e, bare, true, kinds) for e in given.edges if anchored.issuperset(ends_of(e)))
    return GraphPair(replace(bare, edges=edges), target, NATURAL, model_id), tuple(notes)


def _distance(given: FunctionalGraph, target: FunctionalGraph, node_id: str) -> float:
    return float(np.linalg.norm(given.node(node_id).box.center - target.node(node_id).box.center))


def _edge(edge: Edge, given: FunctionalGraph, true: Mapping[frozenset[str], Edge], kinds: EdgeKinds) -> Edge:
    ends = ends_of(edge)
    found = true.get(frozenset(ends))
    if found is None or kind_of(found).value != kinds.get(frozenset(ends)):
        return Contact(*ends)
    parent, child = (given.node(end).label for end in ends_of(found))
    return found if is_allowed(found, parent, child) else Contact(*ends)
