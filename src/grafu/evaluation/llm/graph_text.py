"""A functional graph as the JSON that a language model reads, and what completes it as the JSON that it replies with.

    graph       {"parts": [{"id", "label", "name", "low": [x, y, z], "high": [x, y, z]}], "contacts": [[id, id]]}
    completion  {"labels": {id: label}, "new_parts": [{"id", "label", "low", "high"}],
                 "edges": [{"kind", "parent", "child", ...}]}

An edge of the kind `hinge` has a `border`, the face of the child's box that carries the pin, and an `axis`; `rail`,
`slide` and `turn` have an `axis`; `attached` has neither. Faces and axes are -X, +X, -Y, +Y, -Z, +Z. Lengths are
metres in the object frame, to a millimetre. Parts are numbered: an id of ours may state what a part is, and only the
name in the input is what every method is given.
"""

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from grafu.graph.edges import Contact, Hinge, MotionEdge, kind_of
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import AXIS_NAMES, border_to_face, border_to_signed_axis
from grafu.synth.specimen import Specimen
from grafu.vocabulary import EdgeKind

_DIGITS = 3


def numbered(graph: FunctionalGraph) -> dict[str, str]:
    """Returns for each node its name in prompts and replies: p1 for the first, and so on."""
    return {node.id: f"p{number}" for number, node in enumerate(graph.nodes, 1)}


def graph_text(graph: FunctionalGraph) -> str:
    """Returns the parts of a graph and what touches as JSON, a line for each part; parts are `numbered`."""
    names = numbered(graph)
    parts = ",\n  ".join(_line(_part(node, names) | _name(node)) for node in graph.nodes)
    order = [node.id for node in graph.nodes]
    pairs = sorted(sorted((order.index(e.a), order.index(e.b))) for e in graph.edges if isinstance(e, Contact))
    contacts = _line([[names[order[a]], names[order[b]]] for a, b in pairs])
    return f'{{"parts": [\n  {parts}],\n "contacts": {contacts}}}'


def completion_text(specimen: Specimen) -> str:
    """Returns what completes the given graph of a synthetic model, as the reply should be."""
    given, truth = specimen.given, specimen.truth
    names = numbered(given) | {part: f"new{number}" for number, part in enumerate(specimen.missing, 1)}
    labels = {names[n.id]: truth.node(n.id).label for n in given.nodes if n.label is not truth.node(n.id).label}
    new = [_part(truth.node(part), names) for part in specimen.missing]
    edges = [_motion(edge, truth, names) for edge in truth.motions]
    edges += [_attached(edge.parent, edge.child, names) for edge in truth.attachments]
    stated = {*truth.moving, *(edge.child for edge in truth.attachments)}
    carried = [(part.carried_by, part.id) for part in specimen.whole.parts if part.id not in stated]
    edges += [_attached(parent, child, names) for parent, child in carried if parent is not None]
    lines = ",\n  ".join(map(_line, edges))
    return f'{{"labels": {_line(labels)},\n "new_parts": {_line(new)},\n "edges": [\n  {lines}]}}'


def _part(node: PartNode, names: Mapping[str, str]) -> dict[str, Any]:
    low, high = _rounded(node.box.low), _rounded(node.box.high)
    return {"id": names[node.id], "label": node.label, "low": low, "high": high}


def _name(node: PartNode) -> dict[str, str]:
    return {"name": node.source_name} if node.source_name else {}


def _motion(edge: MotionEdge, graph: FunctionalGraph, names: Mapping[str, str]) -> dict[str, str]:
    ends = {"kind": kind_of(edge).value, "parent": names[edge.parent], "child": names[edge.child]}
    if not isinstance(edge, Hinge):
        return ends | {"axis": AXIS_NAMES[edge.axis]}
    thin = graph.node(edge.child).box.thin_axis
    border = AXIS_NAMES[border_to_face(thin, edge.border)]
    return ends | {"border": border, "axis": AXIS_NAMES[border_to_signed_axis(thin, edge.border, edge.sign)]}


def _attached(parent: str, child: str, names: Mapping[str, str]) -> dict[str, str]:
    return {"kind": EdgeKind.ATTACHED.value, "parent": names[parent], "child": names[child]}


def _rounded(values: np.ndarray) -> list[float]:
    return [round(float(value), _DIGITS) + 0.0 for value in values]


def _line(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)
