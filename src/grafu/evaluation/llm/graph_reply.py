"""A language model's completed graph as motions of another system's: every name and code checked, then laid on parts.

It is strict: a reply that names an unknown part or breaks a rule of functional graphs is refused as a whole. New parts
count for its edges alone, as in other predicted graphs: parts are added by our own steps.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated, Any, Literal, final

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, FiniteFloat, ValidationError

from grafu.asset.foreign.motions import ForeignJoint, ForeignMotions, ForeignPart
from grafu.errors import GraphError, ReplyError, did_you_mean
from grafu.evaluation.llm.reply_json import object_in_reply
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.graph.edges import Attached, Edge, Hinge, MotionEdge, Rail, SignedAxis, Slide, Turn
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import AXIS_NAMES, border_to_signed_axis, code_to_direction, face_to_border
from grafu.graph.official_prediction import BorderPin, OfficialRail
from grafu.vocabulary import PartLabel

Direction = Literal["-X", "+X", "-Y", "+Y", "-Z", "+Z"]
Corner = tuple[FiniteFloat, FiniteFloat, FiniteFloat]


class _Replied(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class _NewPart(_Replied):
    id: str
    label: PartLabel
    low: Corner
    high: Corner


class _HingeEdge(_Replied):
    kind: Literal["hinge"]
    parent: str
    child: str
    border: Direction
    axis: Direction


class _AxisEdge(_Replied):
    kind: Literal["rail", "slide", "turn"]
    parent: str
    child: str
    axis: Direction


class _AttachedEdge(_Replied):
    kind: Literal["attached"]
    parent: str
    child: str


class _Completion(_Replied):
    labels: dict[str, PartLabel] = {}
    new_parts: tuple[_NewPart, ...] = ()
    edges: tuple[Annotated[_HingeEdge | _AxisEdge | _AttachedEdge, Field(discriminator="kind")], ...]


@final
@dataclass(frozen=True, slots=True)
class MiddleTurn:
    """A part that turns about a signed axis through the middle of its box."""

    axis: SignedAxis

    def axis_on(self, box: Box) -> Axis:
        """Returns the axis on a box."""
        return Axis(box.center, code_to_direction(self.axis))


@final
@dataclass(frozen=True)
class CompletedByReply:
    """What a reply states of a graph's parts: all labels, and the motions, in the object frame."""

    labels: Mapping[str, PartLabel]
    motions: ForeignMotions


def read_graph_reply(text: str, graph: FunctionalGraph, model: str) -> CompletedByReply:
    """Returns what the reply of a language model states about a graph of contacts.

    Raises:
        ReplyError: if it is no JSON of the form that was asked for, or names a part that is not there.
        GraphError: if its edges break a rule of functional graphs.
        AssetError: if parts carry one another in a circle.
    """
    try:
        stated = _Completion.model_validate(object_in_reply(text, "edges"))
    except ValidationError as error:
        raise ReplyError(_first_fault(error)) from None
    nodes = _with_new_parts(graph, stated)
    relabelled_graph = relabelled(nodes, dict(stated.labels))
    edges = [_edge(one, relabelled_graph) for one in stated.edges]
    carried = {one.child: one.parent for one in stated.edges if one.kind == "attached"}
    completed = with_edges(relabelled_graph, [edge for edge in edges if edge is not None])
    carried |= {edge.child: edge.parent for edge in completed.motions if edge.parent in completed.moving}
    given = {node.id for node in graph.nodes}
    parts = tuple(
        ForeignPart(
            node.id, TriangleMesh.box_mesh(node.box), True, completed.node(node.id).label, carried.get(node.id), slot
        )
        for slot, node in enumerate(graph.nodes)
    )
    known = tuple(replace(part, parent=part.parent if part.parent in given else None) for part in parts)
    joints = {edge.child: _joint(edge, completed) for edge in completed.motions if edge.child in given}
    labels = {part.name: part.label for part in known}
    return CompletedByReply(
        labels, ForeignMotions("grafu-pred", f"the reply of {model}", known, tuple(joints.values()))
    )


def _with_new_parts(graph: FunctionalGraph, stated: _Completion) -> FunctionalGraph:
    """Returns the graph with the parts that a reply adds."""
    new = []
    for part in stated.new_parts:
        low, high = np.array(part.low), np.array(part.high)
        if np.any(high < low):
            raise ReplyError(f"a new part must have `high` at least `low`: got {part.low}, {part.high} of `{part.id}`")
        new.append(PartNode(part.id, part.label, Box(low, high)))
    whole = replace(graph, nodes=(*graph.nodes, *new))
    named = [*stated.labels, *(end for edge in stated.edges for end in (edge.parent, edge.child))]
    unknown = next((name for name in named if name not in whole), None)
    if unknown is not None:
        near = did_you_mean(unknown, (node.id for node in whole.nodes))
        raise ReplyError(f"a reply must name parts by their ids: there is no `{unknown}`{near}")
    return whole


def _edge(stated: _HingeEdge | _AxisEdge | _AttachedEdge, graph: FunctionalGraph) -> Edge | None:
    """Returns an edge of the graph; None for what moves with a part and is no handle, which no edge states."""
    child = graph.node(stated.child)
    if isinstance(stated, _AttachedEdge):
        return Attached(stated.parent, stated.child) if child.label is PartLabel.HANDLE else None
    axis: Any = AXIS_NAMES.index(stated.axis)
    if isinstance(stated, _AxisEdge):
        kinds = {"rail": Rail, "slide": Slide, "turn": Turn}
        return kinds[stated.kind](stated.parent, stated.child, axis)
    thin, face = child.box.thin_axis, AXIS_NAMES.index(stated.border)
    border = face_to_border(thin, face)  # type: ignore[arg-type]  # an index of six names
    sign: Any = axis % 2
    if border_to_signed_axis(thin, border, sign) != axis:
        along = AXIS_NAMES[border_to_signed_axis(thin, border, 1)][1]
        raise GraphError(f"the axis of a hinge of `{child.id}` at {stated.border} runs along {along}: got {stated.axis}")
    return Hinge(stated.parent, stated.child, border, sign)


def _joint(edge: MotionEdge, graph: FunctionalGraph) -> ForeignJoint:
    code: BorderPin | OfficialRail | MiddleTurn
    if isinstance(edge, Hinge):
        code = BorderPin(edge.border, edge.sign)
    elif isinstance(edge, Turn):
        code = MiddleTurn(edge.axis)
    else:
        code = OfficialRail(edge.axis)
    axis = code.axis_on(graph.node(edge.child).box)
    return ForeignJoint(edge.child, edge.joint_type, axis, limited=False, code=code)


def _first_fault(error: ValidationError) -> str:
    first = error.errors()[0]
    where = ".".join(str(step) for step in first["loc"])
    return f"`{where}` of the reply is wrong: {first['msg']}"
