"""Where motions come from becomes one plan: from a completed graph, or from the joints that the input states.

Both give initial axes only; what is built from them cannot tell the sources apart.

What hangs on a door or drawer alone moves with it: posts of a bar, a pane, a knob's rose, boards of a drawer. Whatever
a part is called, it falls if nothing holds it. Parts that touch each other, but nothing that is static other than small
things like themselves, are carried by the moving part that they touch: from its outer side or within it, and no larger
than it.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from math import pi

import numpy as np

from grafu.articulation.articulated_object import Coupling, Joint, JointLimits
from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import AnnotatedJoint, Asset, Standing
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.transform import transform_points
from grafu.graph.annotated import carrying_part
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Attached, Hinge, MotionEdge, Rail, SignedAxis, Slide, Turn
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import code_to_direction, hinge_to_axis, opening_face, rail_to_axis
from grafu.joints.plan import JointRequest, PlanConfig, RealizationPlan
from grafu.refusal import Reason, Refusal
from grafu.scene.border import SNAP
from grafu.vocabulary import PartLabel

_HANGING = (PartLabel.MISC, PartLabel.UNKNOWN, PartLabel.HANDLE, PartLabel.BAR)
_ORDER = (Hinge, Rail, Slide, Turn)


def plan_from_annotation(asset: Asset, config: PlanConfig = PlanConfig()) -> RealizationPlan:
    """Returns what the input states: a request per annotated joint, a refusal per door or drawer without one.

    Joints that another system predicted count as stated; each request's source states who stated it. A part that rides
    on a moving part is carried by it; a joint that follows another is coupled to it.
    """
    others = {joint.stated_by for joint in asset.joints} - {"annotation"}
    who = " and ".join(sorted(others)) or "the input"
    joints = {joint.part: joint for joint in reversed(asset.joints)}  # a part's first joint counts
    made = {part: request_of_joint(_in_step(joint, joints), asset, config) for part, joint in joints.items()}
    linked = [_linked(made[part], joints, made, asset) for part in dict.fromkeys(j.part for j in asset.joints)]
    leaders = {request.coupling.leader for request in linked if request.coupling is not None}
    requests = tuple(_stopped(request) if request.moving in leaders else request for request in linked)
    stated = {request.moving for request in requests} | {p.id for p in asset.parts if p.carried_by}
    refused = tuple(
        Refusal(part.id, Reason.NO_MOTION, f"{who} states no joint for it")
        for part in asset.parts
        if part.label.is_movable and part.id not in stated
    )
    return RealizationPlan(requests, refused)


def plan_from_completion(
    completion: GraphCompletion, asset: Asset, config: PlanConfig = PlanConfig()
) -> RealizationPlan:
    """Returns what a completed graph states: a request per hinged or railed part, and the refusals it carries."""
    graph = completion.completed
    known = {part.id for part in asset.parts}
    fixed_to = {part.id: part.carried_by for part in asset.parts if part.carried_by}
    carried = [(moving, part) for moving, part in carried_parts(graph, fixed_to, config) if part in known]
    taken = {*fixed_to, *(part for _, part in carried)}
    carried += [(body, part) for body, part in completion.rides if body in graph.moving and part in known - taken]
    rides = [(edge.parent, edge.child) for edge in (*graph.attachments, *graph.motions) if _is_carried(edge, graph)]
    attached = attached_to(asset, [*rides, *carried])
    motions = sorted(graph.motions, key=lambda edge: _ORDER.index(type(edge)))
    moving = dict.fromkeys(edge.child for edge in motions)
    requests = [_from_graph(part, attached.get(part, ()), completion, asset.standing_of(part)) for part in moving]
    moved = {part for _, part in carried}
    refused = tuple(r for r in completion.refused if r.part not in moved)
    return RealizationPlan(tuple(r for r in requests if r.moving in known), refused)


def _is_carried(edge: Attached | MotionEdge, graph: FunctionalGraph) -> bool:
    """Whether an edge states that a door or drawer, as it moves, takes its child along."""
    return isinstance(edge, Attached) or edge.parent == graph.carrier_of(edge.child)


def _from_graph(
    part: str, attached: tuple[str, ...], completion: GraphCompletion, standing: Standing | None
) -> JointRequest:
    """Returns the request of one part that edges of a completed graph move, along its piece of furniture."""
    graph = completion.completed
    edges, box, carrier = graph.motions_of(part), graph.node(part).box, graph.carrier_of(part)
    first = edges[0]
    axis = hinge_to_axis(box, first.border, first.sign) if isinstance(first, Hinge) else rail_to_axis(box, first.axis)
    axis = axis if standing is None else _along_piece(axis, standing)
    mounts = () if carrier else tuple(edge.parent for edge in edges)
    made = JointRequest(part, first.joint_type, axis, completion.source, None, mounts, attached)
    return replace(made, parent=carrier, coupling=first.coupling)


def _along_piece(axis: Axis, standing: Standing) -> Axis:
    """Returns an axis turned to the nearest one of those that its piece of furniture stands along."""
    own = standing.T_piece_object[:3, :3]  # its rows are the piece's axes in the object frame
    across = own @ axis.direction
    nearest = int(np.argmax(np.abs(across)))
    if abs(float(across[nearest])) > SNAP:
        return axis
    return Axis(axis.point, own[nearest] * np.sign(across[nearest]))


def attached_to(asset: Asset, attachments: Iterable[tuple[str, str]]) -> dict[str, tuple[str, ...]]:
    """Returns the parts attached to each part, by the asset or by `attachments`, and those attached to these."""
    known = {part.id for part in asset.parts}
    below: dict[str, list[str]] = {}
    for parent, child in [*((p.carried_by, p.id) for p in asset.parts if p.carried_by), *attachments]:
        if child in known and child not in below.setdefault(parent, []):
            below[parent].append(child)
    return {parent: tuple(_descendants(parent, below)) for parent in below}


def _descendants(parent: str, below: dict[str, list[str]]) -> list[str]:
    found: list[str] = []
    queue = list(below.get(parent, ()))
    while queue:
        child = queue.pop(0)
        if child not in found and child != parent:
            found.append(child)
            queue += below.get(child, ())
    return found


def request_of_joint(joint: AnnotatedJoint, asset: Asset, config: PlanConfig) -> JointRequest:
    """Returns the request of one annotated joint: signed so that positive opens, drawn ajar if its range shows it."""
    lower, upper = (joint.lower, joint.upper) if joint.limited else (0.0, pi / 2)
    lower, upper = min(lower, upper), max(lower, upper)
    opens_up = abs(upper) >= abs(lower)
    if min(-lower, upper) > config.play * max(-lower, upper):
        opens_up = _closed_end(joint, asset, lower, upper) == lower
    axis = joint.axis if opens_up else joint.axis.reversed()
    before, after = (lower, upper) if opens_up else (-upper, -lower)
    drawn_at = -before if min(-before, after) > config.play * max(-before, after) else 0.0
    reference: float | None = after - before if drawn_at else max(abs(before), abs(after))
    if not joint.limited and motion_kind(joint.type).slides:
        reference = None  # a quarter turn is a door's usual opening; how far a drawer comes out is unknown
    attached = attached_to(asset, ()).get(joint.part, ())
    return JointRequest(joint.part, joint.type, axis, joint.stated_by, reference, (), attached, drawn_at)


def _in_step(joint: AnnotatedJoint, joints: Mapping[str, AnnotatedJoint]) -> AnnotatedJoint:
    """Returns a joint with the range that it has while its leader keeps to its own; as it is where it follows none."""
    if joint.coupling is None or _leads_back(joint, joints):
        return joint
    leader = _in_step(joints[joint.coupling.leader], joints)
    ends = (leader.lower, leader.upper) if leader.limited else (0.0, pi / 2)
    if not leader.limited and motion_kind(leader.type).slides:
        return joint
    lower, upper = sorted(joint.coupling.value(end) for end in ends)
    return replace(joint, lower=lower, upper=upper, limited=True)


def _leads_back(joint: AnnotatedJoint, joints: Mapping[str, AnnotatedJoint]) -> bool:
    """Whether the joints that a joint follows end nowhere: in a circle, or at a part without a joint."""
    seen = {joint.part}
    while joint.coupling is not None:
        leader = joint.coupling.leader
        if leader in seen or leader not in joints:
            return True
        seen.add(leader)
        joint = joints[leader]
    return False


def _linked(
    request: JointRequest, joints: Mapping[str, AnnotatedJoint], made: Mapping[str, JointRequest], asset: Asset
) -> JointRequest:
    """Returns a request with the moving part that carries it and the coupling, in values that count from closed."""
    joint = joints[request.moving]
    parent = carrying_part(request.moving, made, asset)
    if joint.coupling is None or _leads_back(joint, joints):
        return replace(request, parent=parent)
    leader = made[joint.coupling.leader]
    own, its = _sign(request, joint), _sign(leader, joints[leader.moving])
    multiplier = own * joint.coupling.multiplier * its
    offset = own * joint.coupling.offset + request.drawn_at - multiplier * leader.drawn_at
    return replace(request, parent=parent, coupling=Coupling(leader.moving, multiplier, offset))


def _stopped(leader: JointRequest) -> JointRequest:
    """Returns a leader that turns no further than is stated: what follows it would be driven beyond its own range."""
    return replace(leader, stop=leader.reference) if leader.kind.turns and leader.stop is None else leader


def _sign(request: JointRequest, joint: AnnotatedJoint) -> float:
    """Returns 1 where positive values of the stated joint open, else -1."""
    return 1.0 if float(np.dot(request.axis.direction, joint.axis.direction)) > 0 else -1.0


def _closed_end(joint: AnnotatedJoint, asset: Asset, lower: float, upper: float) -> float:
    """Returns the end of a range at which the part lies deeper in the rest of the object: closed."""
    moved = Joint("", joint.type, "", "", joint.axis, JointLimits(0.0, 0.0))
    corners = asset.part(joint.part).box.corners()
    others = {other.part for other in asset.joints}
    body = [p.box for p in asset.parts if p.id not in others and p.carried_by is None]
    whole = Box.around(np.vstack([box.corners() for box in body])) if body else asset.box
    inside = {end: _shared(Box.around(transform_points(moved.motion(end), corners)), whole) for end in (lower, upper)}
    return max((lower, upper), key=lambda end: inside[end])


def _shared(a: Box, b: Box) -> float:
    """Returns the volume of the intersection of two boxes."""
    return float(np.prod(np.maximum(np.minimum(a.high, b.high) - np.maximum(a.low, b.low), 0.0)))


def carried_parts(
    graph: FunctionalGraph, fixed_to: Mapping[str, str], config: PlanConfig = PlanConfig()
) -> tuple[tuple[str, str], ...]:
    """Returns the pairs (moving part, part that it carries) that contacts alone tell.

    Args:
        graph: a completed graph: contacts, hinges and rails.
        fixed_to: by the id of each part of which it is known what carries it, the id of that.
        config: how large such parts may be.
    """
    directions = _directions(graph)
    carrier = dict.fromkeys(directions, "") | dict(fixed_to) | {edge.child: edge.parent for edge in graph.attachments}
    loose = {n.id for n in graph.nodes if n.label in _HANGING and n.id not in carrier}
    if not directions or not loose:
        return ()
    found: list[tuple[str, str]] = []
    for cluster in _clusters(graph, loose):
        touched = {other for part in cluster for other in graph.neighbours[part]} - cluster
        moving_parts = {carrier.get(other, other) or other for other in touched}
        if len(moving_parts) != 1 or not moving_parts <= set(directions):
            continue
        moving = moving_parts.pop()
        nodes = [graph.node(part) for part in cluster]
        if all(_may_carry(graph.node(moving), code_to_direction(directions[moving]), n.box, config) for n in nodes):
            found += [(moving, node.id) for node in graph.nodes if node.id in cluster]
    return tuple(found)


def _directions(graph: FunctionalGraph) -> Mapping[str, SignedAxis]:
    """Returns for each moving part the direction in which it opens."""
    directions: dict[str, SignedAxis] = {rail.child: rail.axis for rail in graph.rails}
    for hinge in graph.hinges:
        directions[hinge.child] = opening_face(graph.node(hinge.child).box.thin_axis, hinge.border, hinge.sign)
    return directions


def _clusters(graph: FunctionalGraph, loose: set[str]) -> list[set[str]]:
    """Returns the loose parts in groups that hang together by contact."""
    left, found = set(loose), []
    while left:
        cluster, queue = set[str](), [min(left)]
        while queue:
            part = queue.pop()
            if part in left:
                left.remove(part)
                cluster.add(part)
                queue += [other for other in graph.neighbours[part] if other in left]
        found.append(cluster)
    return sorted(found, key=lambda cluster: min(cluster))


def _may_carry(moving: PartNode, outward: Vec3, box: Box, config: PlanConfig) -> bool:
    """Whether a box lies before a moving part or within it, inside its outline and clearly smaller."""
    axis = int(np.argmax(np.abs(outward)))
    others = [a for a in range(3) if a != axis]
    inner = moving.box.low[axis] if outward[axis] > 0 else -moving.box.high[axis]
    before = float(box.center @ np.abs(outward)) * float(outward[axis]) >= inner
    spare = config.beyond * moving.box.size
    inside = all(
        box.low[a] >= moving.box.low[a] - spare[a] and box.high[a] <= moving.box.high[a] + spare[a] for a in others
    )
    areas = [float(np.prod(b.size[others])) for b in (box, moving.box)]
    flat = float(box.size[axis]) <= 0.5 * float(moving.box.size[axis])  # a pane may fill its door
    return bool(before and inside and (areas[0] <= config.carried_area * areas[1] or flat))
