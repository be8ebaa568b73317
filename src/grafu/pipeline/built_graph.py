"""The completed graph as it was built: parts that were added instead of expected nodes, and an edge for each joint.

Where a part was built for a node that the network had added, what was decided about the node is said of the part. It
builds nothing.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from grafu.additions.step import Addition
from grafu.articulation.articulated_object import ArticulatedObject, Coupling, Joint
from grafu.asset.part import AnnotatedJoint, Asset, Part
from grafu.geometry.touching import near_pairs, touching_pairs
from grafu.graph.annotated import joint_edges
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Attached, Contact, Edge, MotionEdge, ends_of
from grafu.graph.edit import with_edges, without_nodes
from grafu.graph.functional_graph import FunctionalGraph, PartNode, is_allowed
from grafu.graph.parse import ParsingConfig
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel


def as_built(
    completion: GraphCompletion,
    asset: Asset,
    additions: Sequence[Addition],
    parsing: ParsingConfig = ParsingConfig(),
) -> GraphCompletion:
    """Returns the completion with the parts that were added; expected nodes that were not built are gone."""
    bare = without_nodes(completion.completed, completion.added)
    new = [addition.part for addition in additions]
    nodes = (*bare.nodes, *(PartNode(p.id, p.label, p.box) for p in new))
    old = [part for part in asset.parts if part.id in bare]
    joined = replace(bare, nodes=nodes)
    graph = with_edges(joined, _edges(old, new, _attached(new, joined), asset.extent, parsing))
    names = _stands_for(completion, new)
    decisions = tuple(
        replace(d, part=names.get(d.part, d.part)) for d in completion.decisions if d.part in bare or d.part in names
    )
    refused = _with_unheld(graph, tuple(r for r in completion.refused if r.part in bare))
    return replace(completion, completed=graph, added=tuple(p.id for p in new), decisions=decisions, refused=refused)


def _with_unheld(graph: FunctionalGraph, refused: tuple[Refusal, ...]) -> tuple[Refusal, ...]:
    """Returns the refusals, and one for each door and drawer that lost its motion with what it was to hang on."""
    answered = graph.moving | {refusal.part for refusal in refused}
    unheld = (node.id for node in graph.nodes if node.label.is_movable and node.id not in answered)
    why = "what it was predicted to hang on was not built"
    return (*refused, *(Refusal(part, Reason.NO_MOTION, why) for part in unheld))


def with_joints(completion: GraphCompletion, made: ArticulatedObject, mounts: Mapping[str, str]) -> GraphCompletion:
    """Returns the completion in which each joint that was built has its edges, from what carries it to what it moves.

    Edges that state so are kept. On a moving part it has one edge, from that part; `mounts` are, by moving part, the
    static parts that hold the hardware of the others. A joint that follows another states that on its edges. What is
    neither door nor drawer and got no joint does not move.
    """
    joints = {joint.child: joint for joint in made.moving_joints if joint.child in completion.completed}
    graph = _without_unbuilt(completion.completed, joints.keys())
    moved = {joint.id: joint.child for joint in made.moving_joints if joint.child in graph}
    still = [n for n in graph.nodes if n.label.is_support and n.id not in graph.moving | joints.keys()]
    edges: list[MotionEdge] = []
    for joint in joints.values():  # what carries others comes before them
        moves = {edge.child for edge in edges}
        carriers = still if joint.parent not in joints else [graph.node(p) for p in moves if p == joint.parent]
        found = _joint_edges(joint, graph, carriers, mounts.get(joint.child, ""))
        edges += (replace(edge, coupling=_coupling(joint, moved)) for edge in found)
    had = {edge.child for edge in edges}
    others = (
        Contact(*ends_of(e)) if isinstance(e, MotionEdge) and e.child in had and e not in edges else e
        for e in graph.edges
    )
    by_ends = {frozenset(ends_of(e)): e for e in (*others, *edges)}
    refused = tuple(r for r in completion.refused if r.part not in had)
    return replace(completion, completed=replace(graph, edges=tuple(by_ends.values())), refused=refused)


def _without_unbuilt(graph: FunctionalGraph, built: Collection[str]) -> FunctionalGraph:
    """Returns the graph in which a part that is neither door nor drawer moves only where it was built."""

    def is_left(edge: Edge) -> bool:
        return not isinstance(edge, MotionEdge) or edge.child in built or graph.node(edge.child).label.is_movable

    edges = tuple(edge if is_left(edge) else Contact(*ends_of(edge)) for edge in graph.edges)
    return graph if edges == graph.edges else replace(graph, edges=edges)


def _joint_edges(joint: Joint, graph: FunctionalGraph, carriers: list[PartNode], mount: str) -> list[MotionEdge]:
    """Returns the edges of a joint: those that it has from what may carry it, else new ones of the same motion."""
    stated = graph.motions_of(joint.child)
    kept = [edge for edge in stated if edge.parent in {node.id for node in carriers}]
    if kept or not carriers:
        return kept
    limits, held = joint.limits, [node for node in carriers if node.id == mount] or carriers
    as_built = AnnotatedJoint(joint.child, joint.type, joint.axis, limits.lower, limits.upper)
    new = joint_edges(as_built, graph, held)
    return [replace(stated[0], parent=edge.parent) for edge in new] if stated else new


def _coupling(joint: Joint, moved: Mapping[str, str]) -> Coupling | None:
    """Returns how a part follows another; None where it follows none, or hardware alone, such as lift arms."""
    if joint.coupling is None or joint.coupling.leader not in moved:
        return None
    return replace(joint.coupling, leader=moved[joint.coupling.leader])


def without_removed(completion: GraphCompletion, removed: frozenset[str], heirs: Sequence[str] = ()) -> GraphCompletion:
    """Returns the completion without parts of the input that were replaced, and what was decided about them.

    What they carried hangs on the nearest of the `heirs`.
    """
    if not removed:
        return completion
    graph = completion.completed
    carried = [e for e in graph.edges if isinstance(e, MotionEdge) and e.parent in removed]
    graph = with_edges(graph, [replace(e, parent=_nearest(heirs, e.parent, graph)) for e in carried if heirs])
    given, completed = (without_nodes(g, removed & {n.id for n in g.nodes}) for g in (completion.input, graph))
    decisions = tuple(d for d in completion.decisions if d.part not in removed)
    refused = _with_unheld(completed, tuple(r for r in completion.refused if r.part not in removed))
    rides = tuple(pair for pair in completion.rides if removed.isdisjoint(pair))
    return replace(completion, input=given, completed=completed, decisions=decisions, refused=refused, rides=rides)


def _nearest(names: Sequence[str], other: str, graph: FunctionalGraph) -> str:
    middle = graph.node(other).box.center
    return min(names, key=lambda name: float(np.linalg.norm(graph.node(name).box.center - middle)))


def _stands_for(completion: GraphCompletion, new: Sequence[Part]) -> dict[str, str]:
    """Returns for expected nodes the added parts that stand for them: of their label, on their parent, the nearest."""
    graph = completion.completed
    parents = {edge.child: edge.parent for edge in graph.attachments}
    found: dict[str, str] = {}
    for name in completion.added:
        node = graph.node(name)
        alike = [p for p in new if p.label is node.label and p.carried_by == parents.get(name)]
        free = [p for p in alike if p.id not in found.values()]
        if free:
            found[name] = min(free, key=lambda p: float(np.linalg.norm(p.box.center - node.box.center))).id
    return found


def _edges(
    old: Sequence[Part], new: Sequence[Part], attached: Sequence[Edge], extent: float, parsing: ParsingConfig
) -> list[Edge]:
    """Returns what new parts touch, and where handles are attached."""
    parts = [*old, *new]
    if parsing.contact == "none":
        return [*attached]
    pairs = [(a, b) for a, b in near_pairs([p.box for p in parts], parsing.box_tolerance * extent) if b >= len(old)]
    if parsing.contact == "mesh":
        pairs = touching_pairs([p.mesh for p in parts], pairs, parsing.mesh_tolerance * extent)
    contacts = [Contact(parts[a].id, parts[b].id) for a, b in pairs]
    joined = {frozenset(ends_of(edge)) for edge in attached}
    return [*(c for c in contacts if frozenset(ends_of(c)) not in joined), *attached]


def _attached(new: Sequence[Part], graph: FunctionalGraph) -> list[Edge]:
    """Returns how new handles are attached; on what is neither door nor drawer the type system has no such edge."""
    handles = [Attached(p.carried_by, p.id) for p in new if p.carried_by and p.label is PartLabel.HANDLE]
    label = {node.id: node.label for node in graph.nodes}
    return [edge for edge in handles if is_allowed(edge, label[edge.parent], label[edge.child])]
