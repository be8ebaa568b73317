"""The joints and attached parts of an asset as functional edges, and why some cannot be. It completes nothing.

The annotation states the motion and which handle rides where. The mount, which it does not state, is the support
nearest to the pin of a door, or to each flank of a drawer; those that touch the part come before those that do not.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import AnnotatedJoint, Asset
from grafu.errors import GraphError
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.graph.edges import Attached, Hinge, Rail, Slide
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import axis_to_hinge, axis_to_rail, signed_axis
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

_NOT_STATED = "the annotation states no joint for it"


@final
@dataclass(frozen=True, slots=True)
class AnnotatedEdges:
    """The edges that an asset's own joints and attached parts stand for, and the moving parts that have none.

    All edges of one joint stand together; `refused` also names doors and drawers without a joint.
    """

    edges: tuple[Attached | Hinge | Rail | Slide, ...]
    refused: tuple[Refusal, ...]


def annotated_edges(asset: Asset, graph: FunctionalGraph) -> AnnotatedEdges:
    """Returns an edge for each annotated joint and each handle that rides on a door or drawer of the graph.

    A joint that no edge can express (a door that turns across its plane, a joint on a moving part), and a door or
    drawer without a joint, are refused with the reason.
    """
    edges: list[Attached | Hinge | Rail | Slide] = list(_attachments(asset, graph))
    refused = {node.id: _NOT_STATED for node in graph.nodes if node.label.is_movable}
    joints = {joint.part: joint for joint in reversed(asset.joints)}  # a part's first joint counts
    still = [node for node in graph.nodes if node.label.is_support and node.id not in joints]
    for part, joint in joints.items():
        try:
            if asset.part(part).rides_on in joints:
                raise GraphError(f"a functional graph has no edge for a joint on a moving part: {part} is on one")
            edges += joint_edges(joint, graph, still)
            refused.pop(part, None)
        except GraphError as error:
            refused[part] = str(error)
    return AnnotatedEdges(tuple(edges), tuple(Refusal(part, Reason.NO_MOTION, why) for part, why in refused.items()))


def _attachments(asset: Asset, graph: FunctionalGraph) -> Iterable[Attached]:
    for part in asset.parts:
        parent = part.rides_on
        if parent and part.label is PartLabel.HANDLE and graph.node(parent).label.is_movable:
            yield Attached(parent, part.id)


def joint_edges(joint: AnnotatedJoint, graph: FunctionalGraph, still: list[PartNode]) -> list[Hinge | Rail | Slide]:
    """Returns the hinge, the one or two rails, or the slide of a joint; `still` are the nodes that may carry it.

    Raises:
        GraphError: where the codes cannot say it, or nothing could carry it.
    """
    node = graph.node(joint.part)
    touching = graph.neighbours[node.id]
    supports = [other for other in still if other.id in touching] or still
    if not supports:
        raise GraphError("there is no static part that could carry it")
    if motion_kind(joint.type).turns and node.label in (PartLabel.DOOR, PartLabel.UNKNOWN):
        border, sign = axis_to_hinge(node.box, _opening_axis(joint))
        mount = _nearest(supports, joint.axis.closest_point(node.box.center))
        return [Hinge(mount, node.id, border, sign)]
    if motion_kind(joint.type).slides and node.label in (PartLabel.DRAWER, PartLabel.UNKNOWN):
        slide = axis_to_rail(_opening_axis(joint))
        across = 0 if slide // 2 == 1 else 1  # the other horizontal axis
        flanks = (node.box.face_center(signed_axis(across, positive)) for positive in (False, True))
        mounts = dict.fromkeys(_nearest(supports, flank) for flank in flanks)
        return [Rail(mount, node.id, slide) for mount in mounts]
    if motion_kind(joint.type).slides and node.label is PartLabel.DOOR:
        return [Slide(_nearest(supports, node.box.center), node.id, axis_to_rail(_opening_axis(joint)))]
    raise GraphError(f"a functional graph has no edge for a {node.label} part with a {joint.type} joint")


def _opening_axis(joint: AnnotatedJoint) -> Axis:
    """Returns the axis along which positive opens: limits that lie mostly below 0 open the other way."""
    low, high = sorted((joint.lower, joint.upper))
    lies_below = joint.limited and -low > high
    return joint.axis.reversed() if lies_below else joint.axis


def _nearest(nodes: list[PartNode], point: Vec3) -> str:
    return min(nodes, key=lambda node: _distance(node.box, point)).id


def _distance(box: Box, point: Vec3) -> float:
    return float(np.linalg.norm(point - np.clip(point, box.low, box.high)))
