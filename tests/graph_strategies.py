"""Hypothesis strategies of functional graphs: any parts anywhere, every kind of edge, what the type system allows."""

from collections import Counter

import numpy as np
from hypothesis import strategies as st

from grafu.geometry.box import Box
from grafu.geometry.sampling import PointCloud
from grafu.graph.edges import BORDERS, SIGNED_AXES, SIGNS, Attached, Contact, Edge, Hinge, Rail
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel

labels = st.sampled_from(tuple(PartLabel))
_coordinates = st.integers(-2000, 2000).map(lambda k: k / 1000)
_lengths = st.integers(1, 800).map(lambda k: k / 1000)


@st.composite
def nodes(draw: st.DrawFn, node_id: str, label: PartLabel, has_points: bool) -> PartNode:
    """A part with a box on a millimetre grid, and a few points in it."""
    low = np.array([draw(_coordinates) for _ in range(3)])
    size = np.array([draw(_lengths) for _ in range(3)])
    points = PointCloud(low + size * np.array([[0.25, 0.5, 0.75], [1.0, 0.0, 0.5]])) if has_points else None
    return PartNode(node_id, label, Box(low, low + size), points)


@st.composite
def functional_graphs(draw: st.DrawFn, min_nodes: int = 1, max_nodes: int = 14) -> FunctionalGraph:
    """A graph of any labels: most doors have a hinge, most drawers a rail or two, most handles a door or drawer."""
    drawn = draw(st.lists(labels, min_size=min_nodes, max_size=max_nodes))
    has_points = draw(st.booleans())
    numbers: Counter[PartLabel] = Counter()
    parts = []
    for label in drawn:
        parts.append(draw(nodes(f"{label.value.replace(' ', '_')}_{numbers[label]}", label, has_points)))
        numbers[label] += 1
    edges = {edge_ends(e): e for e in draw(_contacts(parts))} | {
        edge_ends(e): e for e in draw(_functional_edges(parts))
    }
    return FunctionalGraph(draw(st.sampled_from(["fur_001", "synth_0_0000003"])), tuple(parts), tuple(edges.values()))


def edge_ends(edge: Edge) -> frozenset[str]:
    """The two ids that an edge joins."""
    return frozenset((edge.a, edge.b) if isinstance(edge, Contact) else (edge.parent, edge.child))


@st.composite
def _contacts(draw: st.DrawFn, parts: list[PartNode]) -> list[Contact]:
    ids = [p.id for p in parts]
    if len(ids) < 2:
        return []
    pairs = draw(st.lists(st.tuples(st.sampled_from(ids), st.sampled_from(ids)), max_size=20))
    return [Contact(a, b) for a, b in pairs if a != b]


@st.composite
def _functional_edges(draw: st.DrawFn, parts: list[PartNode]) -> list[Edge]:
    supports = [p.id for p in parts if p.label.is_support]
    movable = [p.id for p in parts if p.label.is_movable]
    edges: list[Edge] = []
    for part in parts:
        mounts = draw(st.lists(st.sampled_from(supports), max_size=2, unique=True)) if supports else []
        if part.label is PartLabel.DOOR:
            border, sign = draw(st.sampled_from(BORDERS)), draw(st.sampled_from(SIGNS))
            edges += [Hinge(mount, part.id, border, sign) for mount in mounts[:1]]
        elif part.label is PartLabel.DRAWER:
            axis = draw(st.sampled_from(SIGNED_AXES))
            edges += [Rail(mount, part.id, axis) for mount in mounts]
        elif part.label is PartLabel.HANDLE and movable and draw(st.integers(0, 3)):
            edges.append(Attached(draw(st.sampled_from(movable)), part.id))
    return edges
