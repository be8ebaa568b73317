"""The authors' graph files: input, functional and predicted graphs, both ways.

Numbers keep the unit of the file. What our graph cannot hold is left out and named in the notes: a motion that is not
labelled leaves a contact, a second edge between two parts gives way.
"""

from dataclasses import replace
from typing import Any, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.errors import GraphError
from grafu.geometry.box import Box
from grafu.geometry.transform import quaternion_matrix
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Attached, Contact, Edge, Hinge, Rail, ends_of, kind_of
from grafu.graph.functional_graph import FunctionalGraph, PartNode, is_allowed, paper_edges
from grafu.graph.json_values import Json, read_list, read_object, read_text, read_vector
from grafu.graph.motion import signed_axis
from grafu.graph.official_motion import (
    material_to_label,
    motion_fields,
    node_to_material,
    older_motion_fields,
    read_hinge,
    read_rail,
)
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

_DIGITS = 6  # the authors' builder rounds to micrometres
_THINNEST = 0.005  # half sizes of predicted boxes


@final
@dataclass(frozen=True)
class OfficialReading:
    """A graph that was read, and what was left out of it, in words."""

    graph: FunctionalGraph
    notes: tuple[str, ...] = ()


def input_to_official(graph: FunctionalGraph) -> dict[str, Any]:
    """Returns the authors' input graph: nodes in slot order, edges with their kind but without motion."""
    edges = [_edge_to_official(edge, graph) for edge in paper_edges(graph)]
    return {"model_id": graph.model_id, "nodes": _nodes_to_official(graph), "edges": edges}


def functional_to_official(graph: FunctionalGraph, older_labels: bool = False) -> dict[str, Any]:
    """Returns the authors' functional graph: motion keys on edges, `handle_border` on doors that have a handle.

    With `older_labels` the edges also carry the keys of the second label version.
    """
    nodes = _nodes_to_official(graph)
    for edge in graph.attachments:
        door, handle = graph.node(edge.parent), graph.node(edge.child)
        if door.label is PartLabel.DOOR:
            nodes[door.id].setdefault("handle_border", handle_border(door.box, handle.box))
    told = paper_edges(graph)
    edges = [_edge_to_official(e, graph) | motion_fields(e, graph) for e in told]
    if older_labels:
        edges = [d | older_motion_fields(e, graph, d["src"]) for d, e in zip(edges, told, strict=True)]
    return {"model_id": graph.model_id, "nodes": nodes, "edges": edges}


def graph_from_official(data: Json) -> OfficialReading:
    """Returns an input or functional graph; `nodes` may also be a list, whose order is the slots' then.

    Raises:
        GraphError: if a value is missing or wrong, or the graph breaks an invariant.
    """
    nodes = tuple(_node_from_official(key, node) for key, node in _node_items(data))
    return _read_edges(read_text(data, "model_id", "the graph", ""), nodes, data)


def prediction_from_official(data: Json, given: FunctionalGraph) -> GraphCompletion:
    """Returns the authors' prediction for the input graph `given`.

    Slot k below the number of input nodes is the k-th of them: it keeps its id, box and points and takes the predicted
    label. The others are new nodes. Doors and drawers that the prediction leaves still are refused.

    Raises:
        GraphError: if a value is missing or wrong, a slot repeats, or the graph breaks an invariant.
    """
    slots = dict(sorted((_slot_of(key, node), (key, node)) for key, node in _node_items(data)))
    if len(slots) < len(_node_items(data)):
        raise GraphError("a predicted graph must use each slot once: two nodes share one")
    named = {key: _predicted_node(slot, key, node, given) for slot, (key, node) in slots.items()}
    lost = tuple(n for k, n in enumerate(given.nodes) if k not in slots)
    renamed = [e | {end: named[e[end]].id for end in ("src", "dst") if e.get(end) in named} for e in _edges_of(data)]
    reading = _read_edges(given.model_id, tuple(named.values()) + lost, {"edges": renamed})
    moved = {h.child for h in reading.graph.hinges} | {r.child for r in reading.graph.rails}
    still = [n.id for n in reading.graph.nodes if n.label.is_movable and n.id not in moved]
    refused = tuple(Refusal(i, Reason.NO_MOTION, "the prediction states no motion") for i in still)
    added = tuple(n.id for n in reading.graph.nodes if n.id not in given)
    return GraphCompletion(given, reading.graph, "official prediction", added, (), refused)


