"""The joints and attached parts of an asset as functional edges, and why some cannot be. It completes nothing.

The annotation states the motion and which handle rides where. The mount, which it does not state, is the support
nearest to the pin of a door, or to each flank of a drawer; those that touch the part come before those that do not.
"""

from collections.abc import Container, Iterable, Mapping
from typing import final

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import AnnotatedJoint, Asset
from grafu.dataclass import dataclass
from grafu.errors import GraphError
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.graph.edges import Attached, Hinge, MotionEdge, Rail, Slide, Turn
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import axis_to_hinge, direction_to_code, signed_axis
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

_NOT_STATED = "the annotation states no joint for it"


@final
@dataclass(frozen=True, slots=True)
class AnnotatedEdges:
    """The edges that an asset's own joints and attached parts stand for, and the moving parts that have none.

    All edges of one joint stand together; `refused` also names doors and drawers without a joint.
    """

    edges: tuple[Attached | MotionEdge, ...]
    refused: tuple[Refusal, ...]


def annotated_edges(asset: Asset, graph: FunctionalGraph) -> AnnotatedEdges:
    """Returns an edge for each annotated joint and each handle that rides on a door or drawer of the graph.

    A joint on a moving part joins the two. A joint that nothing could carry, and a door or drawer without a joint, are
    refused with the reason.
    """
    edges: list[Attached | MotionEdge] = list(_attachments(asset, graph))
    refused = {node.id: _NOT_STATED for node in graph.nodes if node.label.is_movable}
    joints = {joint.part: joint for joint in reversed(asset.joints)}  # a part's first joint counts
    still = [node for node in graph.nodes if node.label.is_support and node.id not in joints]
    carriers = {part: carrying_part(part, joints, asset) for part in joints}
    for part in _carriers_first(carriers):
        above, has_edge = carriers[part], {edge.child for edge in edges}
        try:
            if above and above not in has_edge:
                raise GraphError(f"it is on {above}, which nothing carries")
            edges += joint_edges(joints[part], graph, [graph.node(above)] if above else still)
            refused.pop(part, None)
        except GraphError as error:
            refused[part] = str(error)
    return AnnotatedEdges(tuple(edges), tuple(Refusal(part, Reason.NO_MOTION, why) for part, why in refused.items()))


def _carriers_first(carriers: Mapping[str, str]) -> Iterable[str]:
    """Yields parts after the moving part that carries them; those that carry one another in a circle are the last."""
    left = list(carriers)
    while left:
        ready = [part for part in left if carriers[part] not in left] or left
        yield from ready
        left = [part for part in left if part not in ready]


def _attachments(asset: Asset, graph: FunctionalGraph) -> Iterable[Attached]:
    for part in asset.parts:
        parent = part.carried_by
        if parent and part.label is PartLabel.HANDLE and graph.node(parent).label.is_movable:
            yield Attached(parent, part.id)


def carrying_part(moving: str, joints: Container[str], asset: Asset) -> str:
    """Returns the nearest part with a joint that a part rides on; "" where the static body carries it."""
    seen, above = {moving}, asset.part(moving).carried_by
    while above is not None and above not in joints:
        if above in seen:
            return ""
        seen.add(above)
        above = asset.part(above).carried_by
    return "" if above is None or above == moving else above


def joint_edges(joint: AnnotatedJoint, graph: FunctionalGraph, carriers: list[PartNode]) -> list[MotionEdge]:
    """Returns the edges of a joint: a hinge, one or two rails, a slide or a turn.

    `carriers` are the nodes that may carry it: those that do not move, or the one moving part that it is on. Of several
    the one is taken that lies nearest, among those that touch the part if any does.

    Raises:
        GraphError: where nothing could carry it.
    """
    node = graph.node(joint.part)
    touching = graph.neighbours[node.id]
    supports = [other for other in carriers if other.id in touching] or carriers
    if not supports:
        raise GraphError("there is no static part that could carry it")
    slide = direction_to_code(_opening_axis(joint).direction)
    if motion_kind(joint.type).turns:
        mount = _nearest(supports, joint.axis.closest_point(node.box.center))
        if node.label not in (PartLabel.DOOR, PartLabel.UNKNOWN) or slide // 2 == node.box.thin_axis:
            return [Turn(mount, node.id, slide)]
        return [Hinge(mount, node.id, *axis_to_hinge(node.box, _opening_axis(joint)))]
    if node.label in (PartLabel.DRAWER, PartLabel.UNKNOWN):
        across = 0 if slide // 2 == 1 else 1  # the other horizontal axis
        flanks = (node.box.face_center(signed_axis(across, positive)) for positive in (False, True))
        mounts = dict.fromkeys(_nearest(supports, flank) for flank in flanks)
        return [Rail(mount, node.id, slide) for mount in mounts]
    return [Slide(_nearest(supports, node.box.center), node.id, slide)]


def _opening_axis(joint: AnnotatedJoint) -> Axis:
    """Returns the axis along which positive opens: limits that lie mostly below 0 open the other way."""
    low, high = sorted((joint.lower, joint.upper))
    lies_below = joint.limited and -low > high
    return joint.axis.reversed() if lies_below else joint.axis


def _nearest(nodes: list[PartNode], point: Vec3) -> str:
    return min(nodes, key=lambda node: _distance(node.box, point)).id


def _distance(box: Box, point: Vec3) -> float:
    return float(np.linalg.norm(point - np.clip(point, box.low, box.high)))
