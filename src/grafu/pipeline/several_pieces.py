"""A scene of several pieces of furniture is completed piece by piece: each as it is seen with its own front at -Y."""

from collections.abc import Callable
from dataclasses import replace
from typing import Final, assert_never

import numpy as np

from grafu.asset.part import Asset, Standing
from grafu.geometry.arrays import Mat3, Mat4
from grafu.geometry.box import Box
from grafu.geometry.transform import transform_points
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import (
    BORDERS,
    SIGNED_AXES,
    Attached,
    Contact,
    Edge,
    Hinge,
    HingeBorder,
    Rail,
    SignedAxis,
    Slide,
    Turn,
    ends_of,
)
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import (
    border_to_face,
    border_to_signed_axis,
    code_to_direction,
    direction_to_code,
    face_to_border,
    plane_axes,
)
from grafu.vocabulary import PartLabel

Complete = Callable[[Asset, FunctionalGraph], GraphCompletion]

_OF_AXES: Final = ("slide", "turn")


def completed_by_pieces(asset: Asset, graph: FunctionalGraph, complete: Complete) -> GraphCompletion:
    """Returns the graph completed piece by piece; floors, walls and props stay as they are.

    Args:
        asset: a scene with its `standings`, in the object frame.
        graph: its graph, of contacts alone or with edges that the input states.
        complete: what completes a piece that stands alone, in its own frame.
    """
    made = (_completed_piece(asset, graph, standing, complete) for standing in asset.standings)
    found = [one for one in made if one is not None]
    held = {node.id for one in found for node in one.input.nodes}
    others = {node.id: PartLabel.MISC for node in graph.nodes if node.id not in held and _may_move(node)}
    labels = others | {node.id: node.label for one in found for node in one.completed.nodes if node.id in graph}
    nodes = (*relabelled(graph, labels).nodes, *(n for one in found for n in one.completed.nodes if n.id not in graph))
    completed = FunctionalGraph(graph.model_id, nodes, tuple(e for one in found for e in one.completed.edges))
    between = (e for e in graph.edges if isinstance(e, Contact) and not any(_holds(one.input, e) for one in found))
    return GraphCompletion(
        graph,
        with_edges(completed, between),
        found[0].source if found else "network",
        tuple(name for one in found for name in one.added),
        tuple(decision for one in found for decision in one.decisions),
        tuple(refusal for one in found for refusal in one.refused),
        found[0].piece if found else None,
        tuple(pair for one in found for pair in one.rides),
        tuple(weighed for one in found for weighed in one.weighed),
    )


def piece_alone(asset: Asset, standing: Standing) -> Asset:
    """Returns one piece of a scene as an asset of its own, in its own frame; parts that are gone are left out."""
    T, own = standing.T_piece_object, set(standing.parts)
    parts = tuple(
        replace(
            part,
            surfaces=tuple(surface.transformed(T) for surface in part.surfaces),
            carried_by=part.carried_by if part.carried_by in own else None,
        )
        for part in asset.parts
        if part.id in own
    )
    return Asset(asset.name, asset.path, asset.kind, parts, standing.frame)


def _may_move(node: PartNode) -> bool:
    return node.label is PartLabel.UNKNOWN or node.label.is_movable


def _holds(graph: FunctionalGraph, edge: Edge) -> bool:
    return all(end in graph for end in ends_of(edge))


def _completed_piece(
    asset: Asset, graph: FunctionalGraph, standing: Standing, complete: Complete
) -> GraphCompletion | None:
    """Returns the completion of one piece, in the object frame; None where no part of it is left."""
    piece = piece_alone(asset, standing)
    if not piece.parts:
        return None
    own = {part.id for part in piece.parts}
    nodes = tuple(replace(n, box=piece.part(n.id).box, points=None) for n in graph.nodes if n.id in own)
    edges = tuple(edge for edge in graph.edges if set(ends_of(edge)) <= own)
    turned = FunctionalGraph(graph.model_id, nodes, edges)
    found = complete(piece, turned)
    return _in_object_frame(found, graph, np.linalg.inv(standing.T_piece_object))


