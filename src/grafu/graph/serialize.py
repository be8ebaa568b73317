"""Our own graph JSON, `grafu.graph/1`, in and out; a round trip is exact.

The form is a superset of the authors', so that their tools read it too:

    schema    "grafu.graph/1"
    model_id  the model's name
    nodes     {id: node} in slot order
      id, type, material, obb   as the authors' (`type` is "part"; `material` their word; quaternion always identity)
      label                     one of the fourteen labels
      box                       {low, high}: exact, metres, object frame
      source_name               the input's own word
      transparent               fraction of the surface that is transparent, only where it is not 0
      points                    [[x, y, z], ...], only where the node has points
    edges     [edge]
      src, dst, kind, connector as the authors'; src is the parent, dst the child of a directed edge
      hinge: hinge_border_4, hinge_axis_sign, hinge_border, hinge_axis_signed; rail: rail_axis_signed;
      slide, turn (kinds that the authors do not have): slide_axis_signed, turn_axis_signed
      follows   only on a motion that follows another: {leader, multiplier, offset}; the leader is a part
    completion   only in a completed graph
      source, added [id], decisions [{part, question, choice, score, runner_up, runner_up_score, by}],
      refused [{part, why}], input {a graph of the same form},
      piece null or {kind, score, runner_up, runner_up_score}, rides [[moving part, part that moves as one with it]]

Readers ignore keys that they do not know, and refuse another schema.
"""

import json
from dataclasses import asdict
from typing import Any, assert_never, get_args

import numpy as np

from grafu.articulation.articulated_object import Coupling
from grafu.errors import GraphError
from grafu.geometry.box import Box
from grafu.geometry.sampling import PointCloud
from grafu.graph.completion import Decision, GraphCompletion, PieceGuess, Question
from grafu.graph.edges import Attached, Contact, Edge, Hinge, MotionEdge, Rail, Slide, Turn, ends_of, kind_of
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.json_values import (
    Json,
    read_code,
    read_list,
    read_number,
    read_object,
    read_text,
    read_vector,
)
from grafu.graph.official_motion import motion_fields, node_to_material
from grafu.refusal import Reason, Refusal
from grafu.visible import writable
from grafu.vocabulary import EdgeKind, PartLabel, PieceKind

SCHEMA = "grafu.graph/1"


def graph_to_json(graph: FunctionalGraph) -> dict[str, Any]:
    """Returns the graph as a JSON-ready dict."""
    return {
        "schema": SCHEMA,
        "model_id": graph.model_id,
        "nodes": {node.id: _node_to_json(node) for node in graph.nodes},
        "edges": [_edge_to_json(edge, graph) for edge in graph.edges],
    }


def completion_to_json(completion: GraphCompletion) -> dict[str, Any]:
    """Returns the completed graph as a JSON-ready dict, with what was added, decided and refused."""
    return graph_to_json(completion.completed) | {
        "completion": {
            "source": completion.source,
            "added": list(completion.added),
            "decisions": [asdict(d) for d in completion.decisions],
            "refused": [_refusal_to_json(r) for r in completion.refused],
            "piece": None if completion.piece is None else asdict(completion.piece),
            "rides": [list(pair) for pair in completion.rides],
            "weighed": {label.value: probability for label, probability in completion.weighed},
            "input": graph_to_json(completion.input),
        }
    }


def dump_json(data: Json) -> str:
    """Returns the text of a graph's or completion's dict; numbers keep every digit, surrogates are escapes."""
    return writable(json.dumps(data, indent=1, allow_nan=False, ensure_ascii=False)) + "\n"


def load_json(text: str) -> Json:
    """Returns the JSON object in a text.

    Raises:
        GraphError: if the text is not JSON or not an object.
    """
    try:
        return read_object(json.loads(text), "a graph file")
    except json.JSONDecodeError as error:
        raise GraphError(f"a graph file must be JSON: {error.msg} in line {error.lineno}") from error
    except (ValueError, RecursionError):  # a number of very many digits, or brackets without end
        raise GraphError("a graph file must be JSON of usual depth and numbers: export it again") from None


