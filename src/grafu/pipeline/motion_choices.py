"""Motions that the user states or rejects part by part, for any motion source: in the graph and in the plan.

It searches no hardware; what the codes of a graph cannot say is refused there, and built from the plan all the same.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence, Set
from dataclasses import replace
from math import pi

from grafu.articulation.articulated_object import ArticulatedObject, Joint, VisualRole
from grafu.asset.part import AnnotatedJoint, Asset, Part
from grafu.completion.handles import attach_handles
from grafu.errors import GraphError, OptionError, did_you_mean
from grafu.geometry.box import Box
from grafu.graph.annotated import joint_edges
from grafu.graph.completion import GraphCompletion, decision_of
from grafu.graph.edges import Attached, Contact, Edge, MotionEdge, ends_of
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.functional_graph import FunctionalGraph, is_allowed
from grafu.joints.make_plan import attached_to
from grafu.joints.motion_choice import (
    FOLD_SIDES,
    MotionChoice,
    Moves,
    Side,
    axis_of_motion,
    label_of_motion,
    motion_as_choice,
)
from grafu.joints.plan import JointChoice, JointRequest, RealizationPlan
from grafu.joints.rail_config import DrawerConfig
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

USER = "user"
REJECTED = "the user fixed it"
_OF_MOTIONS = ("mount", "border", "sign", "slide", "turn")

Motions = Mapping[str, MotionChoice]


def motions_of(made: ArticulatedObject) -> dict[str, MotionChoice]:
    """Returns how the parts of an object move, as choices by the id of the part; see `motion_as_choice`.

    A leaf that follows the one that carries it folds, and so does that one; one that follows hardware alone is lifted.
    """
    parts = [v for link in made.links for v in link.visuals if v.role is VisualRole.PART]
    whole = Box.enclosing([visual.mesh.box for visual in parts])
    joints = {joint.child: joint for joint in made.moving_joints}
    moving_bodies = [(visual.mesh, joints[visual.name]) for visual in parts if visual.name in joints]
    found = {joint.child: motion_as_choice(mesh, joint.type, joint.axis, whole) for mesh, joint in moving_bodies}
    choices = {part: choice for part, choice in found.items() if choice is not None}
    return choices | {leaf: fold for joint in made.moving_joints for leaf, fold in _folded(joint, made, choices)}


def _folded(joint: Joint, made: ArticulatedObject, choices: Motions) -> Iterator[tuple[str, MotionChoice]]:
    """Yields a joint's child and the leaf that carries it, where both turn and it follows that, and how both fold.

    A leaf on arms, which are hardware alone, is lifted.
    """
    outer = choices.get(joint.parent)
    if joint.coupling is not None and not len(made.link(joint.parent).body_mesh.faces):
        yield joint.child, MotionChoice(Moves.LIFTS, Side.TOP)
    if joint.coupling is None or outer is None or joint.child not in choices:
        return
    leads = made.joint_of[joint.parent].id == joint.coupling.leader
    turn = {outer.moves, choices[joint.child].moves} == {Moves.TURNS}
    if leads and turn and outer.side in FOLD_SIDES:
        yield from ((leaf, MotionChoice(Moves.FOLDS, outer.side)) for leaf in (joint.parent, joint.child))


def _unknown_parts(asset: Asset, unknown: Sequence[str]) -> str:
    near = did_you_mean(unknown[0], (part.id for part in asset.parts))
    return f"{asset.name} has no {', '.join(unknown)}{near or '; `grafu inspect` lists its parts'}"


def corrected(asset: Asset, labels: Mapping[str, PartLabel]) -> Asset:
    """Returns the asset with the user's categories.

    Raises:
        OptionError: if a part does not exist.
    """
    unknown = sorted(set(labels) - {part.id for part in asset.parts})
    if unknown:
        raise OptionError(f"categories must be of parts: {_unknown_parts(asset, unknown)}")
    parts = (replace(p, label=labels[p.id], labelled_by="user") if p.id in labels else p for p in asset.parts)
    return replace(asset, parts=tuple(parts)) if labels else asset


def require_fronts(asset: Asset, fronts: Collection[str]) -> None:
    """Raises OptionError if a part does not exist for which was chosen what it is grasped by."""
    if unknown := sorted(set(fronts) - {part.id for part in asset.parts}):
        raise OptionError(f"what is grasped must be a part: {_unknown_parts(asset, unknown)}")


def with_moving(
    asset: Asset, motions: Motions, labels: Mapping[str, PartLabel], drawers: DrawerConfig = DrawerConfig()
) -> Asset:
    """Returns the asset whose parts are called what their stated motions make of them, and ride on nothing then.

    `labels` are the categories that were corrected already; `drawers` states what counts as a drawer.

    Raises:
        OptionError: if a part does not exist, or its corrected category moves in another way.
    """
    known = {part.id for part in asset.parts}
    if unknown := sorted(set(motions) - known):
        raise OptionError(f"motions must be of parts: {_unknown_parts(asset, unknown)}")
    if not motions:
        return asset
    return replace(asset, parts=tuple(_moved(p, motions.get(p.id), labels, drawers) for p in asset.parts))


def _moved(part: Part, choice: MotionChoice | None, labels: Mapping[str, PartLabel], drawers: DrawerConfig) -> Part:
    if choice is None:
        return part
    if choice.moves is Moves.FIXED:
        is_called_still = part.labelled_by == "name" and not part.label.is_movable
        return replace(part, labelled_by="user") if is_called_still else part  # no network overrules it
    label = label_of_motion(part, choice, drawers)
    if labels.get(part.id, label) is not label:
        raise OptionError(f"`{part.id}` {choice.moves} and so is a {label}: its category must not be {part.label}")
    return replace(part, label=label, labelled_by="user", carried_by=None)


def with_motions(completion: GraphCompletion, motions: Motions, asset: Asset) -> GraphCompletion:
    """Returns the completed graph with the motions that are stated, and without those that are rejected.

    Handles that no part carries yet go to the doors and drawers that are new.

    Raises:
        OptionError: if a part is to move in a way that it cannot.
    """
    for part, choice in motions.items():
        completion = _with_motion(completion, asset.part(part), choice, asset)
    free = {edge for edge in attach_handles(completion.completed).graph.attachments if edge.parent in motions}
    return replace(completion, completed=with_edges(completion.completed, sorted(free, key=ends_of)))


def _with_motion(completion: GraphCompletion, part: Part, choice: MotionChoice, asset: Asset) -> GraphCompletion:
    before = completion.completed
    graph, on_it = _without_motion(before, part.id), _motions_on(part.id, before)
    decisions = tuple(d for d in completion.decisions if d.part != part.id or d.question not in _OF_MOTIONS)
    refused = tuple(r for r in completion.refused if r.part != part.id)
    if choice.moves is Moves.FIXED:
        fixed = (Refusal(part.id, Reason.REJECTED, REJECTED),) if graph.node(part.id).label.is_movable else ()
        mount = next((edge.parent for edge in before.motions_of(part.id)), "")
        rehung = [replace(edge, parent=mount) if edge.parent == part.id else edge for edge in on_it]
        return replace(completion, completed=with_edges(graph, rehung), decisions=decisions, refused=(*refused, *fixed))
    graph = relabelled(graph, {part.id: part.label})
    joint = AnnotatedJoint(part.id, choice.type, axis_of_motion(part, choice, asset.box), 0.0, pi / 2, stated_by=USER)
    moving = graph.moving | {part.id, *(edge.child for edge in on_it)}
    try:
        edges = joint_edges(joint, graph, [n for n in graph.nodes if n.label.is_support and n.id not in moving])
    except GraphError as error:
        left = dict.fromkeys((part.id, *(edge.child for edge in on_it)))
        unmoved = tuple(Refusal(name, Reason.NO_MOTION, str(error)) for name in left)
        return replace(completion, completed=graph, decisions=decisions, refused=(*refused, *unmoved))
    told = tuple(decision_of(edge) for edge in edges[:1])
    completed = with_edges(graph, [*edges, *on_it])
    return replace(completion, completed=completed, decisions=(*decisions, *told), refused=refused)


def _without_motion(graph: FunctionalGraph, part: str) -> FunctionalGraph:
    """Returns the graph in which a part hangs on nothing and nothing moves on it: such edges are contacts."""
    moved = {part, *(edge.child for edge in _motions_on(part, graph))}
    edges = (
        Contact(*ends_of(e)) if _moves(e, moved) or (isinstance(e, Attached) and e.child == part) else e
        for e in graph.edges
    )
    return replace(graph, edges=tuple(edges))


def _moves(edge: Edge, parts: Set[str]) -> bool:
    return isinstance(edge, MotionEdge) and edge.child in parts


def _motions_on(part: str, graph: FunctionalGraph) -> list[MotionEdge]:
    """Returns the motions on a part, and on what moves on it."""
    found: list[MotionEdge] = []
    queue = [part]
    while queue:
        above = queue.pop(0)
        direct = [edge for edge in graph.motions if edge.parent == above and graph.carrier_of(edge.child) == above]
        found += direct
        queue += [edge.child for edge in direct]
    return found


def with_mounts(completion: GraphCompletion, joints: Mapping[str, JointChoice]) -> GraphCompletion:
    """Returns the completed graph in which parts hang on, or run on, the mounts that were chosen for them."""
    graph = completion.completed
    for part, choice in joints.items():
        found = graph.motions_of(part)
        if not choice.mount or choice.mount not in graph or choice.mount in {edge.parent for edge in found}:
            continue
        for edge in found[:1]:
            hung = replace(edge, parent=choice.mount)
            if is_allowed(hung, graph.node(choice.mount).label, graph.node(part).label):
                others = tuple(Contact(*ends_of(e)) if e == edge else e for e in graph.edges)
                graph = with_edges(replace(graph, edges=others), [hung])
    return completion if graph is completion.completed else replace(completion, completed=graph)


def plan_with_motions(
    plan: RealizationPlan, motions: Motions, completion: GraphCompletion, asset: Asset
) -> RealizationPlan:
    """Returns the plan with the motions that are stated instead of its own, and without those that are rejected.

    Raises:
        OptionError: if a part is to move in a way that it cannot.
    """
    if not motions:
        return plan
    moved = {request.moving for request in plan.joints} | {refusal.part for refusal in plan.refused}
    attachments = ((edge.parent, edge.child) for edge in completion.completed.attachments)
    attached = attached_to(asset, attachments)
    stated = [part for part, choice in motions.items() if choice.moves is not Moves.FIXED]
    kept = tuple(_uncoupled(_without_parts(r, stated), motions) for r in plan.joints if r.moving not in motions)
    requests = [_request(asset.part(p), motions[p], attached.get(p, ()), completion, asset) for p in stated]
    moving_bodies = {request.moving for request in (*kept, *requests)}
    requests = [_without_parts(request, sorted(moving_bodies - {request.moving})) for request in requests]
    refused = tuple(r for r in plan.refused if r.part not in motions)
    still = (p for p, c in motions.items() if c.moves is Moves.FIXED and (p in moved or asset.part(p).label.is_movable))
    rejected = tuple(Refusal(part, Reason.REJECTED, REJECTED) for part in still)
    return RealizationPlan((*kept, *requests), (*refused, *rejected))


def _without_parts(request: JointRequest, moving_bodies: Sequence[str]) -> JointRequest:
    return replace(request, attached=tuple(part for part in request.attached if part not in moving_bodies))


def _uncoupled(request: JointRequest, motions: Motions) -> JointRequest:
    """Returns a request that follows no joint whose motion the user states or rejects."""
    leads = request.coupling is not None and request.coupling.leader in motions
    return replace(request, coupling=None) if leads else request


def _request(
    part: Part, choice: MotionChoice, attached: tuple[str, ...], completion: GraphCompletion, asset: Asset
) -> JointRequest:
    graph = completion.completed
    mounts = tuple(edge.parent for edge in graph.motions_of(part.id))
    axis = axis_of_motion(part, choice, asset.box)
    return JointRequest(part.id, choice.type, axis, USER, None, mounts, attached)
