"""Pure edits: each returns a new graph and leaves the old one whole."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from typing import assert_never

import numpy as np

from grafu.articulation.articulated_object import Coupling
from grafu.errors import GraphError
from grafu.geometry.box import Box
from grafu.geometry.sampling import PointCloud
from grafu.graph.edges import Attached, Contact, Edge, Hinge, HingeBorder, MotionEdge, Rail, Slide, Turn, ends_of
from grafu.graph.functional_graph import FunctionalGraph, allowed_edges
from grafu.graph.motion import mirror_face, mirror_hinge, mirror_rotation, opening_face, sign_for_opening
from grafu.vocabulary import PartLabel


def without_nodes(graph: FunctionalGraph, ids: Collection[str]) -> FunctionalGraph:
    """Returns the graph without these nodes and the edges at them; what followed one of them follows nothing.

    What moved on a part that does not move any more only touches it.

    Raises:
        GraphError: if an id is not in the graph.
    """
    _require_known(graph, ids)
    nodes = tuple(n for n in graph.nodes if n.id not in ids)
    kept = (_led_by_others(e, ids) for e in graph.edges if not set(ends_of(e)) & set(ids))
    return replace(graph, nodes=nodes, edges=allowed_edges(kept, {n.id: n.label for n in nodes}))


def without_edges(graph: FunctionalGraph, edges: Collection[Edge]) -> FunctionalGraph:
    """Returns the graph without these edges; what moved on a part that does not move any more only touches it.

    Raises:
        GraphError: if an edge is not in the graph.
    """
    missing = [e for e in edges if e not in graph.edges]
    if missing:
        raise GraphError(f"an edge to leave out must be in graph `{graph.model_id}`: got {missing[0]}")
    label_of = {n.id: n.label for n in graph.nodes}
    return replace(graph, edges=allowed_edges((e for e in graph.edges if e not in edges), label_of))


def relabelled(graph: FunctionalGraph, labels: Mapping[str, PartLabel]) -> FunctionalGraph:
    """Returns the graph with new labels; edges that the new labels forbid become contacts.

    Raises:
        GraphError: if an id is not in the graph.
    """
    _require_known(graph, labels)
    nodes = tuple(replace(n, label=labels.get(n.id, n.label)) for n in graph.nodes)
    return replace(graph, nodes=nodes, edges=allowed_edges(graph.edges, {n.id: n.label for n in nodes}))


def without_names(graph: FunctionalGraph, ids: Collection[str]) -> FunctionalGraph:
    """Returns the graph without the input's own words for these nodes."""
    nodes = tuple(replace(n, source_name="") if n.id in ids and n.source_name else n for n in graph.nodes)
    return replace(graph, nodes=nodes)


def as_contacts(graph: FunctionalGraph) -> FunctionalGraph:
    """Returns the non-functional graph: the same nodes, every edge a contact."""
    return replace(graph, edges=tuple(Contact(*ends_of(e)) for e in graph.edges))


def without_contacts(graph: FunctionalGraph, pairs: Collection[frozenset[str]]) -> FunctionalGraph:
    """Returns the graph without the contacts that join one of these pairs of ids; other edges between them stay."""
    if not pairs:
        return graph
    kept = tuple(e for e in graph.edges if not isinstance(e, Contact) or frozenset(ends_of(e)) not in pairs)
    return graph if len(kept) == len(graph.edges) else replace(graph, edges=kept)


def with_edges(graph: FunctionalGraph, edges: Iterable[Edge]) -> FunctionalGraph:
    """Returns the graph with these edges added; each takes the place of the edge that joined the same two parts.

    Raises:
        GraphError: if the edges break an invariant of the graph.
    """
    kept = {frozenset(ends_of(e)): e for e in graph.edges}
    kept.update((frozenset(ends_of(e)), e) for e in edges)
    return replace(graph, edges=tuple(kept.values()))


def rehung(hinge: Hinge, border: HingeBorder, graph: FunctionalGraph) -> Hinge:
    """Returns a hinge at another border of its door, which opens to the same face."""
    thin = graph.node(hinge.child).box.thin_axis
    front = opening_face(thin, hinge.border, hinge.sign)
    return replace(hinge, border=border, sign=sign_for_opening(thin, border, front))


def scaled(graph: FunctionalGraph, factor: float) -> FunctionalGraph:
    """Returns the graph with boxes and points scaled about the origin by a positive factor.

    Raises:
        ValueError: if the factor is not positive.
    """
    if not factor > 0:
        raise ValueError(f"`factor` must be positive: got {factor}")
    sliding = {edge.child for edge in graph.motions if isinstance(edge, Rail | Slide)}
    image = _with_moved_nodes(graph, np.full(3, factor))
    return replace(image, edges=tuple(_scaled_edge(e, sliding, factor) for e in graph.edges))


def mirrored(graph: FunctionalGraph, across: int) -> FunctionalGraph:
    """Returns the mirror image across the plane through the origin square to axis 0 (X) or 1 (Y).

    Motion codes follow: faces and slides like displacements, rotation axes like pseudovectors.

    Raises:
        ValueError: if `across` is not 0 or 1 (gravity is not mirrored).
    """
    if across not in (0, 1):
        raise ValueError(f"`across` must be 0 (X) or 1 (Y): got {across}")
    factors = np.ones(3)
    factors[across] = -1.0
    image = _with_moved_nodes(graph, factors)
    return replace(image, edges=tuple(_mirrored_edge(graph, e, across) for e in graph.edges))


def _with_moved_nodes(graph: FunctionalGraph, factors: np.ndarray) -> FunctionalGraph:
    nodes = []
    for node in graph.nodes:
        ends = np.stack([node.box.low * factors, node.box.high * factors])
        points = None if node.points is None else PointCloud(node.points.points * factors)
        nodes.append(replace(node, box=Box(ends.min(axis=0), ends.max(axis=0)), points=points))
    return replace(graph, nodes=tuple(nodes))


def _mirrored_edge(graph: FunctionalGraph, edge: Edge, across: int) -> Edge:
    match edge:
        case Contact() | Attached():
            return edge
        case Rail() | Slide():
            return replace(edge, axis=mirror_face(edge.axis, across))
        case Turn():
            return replace(edge, axis=mirror_rotation(edge.axis, across))
        case Hinge():
            border, sign = mirror_hinge(graph.node(edge.child).box.thin_axis, edge.border, edge.sign, across)
            return replace(edge, border=border, sign=sign)
        case _:
            assert_never(edge)


def _led_by_others(edge: Edge, ids: Collection[str]) -> Edge:
    follows = isinstance(edge, MotionEdge) and edge.coupling is not None and edge.coupling.leader in ids
    return replace(edge, coupling=None) if isinstance(edge, MotionEdge) and follows else edge


def _scaled_edge(edge: Edge, sliding: Collection[str], factor: float) -> Edge:
    """Returns an edge whose coupling counts scaled metres wherever it counts metres."""
    if not isinstance(edge, MotionEdge) or edge.coupling is None:
        return edge
    coupling = edge.coupling
    own, its = (factor if part in sliding else 1.0 for part in (edge.child, coupling.leader))
    scaled_coupling = Coupling(coupling.leader, coupling.multiplier * own / its, coupling.offset * own)
    return replace(edge, coupling=scaled_coupling)


def _require_known(graph: FunctionalGraph, ids: Iterable[str]) -> None:
    unknown = [i for i in ids if i not in graph]
    if unknown:
        raise GraphError(f"graph `{graph.model_id}` has no node `{unknown[0]}`: name one of its nodes")