def _in_object_frame(found: GraphCompletion, graph: FunctionalGraph, T: Mat4) -> GraphCompletion:
    """Returns a piece's completion in the object frame, to which T maps; what was added has ids of its own."""
    before, new = found.completed, _free_ids(found, graph)
    given = {node.id: graph.node(node.id) for node in found.input.nodes}
    nodes = tuple(_turned_node(node, T, given, new) for node in before.nodes)
    boxes = {old.id: node.box for old, node in zip(before.nodes, nodes, strict=True)}
    R: Mat3 = T[:3, :3]
    edges = tuple(_renamed(_turned_edge(edge, before, boxes, R), new) for edge in before.edges)
    hinges = {edge.child: edge for edge in before.hinges}
    return GraphCompletion(
        FunctionalGraph(
            graph.model_id, tuple(given.values()), tuple(e for e in graph.edges if set(ends_of(e)) <= {*given})
        ),
        FunctionalGraph(graph.model_id, nodes, edges),
        found.source,
        tuple(new.get(name, name) for name in found.added),
        tuple(
            replace(_turned_decision(d, hinges, before, boxes, R), part=new.get(d.part, d.part))
            for d in found.decisions
        ),
        tuple(replace(refusal, part=new.get(refusal.part, refusal.part)) for refusal in found.refused),
        found.piece,
        tuple((new.get(a, a), new.get(b, b)) for a, b in found.rides),
        found.weighed,
    )


def _free_ids(found: GraphCompletion, graph: FunctionalGraph) -> dict[str, str]:
    """Returns new ids of what was added to a piece: those of a scene must differ, and name a part of the piece."""
    first = found.input.nodes[0].id
    return {name: f"{name}_of_{first}" for name in found.added} if len(found.input.nodes) < len(graph.nodes) else {}


def _turned_node(node: PartNode, T: Mat4, given: dict[str, PartNode], new: dict[str, str]) -> PartNode:
    if node.id in given:
        return replace(given[node.id], label=node.label)
    corners = transform_points(T, node.box.corners())
    return replace(node, id=new.get(node.id, node.id), box=Box(corners.min(axis=0), corners.max(axis=0)), points=None)


def _renamed(edge: Edge, new: dict[str, str]) -> Edge:
    if isinstance(edge, Contact):
        return Contact(new.get(edge.a, edge.a), new.get(edge.b, edge.b))
    return replace(edge, parent=new.get(edge.parent, edge.parent), child=new.get(edge.child, edge.child))


def _turned_axis(axis: SignedAxis, R: Mat3) -> SignedAxis:
    return direction_to_code(R @ code_to_direction(axis))


def _turned_edge(edge: Edge, before: FunctionalGraph, boxes: dict[str, Box], R: Mat3) -> Edge:
    match edge:
        case Contact() | Attached():
            return edge
        case Rail() | Slide() | Turn():
            return replace(edge, axis=_turned_axis(edge.axis, R))
        case Hinge():
            thin = before.node(edge.child).box.thin_axis
            after = boxes[edge.child].thin_axis
            border = _turned_border(edge.border, thin, after, R)
            axis = R @ code_to_direction(border_to_signed_axis(thin, edge.border, edge.sign))
            along = plane_axes(after)[1 - border // 2]
            return replace(edge, border=border, sign=1 if axis[along] > 0 else 0)
        case _:
            assert_never(edge)


def _turned_border(border: HingeBorder, thin: int, after: int, R: Mat3) -> HingeBorder:
    """Returns a border of a door in the box of the turned one; `after` is its thin axis.

    A door that stands askew has a box with two broad sides: the border is that to which it comes nearest.
    """
    towards = R @ code_to_direction(border_to_face(thin, border))
    towards[after] = 0.0
    return face_to_border(after, direction_to_code(towards))


def _turned_decision(
    decision: Decision, hinges: dict[str, Hinge], before: FunctionalGraph, boxes: dict[str, Box], R: Mat3
) -> Decision:
    """Returns a decision with its codes as they are in the object frame."""
    part, hinge = decision.part, hinges.get(decision.part)
    if decision.question in _OF_AXES:
        return _with_codes(decision, lambda code: str(_turned_axis(_axis_of(code), R)))
    if decision.question == "border" and part in before:
        thin, after = before.node(part).box.thin_axis, boxes[part].thin_axis
        return _with_codes(decision, lambda code: str(_turned_border(_border_of(code), thin, after, R)))
    if decision.question == "sign" and hinge is not None:
        same = _turned_edge(hinge, before, boxes, R)
        if isinstance(same, Hinge) and same.sign != hinge.sign:
            return _with_codes(decision, lambda code: str(1 - int(code)))
    return decision


def _axis_of(code: str) -> SignedAxis:
    return next(axis for axis in SIGNED_AXES if str(axis) == code)


def _border_of(code: str) -> HingeBorder:
    return next(border for border in BORDERS if str(border) == code)


def _with_codes(decision: Decision, turned: Callable[[str], str]) -> Decision:
    others = tuple((turned(code), score) if code.isdigit() else (code, score) for code, score in decision.others)
    runner_up = turned(decision.runner_up) if decision.runner_up.isdigit() else decision.runner_up
    choice = turned(decision.choice) if decision.choice.isdigit() else decision.choice
    return replace(decision, choice=choice, runner_up=runner_up, others=others)
