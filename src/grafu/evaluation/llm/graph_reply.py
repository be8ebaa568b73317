"""A language model's completed graph as motions of another system's: every name and code checked, then laid on parts.

It is strict: a reply that names an unknown part or breaks a rule of functional graphs is refused as a whole. New parts
count for its edges alone, as in other predicted graphs: parts are added by our own steps.
"""

from dataclasses import replace
from typing import Annotated, Any, Literal, final

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, FiniteFloat, ValidationError

from grafu.asset.foreign.motions import ForeignJoint, ForeignMotions, ForeignPart
from grafu.dataclass import dataclass
from grafu.errors import GraphError, ReplyError, did_you_mean
from grafu.evaluation.llm.graph_text import numbered
from grafu.evaluation.llm.reply_json import first_fault, object_in_reply
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.graph.edges import Attached, Contact, Edge, Hinge, MotionEdge, Rail, SignedAxis, Slide, Turn, ends_of
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
    """What a reply states of a graph's parts: all labels by id, and the motions, in the object frame."""

    labels: dict[str, PartLabel]
    motions: ForeignMotions


def read_graph_reply(text: str, graph: FunctionalGraph, model: str) -> CompletedByReply:
    """Returns what the reply of a language model states about a graph of contacts, whose parts it names by numbers.

    Raises:
        ReplyError: if it is no JSON of the form that was asked for, or names a part that is not there.
        GraphError: if its edges break a rule of functional graphs.
        AssetError: if parts carry one another in a circle.
    """
    try:
        stated = _Completion.model_validate(object_in_reply(text, "edges"))
    except ValidationError as error:
        raise ReplyError(first_fault(error)) from None
    completed = _completed(graph, stated)
    given = completed.nodes[: len(graph.nodes)]
    names = {node.id for node in given}
    carried = {one.child: one.parent for one in stated.edges if one.kind == "attached"}
    carried |= {edge.child: edge.parent for edge in completed.motions if edge.parent in completed.moving}
    carried = {child: parent for child, parent in carried.items() if parent in names}
    parts = tuple(
        ForeignPart(node.id, TriangleMesh.box_mesh(node.box), True, node.label, carried.get(node.id), slot)
        for slot, node in enumerate(given)
    )
    joints = {edge.child: _joint(edge, completed) for edge in completed.motions if edge.child in names}
    labels = {node.id: new.label for node, new in zip(graph.nodes, given, strict=True)}
    return CompletedByReply(
        labels, ForeignMotions("grafu-pred", f"the reply of {model}", parts, tuple(joints.values()))
    )


def _completed(graph: FunctionalGraph, stated: _Completion) -> FunctionalGraph:
    """Returns the completed graph, parts by their numbers: those of the given graph first, then the new ones."""
    whole = relabelled(_with_new_parts(graph, stated), stated.labels)
    edges = (_edge(one, whole) for one in stated.edges)
    return with_edges(whole, [edge for edge in edges if edge is not None])


def _with_new_parts(graph: FunctionalGraph, stated: _Completion) -> FunctionalGraph:
    """Returns the graph, its parts named by numbers, with the parts that a reply adds.

    Raises:
        ReplyError: if a new part has no box, or the reply names a part that is not there.
    """
    names = numbered(graph)
    contacts = tuple(Contact(names[a], names[b]) for a, b in map(ends_of, graph.edges))
    new = [replace(node, id=names[node.id]) for node in graph.nodes]
    for part in stated.new_parts:
        low, high = np.array(part.low), np.array(part.high)
        if np.any(high < low):
            raise ReplyError(f"a new part must have `high` at least `low`: got {part.low}, {part.high} of `{part.id}`")
        new.append(PartNode(part.id, part.label, Box(low, high)))
    whole = FunctionalGraph(graph.model_id, tuple(new), contacts)
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
        kinds: dict[str, type[Rail | Slide | Turn]] = {"rail": Rail, "slide": Slide, "turn": Turn}
        return kinds[stated.kind](stated.parent, stated.child, axis)
    thin, face = child.box.thin_axis, AXIS_NAMES.index(stated.border)
    border = face_to_border(thin, face)  # type: ignore[arg-type]  # an index of six names
    sign: Any = axis % 2
    if border_to_signed_axis(thin, border, sign) != axis:
        along = AXIS_NAMES[border_to_signed_axis(thin, border, 1)][1]
        raise GraphError(
            f"the axis of a hinge of `{child.id}` at {stated.border} runs along {along}: got {stated.axis}"
        )
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