def prediction_to_official(completion: GraphCompletion) -> dict[str, Any]:
    """Returns the authors' predicted graph: slot k is the k-th node of the input, new nodes have the slots behind.

    What the authors' four kinds of edges cannot state is a contact.
    """
    given = [node.id for node in completion.input.nodes]
    graph = completion.completed
    ordered = [graph.node(name) for name in given] + [node for node in graph.nodes if node.id not in completion.input]
    graph = replace(graph, nodes=tuple(ordered))
    names: dict[str, str] = {}
    nodes: dict[str, dict[str, Any]] = {}
    for slot, node in enumerate(graph.nodes):
        word = node_to_material(node)
        names[node.id] = key = f"slot{slot:02d}_{word.replace(' ', '_')}"
        kind = "dynamic" if node.label.is_movable or node.label is PartLabel.HANDLE else "static"
        nodes[key] = {"id": key, "slot": slot, "type": kind, "material": word, "obb": _obb(node.box, _THINNEST)}
    edges = [_edge_to_official(edge, graph) | motion_fields(edge, graph) for edge in paper_edges(graph)]
    told = [
        {name: value for name, value in edge.items() if name != "connector"}
        | {end: names[edge[end]] for end in ("src", "dst")}
        for edge in edges
    ]
    return {"model_id": graph.model_id, "nodes": nodes, "edges": told}


def handle_border(door: Box, handle: Box) -> int:
    """Returns the face of the door, within its plane, that the handle sits nearest to (codes 0..5)."""
    offset = (handle.center - door.center) / np.maximum(door.half, 1e-12)
    offset[door.thin_axis] = 0.0
    axis = int(np.argmax(np.abs(offset)))
    return signed_axis(axis, bool(offset[axis] > 0))


def _nodes_to_official(graph: FunctionalGraph) -> dict[str, dict[str, Any]]:
    return {
        node.id: {"id": node.id, "type": "part", "material": node_to_material(node), "obb": _obb(node.box)}
        for node in graph.nodes
    }


def _obb(box: Box, thinnest: float = 0.0) -> dict[str, list[float]]:
    center, half = (np.round(v, _DIGITS).tolist() for v in (box.center, np.maximum(box.half, thinnest)))
    return {"center": center, "half": half, "quat": [1.0, 0.0, 0.0, 0.0]}


def _edge_to_official(edge: Edge, graph: FunctionalGraph) -> dict[str, Any]:
    slot = {node.id: k for k, node in enumerate(graph.nodes)}
    src, dst = sorted(ends_of(edge), key=lambda end: slot[end])
    return {"src": src, "dst": dst, "kind": kind_of(edge).value, "connector": None}


def _node_items(data: Json) -> list[tuple[str, Json]]:
    nodes = data.get("nodes")
    if isinstance(nodes, list):
        listed = [read_object(node, "a node") for node in nodes]
        return [(read_text(node, "id", "a node"), node) for node in listed]
    nodes = read_object(nodes, "`nodes`")
    return [(key, read_object(node, f"node `{key}`")) for key, node in nodes.items()]


def _edges_of(data: Json) -> list[dict[str, Any]]:
    return [dict(read_object(edge, "an edge")) for edge in read_list(data, "edges", "the graph")]


def _node_from_official(node_id: str, node: Json) -> PartNode:
    word = read_text(node, "material", f"node `{node_id}`", "unknown")
    return PartNode(node_id, material_to_label(word), _read_obb(node, f"node `{node_id}`"), source_name=word)