def graph_from_json(data: Json) -> FunctionalGraph:
    """Returns the graph in a dict of our form (the completed one, where it was completed).

    Raises:
        GraphError: if the schema is another, a value is missing or wrong, or the graph breaks an invariant.
    """
    if data.get("schema") != SCHEMA:
        raise GraphError(f"a graph must have the schema `{SCHEMA}`: got {data.get('schema')!r}")
    nodes = read_object(data.get("nodes"), "`nodes`")
    edges = read_list(data, "edges", "the graph")
    return FunctionalGraph(
        read_text(data, "model_id", "the graph"),
        tuple(_node_from_json(node_id, node) for node_id, node in nodes.items()),
        tuple(_edge_from_json(read_object(edge, "an edge")) for edge in edges),
    )


def completion_from_json(data: Json) -> GraphCompletion:
    """Returns the completion in a dict of our form.

    Raises:
        GraphError: if there is none, or something in it is wrong.
    """
    extra = read_object(data.get("completion"), "`completion`")
    return GraphCompletion(
        graph_from_json(read_object(extra.get("input"), "`completion.input`")),
        graph_from_json(data),
        read_text(extra, "source", "`completion`"),
        tuple(str(i) for i in read_list(extra, "added", "`completion`")),
        tuple(_decision_from_json(read_object(d, "a decision")) for d in read_list(extra, "decisions", "`completion`")),
        tuple(_refusal_from_json(read_object(r, "a refusal")) for r in read_list(extra, "refused", "`completion`")),
        None if extra.get("piece") is None else _piece_from_json(read_object(extra["piece"], "`piece`")),
        tuple(_ride_from_json(pair) for pair in extra.get("rides") or ()),
        _weighed_from_json(read_object(extra.get("weighed") or {}, "`weighed`")),
    )


def box_to_obb(box: Box) -> dict[str, list[float]]:
    """Returns a box in the authors' form: centre, half sizes, identity quaternion (wxyz)."""
    return {"center": box.center.tolist(), "half": box.half.tolist(), "quat": [1.0, 0.0, 0.0, 0.0]}


def _node_to_json(node: PartNode) -> dict[str, Any]:
    points = {} if node.points is None else {"points": node.points.points.tolist()}
    transparent = {"transparent": node.transparent} if node.transparent else {}
    return (
        {
            "id": node.id,
            "type": "part",
            "material": node_to_material(node),
            "obb": box_to_obb(node.box),
            "label": node.label.value,
            "box": {"low": node.box.low.tolist(), "high": node.box.high.tolist()},
            "source_name": node.source_name,
        }
        | transparent
        | points
    )


def _edge_to_json(edge: Edge, graph: FunctionalGraph) -> dict[str, Any]:
    src, dst = ends_of(edge)
    follows = asdict(edge.coupling) if isinstance(edge, MotionEdge) and edge.coupling else None
    ends = {"src": src, "dst": dst, "kind": kind_of(edge).value, "connector": None}
    return ends | _motion_to_json(edge, graph) | ({"follows": follows} if follows else {})


def _motion_to_json(edge: Edge, graph: FunctionalGraph) -> dict[str, int]:
    if isinstance(edge, Slide | Turn):
        return {f"{kind_of(edge).value}_axis_signed": edge.axis}
    return motion_fields(edge, graph)


def _node_from_json(node_id: str, data: Any) -> PartNode:
    where = f"node `{node_id}`"
    node = read_object(data, where)
    box = read_object(node.get("box"), f"`box` of {where}")
    low, high = (read_vector(box, key, f"the box of {where}", (3,)) for key in ("low", "high"))
    if np.any(high < low):
        raise GraphError(f"the box of {where} must have `high` at least `low`: got {low}, {high}")
    points = PointCloud(read_vector(node, "points", where, (-1, 3))) if node.get("points") else None
    label = read_text(node, "label", where)
    if label not in tuple(PartLabel):
        raise GraphError(f"the label of {where} must be one of {[x.value for x in PartLabel]}: got `{label}`")
    name, transparent = read_text(node, "source_name", where, ""), read_number(node, "transparent", where, 0.0)
    return PartNode(node_id, PartLabel(label), Box(low, high), points, name, transparent)


