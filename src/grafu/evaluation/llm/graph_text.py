"""A functional graph as the JSON that a language model reads, and what completes it as the JSON that it replies with.

    graph       {"parts": [{"id", "label", "name", "low": [x, y, z], "high": [x, y, z]}], "contacts": [[id, id]]}
    completion  {"labels": {id: label}, "new_parts": [{"id", "label", "low", "high"}],
                 "edges": [{"kind", "parent", "child", ...}]}

An edge of the kind `hinge` has a `border`, the face of the child's box that carries the pin, and an `axis`; `rail`,
`slide` and `turn` have an `axis`; `attached` has neither. Faces and axes are -X, +X, -Y, +Y, -Z, +Z. Lengths are
metres in the object frame, to a millimetre.
"""

import json
from collections.abc import Sequence
from typing import Any

import numpy as np

from grafu.graph.edges import Attached, Contact, Hinge, MotionEdge, kind_of
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import AXIS_NAMES, border_to_face, border_to_signed_axis
from grafu.synth.specimen import Specimen
from grafu.vocabulary import EdgeKind

_DIGITS = 3


def graph_text(graph: FunctionalGraph) -> str:
    """Returns the parts of a graph and what touches as JSON, a line for each part."""
    parts = ",\n  ".join(_line(_part(node) | _name(node)) for node in graph.nodes)
    contacts = _line([[edge.a, edge.b] for edge in graph.edges if isinstance(edge, Contact)])
    return f'{{"parts": [\n  {parts}],\n "contacts": {contacts}}}'


def completion_text(specimen: Specimen) -> str:
    """Returns what completes the given graph of a synthetic model, as the reply should be."""
    given, truth = specimen.given, specimen.truth
    labels = {n.id: truth.node(n.id).label.value for n in given.nodes if n.label is not truth.node(n.id).label}
    new = [_part(truth.node(part)) for part in specimen.missing]
    edges = [_edge(edge, truth) for edge in truth.edges if isinstance(edge, MotionEdge)]
    edges += [_attached(edge.parent, edge.child) for edge in truth.attachments]
    told = {edge["child"] for edge in edges}
    carried = ((part.carried_by, part.id) for part in specimen.whole.parts if part.id not in told)
    edges += [_attached(parent, child) for parent, child in carried if parent is not None]
    lines = ",\n  ".join(map(_line, edges))
    return f'{{"labels": {_line(labels)},\n "new_parts": {_line(new)},\n "edges": [\n  {lines}]}}'


def _part(node: PartNode) -> dict[str, Any]:
    return {
        "id": node.id,
        "label": node.label.value,
        "low": _rounded(node.box.low),
        "high": _rounded(node.box.high),
    }


def _name(node: PartNode) -> dict[str, str]:
    return {"name": node.source_name} if node.source_name and node.source_name != node.id else {}


def _edge(edge: MotionEdge, graph: FunctionalGraph) -> dict[str, str]:
    ends = {"kind": kind_of(edge).value, "parent": edge.parent, "child": edge.child}
    if not isinstance(edge, Hinge):
        return ends | {"axis": AXIS_NAMES[edge.axis]}
    thin = graph.node(edge.child).box.thin_axis
    border = AXIS_NAMES[border_to_face(thin, edge.border)]
    return ends | {"border": border, "axis": AXIS_NAMES[border_to_signed_axis(thin, edge.border, edge.sign)]}


def _attached(parent: str, child: str) -> dict[str, str]:
    edge = Attached(parent, child)
    return {"kind": EdgeKind.ATTACHED.value, "parent": edge.parent, "child": edge.child}


def _rounded(values: Sequence[float] | np.ndarray) -> list[float]:
    return [round(float(value), _DIGITS) + 0.0 for value in values]


def _line(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)