def _read_obb(node: Json, where: str) -> Box:
    obb = read_object(node.get("obb"), f"`obb` of {where}")
    center, half = (read_vector(obb, key, where, (3,)) for key in ("center", "half"))
    quaternion = read_vector(obb, "quat", where, (4,), [1.0, 0.0, 0.0, 0.0])
    if np.any(half < 0) or not np.any(quaternion):
        raise GraphError(f"`obb` of {where} must have half sizes that are not negative and a rotation: got {dict(obb)}")
    return Box.from_center(center, np.abs(quaternion_matrix(*quaternion)) @ half)


def _slot_of(key: str, node: Json) -> int:
    slot = node.get("slot")
    if isinstance(slot, bool) or not isinstance(slot, int) or slot < 0:
        raise GraphError(f"`slot` of node `{key}` must be an integer from 0: got {slot!r}")
    return slot


def _predicted_node(slot: int, key: str, node: Json, given: FunctionalGraph) -> PartNode:
    predicted = _node_from_official(key, node)
    if slot < len(given.nodes):
        return replace(given.nodes[slot], label=predicted.label)
    free_id = key
    while free_id in given:
        free_id += "_new"
    return replace(predicted, id=free_id)


def _read_edges(model_id: str, nodes: tuple[PartNode, ...], data: Json) -> OfficialReading:
    """Returns the graph of the strongest edge between each two nodes that our invariants allow."""
    known = {node.id: node for node in nodes}
    notes: list[str] = []
    kept: dict[frozenset[str], Edge] = {}
    for raw in _edges_of(data):
        src, dst = (known.get(str(raw.get(end))) for end in ("src", "dst"))
        if src is None or dst is None or src is dst:
            notes.append(f"left out an edge that joins no two nodes: {raw.get('src')}-{raw.get('dst')}")
            continue
        edge = _read_edge(raw, src, dst, notes)
        other = kept.get(frozenset((src.id, dst.id)))
        if other is None or (isinstance(other, Contact) and not isinstance(edge, Contact)):
            kept[frozenset((src.id, dst.id))] = edge
    return OfficialReading(FunctionalGraph(model_id, nodes, _consistent(kept.values(), notes)), tuple(notes))


def _read_edge(raw: Json, src: PartNode, dst: PartNode, notes: list[str]) -> Edge:
    kind = raw.get("kind")
    for parent, child, child_end in ((src, dst, "dst"), (dst, src, "src")):
        edge = _directed_edge(raw, parent, child, child_end)
        if edge is not None and is_allowed(edge, parent.label, child.label) and child.label is not PartLabel.UNKNOWN:
            return edge
    if kind in ("hinge", "rail", "attached"):
        notes.append(f"read as a contact: {kind} {src.id}-{dst.id}, its motion or its direction is not stated")
    return Contact(src.id, dst.id)


def _directed_edge(raw: Json, parent: PartNode, child: PartNode, child_end: str) -> Edge | None:
    kind = raw.get("kind")
    if kind == "attached":
        return Attached(parent.id, child.id)
    if kind == "hinge":
        codes = read_hinge(raw, child.box, child_end)
        return codes and Hinge(parent.id, child.id, codes.border, codes.sign)
    axis = read_rail(raw) if kind == "rail" else None
    return None if axis is None else Rail(parent.id, child.id, axis)


def _consistent(edges: Any, notes: list[str]) -> tuple[Edge, ...]:
    """Returns the edges, those as contacts that contradict an earlier one of the same part."""
    stated: dict[str, Edge] = {}
    result: list[Edge] = []
    for edge in edges:
        if not isinstance(edge, Contact):
            first = stated.setdefault(edge.child, edge)
            if first is not edge and (isinstance(edge, Attached) or replace(first, parent=edge.parent) != edge):
                notes.append(f"read as a contact: {edge}, it contradicts {first}")
                edge = Contact(*ends_of(edge))
        result.append(edge)
    return tuple(result)