def _edge_from_json(data: Json) -> Edge:
    src, dst = read_text(data, "src", "an edge"), read_text(data, "dst", "an edge")
    kind = read_text(data, "kind", "an edge")
    if kind not in tuple(EdgeKind):
        raise GraphError(f"the kind of an edge must be one of {[x.value for x in EdgeKind]}: got `{kind}`")
    match EdgeKind(kind):
        case EdgeKind.CONTACT:
            return Contact(src, dst)
        case EdgeKind.ATTACHED:
            return Attached(src, dst)
        case EdgeKind.HINGE:
            border, sign = _code(data, "hinge_border_4", 4), _code(data, "hinge_axis_sign", 2)
            return Hinge(src, dst, border, sign, _coupling_from_json(data))
        case EdgeKind.RAIL:
            return Rail(src, dst, _code(data, "rail_axis_signed", 6), _coupling_from_json(data))
        case EdgeKind.SLIDE:
            return Slide(src, dst, _code(data, "slide_axis_signed", 6), _coupling_from_json(data))
        case EdgeKind.TURN:
            return Turn(src, dst, _code(data, "turn_axis_signed", 6), _coupling_from_json(data))
        case other:
            assert_never(other)


def _coupling_from_json(data: Json) -> Coupling | None:
    if data.get("follows") is None:
        return None
    follows = read_object(data["follows"], "`follows` of an edge")
    multiplier, offset = (read_number(follows, key, "`follows` of an edge") for key in ("multiplier", "offset"))
    if multiplier == 0:
        raise GraphError(f"`follows` of an edge must have a `multiplier` that is not 0: {data['src']}-{data['dst']}")
    return Coupling(read_text(follows, "leader", "`follows` of an edge"), multiplier, offset)


def _code(data: Json, key: str, count: int) -> Any:
    value = read_code(data, key, count)
    if value is None:
        raise GraphError(
            f"a {data['kind']} edge must state `{key}` 0..{count - 1}: {data['src']}-{data['dst']} has none"
        )
    return value


def _decision_from_json(data: Json) -> Decision:
    question = read_text(data, "question", "a decision")
    if question not in get_args(Question):
        raise GraphError(f"`question` of a decision must be one of {get_args(Question)}: got `{question}`")
    return Decision(
        read_text(data, "part", "a decision"),
        question,  # type: ignore[arg-type]
        read_text(data, "choice", "a decision"),
        read_number(data, "score", "a decision"),
        read_text(data, "runner_up", "a decision", ""),
        read_number(data, "runner_up_score", "a decision"),
        read_text(data, "by", "a decision", ""),
    )


def _piece_from_json(data: Json) -> PieceGuess:
    kinds = [read_text(data, key, "`piece`") for key in ("kind", "runner_up")]
    if not set(kinds) <= set(PieceKind):
        raise GraphError(f"`kind` and `runner_up` of `piece` must be of {[x.value for x in PieceKind]}: got {kinds}")
    kind, runner_up = (PieceKind(word) for word in kinds)
    scores = (read_number(data, key, "`piece`") for key in ("score", "runner_up_score"))
    return PieceGuess(kind, next(scores), runner_up, next(scores))


def _ride_from_json(pair: Any) -> tuple[str, str]:
    if not (isinstance(pair, list) and len(pair) == 2 and all(isinstance(name, str) for name in pair)):
        raise GraphError(f"`rides` must be pairs of node ids (moving part, part that rides on it): got {pair!r}")
    return pair[0], pair[1]


def _weighed_from_json(data: Json) -> tuple[tuple[PartLabel, float], ...]:
    try:
        return tuple((PartLabel(word), read_number(data, word, "`weighed`")) for word in data)
    except ValueError as error:
        raise GraphError(f"`weighed` must name part categories: {error}") from None


def _refusal_to_json(refusal: Refusal) -> Json:
    is_too_complex = refusal.reason is Reason.TOO_COMPLEX
    return {"part": refusal.part, "why": refusal.why, "is_too_complex": is_too_complex}


def _refusal_from_json(data: Json) -> Refusal:
    part, why = read_text(data, "part", "a refusal"), read_text(data, "why", "a refusal")
    is_too_complex = data.get("is_too_complex") is True
    return Refusal(part, Reason.TOO_COMPLEX if is_too_complex else Reason.NO_MOTION, why)
